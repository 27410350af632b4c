/* cli/options.c - what each option does, and the table of them: one line each makes parsing and
 * help. */
#include "cli/option_lines.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI              3.14159265358979323846
#define LONGEST_PAGE_MM 5000

#define PAPER         (CMD_UNFOLD | CMD_FLATTEN)
#define EVERY         (PAPER | CMD_DEFORM | CMD_SIMPLIFY | CMD_INFO | CMD_VERIFY | CMD_WARP)
#define LARGEST       1e9
#define LEAST_SIZE_MM 1e-6 /* of a finished model */

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
           s->pipeline.size_mm >= LEAST_SIZE_MM;
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

static bool set_no_guide(settings *s, const char *text) {
    (void)text;
    s->pipeline.render.guide = false;
    return true;
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

static bool set_texture(settings *s, const char *text) {
    (void)text;
    s->pipeline.colours = KTG_COLOURS_ON;
    return true;
}

static bool set_no_texture(settings *s, const char *text) {
    (void)text;
    s->pipeline.colours = KTG_COLOURS_OFF;
    return true;
}

static bool set_textures_anywhere(settings *s, const char *text) {
    (void)text;
    return s->pipeline.textures_anywhere = true;
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
    s->pipeline.layout.effort = s->pipeline.flatten.effort = s->pipeline.unfold.effort;
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

/* The format is read before --landscape turns it, wherever the two stand. */
const option_line cli_option_lines[] = {
    {"output", 'o', "FILE", PAPER, false, set_output,
     "what to write, by its ending; may be given several times"},
    {"output", 'o', "FILE", CMD_SIMPLIFY | CMD_DEFORM, false, set_output,
     "what to write, by its ending"},
    {"edit", 0, "FILE", CMD_DEFORM, false, set_edit, "what is to be changed"},
    {"edit", 0, "FILE", PAPER, false, set_edit, "change the model first, as deform does"},
    {"sets", 0, "FILE.obj", CMD_DEFORM, false, set_sets, "write what the edit selects, as groups"},
    {"preview", 0, "FILE.png", CMD_DEFORM, false, set_preview, "draw the model before and after"},
    {"output", 'o', "FILE", CMD_WARP, false, set_output,
     "what to write, by its ending; of a pattern may be given several times"},
    {"handles", 0, "FILE", CMD_WARP, false, set_handles, "which points go where"},
    {"refine", 0, "N|auto", CMD_WARP, false, set_refine,
     "N rounds that make it more rigid; auto: only where faces fold over (auto)"},
    {"weights", 0, "cotangent|unit", CMD_WARP, false, set_warp_weight,
     "weights of the edges; unit is the paper's (cotangent)"},
    {"faces", 'f', "N|all", PAPER | CMD_SIMPLIFY, false, set_faces,
     "simplify to N faces, at least 4"},
    {"keep", 0, "FILE", CMD_UNFOLD, false, set_keep,
     "edges that stay folds: lines of vertex numbers, or OBJ l elements"},
    {"cut", 0, "FILE", CMD_UNFOLD, false, set_cut, "edges that are cut, named likewise"},
    {"cut", 0, "FILE", CMD_FLATTEN, false, set_cut,
     "edges that are seams: lines of vertex numbers, or OBJ l elements"},
    {"seams", 0, "LIST", CMD_FLATTEN, false, cli_set_seams,
     "where seams are: objects,groups,materials,marked,uv,crease,components,auto (the first four; "
     "auto where they give none and the model is no disk)"},
    {"crease", 0, "DEGREES", CMD_FLATTEN, false, cli_set_crease,
     "for --seams crease: edges at which the surface turns by so much (40)"},
    {"max-strain", 0, "PERCENT", CMD_FLATTEN, false, cli_set_max_strain,
     "what a panel may strain; --seams auto cuts until 95 % of its area do not strain more (5)"},
    {"fabric", 0, "woven|knit|FILE", CMD_FLATTEN, false, cli_set_fabric,
     "what the cloth bears along and across its grain; how much of it is strained more is told"},
    {"grain", 0, "PANEL=DEGREES", CMD_FLATTEN, false, cli_set_grain,
     "turns a panel's grain from upright; may be given several times"},
    {"omit", 0, "GROUP", PAPER, false, set_omit,
     "leave out a group, object or material; may be given several times"},
    {"height", 0, "LENGTH", PAPER, false, set_height, "height of the finished model"},
    {"width", 0, "LENGTH", PAPER, false, set_width, "its width"},
    {"length", 0, "LENGTH", PAPER, false, set_length, "its length, the third direction"},
    {"scale", 0, "FACTOR", PAPER, false, set_scale, "millimetres per unit of the model"},
    {"sheets", 0, "N", CMD_UNFOLD, false, set_sheets, "as large as N sheets allow (1)"},
    {"unit", 0, "mm|cm|m|in", CMD_FLATTEN, false, set_unit, "the unit of the model file"},
    {"up", 0, "x|y|z", PAPER | CMD_DEFORM, false, set_up,
     "which axis is height (STL: z, others: y)"},
    {"paper", 'p', "FORMAT", PAPER | CMD_WARP, false, set_paper,
     "a0 ... a6, letter, legal, tabloid, ..., WxH, or fit: one page (a4)"},
    {"landscape", 0, NULL, PAPER | CMD_WARP, true, set_landscape, "turn the sheet"},
    {"roll", 0, "WIDTH", PAPER | CMD_WARP, false, set_roll,
     "instead of sheets: pages of that width, cut off where the pieces end"},
    {"fabric-width", 0, "WIDTH", CMD_FLATTEN, false, set_fabric_width,
     "a marker: all pieces on fabric of that width, and how much of it they take"},
    {"nap", 0, NULL, CMD_FLATTEN, false, set_nap, "the cloth has a nap: no piece lies head down"},
    {"margin", 0, "LENGTH", PAPER | CMD_WARP, false, set_margin,
     "left free on every side of a sheet (10mm)"},
    {"gap", 0, "LENGTH", PAPER | CMD_WARP, false, set_gap, "between pieces (2mm)"},
    {"oversize", 0, "split|tile|scale|error", CMD_UNFOLD, false, set_oversize,
     "what is larger than a sheet: divide it, spread it over sheets, shrink all, fail (split)"},
    {"oversize", 0, "tile|scale|error", CMD_FLATTEN, false, set_oversize_flatten,
     "what is larger than a sheet: spread it over sheets, shrink it, or fail (tile)"},
    {"overlap", 0, "LENGTH", PAPER | CMD_WARP, false, set_overlap,
     "of the sheets of a poster (10mm)"},
    {"pieces", 0, "N", CMD_UNFOLD, false, set_pieces,
     "divide every part of the model into N pieces; with a size, more where they do not fit"},
    {"max-faces-per-piece", 0, "N", CMD_UNFOLD, false, set_piece_faces, "no piece has more faces"},
    {"tabs", 0, "LENGTH|none", CMD_UNFOLD, false, set_tabs, "height of the glue tabs (5mm)"},
    {"tab-side", 0, "alternate|smaller|run", CMD_UNFOLD, false, set_tab_side,
     "which side of a seam gets the tabs, where there is room (alternate)"},
    {"number", 0, "seam|edge|none", CMD_UNFOLD, false, set_number, "what is numbered (seam)"},
    {"folds", 0, "dashed|solid", CMD_UNFOLD, false, set_folds,
     "mountain dashed, valley dash-dot; or mountain solid, valley dashed (dashed)"},
    {"flat", 0, "DEGREES", CMD_UNFOLD, false, set_flat,
     "folds flatter than this are not drawn (1)"},
    {"allowance", 0, "LENGTH", CMD_FLATTEN | CMD_WARP, false, cli_set_allowance,
     "along seams (10mm)"},
    {"hem", 0, "LENGTH", CMD_FLATTEN | CMD_WARP, false, cli_set_hem,
     "along borders that are sewn to nothing (20mm)"},
    {"notch", 0, "LENGTH|none", CMD_FLATTEN | CMD_WARP, false, cli_set_notch,
     "length of the marks that meet when a seam is sewn (5mm)"},
    {"notch-every", 0, "LENGTH", CMD_FLATTEN | CMD_WARP, false, cli_set_notch_every,
     "a seam has a mark for each such length (250mm)"},
    {"on-fold", 0, "PANEL", CMD_FLATTEN, false, cli_set_on_fold,
     "cut that symmetric panel on the fold of the cloth: half of it is printed; may be given "
     "several times"},
    {"no-strain-map", 0, NULL, CMD_FLATTEN | CMD_WARP, false, cli_set_no_strain_map,
     "leave out the PDF's page that shows where the cloth strains"},
    {"no-twins", 0, NULL, CMD_FLATTEN, false, cli_set_no_twins,
     "print each panel, also the mirror image of another one"},
    {"method", 0, "auto|genetic", CMD_UNFOLD, false, set_method_unfold,
     "transplants, or the paper's genetic merging (auto)"},
    {"effort", 0, "quick|normal|best", PAPER, false, set_effort,
     "work spent on a compact net, on where seams of cloth go and on nesting pieces (normal)"},
    {"ease", 0, "WEIGHT", CMD_UNFOLD, false, set_ease,
     "0 to 10: how much an easy assembly counts against size and tabs (0)"},
    {"method", 0, "arap|injective|two-step", CMD_FLATTEN, false, set_method_flatten,
     "as rigid as possible, injective where that folds; always injective; or the two linear steps "
     "of Igarashi & Igarashi 2009 (arap)"},
    {"weights", 0, "cotangent|unit", CMD_FLATTEN, false, set_weight,
     "weights of the edges for two-step (cotangent)"},
    {"population", 0, "N", CMD_UNFOLD, false, set_population, "chromosomes in a generation (32)"},
    {"generations", 0, "N", CMD_UNFOLD, false, set_generations, "at most this many (2000)"},
    {"patience", 0, "N", CMD_UNFOLD, false, set_patience,
     "stop after N generations without gain (30)"},
    {"crossover", 0, "RATE", CMD_UNFOLD, false, set_crossover, "crossover rate (0.8)"},
    {"mutation", 0, "RATE", CMD_UNFOLD, false, set_mutation, "mutation rate (0.1)"},
    {"restarts", 0, "N", CMD_UNFOLD, false, set_restarts,
     "fresh starts while there is more than one piece (20)"},
    {"seed", 0, "N", CMD_UNFOLD, false, set_seed, "another seed gives another net (1)"},
    {"threads", 0, "N", CMD_UNFOLD, false, set_threads,
     "processors to use at most (all); the net is the same for any number"},
    {"time", 0, "SECONDS", CMD_UNFOLD, false, set_time, "stop searching after that time"},
    {"no-guide", 0, NULL, CMD_UNFOLD, false, set_no_guide,
     "leave out the PDF's pages that tell how to build the model"},
    {"black", 0, NULL, PAPER | CMD_WARP, false, set_black, "no colours"},
    {"dpi", 0, "N", PAPER | CMD_WARP, false, set_dpi, "resolution of PNG pictures (150)"},
    {"svg-unit", 0, "mm|px72|px96", PAPER, false, set_svg_unit,
     "what a unit of an SVG is, for cutters that read pixels (mm)"},
    {"real-dashes", 0, NULL, PAPER, false, set_real_dashes,
     "SVG, DXF: dashes are short lines of their own, for cutters that know no others"},
    {"plain-dxf", 0, NULL, CMD_FLATTEN, false, set_plain_dxf,
     "a DXF for cutters, one for each sheet, instead of one for garment CAD (ASTM D6673)"},
    {"texture", 0, NULL, PAPER, false, set_texture,
     "print the model's images and colours, also where it has one colour all over, or is cloth"},
    {"no-texture", 0, NULL, PAPER, false, set_no_texture, "leave the faces white"},
    {"textures-anywhere", 0, NULL, PAPER, false, set_textures_anywhere,
     "read images and material files outside the model's folder, too"},
    {"registration", 0, NULL, PAPER, false, set_registration,
     "marks in the margins by which a cutter finds the print"},
    {"report", 0, "FILE.json", PAPER | CMD_DEFORM, false, set_report,
     "write the figures of the run"},
    {"quiet", 'q', NULL, EVERY, false, set_quiet, "say nothing but errors"},
    {"help", 'h', NULL, EVERY, false, set_help, "show this"},
};

_Static_assert(sizeof cli_option_lines / sizeof *cli_option_lines <= CLI_MOST_OPTIONS,
               "more options than option_lines.h has room for");

const int cli_option_count = sizeof cli_option_lines / sizeof *cli_option_lines;
