/* pattern/offset_walk.c - the outermost walk around a closed curve that crosses itself: split its
 * sides where they meet, make points that coincide one node, then keep to the right. */
#include "pattern/offset_walk.h"

#include "core/memory.h"
#include "pattern/grid.h"

#include <stdlib.h>
#include <string.h>

/* A place on a side of the curve where it is split. */
typedef struct split {
    uint32_t side;
    double at; /* 0 .. 1 along the side */
    ktg_vec2 point;
    uint32_t node;
} split;

/* One way along a piece of the curve between two nodes. */
typedef struct arc {
    uint32_t from, to;
    double angle; /* of its direction */
} arc;

typedef struct walk {
    const ktg_vec2 *curve;
    uint32_t count;
    double near;
    const ktg_vec2 *inside; /* or NULL */
    ktg_box *boxes;
    ktg_grid grid;
    split *splits;
    size_t split_count, split_capacity;
    uint32_t node_count;
    ktg_vec2 *nodes;
    arc *arcs; /* both directions of each, sorted by from and angle */
    size_t arc_count;
    uint32_t *first_arc; /* node_count + 1 */
} walk;

static ktg_vec2 start_of(const walk *w, uint32_t side) {
    return w->curve[side];
}

static ktg_vec2 end_of(const walk *w, uint32_t side) {
    return w->curve[side + 1 == w->count ? 0 : side + 1];
}

static ktg_status add_split(ktg_context *context, walk *w, uint32_t side, double at,
                            ktg_vec2 point) {
    KTG_TRY(ktg_reserve(context, &w->splits, &w->split_capacity, w->split_count + 1));
    w->splits[w->split_count++] = (split){side, at, point, 0};
    return KTG_OK;
}

/* Splits `side` at p where p lies on it; *touches tells. */
static ktg_status split_at_point(ktg_context *context, walk *w, uint32_t side, ktg_vec2 p,
                                 bool *touches) {
    ktg_vec2 a = start_of(w, side), d = ktg_sub2(end_of(w, side), a), v = ktg_sub2(p, a);
    double length = ktg_length2(d);
    if (length <= w->near)
        return KTG_OK;
    double along = ktg_dot2(v, d) / length;
    if (fabs(ktg_cross2(d, v)) / length > w->near || along < -w->near || along > length + w->near)
        return KTG_OK;
    *touches = true;
    return add_split(context, w, side, along / length, p);
}

/* Splits two sides where they cross or touch. */
static ktg_status split_pair(ktg_context *context, walk *w, uint32_t i, uint32_t k) {
    ktg_vec2 a = start_of(w, i), b = end_of(w, i), c = start_of(w, k), d = end_of(w, k);
    bool touches = false;
    KTG_TRY(split_at_point(context, w, i, c, &touches));
    KTG_TRY(split_at_point(context, w, i, d, &touches));
    KTG_TRY(split_at_point(context, w, k, a, &touches));
    KTG_TRY(split_at_point(context, w, k, b, &touches));
    if (touches)
        return KTG_OK;
    ktg_vec2 ab = ktg_sub2(b, a), cd = ktg_sub2(d, c), ac = ktg_sub2(c, a);
    double turn = ktg_cross2(ab, cd);
    if (turn == 0)
        return KTG_OK;
    double s = ktg_cross2(ac, cd) / turn, r = ktg_cross2(ac, ab) / turn;
    if (!(s > 0 && s < 1 && r > 0 && r < 1))
        return KTG_OK;
    ktg_vec2 crossing = ktg_madd2(a, s, ab);
    KTG_TRY(add_split(context, w, i, s, crossing));
    return add_split(context, w, k, r, crossing);
}

static ktg_status split_all(ktg_context *context, walk *w) {
    w->boxes = ktg_new(context, w->count, ktg_box);
    if (!w->boxes)
        return KTG_MEMORY;
    for (uint32_t i = 0; i < w->count; i++) {
        ktg_vec2 ends[2] = {start_of(w, i), end_of(w, i)};
        w->boxes[i] = ktg_box_grown(ktg_box_of(ends, 2), w->near);
        KTG_TRY(add_split(context, w, i, 0, ends[0]));
        KTG_TRY(add_split(context, w, i, 1, ends[1]));
    }
    KTG_TRY(ktg_grid_build(context, w->boxes, w->count, &w->grid));
    for (uint32_t i = 0; i < w->count; i++) {
        uint32_t found = ktg_grid_query(&w->grid, w->boxes[i]);
        for (uint32_t n = 0; n < found; n++)
            if (w->grid.found[n] > i)
                KTG_TRY(split_pair(context, w, i, w->grid.found[n]));
    }
    if (w->split_count >= KTG_NONE)
        return ktg_fail(context, KTG_LIMIT, "an outline with too many crossings");
    return KTG_OK;
}

/* ---- nodes -------------------------------------------------------------------------------- */

static int by_x(const void *left, const void *right) {
    const split *a = *(split *const *)left, *b = *(split *const *)right;
    if (a->point.x != b->point.x)
        return a->point.x < b->point.x ? -1 : 1;
    if (a->point.y != b->point.y)
        return a->point.y < b->point.y ? -1 : 1;
    return (a > b) - (a < b);
}

/* Splits that lie together get one node, that of the first from the left. */
static ktg_status join_nodes(ktg_context *context, walk *w) {
    split **order = ktg_new(context, w->split_count, split *);
    w->nodes = ktg_new(context, w->split_count, ktg_vec2);
    if (!order || !w->nodes) {
        ktg_free(order);
        return KTG_MEMORY;
    }
    for (size_t i = 0; i < w->split_count; i++)
        order[i] = &w->splits[i];
    qsort(order, w->split_count, sizeof *order, by_x);
    uint32_t oldest = 0; /* nodes from here on are near enough in x */
    for (size_t i = 0; i < w->split_count; i++) {
        ktg_vec2 p = order[i]->point;
        while (oldest < w->node_count && w->nodes[oldest].x < p.x - 2 * w->near)
            oldest++;
        uint32_t node = oldest;
        while (node < w->node_count && ktg_length2(ktg_sub2(w->nodes[node], p)) > 2 * w->near)
            node++;
        if (node == w->node_count)
            w->nodes[w->node_count++] = p;
        order[i]->node = node;
    }
    ktg_free(order);
    return KTG_OK;
}

/* ---- arcs --------------------------------------------------------------------------------- */

static int along_sides(const void *left, const void *right) {
    const split *a = left, *b = right;
    if (a->side != b->side)
        return a->side < b->side ? -1 : 1;
    if (a->at != b->at)
        return a->at < b->at ? -1 : 1;
    return (a->node > b->node) - (a->node < b->node);
}

static int around_nodes(const void *left, const void *right) {
    const arc *a = left, *b = right;
    if (a->from != b->from)
        return a->from < b->from ? -1 : 1;
    if (a->angle != b->angle)
        return a->angle < b->angle ? -1 : 1;
    return (a->to > b->to) - (a->to < b->to);
}

static void add_arc(walk *w, uint32_t from, uint32_t to) {
    ktg_vec2 d = ktg_sub2(w->nodes[to], w->nodes[from]);
    w->arcs[w->arc_count++] = (arc){from, to, atan2(d.y, d.x)};
}

static ktg_status build_arcs(ktg_context *context, walk *w) {
    w->arcs = ktg_new(context, 2 * w->split_count, arc);
    w->first_arc = ktg_new(context, (size_t)w->node_count + 1, uint32_t);
    if (!w->arcs || !w->first_arc)
        return KTG_MEMORY;
    qsort(w->splits, w->split_count, sizeof *w->splits, along_sides);
    for (size_t i = 0; i + 1 < w->split_count; i++) {
        const split *a = &w->splits[i], *b = a + 1;
        if (a->side != b->side || a->node == b->node)
            continue;
        add_arc(w, a->node, b->node);
        add_arc(w, b->node, a->node);
    }
    qsort(w->arcs, w->arc_count, sizeof *w->arcs, around_nodes);
    size_t kept = 0;
    for (size_t i = 0; i < w->arc_count; i++)
        if (kept == 0 || around_nodes(&w->arcs[kept - 1], &w->arcs[i]) != 0)
            w->arcs[kept++] = w->arcs[i];
    w->arc_count = kept;
    for (size_t i = 0; i < kept; i++)
        w->first_arc[w->arcs[i].from + 1]++;
    for (uint32_t n = 0; n < w->node_count; n++)
        w->first_arc[n + 1] += w->first_arc[n];
    return KTG_OK;
}

/* The arc from `node` that comes first counter-clockwise after direction `back`: the way to the
 * right of one who came from there. Arcs are sorted by angle. */
static uint32_t rightmost(const walk *w, uint32_t node, double back) {
    uint32_t first = w->first_arc[node], end = w->first_arc[node + 1];
    for (uint32_t a = first; a < end; a++)
        if (w->arcs[a].angle > back)
            return a;
    return first;
}

/* Walks until the first arc comes again; path: the nodes it comes through. */
static bool walk_around(const walk *w, uint32_t *path, size_t *count) {
    *count = 0;
    if (w->arc_count == 0)
        return false;
    uint32_t start = rightmost(w, 0, -KTG_PI), a = start; /* node 0 is the leftmost: one comes to
                                                             it from the left */
    do {
        path[(*count)++] = w->arcs[a].from;
        ktg_vec2 back = ktg_sub2(w->nodes[w->arcs[a].from], w->nodes[w->arcs[a].to]);
        a = rightmost(w, w->arcs[a].to, atan2(back.y, back.x));
    } while (a != start && *count < w->arc_count);
    return a == start;
}

/* ---- loops -------------------------------------------------------------------------------- */

static bool goes_around(const walk *w, const uint32_t *path, size_t count, ktg_vec2 p) {
    bool inside = false;
    for (size_t i = 0; i < count; i++) {
        ktg_vec2 a = w->nodes[path[i]], b = w->nodes[path[i + 1 == count ? 0 : i + 1]];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside;
}

/* A path that comes through nodes twice consists of loops that have a node in common: keeps the one
 * around w->inside. place: node_count entries, KTG_NONE. False where there are several and none is
 * wanted. */
static bool keep_loop(const walk *w, uint32_t *place, uint32_t *path, size_t *count) {
    size_t top = 0; /* path[0..top): what is not yet closed */
    for (size_t i = 0; i < *count; i++) {
        uint32_t node = path[i], first = place[node];
        if (first == KTG_NONE) {
            place[node] = (uint32_t)top;
            path[top++] = node;
            continue;
        }
        if (!w->inside)
            return false;
        if (goes_around(w, path + first, top - first, *w->inside)) {
            *count = top - first;
            memmove(path, path + first, *count * sizeof *path);
            return true;
        }
        for (; top > (size_t)first + 1; top--)
            place[path[top - 1]] = KTG_NONE;
    }
    *count = top;
    return true;
}

static ktg_status find_outline(ktg_context *context, walk *w, ktg_vec2 **outline,
                               size_t *outline_count, bool *simple) {
    uint32_t *place = ktg_new(context, w->node_count, uint32_t);
    uint32_t *path = ktg_new(context, w->arc_count + 1, uint32_t);
    *outline = ktg_new(context, w->arc_count + 1, ktg_vec2);
    ktg_status status = place && path && *outline ? KTG_OK : KTG_MEMORY;
    for (uint32_t n = 0; status == KTG_OK && n < w->node_count; n++)
        place[n] = KTG_NONE;
    *outline_count = 0;
    *simple = status == KTG_OK && walk_around(w, path, outline_count) &&
              keep_loop(w, place, path, outline_count) && *outline_count >= 3;
    for (size_t i = 0; status == KTG_OK && i < *outline_count; i++)
        (*outline)[i] = w->nodes[path[i]];
    ktg_free(place);
    ktg_free(path);
    return status;
}

/* Corners on a straight line say nothing. */
static void drop_straight(ktg_vec2 *outline, size_t *count, double near) {
    size_t kept = 0, total = *count;
    for (size_t i = 0; i < total; i++) {
        ktg_vec2 before = kept ? outline[kept - 1] : outline[total - 1];
        ktg_vec2 d = ktg_sub2(outline[i + 1 == total ? 0 : i + 1], before);
        ktg_vec2 v = ktg_sub2(outline[i], before);
        if (fabs(ktg_cross2(d, v)) > near * ktg_length2(d) || ktg_dot2(d, v) <= 0)
            outline[kept++] = outline[i];
    }
    *count = kept;
}

static ktg_status run(ktg_context *context, walk *w, ktg_vec2 **outline, size_t *outline_count,
                      bool *simple) {
    KTG_TRY(split_all(context, w));
    KTG_TRY(join_nodes(context, w));
    KTG_TRY(build_arcs(context, w));
    KTG_TRY(find_outline(context, w, outline, outline_count, simple));
    drop_straight(*outline, outline_count, w->near);
    *simple = *simple && *outline_count >= 3;
    return KTG_OK;
}

ktg_status ktg_outermost_walk(ktg_context *context, const ktg_vec2 *curve, size_t count,
                              double near, const ktg_vec2 *inside, ktg_vec2 **outline,
                              size_t *outline_count, bool *simple) {
    *outline = NULL;
    if (count >= KTG_NONE)
        return ktg_fail(context, KTG_LIMIT, "an outline of %zu points is too long", count);
    walk w = {.curve = curve, .count = (uint32_t)count, .near = near, .inside = inside};
    ktg_status status = run(context, &w, outline, outline_count, simple);
    ktg_grid_drop(&w.grid);
    ktg_free(w.boxes);
    ktg_free(w.splits);
    ktg_free(w.nodes);
    ktg_free(w.arcs);
    ktg_free(w.first_arc);
    if (status != KTG_OK) {
        ktg_free(*outline);
        *outline = NULL;
    }
    return status;
}
