/* render/build_page.c - "How to build it": how its pages are filled. */
#include "render/build_guide.h"

#include "core/memory.h"
#include "render/furniture.h"
#include "render/text.h"

#include <stdio.h>
#include <string.h>

#define GAP_MM       4.0
#define CELL_MM      52.0 /* the least width of a step's picture, on usual paper ... */
#define SMALL_MM     38.0 /* ... and on small paper */
#define SMALL_PAGE   120.0
#define MOST_CELL_MM 100.0
#define CELL_HIGH    0.82 /* of its width */
#define MODEL_HIGH   0.8
#define TEXT_MM      1.9
#define TITLE_MM     2.3
#define LEAST_PAGE   100.0 /* on smaller or larger sheets the guide is on A4 */
#define MOST_PAGE    430.0

bool ktg_build_guide_is_wanted(const ktg_drawing *drawing) {
    const ktg_pattern *pattern = drawing->pattern;
    return drawing->options.guide && pattern->mode == KTG_PAPER && pattern->seam_count > 0 &&
           pattern->vertex_count > 0;
}

ktg_status ktg_build_guide_new(const ktg_drawing *drawing, ktg_build_guide **guide) {
    *guide = ktg_new(drawing->context, 1, ktg_build_guide);
    if (!*guide)
        return KTG_MEMORY;
    (*guide)->drawing = drawing;
    ktg_status status = ktg_guide_find_steps(*guide);
    if (status == KTG_OK)
        status = ktg_guide_choose_eyes(*guide);
    for (uint32_t k = 0; status == KTG_OK && k < (*guide)->step_count; k++)
        (*guide)->cell_count += (*guide)->steps[k].eye_count > 1 ? 2 : 1;
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
    return guide->has_begun && guide->next_cell == guide->cell_count;
}

/* ---- the head ----------------------------------------------------------------------------- */

static void write_facts(const ktg_build_guide *g, ktg_column *at) {
    const ktg_pattern *p = g->drawing->pattern;
    char details[KTG_DETAIL_COUNT][KTG_DETAIL_SIZE], text[KTG_WORDS_SIZE];
    size_t count = ktg_furniture_details(g->drawing, SIZE_MAX, details), numbered = 0;
    for (size_t s = 0; s < p->seam_count; s++)
        numbered += g->low[s] > 0;
    size_t seams = numbered > 0 ? numbered : p->seam_count;
    int used = snprintf(text, sizeof text, "%s. %zu piece%s on %s. %zu seam%s%s",
                        count > 2 ? details[count - 2] : "", p->piece_count,
                        p->piece_count == 1 ? "" : "s", details[0], seams, seams == 1 ? "" : "s",
                        numbered > 0 ? " with numbers" : "");
    if (g->step_count > 0)
        snprintf(text + used, sizeof text - (size_t)used, ", %u step%s.", g->step_count,
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

static bool has_numbers(const ktg_build_guide *g) {
    for (uint32_t k = 0; k < g->step_count; k++)
        if (g->steps[k].low > 0)
            return true;
    return false;
}

static void write_rules(const ktg_build_guide *g, ktg_column *at) {
    if (g->step_count == 0)
        return;
    ktg_column_wrap(at, KTG_FACE_PLAIN, TEXT_MM,
                    has_numbers(g)
                        ? "Score the folds, cut, and fold everything once, tabs too. Then glue the "
                          "seams in the order of their numbers, tab under edge."
                        : "Score the folds, cut, and fold everything once, tabs too. Then glue the "
                          "seams step by step, tab under edge.",
                    false);
    ktg_column_wrap(at, KTG_FACE_PLAIN, TEXT_MM,
                    "Begin a seam at the end where the paper is closed already (a dot in the "
                    "pictures), and close it from there like a zip.",
                    false);
    if (has_numbers(g))
        ktg_column_wrap(at, KTG_FACE_PLAIN, TEXT_MM,
                        "Edges without a number meet in narrow notches (thin red lines here): "
                        "close those beside a seam before the seam.",
                        false);
    if (g->drawing->pattern->piece_count > 1 && ktg_guide_has_bodies(g))
        ktg_column_wrap(at, KTG_FACE_PLAIN, TEXT_MM,
                        "Bodies that no seam joins are built one by one; put them together as the "
                        "pictures show. For the last seam of a body put glue on all its tabs at "
                        "once, then press the paper down on them.",
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
        uint32_t c = ktg_drawing_colour(at->drawing, keys[k].colour);
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

/* A step's picture and text, or its second picture. */
typedef struct cell {
    uint32_t step;
    int eye;
} cell;

static cell find_cell(const ktg_build_guide *g, uint32_t number) {
    cell c = {0, 0};
    for (;; c.step++) {
        uint32_t cells = g->steps[c.step].eye_count > 1 ? 2 : 1;
        if (number < cells)
            break;
        number -= cells;
    }
    c.eye = (int)number;
    return c;
}

/* "(Seen from behind; 3 is not seen.)" */
static void write_eye(const ktg_build_guide *g, cell c, ktg_column *at, bool dry) {
    const ktg_step *step = &g->steps[c.step];
    char text[2 * KTG_WORDS_SIZE], missing[KTG_WORDS_SIZE] = "";
    if (step->eye_count == 0)
        return;
    if (c.eye + 1 == step->eye_count && !dry)
        ktg_words_missing(g, c.step, missing);
    if (c.eye > 0)
        snprintf(text, sizeof text, "Step %u ", c.step + 1);
    else
        snprintf(text, sizeof text, "Seen ");
    size_t used = strlen(text);
    snprintf(text + used, sizeof text - used, "%s%s%s.", step->eyes[c.eye].name,
             *missing ? "; hidden: " : "", missing);
    ktg_column_wrap(at, KTG_FACE_PLAIN, 0.9 * TEXT_MM, text, dry);
}

/* What is written under a cell's picture, or with `dry` only how high that is. */
static double write_cell(const ktg_build_guide *g, cell c, ktg_column at, bool dry) {
    char text[KTG_WORDS_SIZE];
    double y = at.y;
    if (c.eye == 0) {
        ktg_words_title(g, c.step, text);
        ktg_column_wrap(&at, KTG_FACE_BOLD, TITLE_MM, text, dry);
        ktg_words_step(g, c.step, text);
        ktg_column_wrap(&at, KTG_FACE_PLAIN, TEXT_MM, text, dry);
    }
    write_eye(g, c, &at, dry);
    return at.y - y;
}

static double picture_height(const ktg_build_guide *g, cell c, const ktg_column *at) {
    return g->steps[c.step].eye_count > 0 ? g->shape * at->width : 0;
}

/* Draws a cell at the column's place; its height comes out. */
static ktg_status draw_cell(ktg_build_guide *g, cell c, ktg_column at, double *height) {
    double picture = picture_height(g, c, &at);
    if (picture > 0) {
        ktg_area area = {at.x, at.y, at.x + at.width, at.y + picture};
        KTG_TRY(ktg_check_cancel(g->drawing->context));
        KTG_TRY(ktg_guide_draw_step(g, c.step, c.eye, at.cairo, area));
        at.y += picture + 1;
    }
    *height = write_cell(g, c, at, false) + (picture > 0 ? picture + 1 : 0);
    return KTG_OK;
}

/* The height of the row of `count` cells from `first` on. */
static double row_height(const ktg_build_guide *g, uint32_t first, uint32_t count, ktg_column at) {
    double height = 0;
    for (uint32_t k = 0; k < count; k++) {
        cell c = find_cell(g, first + k);
        double picture = picture_height(g, c, &at);
        height = fmax(height, write_cell(g, c, at, true) + (picture > 0 ? picture + 1 : 0));
    }
    return height;
}

/* How many of the cells from `first` on have room above the column's floor, in whole rows. */
static uint32_t cells_with_room(const ktg_build_guide *g, uint32_t columns, ktg_column at) {
    uint32_t next = g->next_cell;
    while (next < g->cell_count) {
        uint32_t left = g->cell_count - next, count = left < columns ? left : columns;
        double high = row_height(g, next, count, at);
        if (at.y + high > at.floor)
            break;
        at.y += high + GAP_MM;
        next += count;
    }
    return next - g->next_cell;
}

static ktg_column place_of(const ktg_column *at, uint32_t columns) {
    ktg_column place = *at;
    place.width = (at->width - (columns - 1) * GAP_MM) / columns;
    return place;
}

/* The columns and the shape of pictures with which most cells find room on the page; of several
 * choices the one with the largest pictures. Returns how many cells that are. */
static uint32_t choose_grid(ktg_build_guide *g, const ktg_column *at, uint32_t *columns) {
    static const double shapes[] = {0.95, 0.82, 0.72, 0.62};
    double least = at->width < SMALL_PAGE ? SMALL_MM : CELL_MM, area = 0, shape = shapes[0];
    uint32_t most_columns = (uint32_t)fmax(1, floor((at->width + GAP_MM) / (least + GAP_MM)));
    uint32_t most = 0;
    *columns = most_columns;
    for (uint32_t c = 1; c <= most_columns; c++) {
        ktg_column place = place_of(at, c);
        for (size_t i = 0; i < sizeof shapes / sizeof *shapes && place.width <= MOST_CELL_MM; i++) {
            double own = place.width * place.width * shapes[i];
            g->shape = shapes[i];
            uint32_t count = cells_with_room(g, c, place);
            if (count < most || (count == most && own <= area))
                continue;
            most = count;
            area = own;
            shape = shapes[i];
            *columns = c;
        }
    }
    g->shape = shape;
    return most;
}

static ktg_status draw_cells(ktg_build_guide *g, ktg_column *at, bool is_empty) {
    uint32_t columns, room = choose_grid(g, at, &columns);
    ktg_column place = place_of(at, columns);
    if (room == 0 && is_empty) /* a page too small for a row has one anyway */
        room = columns;
    uint32_t left = g->cell_count - g->next_cell, end = g->next_cell + (room < left ? room : left);
    while (g->next_cell < end) {
        double high, row = 0;
        for (uint32_t k = 0; k < columns && g->next_cell < end; k++) {
            place.x = at->x + k * (place.width + GAP_MM);
            KTG_TRY(draw_cell(g, find_cell(g, g->next_cell++), place, &high));
            row = fmax(row, high);
        }
        place.y += row + GAP_MM;
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
    return draw_cells(guide, &at, !is_first);
}
