/* pattern/cutting_line.c - the outline of a piece of cloth: its border moved out by the allowance
 * of each edge, cleaned where it crosses itself. */
#include "core/memory.h"
#include "pattern/corner.h"
#include "pattern/offset_walk.h"

/* How much widths are changed, relative, when curves that only touch confuse the walk, and how
 * often that is tried. */
#define NUDGE  1e-5
#define NUDGES 8

/* A border is straight when it bends by less than this tangent. */
#define STRAIGHT 0.2

typedef struct cut {
    const ktg_topology *t;
    const ktg_finish_options *options;
    const double *room; /* of ktg_cloth */
    double nudge;
    bool plain; /* hems end like seams */
    ktg_vec2 *points;
    size_t count, capacity;
} cut;

static ktg_status put(ktg_context *context, cut *c, ktg_vec2 p) {
    KTG_TRY(ktg_reserve(context, &c->points, &c->capacity, c->count + 1));
    c->points[c->count++] = p;
    return KTG_OK;
}

/* ---- corners ------------------------------------------------------------------------------ */

static void set_side(const cut *c, uint32_t h, int side, ktg_corner *corner) {
    corner->along[side] = ktg_along(c->t, h);
    corner->width[side] = c->nudge * ktg_allowance_at(c->t, c->options, h);
    corner->hem[side] = ktg_edge_at(c->t, h)->kind == KTG_EDGE_BORDER;
}

/* Whether the border stays near the line of half-edge h, away from its corner, as far as a hem that
 * is turned up there reaches. */
static bool runs_straight(const cut *c, uint32_t h, bool onwards) {
    ktg_vec2 at = onwards ? ktg_start_of(c->t, h) : ktg_end_of(c->t, h);
    ktg_vec2 along = ktg_mul2(ktg_along(c->t, h), onwards ? 1 : -1);
    double width = ktg_allowance_at(c->t, c->options, h);
    uint32_t g = h;
    do {
        ktg_vec2 v = ktg_sub2(onwards ? ktg_end_of(c->t, g) : ktg_start_of(c->t, g), at);
        if (fabs(ktg_cross2(along, v)) > STRAIGHT * fabs(ktg_dot2(along, v)))
            return false;
        if (ktg_dot2(along, v) >= 2 * width)
            return true;
        g = onwards ? ktg_border_next(c->t, g) : ktg_border_previous(c->t, g);
    } while (g != h && ktg_edge_at(c->t, g)->kind == KTG_EDGE_BORDER);
    return true;
}

/* The corner from border half-edge h to `next`, without the other pieces' wishes. */
static ktg_corner corner_between(const cut *c, uint32_t h, uint32_t next) {
    ktg_corner corner = {.at = ktg_end_of(c->t, h)};
    set_side(c, h, 0, &corner);
    set_side(c, next, 1, &corner);
    corner.reach[0] = ktg_corner_reach(&corner, 0);
    corner.reach[1] = ktg_corner_reach(&corner, 1);
    if (c->plain)
        corner.hem[0] = corner.hem[1] = false;
    if (corner.hem[0] != corner.hem[1] &&
        !runs_straight(c, corner.hem[0] ? h : next, corner.hem[1]))
        corner.hem[0] = corner.hem[1] = false;
    return corner;
}

/* How far the strip of cloth at one end of h reaches in the mate's piece, which it is sewn to. */
static double mate_reach(const cut *c, uint32_t h, int side) {
    uint32_t mate = ktg_mate(c->t, h);
    if (side == 0) { /* h's end is where its mate begins */
        ktg_corner corner = corner_between(c, ktg_border_previous(c->t, mate), mate);
        return corner.reach[1];
    }
    ktg_corner corner = corner_between(c, mate, ktg_border_next(c->t, mate));
    return corner.reach[0];
}

/* At the end of a seam its two strips of cloth are to be equally long, or they do not fit when they
 * are sewn together: the shorter one counts. */
static void heed_mates(const cut *c, uint32_t h, uint32_t next, ktg_corner *corner) {
    const ktg_pattern_edge *e = ktg_edge_at(c->t, h), *f = ktg_edge_at(c->t, next);
    if (e->kind == KTG_EDGE_CUT && e->seam == f->seam)
        return;
    if (e->kind == KTG_EDGE_CUT)
        corner->reach[0] = fmin(corner->reach[0], mate_reach(c, h, 0));
    if (f->kind == KTG_EDGE_CUT)
        corner->reach[1] = fmin(corner->reach[1], mate_reach(c, next, 1));
}

static ktg_status put_corner(ktg_context *context, cut *c, uint32_t h, uint32_t next) {
    ktg_corner corner = corner_between(c, h, next);
    ktg_corner_path path;
    double room = c->room[c->t->place_of[next]];
    ktg_vec2 out[2] = {ktg_outward(corner.along[0]), ktg_outward(corner.along[1])};
    if (room < fmax(corner.width[0], corner.width[1])) {
        double width = fmin(room, fmin(corner.width[0], corner.width[1]));
        return put(context, c, ktg_madd2(corner.at, width, ktg_unit2(ktg_add2(out[0], out[1]))));
    }
    heed_mates(c, h, next, &corner);
    ktg_corner_go(&corner, &path);
    for (uint32_t i = 0; i < path.count; i++)
        if (ktg_length2(ktg_sub2(path.points[i], corner.at)) <= room * (1 + 1e-9))
            KTG_TRY(
                put(context, c, path.points[i])); /* a corner that would reach too far is cut off */
    return KTG_OK;
}

/* ---- darts -------------------------------------------------------------------------------- */

/* A dart as it is passed on the way around: from the half-edge before it to the one after it. */
typedef struct passed_dart {
    ktg_vec2 point, cap[3];
    bool whole; /* there is a cap */
} passed_dart;

/* The half-edge after a dart's last one; *apex: the one that comes to its point. */
static uint32_t pass_dart(const ktg_topology *t, uint32_t first, uint32_t *apex) {
    uint32_t seam = ktg_edge_at(t, first)->seam, h = first;
    *apex = first;
    for (; ktg_edge_at(t, h)->seam == seam; h = ktg_border_next(t, h))
        if (ktg_border_next(t, h) == ktg_mate(t, h))
            *apex = h;
    return h;
}

static passed_dart dart_between(const cut *c, uint32_t h, uint32_t first, uint32_t apex,
                                uint32_t after) {
    const ktg_topology *t = c->t;
    ktg_corner start = {.at = ktg_end_of(t, h)}, end = {.at = ktg_start_of(t, after)};
    passed_dart dart = {.point = ktg_end_of(t, apex)};
    uint32_t last = ktg_border_previous(t, after);
    set_side(c, h, 0, &start);
    set_side(c, after, 1, &end);
    dart.whole = ktg_dart_cap(&start, &end, ktg_along(t, first), ktg_mul2(ktg_along(t, last), -1),
                              dart.point, dart.cap);
    return dart;
}

/* Across the mouth of the dart between h and *next, which becomes the half-edge after it. */
static ktg_status put_dart(ktg_context *context, cut *c, uint32_t h, uint32_t *next) {
    uint32_t first = *next, apex;
    *next = pass_dart(c->t, first, &apex);
    passed_dart dart = dart_between(c, h, first, apex, *next);
    for (int i = 0; i < 3; i++)
        KTG_TRY(put(context, c, dart.cap[i]));
    return KTG_OK;
}

/* The fold in the middle of a dart, and notches at the ends of its legs. */
static ktg_status draw_dart(ktg_context *context, const cut *c, const passed_dart *dart,
                            ktg_pattern_piece *piece, const ktg_vec2 mouths[2]) {
    KTG_TRY(ktg_piece_add_segment(context, piece, KTG_LINE_DART, dart->point, dart->cap[1]));
    for (int k = 0; k < 2; k++) {
        ktg_vec2 end = dart->cap[2 * k], in = ktg_sub2(mouths[k], end);
        double length = fmin(c->options->notch_mm, ktg_length2(in));
        if (length > 0)
            KTG_TRY(ktg_piece_add_segment(context, piece, KTG_LINE_NOTCH, end,
                                          ktg_madd2(end, length, ktg_unit2(in))));
    }
    return KTG_OK;
}

static ktg_status draw_darts(ktg_context *context, const cut *c, uint32_t p,
                             ktg_pattern_piece *piece) {
    const ktg_topology *t = c->t;
    for (uint32_t k = t->border_first[p]; k < t->border_first[p + 1]; k++) {
        uint32_t h = t->border[k], first = ktg_border_next(t, h), apex;
        if (!ktg_is_dart(t, first) || ktg_edge_at(t, h)->seam == ktg_edge_at(t, first)->seam)
            continue;
        uint32_t after = pass_dart(t, first, &apex);
        passed_dart dart = dart_between(c, h, first, apex, after);
        const ktg_vec2 mouths[2] = {ktg_start_of(t, first), ktg_start_of(t, after)};
        KTG_TRY(draw_dart(context, c, &dart, piece, mouths));
    }
    return KTG_OK;
}

/* ---- all the way around ------------------------------------------------------------------- */

static ktg_status go_around(ktg_context *context, cut *c, uint32_t p) {
    const ktg_topology *t = c->t;
    c->count = 0;
    for (uint32_t k = t->border_first[p]; k < t->border_first[p + 1]; k++) {
        uint32_t h = t->border[k], next = ktg_border_next(t, h);
        if (ktg_is_dart(t, h))
            continue;
        if (ktg_is_dart(t, next))
            KTG_TRY(put_dart(context, c, h, &next));
        else
            KTG_TRY(put_corner(context, c, h, next));
    }
    return KTG_OK;
}

/* The middle of the widest face. */
static ktg_vec2 deep_inside(const ktg_pattern_piece *piece) {
    ktg_vec2 best = {0, 0};
    double largest = -INFINITY;
    for (size_t f = 0; f < piece->face_count; f++) {
        const uint32_t *corners = piece->corners + 3 * f;
        ktg_vec2 a = piece->vertices[corners[0]], b = piece->vertices[corners[1]],
                 c = piece->vertices[corners[2]];
        double area = ktg_cross2(ktg_sub2(b, a), ktg_sub2(c, a));
        if (area > largest) {
            largest = area;
            best = ktg_mul2(ktg_add2(ktg_add2(a, b), c), 1.0 / 3);
        }
    }
    return best;
}

static bool is_within(const ktg_pattern_piece *piece, ktg_vec2 p, double near) {
    bool inside = false;
    double nearest = INFINITY;
    for (size_t i = 0; i < piece->outline_count; i++) {
        ktg_vec2 a = piece->outline[i], b = piece->outline[(i + 1) % piece->outline_count];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
        nearest = fmin(nearest, ktg_distance_to_segment(p, a, b));
    }
    return inside || nearest <= near;
}

static bool holds_border(const cut *c, uint32_t p, const ktg_pattern_piece *piece, double near) {
    const ktg_topology *t = c->t;
    for (uint32_t k = t->border_first[p]; k < t->border_first[p + 1]; k++)
        if (!is_within(piece, ktg_start_of(t, t->border[k]), near))
            return false;
    return true;
}

/* One try. `loop`: parts of the line that go around nothing of the piece (the hem of a piece that
 * ends in a point, turned over in that point) may be cut off. */
static ktg_status try_line(ktg_context *context, cut *c, uint32_t p, bool loop,
                           ktg_pattern_piece *piece, bool *done) {
    double widest = fmax(fmax(c->options->allowance_mm, c->options->hem_mm), 0.1);
    ktg_vec2 inside = deep_inside(piece);
    KTG_TRY(go_around(context, c, p));
    KTG_TRY(ktg_outermost_walk(context, c->points, c->count, 1e-7 * widest, loop ? &inside : NULL,
                               &piece->outline, &piece->outline_count, done));
    *done = *done && (!loop || holds_border(c, p, piece, 3e-7 * widest));
    if (!*done) {
        ktg_free(piece->outline);
        piece->outline = NULL;
        piece->outline_count = 0;
    }
    return KTG_OK;
}

/* With all care, then with hems that end plainly, then with loops cut off. */
static ktg_status clean(ktg_context *context, cut *c, uint32_t p, ktg_pattern_piece *piece) {
    bool done = false;
    for (int way = 0; way < 4; way++)
        for (int k = 0; k < NUDGES; k++) {
            c->nudge = 1 + k * NUDGE;
            c->plain = way % 2 == 1;
            KTG_TRY(try_line(context, c, p, way >= 2, piece, &done));
            if (done)
                return KTG_OK;
        }
    return ktg_fail(context, KTG_GEOMETRY,
                    "the seam allowance around piece %u (%s) crosses itself: choose a smaller one",
                    p + 1, piece->name ? piece->name : "no name");
}

/* Whether the cut over the dart's mouth keeps away from the rest of the border, from `after` round
 * to h. */
static bool cap_is_free(const cut *c, uint32_t h, uint32_t after, const passed_dart *dart) {
    const ktg_topology *t = c->t;
    double least =
        0.6 * fmin(ktg_allowance_at(t, c->options, h), ktg_allowance_at(t, c->options, after));
    for (uint32_t g = after; g != h; g = ktg_border_next(t, g)) {
        ktg_vec2 p = ktg_end_of(t, g);
        if (ktg_distance_to_segment(p, dart->cap[0], dart->cap[1]) < least ||
            ktg_distance_to_segment(p, dart->cap[1], dart->cap[2]) < least)
            return false;
    }
    return true;
}

void ktg_darts_keep_foldable(const ktg_cloth *cloth) {
    const ktg_topology *t = cloth->topology;
    cut c = {.t = t, .options = cloth->options, .room = cloth->room, .nudge = 1};
    for (uint32_t k = 0; k < t->border_count; k++) {
        uint32_t h = t->border[k], first = ktg_border_next(t, h), apex;
        uint32_t seam = ktg_edge_at(t, first)->seam;
        if (!ktg_is_dart(t, first) || ktg_edge_at(t, h)->seam == seam)
            continue;
        uint32_t after = pass_dart(t, first, &apex);
        bool alone = !ktg_is_dart(t, h) && !ktg_is_dart(t, after);
        passed_dart dart = dart_between(&c, h, first, apex, after);
        cloth->pattern->seams[seam].dart = alone && dart.whole && cap_is_free(&c, h, after, &dart);
    }
}

ktg_status ktg_cutting_line(ktg_context *context, const ktg_cloth *cloth, uint32_t p) {
    cut c = {.t = cloth->topology, .options = cloth->options, .room = cloth->room, .nudge = 1};
    ktg_pattern_piece *piece = &cloth->pattern->pieces[p];
    ktg_status status = clean(context, &c, p, piece);
    c.nudge = 1;
    c.plain = false;
    if (status == KTG_OK)
        status = draw_darts(context, &c, p, piece);
    ktg_free(c.points);
    return status;
}
