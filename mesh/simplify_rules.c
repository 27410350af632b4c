/* mesh/simplify_rules.c - what a collapse may not do to the faces around it. */
#include "core/memory.h"
#include "mesh/intersect.h"
#include "mesh/simplify.h"
#include "mesh/weld.h"

/* A face may turn by 78 degrees at most in one collapse. */
static const double least_turn_cosine = 0.2;

/* How high over its longest edge, as a part of it, a face has to stay unless one was worse. */
static const double least_height[KTG_STRICTNESS_COUNT] = {0.12, 1e-3};

/* Two faces may fold on each other up to about 11 degrees unless two did already. */
static const double least_fold_cosine = -0.98;

/* Where so much of the surface is around, or so many pairs of faces intersect, nothing is
 * collapsed: it would take long to prove that it does no harm. */
enum { MOST_AROUND = 1024, MOST_PAIRS = 64 };

static bool has_corner(const uint32_t *face, uint32_t vertex) {
    return face[0] == vertex || face[1] == vertex || face[2] == vertex;
}

static ktg_status add_face(ktg_simplify *s, uint32_t face, size_t at) {
    KTG_TRY(ktg_reserve(s->context, &s->changed, &s->changed_capacity, at + 1));
    KTG_TRY(ktg_reserve(s->context, &s->shapes, &s->shape_capacity, 6 * (at + 1)));
    KTG_TRY(ktg_reserve(s->context, &s->outlines, &s->outline_capacity, at + 1));
    s->changed[at] = face;
    return KTG_OK;
}

static void set_shape(ktg_simplify *s, size_t at, const ktg_candidate *c, ktg_vec3 position) {
    const uint32_t *corner = s->faces + 3 * (size_t)s->changed[at];
    for (int k = 0; k < 3; k++) {
        bool moves = corner[k] == c->from || corner[k] == c->to;
        s->shapes[6 * at + (size_t)k] = s->positions[corner[k]];
        s->shapes[6 * at + 3 + (size_t)k] = moves ? position : s->positions[corner[k]];
    }
}

/* Lists the faces around both vertices: those that stay first, then those on both. */
static ktg_status gather(ktg_simplify *s, const ktg_candidate *c, ktg_vec3 position) {
    const uint32_t *around;
    size_t total = 0;
    s->changed_count = 0;
    for (int pass = 0; pass < 3; pass++) {
        uint32_t vertex = pass == 1 ? c->to : c->from, other = pass == 1 ? c->from : c->to;
        uint32_t count = ktg_halfedges_faces(s->halfedges, vertex, &around);
        for (uint32_t i = 0; i < count; i++) {
            if (has_corner(s->faces + 3 * (size_t)around[i], other) != (pass == 2))
                continue;
            KTG_TRY(add_face(s, around[i], total));
            set_shape(s, total++, c, position);
        }
        if (pass == 1)
            s->changed_count = total;
    }
    s->removed_count = total - s->changed_count;
    return KTG_OK;
}

static ktg_vec3 normal_of(const ktg_vec3 *corners) {
    return ktg_cross3(ktg_sub3(corners[1], corners[0]), ktg_sub3(corners[2], corners[0]));
}

/* The height over the longest edge as a part of it, whatever the scale (weld.h). */
static double height_of(const ktg_vec3 *corners) {
    int longest;
    return ktg_mesh_flatness(corners, &longest);
}

static bool shapes_allowed(const ktg_simplify *s) {
    double before = INFINITY, after = INFINITY;
    for (size_t i = 0; i < s->changed_count + s->removed_count; i++)
        before = fmin(before, height_of(s->shapes + 6 * i));
    for (size_t i = 0; i < s->changed_count; i++) {
        const ktg_vec3 *old = s->shapes + 6 * i, *new = old + 3;
        ktg_vec3 from = ktg_unit3(normal_of(old)), to = ktg_unit3(normal_of(new));
        if (ktg_dot3(from, to) < least_turn_cosine)
            return false;
        after = fmin(after, height_of(new));
    }
    return after >= least_height[s->strictness] || (after > before && after >= KTG_MESH_FLAT);
}

static bool shares_corner_besides(const uint32_t *p, const uint32_t *q, const ktg_candidate *c) {
    for (int k = 0; k < 3; k++)
        if (p[k] != c->from && p[k] != c->to && has_corner(q, p[k]))
            return true;
    return false;
}

/* The sharpest fold between faces around the collapse, as the cosine between their normals: old
 * (`offset` 0) or new (3). */
static double sharpest_fold(const ktg_simplify *s, const ktg_candidate *c, size_t offset) {
    double cosine = 1;
    for (size_t i = 0; i < s->changed_count; i++)
        for (size_t j = i + 1; j < s->changed_count; j++) {
            const uint32_t *p = s->faces + 3 * (size_t)s->changed[i];
            const uint32_t *q = s->faces + 3 * (size_t)s->changed[j];
            if (!shares_corner_besides(p, q, c))
                continue;
            ktg_vec3 m = ktg_unit3(normal_of(s->shapes + 6 * i + offset));
            ktg_vec3 n = ktg_unit3(normal_of(s->shapes + 6 * j + offset));
            cosine = fmin(cosine, ktg_dot3(m, n));
        }
    return cosine;
}

static bool folds_allowed(const ktg_simplify *s, const ktg_candidate *c) {
    double fold = sharpest_fold(s, c, 3);
    return fold > least_fold_cosine || fold > sharpest_fold(s, c, 0);
}

/* Faces that are in `changed`, staying or going. */
static bool is_listed(const ktg_simplify *s, uint32_t face) {
    for (size_t i = 0; i < s->changed_count + s->removed_count; i++)
        if (s->changed[i] == face)
            return true;
    return false;
}

static void face_shape(const ktg_simplify *s, uint32_t face, ktg_vec3 corners[3]) {
    for (int k = 0; k < 3; k++)
        corners[k] = s->positions[s->faces[3 * (size_t)face + (size_t)k]];
}

/* Intersecting pairs among the first `count` listed shapes. */
static size_t pairs_within(ktg_simplify *s, size_t count, size_t offset, size_t most) {
    size_t pairs = 0;
    for (size_t i = 0; i < count; i++)
        for (size_t j = i + 1; j < count && pairs < most; j++)
            pairs +=
                ktg_triangles_intersect(s->shapes + 6 * i + offset, s->shapes + 6 * j + offset);
    return pairs;
}

/* Those of them with face `other` of the surface. */
static size_t pairs_with(ktg_simplify *s, uint32_t other, size_t count, size_t offset) {
    ktg_vec3 q[3];
    size_t pairs = 0;
    face_shape(s, other, q);
    ktg_box box = ktg_box_of(q[0], q[1], q[2]);
    for (size_t i = 0; i < count; i++)
        pairs += ktg_box_meets(box, s->outlines[i]) &&
                 ktg_triangles_intersect(s->shapes + 6 * i + offset, q);
    return pairs;
}

/* Intersecting pairs among `count` listed shapes, old (`offset` 0) or new (3), and between them and
 * the rest of the surface; counting may stop at `most`. *crowded: so much is around that some
 * may be missing. */
static ktg_status count_pairs(ktg_simplify *s, size_t count, size_t offset, size_t most,
                              size_t *pairs, bool *crowded) {
    size_t found;
    for (size_t i = 0; i < count; i++) {
        const ktg_vec3 *p = s->shapes + 6 * i + offset;
        s->outlines[i] = ktg_box_of(p[0], p[1], p[2]);
    }
    ktg_box all = s->outlines[0];
    for (size_t i = 1; i < count; i++)
        all = ktg_box_join(all, s->outlines[i]);
    *pairs = pairs_within(s, count, offset, most);
    KTG_TRY(ktg_boxes_query(s->context, s->boxes, all, MOST_AROUND, &s->found, &s->found_capacity,
                            &found));
    *crowded = found == MOST_AROUND;
    for (size_t k = 0; k < found && *pairs < most; k++)
        if (!is_listed(s, s->found[k]))
            *pairs += pairs_with(s, s->found[k], count, offset);
    return KTG_OK;
}

/* No more intersecting pairs than there were. Usually there is none after, and what was before
 * need not be known. */
static ktg_status intersections_allowed(ktg_simplify *s, bool *allowed) {
    size_t after, before = 0;
    bool crowded, any;
    KTG_TRY(count_pairs(s, s->changed_count, 3, MOST_PAIRS, &after, &crowded));
    if (after > 0 && after < MOST_PAIRS && !crowded)
        KTG_TRY(count_pairs(s, s->changed_count + s->removed_count, 0, after, &before, &any));
    *allowed = after <= before && !crowded;
    return KTG_OK;
}

ktg_status ktg_simplify_allowed(ktg_simplify *s, const ktg_candidate *candidate, ktg_vec3 position,
                                bool *allowed) {
    *allowed = false;
    KTG_TRY(gather(s, candidate, position));
    if (s->changed_count == 0 || !shapes_allowed(s) || !folds_allowed(s, candidate))
        return KTG_OK;
    *allowed = true;
    if (s->uv.corners)
        KTG_TRY(ktg_simplify_uv_allowed(s, candidate, position, allowed));
    if (!*allowed)
        return KTG_OK;
    return intersections_allowed(s, allowed);
}
