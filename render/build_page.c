/* render/build_page.c - "How to build it": how its pages are filled. */
#include "render/build_guide.h"

#include "core/memory.h"

#include <stdio.h>

#define GAP_MM     4.0
#define CELL_MM    52.0 /* the least width of a step's picture, on usual paper ... */
#define SMALL_MM   38.0 /* ... and on small paper */
#define SMALL_PAGE 120.0
#define CELL_HIGH  0.82 /* of its width */
#define MODEL_HIGH 0.8
#define TEXT_MM    1.9
#define TITLE_MM   2.3
#define LEAST_PAGE 100.0 /* on smaller or larger sheets the guide is on A4 */
#define MOST_PAGE  430.0

bool ktg_build_guide_is_wanted(const ktg_drawing *drawing) {
    const ktg_pattern *pattern = drawing->pattern;
    return drawing->options.guide && pattern->mode == KTG_PAPER && pattern->face_count > 0 &&
           pattern->vertex_count > 0;
}

ktg_status ktg_build_guide_new(const ktg_drawing *drawing, ktg_build_guide **guide) {
    *guide = ktg_new(drawing->context, 1, ktg_build_guide);
    if (!*guide)
        return KTG_MEMORY;
    (*guide)->drawing = drawing;
    ktg_status status = ktg_guide_find_steps(*guide);
    if (status != KTG_OK)
        ktg_build_guide_free(guide);
    return status;
}

void ktg_build_guide_size(const ktg_drawing *drawing, double *width_mm, double *height_mm) {
    const ktg_pattern_sheet *sheet = &drawing->pattern->sheets[0];
    bool usual = fmin(sheet->width_mm, sheet->height_mm) >= LEAST_PAGE &&
                 fmax(sheet->width_mm, sheet->height_mm) <= MOST_PAGE;
    *width_mm = usual ? sheet->width_mm : 210;
    *height_mm = usual ? sheet->height_mm : 297;
}

bool ktg_build_guide_is_done(const ktg_build_guide *guide) {
    return guide->has_begun && guide->next_step == guide->step_count;
}

/* ---- the head ----------------------------------------------------------------------------- */

static void write_facts(const ktg_build_guide *g, ktg_column *at) {
    const ktg_pattern *p = g->drawing->pattern;
    char details[KTG_DETAIL_COUNT][KTG_DETAIL_SIZE], text[KTG_WORDS_SIZE];
    size_t count = ktg_furniture_details(g->drawing, SIZE_MAX, details), numbered = 0;
    for (size_t s = 0; s < p->seam_count; s++)
        numbered += g->low[s] > 0;
    snprintf(text, sizeof text, "%s. %zu piece%s on %s. %zu seam%s with numbers, %u step%s.",
             count > 2 ? details[count - 2] : "", p->piece_count, p->piece_count == 1 ? "" : "s",
             details[0], numbered, numbered == 1 ? "" : "s", g->step_count,
             g->step_count == 1 ? "" : "s");
    if (text[0] >= 'a' && text[0] <= 'z')
        text[0] = (char)(text[0] - 'a' + 'A');
    ktg_column_wrap(at, KTG_FACE_PLAIN, TEXT_MM, text, false);
    ktg_words_paper(g, text);
    ktg_column_wrap(at, KTG_FACE_PLAIN, TEXT_MM, text, false);
    ktg_column_wrap(at, KTG_FACE_PLAIN, TEXT_MM,
                    "Tools: scissors or a knife on a mat; a ruler and an empty ballpoint pen to "
                    "score folds; white glue, a thin coat; tweezers for small tabs.",
                    false);
}

static void write_rules(const ktg_build_guide *g, ktg_column *at) {
    if (g->step_count == 0)
        return;
    ktg_column_wrap(at, KTG_FACE_PLAIN, TEXT_MM,
                    "Score the folds, cut, and fold everything once, tabs too. Then glue the seams "
                    "in the order of their numbers, tab under edge.",
                    false);
    ktg_column_wrap(at, KTG_FACE_PLAIN, TEXT_MM,
                    "Begin a seam at the end where the paper is closed already, and close it from "
                    "there like a zip. Edges without a number meet in a narrow notch: close it as "
                    "soon as a seam comes to it.",
                    false);
}

static void draw_key(ktg_column *at) {
    static const struct {
        uint32_t colour;
        const char *words;
    } keys[] = {{KTG_GUIDE_NOW, "this step; its seams are thick lines"},
                {KTG_GUIDE_BEFORE, "built before"},
                {KTG_GUIDE_OPEN, "still open"}};
    double x = at->x, size = TEXT_MM * 1.3 * at->scale;
    ktg_text_set(at->cairo, KTG_FACE_PLAIN, TEXT_MM * at->scale);
    cairo_set_dash(at->cairo, NULL, 0, 0);
    for (size_t k = 0; k < sizeof keys / sizeof *keys; k++) {
        uint32_t c = keys[k].colour;
        cairo_rectangle(at->cairo, x, at->y, 1.6 * size, size);
        cairo_set_source_rgb(at->cairo, (c >> 16 & 255) / 255.0, (c >> 8 & 255) / 255.0,
                             (c & 255) / 255.0);
        cairo_fill_preserve(at->cairo);
        cairo_set_source_rgb(at->cairo, 0.3, 0.3, 0.3);
        cairo_set_line_width(at->cairo, 0.12);
        cairo_stroke(at->cairo);
        cairo_set_source_rgb(at->cairo, 0.15, 0.15, 0.15);
        ktg_text_draw(at->cairo, x + 2.2 * size, at->y + size * 0.88, keys[k].words);
        x += 2.2 * size + ktg_text_width(at->cairo, keys[k].words) + 2.5 * size;
    }
    at->y += 2.2 * size;
}

static ktg_status draw_models(const ktg_build_guide *g, ktg_column *at) {
    static const char *const names[] = {"From the front", "From behind"};
    double width = (at->width - GAP_MM) / 2, height = MODEL_HIGH * width;
    height = fmin(height, fmax(20, (at->floor - at->y) * 0.6));
    for (int k = 0; k < 2; k++) {
        double x = at->x + k * (width + GAP_MM);
        ktg_column under = *at;
        KTG_TRY(ktg_guide_draw_model(g, at->cairo, (ktg_area){x, at->y, x + width, at->y + height},
                                     k > 0));
        under.x = x;
        under.y += height + 1;
        under.width = width;
        ktg_column_wrap(&under, KTG_FACE_PLAIN, TEXT_MM, names[k], false);
    }
    at->y += height + 1 + 3 * TEXT_MM * at->scale;
    return KTG_OK;
}

static ktg_status draw_head(ktg_build_guide *g, ktg_column *at) {
    ktg_column_write(at, KTG_FACE_BOLD, 3.6, 0, "How to build it");
    ktg_column_write(at, KTG_FACE_BOLD, 2.6, 0, g->drawing->title);
    write_facts(g, at);
    ktg_column_skip(at, 1.5);
    KTG_TRY(draw_models(g, at));
    write_rules(g, at);
    ktg_column_skip(at, 1.5);
    if (g->step_count > 0)
        draw_key(at);
    g->has_begun = true;
    return KTG_OK;
}

/* ---- steps -------------------------------------------------------------------------------- */

static bool has_picture(const ktg_build_guide *g, uint32_t step) {
    return g->steps[step].seam_count >= g->picture_least;
}

/* The pieces of the body that are there once the step is done. */
static void show_pieces(ktg_build_guide *g, uint32_t step) {
    for (uint32_t f = 0; f < g->drawing->pattern->face_count; f++) {
        uint32_t piece = g->piece_of[f];
        g->shown[f] = piece != KTG_NONE && g->part_of[piece] == g->steps[step].part &&
                      g->first_step[piece] > 0 && g->first_step[piece] <= step + 1;
    }
}

/* What is written under a step's picture, or with `dry` only how high that is. */
static double write_step(const ktg_build_guide *g, uint32_t step, ktg_column at, const char *eye,
                         const char *missing, bool dry) {
    char text[KTG_WORDS_SIZE];
    double y = at.y;
    ktg_words_title(g, step, text);
    ktg_column_wrap(&at, KTG_FACE_BOLD, TITLE_MM, text, dry);
    ktg_words_step(g, step, text);
    ktg_column_wrap(&at, KTG_FACE_PLAIN, TEXT_MM, text, dry);
    if (*eye) {
        snprintf(text, sizeof text, "(Seen %s%s%s.)", eye, *missing ? "; " : "", missing);
        ktg_column_wrap(&at, KTG_FACE_PLAIN, 0.85 * TEXT_MM, text, dry);
    }
    return at.y - y;
}

/* Draws a step at the column's place; its height comes out. */
static ktg_status draw_step(ktg_build_guide *g, uint32_t step, ktg_column at, double *height) {
    ktg_named_eye eye = {.name = ""};
    char missing[KTG_WORDS_SIZE] = "";
    double picture = has_picture(g, step) ? CELL_HIGH * at.width : 0;
    if (picture > 0) {
        KTG_TRY(ktg_check_cancel(g->drawing->context));
        show_pieces(g, step);
        KTG_TRY(ktg_guide_choose_eye(g, step, &eye));
        if (*eye.name)
            KTG_TRY(ktg_guide_draw_step(g, step, at.cairo,
                                        (ktg_area){at.x, at.y, at.x + at.width, at.y + picture},
                                        &eye, missing));
        at.y += picture + 1;
    }
    *height = write_step(g, step, at, eye.name, missing, false) + (picture > 0 ? picture + 1 : 0);
    return KTG_OK;
}

static double height_of_step(const ktg_build_guide *g, uint32_t step, ktg_column at) {
    double height = write_step(g, step, at, "from the front right, high above",
                               "not seen from here: 1, 2, 3, 4", true);
    return height + (has_picture(g, step) ? CELL_HIGH * at.width + 1 : 0);
}

static ktg_status draw_steps(ktg_build_guide *g, ktg_column *at, bool is_empty) {
    double least = at->width < SMALL_PAGE ? SMALL_MM : CELL_MM;
    uint32_t columns = (uint32_t)fmax(1, floor((at->width + GAP_MM) / (least + GAP_MM)));
    ktg_column cell = *at;
    cell.width = (at->width - (columns - 1) * GAP_MM) / columns;
    while (g->next_step < g->step_count) {
        uint32_t left = g->step_count - g->next_step, count = left < columns ? left : columns;
        double high = 0, row = 0;
        for (uint32_t k = 0; k < count; k++)
            high = fmax(high, height_of_step(g, g->next_step + k, cell));
        if (!is_empty && cell.y + high > at->floor)
            return KTG_OK;
        for (uint32_t k = 0; k < count; k++) {
            cell.x = at->x + k * (cell.width + GAP_MM);
            KTG_TRY(draw_step(g, g->next_step + k, cell, &high));
            row = fmax(row, high);
        }
        g->next_step += count;
        cell.y += row + GAP_MM;
        is_empty = false;
    }
    return KTG_OK;
}

ktg_status ktg_build_guide_draw(ktg_build_guide *guide, cairo_t *cairo, double width_mm,
                                double height_mm) {
    double margin = fmin(15, fmin(width_mm, height_mm) / 10);
    double scale = fmax(0.8, fmin(1, width_mm / 150));
    ktg_column at = {guide->drawing,     cairo, margin, margin, width_mm - 2 * margin,
                     height_mm - margin, scale};
    bool is_first = !guide->has_begun;
    ktg_page_begin(cairo);
    if (is_first)
        KTG_TRY(draw_head(guide, &at));
    return draw_steps(guide, &at, !is_first);
}
