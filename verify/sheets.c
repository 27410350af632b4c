/* verify/sheets.c - each piece on a sheet, inside what can be printed, clear of the others. */
#include "core/memory.h"
#include "verify/check.h"

static ktg_motion2 motion_of(const ktg_pattern_placement *at) {
    return (ktg_motion2){cos(at->rotation), sin(at->rotation), {at->x, at->y}};
}

/* How far p is outside the printable rectangle. */
static double outside(const ktg_pattern_sheet *sheet, ktg_vec2 p) {
    const double *r = sheet->printable;
    return fmax(fmax(r[0] - p.x, p.x - r[2]), fmax(r[1] - p.y, p.y - r[3]));
}

static double most_outside(const ktg_pattern_sheet *sheet, ktg_motion2 m, const ktg_vec2 *points,
                           size_t count) {
    double most = -INFINITY;
    for (size_t i = 0; i < count; i++)
        most = fmax(most, outside(sheet, ktg_move2(m, points[i])));
    return most;
}

/* The outline, and what it should enclose. */
static void check_inside(ktg_check *check, const ktg_pattern_sheet *sheet, size_t id,
                         const ktg_pattern_placement *at) {
    const ktg_pattern_piece *piece = &check->pattern->pieces[at->piece];
    ktg_motion2 m = motion_of(at);
    double most = most_outside(sheet, m, piece->outline, piece->outline_count);
    for (size_t i = 0; i < piece->vertex_count; i++)
        if (!piece->on_fold || ktg_check_on_drawn_side(piece, piece->vertices[i]) >= 0)
            most = fmax(most, outside(sheet, ktg_move2(m, piece->vertices[i])));
    for (size_t i = 0; i < piece->tab_count; i++)
        most =
            fmax(most, most_outside(sheet, m, piece->tabs[i].corners, piece->tabs[i].corner_count));
    if (!(most <= KTG_VERIFY_TOUCH * check->mm))
        ktg_check_problem(check, "Piece %u leaves the printable area of sheet %zu by %.3g mm.",
                          at->piece + 1, id, most);
}

static ktg_status add_moved(ktg_check *check, ktg_check_shapes *shapes, ktg_motion2 m,
                            const ktg_vec2 *points, uint32_t count, uint32_t group) {
    ktg_vec2 moved[KTG_TAB_CORNERS];
    for (uint32_t i = 0; i < count; i++)
        moved[i] = ktg_move2(m, points[i]);
    return ktg_check_add_shape(check->context, shapes, moved, count, group, group, false);
}

static ktg_status add_placed(ktg_check *check, ktg_check_shapes *shapes,
                             const ktg_pattern_placement *at, uint32_t group) {
    const ktg_pattern_piece *piece = &check->pattern->pieces[at->piece];
    ktg_motion2 m = motion_of(at);
    for (size_t i = 0; i < piece->face_count; i++) {
        ktg_vec2 corners[4];
        uint32_t count = ktg_check_drawn_face(piece, i, corners);
        if (count > 0)
            KTG_TRY(add_moved(check, shapes, m, corners, count, group));
    }
    for (size_t i = 0; i < piece->tab_count; i++)
        KTG_TRY(add_moved(check, shapes, m, piece->tabs[i].corners, piece->tabs[i].corner_count,
                          group));
    return KTG_OK;
}

/* The pairs of placements of one sheet that have been reported. */
typedef struct pairs {
    const ktg_pattern_sheet *sheet;
    size_t id;
    uint32_t last[2];
} pairs;

/* Two pieces overlap in many faces; what comes in a row is said once. */
static void report_pieces(ktg_check *check, const ktg_check_shape *a, const ktg_check_shape *b,
                          double depth, void *user) {
    pairs *seen = user;
    uint32_t low = a->group < b->group ? a->group : b->group;
    uint32_t high = a->group < b->group ? b->group : a->group;
    if (seen->last[0] == low && seen->last[1] == high)
        return;
    seen->last[0] = low;
    seen->last[1] = high;
    ktg_check_problem(check, "Pieces %u and %u overlap on sheet %zu by %.3g mm.",
                      seen->sheet->placements[low].piece + 1,
                      seen->sheet->placements[high].piece + 1, seen->id, depth);
}

static ktg_status check_apart(ktg_check *check, const ktg_pattern_sheet *sheet, size_t id) {
    ktg_check_shapes shapes = {.by_group = true};
    pairs seen = {sheet, id, {KTG_NONE, KTG_NONE}};
    ktg_status status = KTG_OK;
    for (uint32_t i = 0; status == KTG_OK && i < sheet->placement_count; i++)
        status = add_placed(check, &shapes, &sheet->placements[i], i);
    if (status == KTG_OK)
        status = ktg_check_overlaps(check, &shapes, report_pieces, &seen);
    ktg_check_free_shapes(&shapes);
    return status;
}

static void check_rectangle(ktg_check *check, const ktg_pattern_sheet *sheet, size_t id) {
    const double *r = sheet->printable;
    double near = KTG_VERIFY_TOUCH * check->mm;
    if (!(r[0] >= -near && r[1] >= -near && r[2] <= sheet->width_mm + near &&
          r[3] <= sheet->height_mm + near && r[0] < r[2] && r[1] < r[3]))
        ktg_check_problem(check, "The printable area of sheet %zu is not within its paper.", id);
}

/* Once each, or on tiles; more often only where a piece is to be cut several times; a piece that is
 * cut with its twin at most once. */
static void check_counts(ktg_check *check, const uint32_t *placed, const uint32_t *tiled) {
    for (size_t i = 0; i < check->pattern->piece_count; i++) {
        const ktg_pattern_piece *piece = &check->pattern->pieces[i];
        uint64_t most = (uint64_t)piece->cut_count + piece->cut_mirrored;
        if (most < 1 || check->pattern->mode == KTG_PAPER)
            most = 1;
        bool twin = check->pattern->mode == KTG_CLOTH && piece->cut_count == 0;
        if (placed[i] == 0 && tiled[i] == 0 && !twin)
            ktg_check_problem(check, "Piece %zu is on no sheet.", i + 1);
        else if (placed[i] > 0 && tiled[i] > 0)
            ktg_check_problem(check, "Piece %zu is on a sheet and on tiles.", i + 1);
        else if (placed[i] > most)
            ktg_check_problem(check, "Piece %zu is placed %u times.", i + 1, placed[i]);
    }
}

static ktg_status check_sheet(ktg_check *check, size_t i, uint32_t *placed, uint32_t *tiled) {
    const ktg_pattern_sheet *sheet = &check->pattern->sheets[i];
    check_rectangle(check, sheet, i + 1);
    for (size_t k = 0; k < sheet->placement_count; k++) {
        bool tile = sheet->kind == KTG_TILE;
        (tile ? tiled : placed)[sheet->placements[k].piece]++;
        if (!tile)
            check_inside(check, sheet, i + 1, &sheet->placements[k]);
    }
    return check_apart(check, sheet, i + 1);
}

ktg_status ktg_check_sheets(ktg_check *check) {
    const ktg_pattern *p = check->pattern;
    if (p->sheet_count == 0)
        return KTG_OK;
    uint32_t *placed = ktg_new(check->context, p->piece_count, uint32_t);
    uint32_t *tiled = ktg_new(check->context, p->piece_count, uint32_t);
    ktg_status status = placed && tiled ? KTG_OK : KTG_MEMORY;
    for (size_t i = 0; status == KTG_OK && i < p->sheet_count; i++)
        status = check_sheet(check, i, placed, tiled);
    if (status == KTG_OK)
        check_counts(check, placed, tiled);
    if (status == KTG_OK)
        status = ktg_check_tiles(check, tiled);
    ktg_free(placed);
    ktg_free(tiled);
    return status;
}
