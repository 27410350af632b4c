/* cli/options.c - the table of options: one line each makes parsing and help. */
#include "cli/cli.h"

#include <ctype.h>
#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI              3.14159265358979323846
#define LONGEST_PAGE_MM 5000

#define PAPER   (CMD_UNFOLD | CMD_FLATTEN)
#define EVERY   (PAPER | CMD_DEFORM | CMD_SIMPLIFY | CMD_INFO | CMD_VERIFY | CMD_WARP)
#define LARGEST 1e9

static bool parse_number(const char *text, double least, double most, double *number) {
    char *end;
    double value = strtod(text, &end);
    if (end == text || *end || !(value >= least && value <= most))
        return false;
    *number = value;
    return true;
}

static bool parse_count(const char *text, uint64_t least, uint64_t most, uint64_t *count) {
    char *end;
    errno = 0;
    unsigned long long value = strtoull(text, &end, 10);
    if (!isdigit((unsigned char)*text) || *end || errno || value < least || value > most)
        return false;
    *count = value;
    return true;
}

static bool parse_count32(const char *text, uint32_t least, uint32_t *count) {
    uint64_t value;
    if (!parse_count(text, least, UINT32_MAX - 1, &value))
        return false;
    *count = (uint32_t)value;
    return true;
}

bool cli_parse_length(const char *text, double *mm) {
    static const struct {
        const char *unit;
        double mm;
    } units[] = {{"", 1}, {"mm", 1}, {"cm", 10}, {"m", 1000}, {"in", 25.4}, {"\"", 25.4}};
    char *end;
    double value = strtod(text, &end);
    if (end == text || !(value >= 0 && value <= LARGEST))
        return false;
    while (*end == ' ')
        end++;
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        if (strcmp(end, units[i].unit) == 0) {
            *mm = value * units[i].mm;
            return true;
        }
    }
    return false;
}

/* The place of `text` in a list of words that ends with NULL; -1 when it is not there. */
static int word_index(const char *text, const char *const *words) {
    for (int i = 0; words[i]; i++)
        if (strcmp(text, words[i]) == 0)
            return i;
    return -1;
}

static bool set_output(settings *s, const char *text) {
    if (s->output_count == CLI_MOST_OUTPUTS) {
        snprintf(s->complaint, sizeof s->complaint, "not more than %d files can be written",
                 CLI_MOST_OUTPUTS);
        return false;
    }
    s->outputs[s->output_count++] = text;
    return true;
}

/* Several files or names for one option. */
static bool add_word(settings *s, word_list *list, const char *text) {
    if (list->count == CLI_MOST_OUTPUTS) {
        snprintf(s->complaint, sizeof s->complaint, "not more than %d can be given",
                 CLI_MOST_OUTPUTS);
        return false;
    }
    list->words[list->count++] = text;
    return true;
}

static bool set_keep(settings *s, const char *text) {
    return add_word(s, &s->keep, text);
}

static bool set_cut(settings *s, const char *text) {
    return add_word(s, &s->cut, text);
}

static bool set_omit(settings *s, const char *text) {
    return *text && add_word(s, &s->omit, text);
}

static bool set_edit(settings *s, const char *text) {
    s->pipeline.edit = text;
    return *text != 0;
}

static bool set_sets(settings *s, const char *text) {
    s->sets = text;
    return *text != 0;
}

static bool set_preview(settings *s, const char *text) {
    s->preview = text;
    return *text != 0;
}

static bool set_faces(settings *s, const char *text) {
    s->faces_given = true;
    s->pipeline.faces = KTG_ALL_FACES;
    return strcmp(text, "all") == 0 || parse_count32(text, 4, &s->pipeline.faces);
}

/* One size decides about all others. */
static bool note_size(settings *s, ktg_size_rule rule, const char *option) {
    if (s->size_given && strcmp(s->size_given, option) != 0) {
        snprintf(s->complaint, sizeof s->complaint, "give one size only, not both %s and %s",
                 s->size_given, option);
        return false;
    }
    s->size_given = option;
    s->pipeline.size_rule = rule;
    return true;
}

static bool set_size(settings *s, ktg_size_rule rule, const char *option, const char *text) {
    return note_size(s, rule, option) && cli_parse_length(text, &s->pipeline.size_mm) &&
           s->pipeline.size_mm > 0;
}

static bool set_height(settings *s, const char *text) {
    return set_size(s, KTG_SIZE_HEIGHT, "--height", text);
}

static bool set_width(settings *s, const char *text) {
    return set_size(s, KTG_SIZE_WIDTH, "--width", text);
}

static bool set_length(settings *s, const char *text) {
    return set_size(s, KTG_SIZE_LENGTH, "--length", text);
}

static bool set_scale(settings *s, const char *text) {
    return note_size(s, KTG_SIZE_FACTOR, "--scale") &&
           parse_number(text, 1e-12, 1e12, &s->pipeline.size_mm);
}

static bool set_sheets(settings *s, const char *text) {
    return note_size(s, KTG_SIZE_FIT, "--sheets") && parse_count32(text, 1, &s->pipeline.sheets) &&
           s->pipeline.sheets <= 1000;
}

static bool set_unit(settings *s, const char *text) {
    static const char *const units[] = {"mm", "cm", "m", "in", NULL};
    static const double mm[] = {1, 10, 1000, 25.4};
    int unit = word_index(text, units);
    s->pipeline.size_mm = unit >= 0 ? mm[unit] : 0;
    return note_size(s, KTG_SIZE_FACTOR, "--unit") && unit >= 0;
}

static bool set_up(settings *s, const char *text) {
    static const char *const axes[] = {"x", "y", "z", NULL};
    int axis = word_index(text, axes);
    s->pipeline.up = axis >= 0 ? (ktg_axis)(KTG_AXIS_X + axis) : KTG_AXIS_AUTO;
    return axis >= 0;
}

static bool set_paper(settings *s, const char *text) {
    ktg_context *context = NULL;
    if (ktg_context_new(&context) != KTG_OK)
        return false;
    ktg_status status = ktg_sheet_parse(context, text, &s->pipeline.layout.sheet);
    s->pipeline.layout.roll = s->pipeline.marker = false;
    s->sheet_given = true;
    if (status != KTG_OK)
        snprintf(s->complaint, sizeof s->complaint, "%s", ktg_context_message(context));
    ktg_context_free(&context);
    return status == KTG_OK;
}

/* A roll: pages as wide as it is, and as long as a PDF's may be. */
static bool set_roll(settings *s, const char *text) {
    ktg_sheet_format *sheet = &s->pipeline.layout.sheet;
    double width_mm;
    if (!cli_parse_length(text, &width_mm) || width_mm < 20 || width_mm > LONGEST_PAGE_MM)
        return false;
    sheet->width_mm = width_mm;
    sheet->height_mm = LONGEST_PAGE_MM;
    strcpy(sheet->name, "the roll");
    s->pipeline.marker = false;
    s->sheet_given = true;
    return s->pipeline.layout.roll = true;
}

/* Fabric is a roll, too; a marker of it is one page as long as a PDF's may be. */
static bool set_fabric_width(settings *s, const char *text) {
    if (!set_roll(s, text))
        return false;
    s->pipeline.layout.sheet.height_mm = KTG_LAYOUT_PAGE_MM;
    strcpy(s->pipeline.layout.sheet.name, "fabric");
    return s->pipeline.marker = true;
}

static bool set_nap(settings *s, const char *text) {
    (void)text;
    return s->pipeline.layout.nap = true;
}

static bool set_landscape(settings *s, const char *text) {
    (void)text;
    s->sheet_given = true;
    ktg_sheet_format *sheet = &s->pipeline.layout.sheet;
    if (ktg_layout_is_page(sheet)) {
        snprintf(s->complaint, sizeof s->complaint,
                 "--landscape turns sheets, not a page as large as the pattern needs");
        return false;
    }
    if (sheet->width_mm < sheet->height_mm && !s->pipeline.layout.roll) {
        double width = sheet->width_mm;
        sheet->width_mm = sheet->height_mm;
        sheet->height_mm = width;
    }
    return true;
}

static bool set_margin(settings *s, const char *text) {
    s->sheet_given = true;
    return cli_parse_length(text, &s->pipeline.layout.sheet.margin_mm);
}

static bool set_gap(settings *s, const char *text) {
    return cli_parse_length(text, &s->pipeline.layout.gap_mm);
}

static bool set_tabs(settings *s, const char *text) {
    s->pipeline.finish.tab_height_mm = 0;
    return strcmp(text, "none") == 0 ||
           (cli_parse_length(text, &s->pipeline.finish.tab_height_mm) &&
            s->pipeline.finish.tab_height_mm <= 100);
}

static bool set_tab_side(settings *s, const char *text) {
    static const char *const sides[] = {"alternate", "smaller", "run", NULL};
    int side = word_index(text, sides);
    s->pipeline.finish.tab_side = side >= 0 ? (ktg_tab_side)side : KTG_TAB_ALTERNATE;
    return side >= 0;
}

static bool set_number(settings *s, const char *text) {
    static const char *const styles[] = {"seam", "edge", "none", NULL};
    int style = word_index(text, styles);
    s->pipeline.finish.numbers = style >= 0 ? (ktg_number_style)style : KTG_NUMBER_SEAM;
    return style >= 0;
}

static bool set_folds(settings *s, const char *text) {
    static const char *const styles[] = {"dashed", "solid", NULL};
    int style = word_index(text, styles);
    s->pipeline.render.folds = style >= 0 ? (ktg_fold_style)style : KTG_FOLDS_DASHED;
    return style >= 0;
}

static bool set_flat(settings *s, const char *text) {
    double degrees;
    if (!parse_number(text, 0, 180, &degrees))
        return false;
    s->pipeline.render.flat_below = degrees * PI / 180;
    return true;
}

static bool set_dpi(settings *s, const char *text) {
    return parse_number(text, 10, 2400, &s->pipeline.render.dots_per_inch);
}

static bool set_black(settings *s, const char *text) {
    (void)text;
    s->pipeline.render.colour = false;
    return true;
}

static bool set_svg_unit(settings *s, const char *text) {
    static const char *const units[] = {"mm", "px72", "px96", NULL};
    int unit = word_index(text, units);
    s->pipeline.render.svg_unit = unit >= 0 ? (ktg_svg_unit)unit : KTG_SVG_MM;
    return unit >= 0;
}

static bool set_real_dashes(settings *s, const char *text) {
    (void)text;
    return s->pipeline.render.real_dashes = true;
}

static bool set_plain_dxf(settings *s, const char *text) {
    (void)text;
    return s->pipeline.render.plain_dxf = true;
}

static bool set_registration(settings *s, const char *text) {
    (void)text;
    return s->pipeline.render.registration = true;
}

static bool set_weight(settings *s, const char *text) {
    static const char *const weights[] = {"cotangent", "unit", NULL};
    int weight = word_index(text, weights);
    s->pipeline.flatten.weight = weight == 1 ? KTG_WEIGHT_UNIT : KTG_WEIGHT_COTANGENT;
    return weight >= 0;
}

static bool set_method_unfold(settings *s, const char *text) {
    static const char *const methods[] = {"auto", "genetic", NULL};
    int method = word_index(text, methods);
    s->pipeline.unfold.method = method == 1 ? KTG_METHOD_GENETIC : KTG_METHOD_AUTO;
    return method >= 0;
}

static bool set_effort(settings *s, const char *text) {
    static const char *const efforts[] = {"quick", "normal", "best", NULL};
    int effort = word_index(text, efforts);
    s->pipeline.unfold.effort = effort >= 0 ? (ktg_effort)effort : KTG_EFFORT_NORMAL;
    s->pipeline.layout.effort = s->pipeline.unfold.effort;
    return effort >= 0;
}

static bool set_oversize(settings *s, const char *text) {
    static const char *const ways[] = {"split", "tile", "scale", "error", NULL};
    int way = word_index(text, ways);
    s->oversize_given = true;
    s->pipeline.large = way >= 0 ? (ktg_large)way : KTG_LARGE_SPLIT;
    return way >= 0;
}

/* Cloth is cut along its seams only. */
static bool set_oversize_flatten(settings *s, const char *text) {
    return strcmp(text, "split") != 0 && set_oversize(s, text);
}

static bool set_overlap(settings *s, const char *text) {
    return cli_parse_length(text, &s->pipeline.overlap_mm);
}

static bool set_pieces(settings *s, const char *text) {
    return parse_count32(text, 1, &s->pipeline.unfold.pieces);
}

static bool set_piece_faces(settings *s, const char *text) {
    return parse_count32(text, 1, &s->pipeline.unfold.piece_faces);
}

static bool set_method_flatten(settings *s, const char *text) {
    static const char *const methods[] = {"arap", "injective", "two-step", NULL};
    int method = word_index(text, methods);
    s->pipeline.flatten.method = method >= 0 ? (ktg_flatten_method)method : KTG_FLATTEN_ARAP;
    return method >= 0;
}

static bool set_population(settings *s, const char *text) {
    return parse_count32(text, 4, &s->pipeline.unfold.population) &&
           s->pipeline.unfold.population <= 10000;
}

static bool set_generations(settings *s, const char *text) {
    return parse_count32(text, 0, &s->pipeline.unfold.generations);
}

static bool set_patience(settings *s, const char *text) {
    return parse_count32(text, 1, &s->pipeline.unfold.patience);
}

static bool set_restarts(settings *s, const char *text) {
    return parse_count32(text, 0, &s->pipeline.unfold.restarts);
}

static bool set_crossover(settings *s, const char *text) {
    return parse_number(text, 0, 1, &s->pipeline.unfold.crossover_rate);
}

static bool set_mutation(settings *s, const char *text) {
    return parse_number(text, 0, 1, &s->pipeline.unfold.mutation_rate);
}

static bool set_seed(settings *s, const char *text) {
    return parse_count(text, 0, UINT64_MAX, &s->seed);
}

static bool set_ease(settings *s, const char *text) {
    return parse_number(text, 0, 10, &s->pipeline.unfold.ease);
}

static bool set_threads(settings *s, const char *text) {
    uint64_t threads;
    if (!parse_count(text, 1, 256, &threads))
        return false;
    s->threads = (uint32_t)threads;
    return true;
}

static bool set_time(settings *s, const char *text) {
    return parse_number(text, 1e-3, 1e9, &s->pipeline.unfold.seconds);
}

static bool set_report(settings *s, const char *text) {
    s->pipeline.report = text;
    return true;
}

static bool set_quiet(settings *s, const char *text) {
    (void)text;
    return s->quiet = true;
}

static bool set_help(settings *s, const char *text) {
    (void)text;
    return s->help = true;
}

static bool set_handles(settings *s, const char *text) {
    s->handles = text;
    return *text != 0;
}

static bool set_warp_weight(settings *s, const char *text) {
    static const char *const weights[] = {"cotangent", "unit", NULL};
    int weight = word_index(text, weights);
    s->warp.weight = weight == 1 ? KTG_WEIGHT_UNIT : KTG_WEIGHT_COTANGENT;
    return weight >= 0;
}

static bool set_refine(settings *s, const char *text) {
    s->warp.refine = KTG_NONE;
    return strcmp(text, "auto") == 0 ||
           (parse_count32(text, 0, &s->warp.refine) && s->warp.refine <= 100000);
}

typedef struct option_line {
    const char *name;
    char letter;
    const char *value; /* what its value is called; NULL: it has none */
    int commands;
    bool (*apply)(settings *s, const char *text);
    const char *help;
} option_line;

static const option_line lines[] = {
    {"output", 'o', "FILE", PAPER, set_output,
     "what to write, by its ending; may be given several times"},
    {"output", 'o', "FILE", CMD_SIMPLIFY | CMD_DEFORM, set_output, "what to write, by its ending"},
    {"edit", 0, "FILE", CMD_DEFORM, set_edit, "what is to be changed"},
    {"edit", 0, "FILE", PAPER, set_edit, "change the model first, as deform does"},
    {"sets", 0, "FILE.obj", CMD_DEFORM, set_sets, "write what the edit selects, as groups"},
    {"preview", 0, "FILE.png", CMD_DEFORM, set_preview, "draw the model before and after"},
    {"output", 'o', "FILE", CMD_WARP, set_output,
     "what to write, by its ending; of a pattern may be given several times"},
    {"handles", 0, "FILE", CMD_WARP, set_handles, "which points go where"},
    {"refine", 0, "N|auto", CMD_WARP, set_refine,
     "N rounds that make it more rigid; auto: only where faces fold over (auto)"},
    {"weights", 0, "cotangent|unit", CMD_WARP, set_warp_weight,
     "weights of the edges; unit is the paper's (cotangent)"},
    {"faces", 'f', "N|all", PAPER | CMD_SIMPLIFY, set_faces, "simplify to N faces, at least 4"},
    {"keep", 0, "FILE", CMD_UNFOLD, set_keep,
     "edges that stay folds: lines of vertex numbers, or OBJ l elements"},
    {"cut", 0, "FILE", CMD_UNFOLD, set_cut, "edges that are cut, named likewise"},
    {"cut", 0, "FILE", CMD_FLATTEN, set_cut,
     "edges that are seams: lines of vertex numbers, or OBJ l elements"},
    {"seams", 0, "LIST", CMD_FLATTEN, cli_set_seams,
     "where seams are: objects,groups,materials,marked,uv,crease,components,auto (the first four; "
     "auto where they give none and the model is no disk)"},
    {"crease", 0, "DEGREES", CMD_FLATTEN, cli_set_crease,
     "for --seams crease: edges at which the surface turns by so much (40)"},
    {"max-strain", 0, "PERCENT", CMD_FLATTEN, cli_set_max_strain,
     "what a panel may strain; --seams auto cuts until 95 % of its area do not strain more (5)"},
    {"fabric", 0, "woven|knit|FILE", CMD_FLATTEN, cli_set_fabric,
     "what the cloth bears along and across its grain; how much of it is strained more is told"},
    {"grain", 0, "PANEL=DEGREES", CMD_FLATTEN, cli_set_grain,
     "turns a panel's grain from upright; may be given several times"},
    {"omit", 0, "GROUP", PAPER, set_omit,
     "leave out a group, object or material; may be given several times"},
    {"height", 0, "LENGTH", PAPER, set_height, "height of the finished model"},
    {"width", 0, "LENGTH", PAPER, set_width, "its width"},
    {"length", 0, "LENGTH", PAPER, set_length, "its length, the third direction"},
    {"scale", 0, "FACTOR", PAPER, set_scale, "millimetres per unit of the model"},
    {"sheets", 0, "N", CMD_UNFOLD, set_sheets, "as large as N sheets allow (1)"},
    {"unit", 0, "mm|cm|m|in", CMD_FLATTEN, set_unit, "the unit of the model file"},
    {"up", 0, "x|y|z", PAPER | CMD_DEFORM, set_up, "which axis is height (STL: z, others: y)"},
    {"paper", 'p', "FORMAT", PAPER | CMD_WARP, set_paper,
     "a0 ... a6, letter, legal, tabloid, ..., WxH, or fit: one page (a4)"},
    {"landscape", 0, NULL, PAPER | CMD_WARP, set_landscape, "turn the sheet"},
    {"roll", 0, "WIDTH", PAPER | CMD_WARP, set_roll,
     "instead of sheets: pages of that width, cut off where the pieces end"},
    {"fabric-width", 0, "WIDTH", CMD_FLATTEN, set_fabric_width,
     "a marker: all pieces on fabric of that width, and how much of it they take"},
    {"nap", 0, NULL, CMD_FLATTEN, set_nap, "the cloth has a nap: no piece lies head down"},
    {"margin", 0, "LENGTH", PAPER | CMD_WARP, set_margin,
     "left free on every side of a sheet (10mm)"},
    {"gap", 0, "LENGTH", PAPER | CMD_WARP, set_gap, "between pieces (2mm)"},
    {"oversize", 0, "split|tile|scale|error", CMD_UNFOLD, set_oversize,
     "what is larger than a sheet: divide it, spread it over sheets, shrink all, fail (split)"},
    {"oversize", 0, "tile|scale|error", CMD_FLATTEN, set_oversize_flatten,
     "what is larger than a sheet: spread it over sheets, shrink it, or fail (tile)"},
    {"overlap", 0, "LENGTH", PAPER | CMD_WARP, set_overlap, "of the sheets of a poster (10mm)"},
    {"pieces", 0, "N", CMD_UNFOLD, set_pieces,
     "divide every part of the model into N pieces; with a size, more where they do not fit"},
    {"max-faces-per-piece", 0, "N", CMD_UNFOLD, set_piece_faces, "no piece has more faces"},
    {"tabs", 0, "LENGTH|none", CMD_UNFOLD, set_tabs, "height of the glue tabs (5mm)"},
    {"tab-side", 0, "alternate|smaller|run", CMD_UNFOLD, set_tab_side,
     "which side of a seam gets the tabs, where there is room (alternate)"},
    {"number", 0, "seam|edge|none", CMD_UNFOLD, set_number, "what is numbered (seam)"},
    {"folds", 0, "dashed|solid", CMD_UNFOLD, set_folds,
     "mountain dashed, valley dash-dot; or mountain solid, valley dashed (dashed)"},
    {"flat", 0, "DEGREES", CMD_UNFOLD, set_flat, "folds flatter than this are not drawn (1)"},
    {"allowance", 0, "LENGTH", CMD_FLATTEN | CMD_WARP, cli_set_allowance, "along seams (10mm)"},
    {"hem", 0, "LENGTH", CMD_FLATTEN | CMD_WARP, cli_set_hem,
     "along borders that are sewn to nothing (20mm)"},
    {"notch", 0, "LENGTH|none", CMD_FLATTEN | CMD_WARP, cli_set_notch,
     "length of the marks that meet when a seam is sewn (5mm)"},
    {"notch-every", 0, "LENGTH", CMD_FLATTEN | CMD_WARP, cli_set_notch_every,
     "a seam has a mark for each such length (250mm)"},
    {"on-fold", 0, "PANEL", CMD_FLATTEN, cli_set_on_fold,
     "cut that symmetric panel on the fold of the cloth: half of it is printed; may be given "
     "several times"},
    {"no-strain-map", 0, NULL, CMD_FLATTEN | CMD_WARP, cli_set_no_strain_map,
     "leave out the PDF's page that shows where the cloth strains"},
    {"no-twins", 0, NULL, CMD_FLATTEN, cli_set_no_twins,
     "print each panel, also the mirror image of another one"},
    {"method", 0, "auto|genetic", CMD_UNFOLD, set_method_unfold,
     "transplants, or the paper's genetic merging (auto)"},
    {"effort", 0, "quick|normal|best", PAPER, set_effort,
     "work spent on a compact net and on nesting pieces (normal)"},
    {"ease", 0, "WEIGHT", CMD_UNFOLD, set_ease,
     "0 to 10: how much an easy assembly counts against size and tabs (0)"},
    {"method", 0, "arap|injective|two-step", CMD_FLATTEN, set_method_flatten,
     "as rigid as possible, injective where that folds; always injective; or the two linear steps "
     "of Igarashi & Igarashi 2009 (arap)"},
    {"weights", 0, "cotangent|unit", CMD_FLATTEN, set_weight,
     "weights of the edges for two-step (cotangent)"},
    {"population", 0, "N", CMD_UNFOLD, set_population, "chromosomes in a generation (32)"},
    {"generations", 0, "N", CMD_UNFOLD, set_generations, "at most this many (2000)"},
    {"patience", 0, "N", CMD_UNFOLD, set_patience, "stop after N generations without gain (30)"},
    {"crossover", 0, "RATE", CMD_UNFOLD, set_crossover, "crossover rate (0.8)"},
    {"mutation", 0, "RATE", CMD_UNFOLD, set_mutation, "mutation rate (0.1)"},
    {"restarts", 0, "N", CMD_UNFOLD, set_restarts,
     "fresh starts while there is more than one piece (20)"},
    {"seed", 0, "N", CMD_UNFOLD, set_seed, "another seed gives another net (1)"},
    {"threads", 0, "N", CMD_UNFOLD, set_threads,
     "processors to use at most (all); the net is the same for any number"},
    {"time", 0, "SECONDS", CMD_UNFOLD, set_time, "stop searching after that time"},
    {"black", 0, NULL, PAPER | CMD_WARP, set_black, "no colours"},
    {"dpi", 0, "N", PAPER | CMD_WARP, set_dpi, "resolution of PNG pictures (150)"},
    {"svg-unit", 0, "mm|px72|px96", PAPER, set_svg_unit,
     "what a unit of an SVG is, for cutters that read pixels (mm)"},
    {"real-dashes", 0, NULL, PAPER, set_real_dashes,
     "SVG, DXF: dashes are short lines of their own, for cutters that know no others"},
    {"plain-dxf", 0, NULL, CMD_FLATTEN, set_plain_dxf,
     "a DXF for cutters, one for each sheet, instead of one for garment CAD (ASTM D6673)"},
    {"registration", 0, NULL, PAPER, set_registration,
     "marks in the margins by which a cutter finds the print"},
    {"report", 0, "FILE.json", PAPER | CMD_DEFORM, set_report, "write the figures of the run"},
    {"quiet", 'q', NULL, EVERY, set_quiet, "say nothing but errors"},
    {"help", 'h', NULL, EVERY, set_help, "show this"},
};

enum { LINE_COUNT = sizeof lines / sizeof *lines };

void cli_print_options(FILE *stream, int command) {
    for (int i = 0; i < LINE_COUNT; i++) {
        if (!(lines[i].commands & command))
            continue;
        char left[64];
        const char *value = lines[i].value ? lines[i].value : "";
        char letter[8] = "    ";
        if (lines[i].letter)
            snprintf(letter, sizeof letter, "-%c, ", lines[i].letter);
        snprintf(left, sizeof left, "%s--%s %s", letter, lines[i].name, value);
        if (strlen(left) > 30)
            fprintf(stream, "  %s\n  %-30s  %s\n", left, "", lines[i].help);
        else
            fprintf(stream, "  %-30s  %s\n", left, lines[i].help);
    }
}

/* getopt's tables for one command; code 256 + i stands for line i. */
static void make_tables(int command, struct option *longs, char *shorts) {
    size_t length = 0;
    shorts[length++] = ':';
    for (int i = 0; i < LINE_COUNT; i++) {
        if (!(lines[i].commands & command))
            continue;
        *longs++ = (struct option){lines[i].name, lines[i].value ? required_argument : no_argument,
                                   NULL, 256 + i};
        if (lines[i].letter) {
            shorts[length++] = lines[i].letter;
            if (lines[i].value)
                shorts[length++] = ':';
        }
    }
    *longs = (struct option){0};
    shorts[length] = 0;
}

static const option_line *line_of(int code, int command) {
    if (code >= 256)
        return &lines[code - 256];
    for (int i = 0; i < LINE_COUNT; i++)
        if (lines[i].letter == code && (lines[i].commands & command))
            return &lines[i];
    return NULL;
}

static bool refuse(const char *command, const char *what, const char *text) {
    fprintf(stderr, "katagami %s: %s", command, what);
    cli_print_safe(stderr, text);
    fprintf(stderr, "; see katagami %s --help\n", command);
    return false;
}

/* After getopt's '?': a short option it does not know is in optopt, and may stand among others in
 * one word; a long one was the word before optind. */
static bool refuse_option(char **argv) {
    char letter[3] = {'-', (char)optopt, 0};
    if (optopt >= 256)
        return refuse(argv[0], "no value is wanted in ", argv[optind - 1]);
    return refuse(argv[0], "there is no option ", optopt ? letter : argv[optind - 1]);
}

static bool apply_line(const option_line *line, settings *s, const char *command) {
    if (line->apply(s, optarg))
        return true;
    fprintf(stderr, "katagami %s: ", command);
    if (s->complaint[0]) {
        cli_print_safe(stderr, s->complaint);
    } else {
        fprintf(stderr, "--%s wants %s, not '", line->name, line->value);
        cli_print_safe(stderr, optarg);
        fputc('\'', stderr);
    }
    fputc('\n', stderr);
    return false;
}

/* The format is read before --landscape turns it, wherever the two stand. */
static bool run_options(int argc, char **argv, int command, bool landscape_pass, settings *s) {
    struct option longs[LINE_COUNT + 1];
    char shorts[2 * LINE_COUNT + 2];
    make_tables(command, longs, shorts);
    optind = 0;
    int code;
    while ((code = getopt_long(argc, argv, shorts, longs, NULL)) != -1) {
        if (code == '?')
            return refuse_option(argv);
        if (code == ':')
            return refuse(argv[0], "a value is missing after ", argv[optind - 1]);
        const option_line *line = line_of(code, command);
        if ((line->apply == set_landscape) == landscape_pass && !apply_line(line, s, argv[0]))
            return false;
    }
    return true;
}

bool cli_read_options(int argc, char **argv, int command, int least_arguments, int most_arguments,
                      settings *s) {
    *s = (settings){.seed = 1};
    ktg_pipeline_defaults(&s->pipeline);
    ktg_warp_defaults(&s->warp);
    if (!run_options(argc, argv, command, false, s) || !run_options(argc, argv, command, true, s))
        return false;
    if (s->help)
        return true;
    s->argument_count = argc - optind;
    if (s->argument_count < least_arguments)
        return refuse(argv[0], "a file is missing", "");
    if (s->argument_count > most_arguments)
        return refuse(argv[0], "one file too many: ", argv[optind + most_arguments]);
    for (int i = 0; i < s->argument_count; i++)
        s->arguments[i] = argv[optind + i];
    return true;
}
