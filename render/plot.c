/* render/plot.c - a sheet as paths and texts, sorted by what is done with them. */
#include "render/plot.h"

#include "core/memory.h"
#include "render/text.h"

#include <stdio.h>

const ktg_layer_look *ktg_layer_look_of(ktg_layer layer) {
    static const ktg_layer_look looks[KTG_LAYER_COUNT] = {
        [KTG_LAYER_SHEET] = {"sheet", "Sheet", "SHEET", 0x808080, 8},
        [KTG_LAYER_CALIBRATION] = {"calibration", "Calibration 50 mm", "CALIBRATION", 0x00b050, 3},
        [KTG_LAYER_REGISTRATION] = {"registration", "Registration", "REGISTRATION", 0x202020, 250},
        [KTG_LAYER_POSTER] = {"poster", "Poster joins", "POSTER", 0xa0a0a0, 9},
        [KTG_LAYER_TEXT] = {"text", "Text", "TEXT", 0x505050, 252},
        [KTG_LAYER_JOINT] = {"joint", "Edge to edge", "EDGE_TO_EDGE", 0x8b5a2b, 34},
        [KTG_LAYER_MOUNTAIN] = {"mountain", "Mountain", "MOUNTAIN", 0xb3261e, 1},
        [KTG_LAYER_VALLEY] = {"valley", "Valley", "VALLEY", 0x1f5fbf, 5},
        [KTG_LAYER_TAB_FOLD] = {"tab-folds", "Tab folds", "TAB_FOLD", 0xe07b00, 30},
        [KTG_LAYER_INTERNAL] = {"internal", "Internal", "INTERNAL", 0x909000, 52},
        [KTG_LAYER_SEW] = {"sew", "Sew", "SEW", 0x00803c, 94},
        [KTG_LAYER_GRAIN] = {"grain", "Grain", "GRAIN", 0x00a0a0, 4},
        [KTG_LAYER_PLACE_FOLD] = {"place-on-fold", "Place on fold", "PLACE_ON_FOLD", 0x7030c0, 200},
        [KTG_LAYER_DART] = {"dart", "Dart", "DART", 0x0070c0, 150},
        [KTG_LAYER_NOTCH] = {"notch", "Notch", "NOTCH", 0xd000a0, 6},
        [KTG_LAYER_CUT] = {"cut", "Cut", "CUT", 0x000000, 7},
    };
    return &looks[layer];
}

unsigned ktg_plot_layers(const ktg_plot *plot) {
    unsigned layers = 0;
    for (size_t i = 0; i < plot->path_count; i++)
        layers |= 1u << plot->paths[i].layer;
    for (size_t i = 0; i < plot->text_count; i++)
        layers |= 1u << plot->texts[i].layer;
    return layers;
}

void ktg_plot_number(double value, char text[KTG_NUMBER_SIZE]) {
    long long scaled = llround(fmin(fmax(value, -1e12), 1e12) * 1e4);
    const char *sign = scaled < 0 ? "-" : "";
    scaled = scaled < 0 ? -scaled : scaled;
    int used =
        snprintf(text, KTG_NUMBER_SIZE, "%s%lld.%04lld", sign, scaled / 10000, scaled % 10000);
    while (text[used - 1] == '0')
        text[--used] = 0;
    if (text[used - 1] == '.')
        text[--used] = 0;
}

/* ---- adding ------------------------------------------------------------------------------- */

static ktg_status add_whole(ktg_plot *plot, ktg_layer layer, ktg_stroke stroke,
                            const ktg_vec2 *points, size_t count, bool closed) {
    ktg_context *context = plot->page.drawing->context;
    if (count < 2)
        return KTG_OK;
    KTG_TRY(ktg_reserve(context, &plot->points, &plot->point_capacity, plot->point_count + count));
    KTG_TRY(ktg_reserve(context, &plot->paths, &plot->path_capacity, plot->path_count + 1));
    plot->paths[plot->path_count++] =
        (ktg_plot_path){layer, stroke, plot->point_count, count, closed};
    for (size_t i = 0; i < count; i++)
        plot->points[plot->point_count++] = points[i];
    return KTG_OK;
}

/* What lies in the box of the way from `from` to `to` (Liang and Barsky 1984), as parts of it. */
static bool clip(const double box[4], ktg_vec2 from, ktg_vec2 to, double *begin, double *end) {
    const double step[] = {from.x - to.x, to.x - from.x, from.y - to.y, to.y - from.y};
    const double room[] = {from.x - box[0], box[2] - from.x, from.y - box[1], box[3] - from.y};
    *begin = 0;
    *end = 1;
    for (int k = 0; k < 4; k++) {
        if (step[k] == 0 && room[k] < 0)
            return false;
        if (step[k] < 0)
            *begin = fmax(*begin, room[k] / step[k]);
        else if (step[k] > 0)
            *end = fmin(*end, room[k] / step[k]);
    }
    return *begin < *end;
}

/* A path in pieces, where it leaves the box and comes back. */
static ktg_status add_clipped(ktg_plot *plot, ktg_layer layer, ktg_stroke stroke,
                              const ktg_vec2 *points, size_t count, bool closed) {
    ktg_vec2 *run = ktg_new(plot->page.drawing->context, count + 2, ktg_vec2);
    if (!run)
        return KTG_MEMORY;
    ktg_status status = KTG_OK;
    size_t used = 0;
    for (size_t i = 0; status == KTG_OK && i + (closed ? 0 : 1) < count; i++) {
        ktg_vec2 a = points[i], b = points[(i + 1) % count], way = ktg_sub2(b, a);
        double begin, end;
        bool inside = clip(plot->page.sheet->printable, a, b, &begin, &end);
        if (inside && used == 0)
            run[used++] = ktg_madd2(a, begin, way);
        if (inside)
            run[used++] = ktg_madd2(a, end, way);
        if (inside && end >= 1)
            continue;
        status = add_whole(plot, layer, stroke, run, used, false);
        used = 0;
    }
    if (status == KTG_OK)
        status = add_whole(plot, layer, stroke, run, used, false);
    ktg_free(run);
    return status;
}

static bool is_inside(const double box[4], ktg_vec2 p) {
    return p.x >= box[0] && p.x <= box[2] && p.y >= box[1] && p.y <= box[3];
}

ktg_status ktg_plot_add(ktg_plot *plot, ktg_layer layer, ktg_stroke stroke, const ktg_vec2 *points,
                        size_t count, bool closed) {
    const ktg_pattern_sheet *sheet = plot->page.sheet;
    bool is_whole = sheet->kind != KTG_TILE || layer < KTG_LAYER_TEXT;
    for (size_t i = 0; i < count && !is_whole; i++) {
        if (!is_inside(sheet->printable, points[i]))
            return add_clipped(plot, layer, stroke, points, count, closed);
    }
    return add_whole(plot, layer, stroke, points, count, closed);
}

ktg_status ktg_plot_write(ktg_plot *plot, const ktg_plot_text *text) {
    ktg_context *context = plot->page.drawing->context;
    char clean[2 * KTG_TITLE_SIZE];
    ktg_text_clean(text->text, SIZE_MAX, clean, sizeof clean);
    bool shown = plot->page.sheet->kind != KTG_TILE || text->layer < KTG_LAYER_TEXT ||
                 is_inside(plot->page.sheet->printable, text->at);
    if (!*clean || !shown)
        return KTG_OK;
    KTG_TRY(ktg_reserve(context, &plot->texts, &plot->text_capacity, plot->text_count + 1));
    ktg_plot_text *added = &plot->texts[plot->text_count];
    *added = *text;
    added->text = ktg_copy_text(context, clean, SIZE_MAX);
    if (!added->text)
        return KTG_MEMORY;
    ktg_text_set(plot->page.cairo, KTG_FACE_PLAIN, text->height_mm);
    added->width = ktg_text_width(plot->page.cairo, clean);
    plot->text_count++;
    return KTG_OK;
}

/* ---- a piece ------------------------------------------------------------------------------ */

static ktg_layer layer_of_line(ktg_line_kind kind) {
    switch (kind) {
    case KTG_LINE_SEW:
        return KTG_LAYER_SEW;
    case KTG_LINE_GRAIN:
        return KTG_LAYER_GRAIN;
    case KTG_LINE_FOLD:
        return KTG_LAYER_PLACE_FOLD;
    case KTG_LINE_DART:
        return KTG_LAYER_DART;
    case KTG_LINE_NOTCH:
        return KTG_LAYER_NOTCH;
    default:
        return KTG_LAYER_INTERNAL;
    }
}

#define HEAD_MM 4.0

static ktg_status add_head(ktg_plot *plot, ktg_vec2 tip, ktg_vec2 from) {
    ktg_vec2 back = ktg_sub2(from, tip), along = ktg_unit2(back), side = ktg_perp2(along);
    double length = fmin(HEAD_MM, ktg_length2(back) / 4);
    ktg_vec2 foot = ktg_madd2(tip, length, along);
    ktg_vec2 head[] = {ktg_madd2(foot, length / 3, side), tip, ktg_madd2(foot, -length / 3, side)};
    return ktg_plot_add(plot, KTG_LAYER_GRAIN, KTG_STROKE_GRAIN, head, 3, false);
}

static ktg_status add_line(ktg_plot *plot, const ktg_pattern_placement *at,
                           const ktg_pattern_line *line) {
    size_t count = line->point_count;
    ktg_vec2 *points = ktg_new(plot->page.drawing->context, count, ktg_vec2);
    if (!points)
        return KTG_MEMORY;
    for (size_t i = 0; i < count; i++)
        points[i] = ktg_plot_point(at, line->points[i]);
    bool closed = count > 3 && line->points[0].x == line->points[count - 1].x &&
                  line->points[0].y == line->points[count - 1].y;
    ktg_status status =
        ktg_plot_add(plot, layer_of_line(line->kind), ktg_stroke_of_line(line->kind), points,
                     closed ? count - 1 : count, closed);
    if (status == KTG_OK && line->kind == KTG_LINE_GRAIN && count > 1) {
        status = add_head(plot, points[0], points[1]);
        if (status == KTG_OK)
            status = add_head(plot, points[count - 1], points[count - 2]);
    }
    ktg_free(points);
    return status;
}

static ktg_status add_label(ktg_plot *plot, const ktg_pattern_placement *at,
                            const ktg_pattern_label *label) {
    ktg_placed_label placed;
    if (label->leader) {
        ktg_vec2 way[] = {ktg_plot_point(at, label->at), ktg_plot_point(at, label->foot)};
        KTG_TRY(ktg_plot_add(plot, KTG_LAYER_TEXT, KTG_STROKE_INTERNAL, way, 2, false));
    }
    if (!ktg_label_place(&plot->page, at, label, &placed))
        return KTG_OK;
    ktg_vec2 middle = {placed.at.x, plot->page.sheet->height_mm - placed.at.y};
    return ktg_plot_write(plot, &(ktg_plot_text){KTG_LAYER_TEXT, placed.text, middle, false,
                                                 placed.angle, label->height_mm});
}

static ktg_status add_piece(ktg_plot *plot, const ktg_pattern_placement *at) {
    const ktg_pattern_piece *piece = &plot->page.drawing->pattern->pieces[at->piece];
    for (size_t i = 0; i < piece->line_count; i++)
        KTG_TRY(add_line(plot, at, &piece->lines[i]));
    for (size_t i = 0; i < piece->label_count; i++)
        KTG_TRY(add_label(plot, at, &piece->labels[i]));
    return KTG_OK;
}

static ktg_status add_joints(ktg_plot *plot, const ktg_pattern_placement *at) {
    const ktg_drawing *drawing = plot->page.drawing;
    for (size_t i = 0; i < drawing->joint_count; i++) {
        const ktg_joint_mark *mark = &drawing->joints[i];
        ktg_vec2 corners[3];
        for (int k = 0; k < 3; k++)
            corners[k] = ktg_plot_point(at, mark->corners[k]);
        if (mark->piece == at->piece)
            KTG_TRY(ktg_plot_add(plot, KTG_LAYER_JOINT, KTG_STROKE_JOINT, corners, 3, false));
    }
    return KTG_OK;
}

/* ---- a sheet ------------------------------------------------------------------------------ */

static ktg_status collect(ktg_plot *plot) {
    const ktg_pattern_sheet *sheet = plot->page.sheet;
    KTG_TRY(ktg_check_cancel(plot->page.drawing->context));
    KTG_TRY(ktg_plot_marks(plot));
    KTG_TRY(ktg_plot_folds(plot));
    for (size_t i = 0; i < sheet->placement_count; i++) {
        KTG_TRY(add_piece(plot, &sheet->placements[i]));
        KTG_TRY(add_joints(plot, &sheet->placements[i]));
    }
    return ktg_plot_cuts(plot);
}

/* Text is measured on a surface that nobody sees. */
ktg_status ktg_plot_make(const ktg_drawing *drawing, size_t number, ktg_plot *plot) {
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
    cairo_t *cairo = cairo_create(surface);
    *plot = (ktg_plot){.page = {drawing, &drawing->pattern->sheets[number], number, cairo}};
    ktg_page_begin(cairo);
    ktg_status status = collect(plot);
    cairo_status_t measured = cairo_status(cairo);
    cairo_destroy(cairo);
    cairo_surface_destroy(surface);
    plot->page.cairo = NULL;
    if (status == KTG_OK)
        status = ktg_cairo_status(drawing->context, NULL, measured, "the sheet");
    if (status == KTG_OK)
        ktg_progress(drawing->context, "render",
                     (double)(number + 1) / (double)drawing->pattern->sheet_count, NULL);
    return status;
}

void ktg_plot_drop(ktg_plot *plot) {
    for (size_t i = 0; i < plot->text_count; i++)
        ktg_free(plot->texts[i].text);
    ktg_free(plot->texts);
    ktg_free(plot->paths);
    ktg_free(plot->points);
    *plot = (ktg_plot){0};
}
