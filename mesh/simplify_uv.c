/* mesh/simplify_uv.c - texture coordinates in a collapse: where a chart's faces stay one sheet
 * around the edge, its new corner is taken from the point of its old ring nearest to it. */
#include "core/memory.h"
#include "core/vec.h"
#include "mesh/simplify.h"

#include <string.h>

/* How much shorter or longer an edge may become in the texture, for its length, than any was in the
 * ring before. */
static const double most_stretch = 2;

/* A collapse, and which of its vertices change their place in the texture. */
typedef struct move {
    uint32_t from, to;
    ktg_vec3 position;
    bool from_moves, to_moves;
} move;

static uint32_t corner_of(const ktg_simplify *s, uint32_t face, uint32_t vertex) {
    const uint32_t *corner = s->faces + 3 * (size_t)face;
    return corner[0] == vertex ? 0 : corner[1] == vertex ? 1 : corner[2] == vertex ? 2 : KTG_NONE;
}

static bool has_vertex(const ktg_simplify *s, uint32_t face, uint32_t vertex) {
    return corner_of(s, face, vertex) != KTG_NONE;
}

static ktg_vec2 uv_at(const ktg_simplify *s, uint32_t face, uint32_t vertex) {
    return s->uv.corners[3 * (size_t)face + corner_of(s, face, vertex)];
}

/* ---- which faces are of one sheet with those beside the edge -------------------------------- */

/* True when the two faces share an edge at `vertex` and are of one chart across it. */
static bool joined_at(const ktg_simplify *s, uint32_t f, uint32_t g, uint32_t vertex) {
    if (!has_vertex(s, f, vertex) || !has_vertex(s, g, vertex))
        return false;
    for (int k = 0; k < 3; k++) {
        uint32_t other = s->faces[3 * (size_t)f + (size_t)k];
        if (other != vertex && has_vertex(s, g, other))
            return ktg_uv_joined(s, f, g, vertex, other);
    }
    return false;
}

/* Everything that can be reached from listed face `first` around the vertices that move. */
static void spread(ktg_simplify *s, const move *m, size_t first, uint8_t part) {
    size_t total = s->changed_count + s->removed_count, depth = 0;
    s->uv.parts[first] = part;
    s->uv.stack[depth++] = (uint32_t)first;
    while (depth > 0) {
        uint32_t f = s->changed[s->uv.stack[--depth]];
        for (size_t j = 0; j < total; j++) {
            uint32_t g = s->changed[j];
            if (s->uv.parts[j] || !((m->from_moves && joined_at(s, f, g, m->from)) ||
                                    (m->to_moves && joined_at(s, f, g, m->to))))
                continue;
            s->uv.parts[j] = part;
            s->uv.stack[depth++] = (uint32_t)j;
        }
    }
}

/* *whole is false where a sheet comes back to the edge from the other side of a seam. */
static void find_parts(ktg_simplify *s, const move *m, bool *whole) {
    size_t first = s->changed_count, second = first + 1;
    memset(s->uv.parts, 0, s->changed_count + s->removed_count);
    *whole = true;
    spread(s, m, first, 1);
    if (s->removed_count < 2)
        return;
    if (s->uv.parts[second] == 0)
        spread(s, m, second, 2);
    else
        *whole = ktg_uv_joined(s, s->changed[first], s->changed[second], m->from, m->to);
}

/* ---- the new coordinates -------------------------------------------------------------------- */

/* The weights of the point of a triangle that is nearest to the origin (Ericson 2005, 5.1.5). */
static void weigh_nearest(const ktg_vec3 t[3], double weights[3]) {
    ktg_vec3 ab = ktg_sub3(t[1], t[0]), ac = ktg_sub3(t[2], t[0]);
    double d1 = -ktg_dot3(ab, t[0]), d2 = -ktg_dot3(ac, t[0]), d3 = -ktg_dot3(ab, t[1]),
           d4 = -ktg_dot3(ac, t[1]), d5 = -ktg_dot3(ab, t[2]), d6 = -ktg_dot3(ac, t[2]);
    double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2, v = 0, w = 0;
    if (d1 <= 0 && d2 <= 0) {
        v = w = 0;
    } else if (d3 >= 0 && d4 <= d3) {
        v = 1;
    } else if (d6 >= 0 && d5 <= d6) {
        w = 1;
    } else if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        v = d1 / (d1 - d3);
    } else if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        w = d2 / (d2 - d6);
    } else if (va <= 0 && d4 >= d3 && d5 >= d6) {
        w = (d4 - d3) / (d4 - d3 + d5 - d6);
        v = 1 - w;
    } else {
        v = vb / (va + vb + vc);
        w = vc / (va + vb + vc);
    }
    weights[0] = 1 - v - w;
    weights[1] = v;
    weights[2] = w;
}

static ktg_vec2 blend(const ktg_vec2 uv[3], const double weights[3]) {
    return (ktg_vec2){weights[0] * uv[0].x + weights[1] * uv[1].x + weights[2] * uv[2].x,
                      weights[0] * uv[0].y + weights[1] * uv[1].y + weights[2] * uv[2].y};
}

/* The coordinates at the point nearest to the new position among the old shapes of a part. */
static ktg_vec2 nearest_uv(const ktg_simplify *s, const move *m, uint8_t part) {
    ktg_vec2 best = {NAN, NAN};
    double least = INFINITY;
    for (size_t i = 0; i < s->changed_count + s->removed_count; i++) {
        ktg_vec3 shape[3], point = {0, 0, 0};
        double weights[3];
        if (s->uv.parts[i] != part)
            continue;
        for (size_t k = 0; k < 3; k++) /* in the frame, where no product overflows */
            shape[k] = ktg_mul3(ktg_sub3(s->shapes[6 * i + k], m->position), s->scale);
        weigh_nearest(shape, weights);
        for (int k = 0; k < 3; k++)
            point = ktg_madd3(point, weights[k], shape[k]);
        if (ktg_dot3(point, point) < least) {
            least = ktg_dot3(point, point);
            best = blend(s->uv.corners + 3 * (size_t)s->changed[i], weights);
        }
    }
    return best;
}

/* The coordinates beside the new position on the edge, in the removed face: a seam stays the
 * outline of its charts. */
static ktg_vec2 uv_along(const ktg_simplify *s, const move *m, uint32_t removed) {
    ktg_vec3 edge = ktg_sub3(s->positions[m->to], s->positions[m->from]);
    double t = ktg_dot3(ktg_sub3(m->position, s->positions[m->from]), edge) / ktg_dot3(edge, edge);
    ktg_vec2 a = uv_at(s, removed, m->from), b = uv_at(s, removed, m->to);
    return ktg_madd2(a, t > 0 ? fmin(t, 1) : 0, ktg_sub2(b, a));
}

static bool is_seam(const ktg_simplify *s, uint32_t a, uint32_t b) {
    const uint32_t *removed = s->changed + s->changed_count;
    return s->removed_count == 2 && ktg_uv_seam(s, removed[0], removed[1], a, b);
}

/* The coordinates of the new vertex in the sheet of the removed face `removed`. */
static ktg_vec2 uv_of_part(const ktg_simplify *s, const move *m, uint32_t removed, uint8_t part) {
    if (ktg_uv_is_none(s->uv.corners[3 * (size_t)removed]))
        return (ktg_vec2){NAN, NAN};
    if (!m->to_moves)
        return uv_at(s, removed, m->to);
    if (!m->from_moves)
        return uv_at(s, removed, m->from);
    return is_seam(s, m->from, m->to) ? uv_along(s, m, removed) : nearest_uv(s, m, part);
}

static void set_moved(ktg_simplify *s, const move *m, bool whole) {
    ktg_vec2 none = {NAN, NAN}, of_part[3] = {none, none, none};
    for (size_t i = 0; whole && i < s->removed_count && i < 2; i++) {
        uint8_t part = s->uv.parts[s->changed_count + i];
        if (i == 0 || part == 2)
            of_part[part] = uv_of_part(s, m, s->changed[s->changed_count + i], part);
    }
    for (size_t i = 0; i < s->changed_count; i++) {
        uint32_t f = s->changed[i], vertex = has_vertex(s, f, m->from) ? m->from : m->to;
        ktg_vec2 old = uv_at(s, f, vertex);
        bool moves = vertex == m->from ? m->from_moves : m->to_moves;
        s->uv.moved[i] = !moves || ktg_uv_is_none(old) ? old : of_part[s->uv.parts[i]];
    }
}

/* What takes the place of a spare face loses its coordinates. */
static void drop_beside_spare(ktg_simplify *s, const move *m) {
    for (size_t r = 0; r < s->removed_count; r++) {
        uint32_t gone = s->changed[s->changed_count + r];
        for (size_t i = 0; i < s->changed_count && s->uv.spare[gone]; i++) {
            uint32_t f = s->changed[i], common = 0;
            bool moves = has_vertex(s, f, m->from) ? m->from_moves : m->to_moves;
            for (size_t k = 0; k < 3; k++)
                common += has_vertex(s, gone, s->faces[3 * (size_t)f + k]);
            if (moves && common == 2)
                s->uv.moved[i] = (ktg_vec2){NAN, NAN};
        }
    }
}

/* ---- what may not be ------------------------------------------------------------------------ */

/* The coordinates of a changed face, and what they become. */
static void face_uvs(const ktg_simplify *s, const move *m, size_t i, ktg_vec2 old[3],
                     ktg_vec2 new[3]) {
    uint32_t f = s->changed[i];
    for (size_t k = 0; k < 3; k++) {
        uint32_t vertex = s->faces[3 * (size_t)f + k];
        old[k] = s->uv.corners[3 * (size_t)f + k];
        new[k] = vertex == m->from || vertex == m->to ? s->uv.moved[i] : old[k];
    }
}

static double uv_area(const ktg_vec2 uv[3]) {
    return ktg_cross2(ktg_sub2(uv[1], uv[0]), ktg_sub2(uv[2], uv[0]));
}

/* Faces that would lie the other way round in the texture lose their coordinates. */
static void drop_turned(ktg_simplify *s, const move *m) {
    for (size_t i = 0; i < s->changed_count; i++) {
        ktg_vec2 old[3], new[3];
        face_uvs(s, m, i, old, new);
        double before = uv_area(old), after = uv_area(new);
        if ((before > 0 && !(after > 0)) || (before < 0 && !(after < 0)))
            s->uv.moved[i] = (ktg_vec2){NAN, NAN};
    }
}

/* Whether a face loses its coordinates that is not beside a spare one that goes. */
static bool loses_any(const ktg_simplify *s) {
    for (size_t r = 0; r < s->removed_count; r++)
        if (s->uv.spare[s->changed[s->changed_count + r]])
            return false;
    for (size_t i = 0; i < s->changed_count; i++)
        if (ktg_uv_is_none(s->uv.moved[i]) &&
            !ktg_uv_is_none(s->uv.corners[3 * (size_t)s->changed[i]]))
            return true;
    return false;
}

/* Squares of how long edges are in the texture for their length. */
static void note_ratios(const ktg_vec2 uv[3], const ktg_vec3 *shape, double *low, double *high) {
    for (int k = 0; k < 3; k++) {
        ktg_vec2 across = ktg_sub2(uv[(k + 1) % 3], uv[k]);
        ktg_vec3 edge = ktg_sub3(shape[(k + 1) % 3], shape[k]);
        double ratio = ktg_dot2(across, across) / ktg_dot3(edge, edge);
        *low = fmin(*low, ratio); /* both pass over NaN */
        *high = fmax(*high, ratio);
    }
}

static bool is_stretched(const ktg_simplify *s, const move *m) {
    double low = INFINITY, high = 0, new_low = INFINITY, new_high = 0;
    for (size_t i = 0; i < s->changed_count + s->removed_count; i++)
        note_ratios(s->uv.corners + 3 * (size_t)s->changed[i], s->shapes + 6 * i, &low, &high);
    for (size_t i = 0; i < s->changed_count; i++) {
        ktg_vec2 old[3], new[3];
        face_uvs(s, m, i, old, new);
        note_ratios(new, s->shapes + 6 * i + 3, &new_low, &new_high);
    }
    double most = most_stretch * most_stretch;
    return new_low * most < low || new_high > high * most;
}

/* A vertex on a seam goes along the seam. */
static bool leaves_seam(const ktg_simplify *s, const ktg_candidate *c) {
    return s->uv.bonds[c->from] != KTG_OFF_SEAM && !is_seam(s, c->from, c->to);
}

/* Whether removed face f has the border across its edge from `vertex` to `third`, or a seam that is
 * not closed at `vertex`. */
static bool ends_across(const ktg_simplify *s, uint32_t f, uint32_t vertex, uint32_t third) {
    for (size_t i = 0; i < s->changed_count; i++) {
        uint32_t g = s->changed[i];
        if (has_vertex(s, g, vertex) && has_vertex(s, g, third))
            return ktg_uv_seam(s, f, g, vertex, vertex);
    }
    return true;
}

/* A chart, or the neck of one, that is one face wide there would vanish. */
static bool closes_chart(const ktg_simplify *s, const ktg_candidate *c) {
    for (size_t i = 0; i < s->removed_count; i++) {
        uint32_t f = s->changed[s->changed_count + i], third = KTG_NONE;
        for (size_t k = 0; k < 3; k++) {
            uint32_t vertex = s->faces[3 * (size_t)f + k];
            if (vertex != c->from && vertex != c->to)
                third = vertex;
        }
        if (ends_across(s, f, c->from, third) && ends_across(s, f, c->to, third))
            return true;
    }
    return false;
}

static bool same_place(ktg_vec3 a, ktg_vec3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

ktg_status ktg_simplify_uv_allowed(ktg_simplify *s, const ktg_candidate *c, ktg_vec3 position,
                                   bool *allowed) {
    size_t total = s->changed_count + s->removed_count;
    bool whole;
    bool keeps_to = ktg_simplify_bond(s, c->to) > ktg_simplify_bond(s, c->from);
    move m = {c->from, c->to, position, !same_place(position, s->positions[c->from]),
              !keeps_to && !same_place(position, s->positions[c->to])};
    KTG_TRY(ktg_reserve(s->context, &s->uv.parts, &s->uv.part_capacity, total));
    KTG_TRY(ktg_reserve(s->context, &s->uv.moved, &s->uv.moved_capacity, total));
    KTG_TRY(ktg_reserve(s->context, &s->uv.stack, &s->uv.stack_capacity, total));
    *allowed = !s->uv.kept || !(leaves_seam(s, c) || closes_chart(s, c));
    if (!*allowed)
        return KTG_OK;
    find_parts(s, &m, &whole);
    set_moved(s, &m, whole);
    drop_beside_spare(s, &m);
    drop_turned(s, &m);
    *allowed = !s->uv.kept || !(loses_any(s) || is_stretched(s, &m));
    return KTG_OK;
}

void ktg_simplify_move_uvs(ktg_simplify *s, const ktg_candidate *c) {
    for (size_t i = 0; s->uv.corners && i < s->changed_count; i++) {
        uint32_t f = s->changed[i];
        ktg_vec2 *corners = s->uv.corners + 3 * (size_t)f, uv = s->uv.moved[i];
        bool had_none = ktg_uv_is_none(corners[0]);
        corners[corner_of(s, f, has_vertex(s, f, c->from) ? c->from : c->to)] = uv;
        s->uv.spare[f] |= ktg_uv_is_none(uv) && !had_none;
        for (int k = 0; k < 3 && ktg_uv_is_none(uv); k++)
            corners[k] = uv;
    }
}
