/* layout/pieces.c - pattern pieces as polygons to be nested, and back.
 *
 * Sheets are filled from the top, so a bin's length runs down a sheet and its width across: the
 * nesting sees everything turned by a quarter, (x, y) -> (-y, x). */
#include "layout/pieces.h"

#include "core/memory.h"
#include "core/vec.h"
#include "layout/nest.h"

#define QUARTER (KTG_PI / 2)

/* The grain runs up the sheet: a quarter turn in a bin, or, where there is no nap, three. */
static const double grain_turns[] = {QUARTER, 3 * QUARTER};

/* What nesting needs of the pieces. */
typedef struct nesting {
    ktg_nest_shape *shapes; /* piece_count */
    uint32_t *items;
    ktg_nest_place *places;
} nesting;

static ktg_status make(ktg_context *context, const ktg_pattern *pattern,
                       const ktg_layout_options *options, nesting *n) {
    size_t count = pattern->piece_count;
    n->shapes = ktg_new(context, count, ktg_nest_shape);
    n->items = ktg_new(context, count, uint32_t);
    n->places = ktg_new(context, count, ktg_nest_place);
    if (!n->shapes || !n->items || !n->places)
        return KTG_MEMORY;
    for (size_t i = 0; i < count; i++) {
        const ktg_pattern_piece *piece = &pattern->pieces[i];
        ktg_nest_shape *shape = &n->shapes[i];
        ktg_vec2 *cover;
        KTG_TRY(ktg_layout_cover(context, piece, options->gap_mm, &cover, &shape->cover_count));
        shape->cover = cover;
        shape->outline = piece->outline;
        shape->outline_count = piece->outline_count;
        shape->turns = grain_turns;
        shape->turn_count = !options->keep_grain ? 0 : options->nap ? 1 : 2;
        n->items[i] = (uint32_t)i;
    }
    return KTG_OK;
}

static void drop(nesting *n, size_t count) {
    for (size_t i = 0; n->shapes && i < count; i++)
        ktg_free((void *)n->shapes[i].cover);
    ktg_free(n->shapes);
    ktg_free(n->items);
    ktg_free(n->places);
}

static ktg_nest_place into_bin(const ktg_sheet_format *sheet, const ktg_laid *laid) {
    double top = sheet->height_mm - sheet->margin_mm;
    return (ktg_nest_place){laid->sheet, top - laid->at.y, laid->at.x - sheet->margin_mm,
                            laid->at.rotation + QUARTER};
}

static void out_of_bin(const ktg_sheet_format *sheet, const ktg_nest_place *place, ktg_laid *laid) {
    laid->sheet = place->bin;
    laid->at.x = sheet->margin_mm + place->y;
    laid->at.y = sheet->height_mm - sheet->margin_mm - place->x;
    laid->at.rotation = remainder(place->turn - QUARTER, 2 * KTG_PI);
}

/* With more pieces than this the table of pairs would get too large: they stay in rows. */
#define MOST_PIECES 3000

/* How long to search: so much for each piece, up to a limit. */
static uint64_t work_for(const ktg_layout_options *options, size_t piece_count) {
    static const struct {
        double each, most;
    } work[] = {{10e6, 150e6}, {40e6, 600e6}, {400e6, 5000e6}};
    return (uint64_t)fmin(work[options->effort].each * (double)piece_count,
                          work[options->effort].most);
}

ktg_status ktg_layout_nest(ktg_context *context, const ktg_pattern *pattern,
                           const ktg_layout_options *options, ktg_laid *laid,
                           ktg_layout_report *report) {
    const ktg_sheet_format *sheet = &options->sheet;
    size_t count = pattern->piece_count;
    if (count > MOST_PIECES)
        return KTG_OK;
    ktg_vec2 room = ktg_layout_room(sheet);
    nesting n = {0};
    ktg_nest_report done = {0};
    ktg_status status = make(context, pattern, options, &n);
    if (status == KTG_OK) {
        ktg_nest_problem problem = {.shapes = n.shapes,
                                    .shape_count = count,
                                    .items = n.items,
                                    .item_count = count,
                                    .width = room.x,
                                    .length = room.y,
                                    .gap = options->gap_mm,
                                    .enough = options->enough_sheets * room.y * (1 + 1e-9),
                                    .work = work_for(options, count),
                                    .seconds = options->seconds};
        for (size_t i = 0; i < count; i++)
            n.places[i] = into_bin(sheet, &laid[i]);
        status = ktg_nest(context, &problem, n.places, &done);
    }
    if (status == KTG_OK && done.records > 0)
        for (size_t i = 0; i < count; i++)
            out_of_bin(sheet, &n.places[i], &laid[i]);
    report->work = done.work;
    report->records = done.records;
    drop(&n, count);
    return status;
}
