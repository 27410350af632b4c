/* pattern/mirror.c - pieces of cloth that are mirror images of each other, or of themselves: they
 * are printed once and cut twice.
 *
 * Pieces stand upright, by their grain, so that only mirroring across an upright line (or none) and
 * a move come into question, and not a turn: the grain has to fit, too. */
#include "core/memory.h"
#include "pattern/cloth.h"
#include "pattern/grid.h"

/* Shapes are the same when no point of one border is further from the other, in mm. */
#define SAME_MM 0.5

/* The border of a piece as a closed polygon, with what can be compared first. */
typedef struct shape {
    size_t count;
    ktg_vec2 *points;
    bool *hem; /* count: nothing is sewn to the edge from that point on */
    double area, length;
    ktg_vec2 centre; /* of its area */
} shape;

static ktg_status make_shape(ktg_context *context, const ktg_topology *t, uint32_t p, shape *s) {
    s->count = t->border_first[p + 1] - t->border_first[p];
    s->points = ktg_new(context, s->count, ktg_vec2);
    s->hem = ktg_new(context, s->count, bool);
    if (!s->points || !s->hem)
        return KTG_MEMORY;
    for (size_t i = 0; i < s->count; i++) {
        uint32_t h = t->border[t->border_first[p] + i];
        s->points[i] = ktg_start_of(t, h);
        s->hem[i] = ktg_edge_at(t, h)->kind == KTG_EDGE_BORDER;
    }
    ktg_vec2 origin = s->points[0];
    for (size_t i = 0; i < s->count; i++) {
        ktg_vec2 a = ktg_sub2(s->points[i], origin);
        ktg_vec2 b = ktg_sub2(s->points[(i + 1) % s->count], origin);
        double area = ktg_cross2(a, b) / 2;
        s->area += area;
        s->length += ktg_length2(ktg_sub2(b, a));
        s->centre = ktg_madd2(s->centre, area / 3, ktg_add2(a, b));
    }
    s->centre = ktg_add2(ktg_mul2(s->centre, 1 / s->area), origin);
    return KTG_OK;
}

/* Whether p is near the border, at an edge that is a hem or none, as `hem` says. */
static bool near_border(ktg_grid *grid, const shape *s, ktg_vec2 p, bool hem) {
    ktg_box box = ktg_box_grown((ktg_box){p, p}, SAME_MM);
    uint32_t found = ktg_grid_query(grid, box);
    for (uint32_t k = 0; k < found; k++) {
        uint32_t i = grid->found[k];
        if (s->hem[i] == hem &&
            ktg_distance_to_segment(p, s->points[i], s->points[(i + 1) % s->count]) <= SAME_MM)
            return true;
    }
    return false;
}

/* Corner i and the middle of the edge that leaves it. */
static bool point_lies(ktg_grid *grid, const shape *from, const shape *to, size_t i,
                       const ktg_likeness *mirror) {
    ktg_vec2 a = from->points[i], b = from->points[(i + 1) % from->count];
    ktg_vec2 middle = ktg_mul2(ktg_add2(a, b), 0.5);
    return near_border(grid, to, ktg_likeness_point(mirror, a), from->hem[i]) &&
           near_border(grid, to, ktg_likeness_point(mirror, middle), from->hem[i]);
}

/* Whether every corner of `from`, and the middle of every edge, moved by `mirror`, is near the
 * border of `to`, at an edge of the same kind. */
static ktg_status lies_on(ktg_context *context, const shape *from, const shape *to,
                          const ktg_likeness *mirror, bool *lies) {
    ktg_grid grid = {0};
    ktg_box *boxes = ktg_new(context, to->count, ktg_box);
    ktg_status status = boxes ? KTG_OK : KTG_MEMORY;
    for (size_t i = 0; status == KTG_OK && i < to->count; i++) {
        ktg_vec2 ends[2] = {to->points[i], to->points[(i + 1) % to->count]};
        boxes[i] = ktg_box_of(ends, 2);
    }
    if (status == KTG_OK)
        status = ktg_grid_build(context, boxes, (uint32_t)to->count, &grid);
    *lies = status == KTG_OK;
    for (size_t i = 0; *lies && i < from->count; i++)
        *lies = point_lies(&grid, from, to, i, mirror);
    ktg_grid_drop(&grid);
    ktg_free(boxes);
    return status;
}

static bool may_be_same(const shape *a, const shape *b) {
    return fabs(a->length - b->length) <= 0.003 * a->length &&
           fabs(a->area - b->area) <= 0.003 * a->area;
}

static ktg_status try_mirror(ktg_context *context, const shape *shapes, uint32_t from, uint32_t to,
                             bool mirrored, ktg_likeness *mirror) {
    const shape *a = &shapes[from], *b = &shapes[to];
    ktg_likeness way = {.piece = to, .mirrored = mirrored};
    bool there = may_be_same(a, b), back = false;
    way.moved = ktg_sub2(b->centre, ktg_likeness_point(&way, a->centre));
    ktg_likeness other = {from, mirrored, way.moved};
    if (!mirrored)
        other.moved = ktg_mul2(way.moved, -1);
    other.moved.y = -way.moved.y;
    if (there)
        KTG_TRY(lies_on(context, a, b, &way, &there));
    if (there)
        KTG_TRY(lies_on(context, b, a, &other, &back));
    if (there && back)
        *mirror = way;
    return KTG_OK;
}

/* Twins are mirror images, or copies, of the first piece that is one. */
static ktg_status find_twin(ktg_context *context, ktg_cloth *cloth, const shape *shapes,
                            uint32_t p) {
    for (uint32_t q = 0; q < p && cloth->twins[p].piece == KTG_NONE; q++) {
        if (cloth->twins[q].piece != KTG_NONE)
            continue;
        /* to a symmetric piece a mirror image is a copy */
        bool mirrored = cloth->selves[q].piece == KTG_NONE;
        for (int k = 0; k < 2 && cloth->twins[p].piece == KTG_NONE; k++)
            KTG_TRY(try_mirror(context, shapes, p, q, mirrored == (k == 0), &cloth->twins[p]));
    }
    ktg_pattern_piece *piece = &cloth->pattern->pieces[p];
    const ktg_likeness *twin = &cloth->twins[p];
    if (twin->piece == KTG_NONE)
        return KTG_OK;
    ktg_pattern_piece *original = &cloth->pattern->pieces[twin->piece];
    piece->cut_count = 0;
    piece->twin_of = twin->piece;
    if (twin->mirrored)
        original->cut_mirrored++;
    else
        original->cut_count++;
    return KTG_OK;
}

static ktg_status compare(ktg_context *context, ktg_cloth *cloth, shape *shapes) {
    uint32_t count = (uint32_t)cloth->pattern->piece_count;
    for (uint32_t p = 0; p < count; p++) {
        KTG_TRY(ktg_check_cancel(context));
        KTG_TRY(make_shape(context, cloth->topology, p, &shapes[p]));
        cloth->twins[p].piece = cloth->selves[p].piece = KTG_NONE;
        cloth->pattern->pieces[p].cut_count = 1;
        cloth->pattern->pieces[p].cut_mirrored = 0;
        KTG_TRY(try_mirror(context, shapes, p, p, true, &cloth->selves[p]));
        if (cloth->options->twins)
            KTG_TRY(find_twin(context, cloth, shapes, p));
    }
    return KTG_OK;
}

ktg_status ktg_mirrors_find(ktg_context *context, ktg_cloth *cloth) {
    size_t count = cloth->pattern->piece_count;
    shape *shapes = ktg_new(context, count, shape);
    ktg_status status = shapes ? compare(context, cloth, shapes) : KTG_MEMORY;
    for (size_t p = 0; shapes && p < count; p++) {
        ktg_free(shapes[p].points);
        ktg_free(shapes[p].hem);
    }
    ktg_free(shapes);
    return status;
}
