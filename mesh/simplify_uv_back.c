/* mesh/simplify_uv_back.c - texture coordinates of the simplified mesh: made exact, and given back.
 */
#include "core/memory.h"
#include "core/vec.h"
#include "mesh/closest.h"
#include "mesh/simplify.h"

#include <string.h>

/* ---- made exact ----------------------------------------------------------------------------- */

/* The weights of a point of the plane of a triangle. */
static void weigh(ktg_vec3 a, ktg_vec3 b, ktg_vec3 c, ktg_vec3 point, double weights[3]) {
    ktg_vec3 ab = ktg_sub3(b, a), ac = ktg_sub3(c, a), ap = ktg_sub3(point, a);
    double bb = ktg_dot3(ab, ab), bc = ktg_dot3(ab, ac), cc = ktg_dot3(ac, ac);
    double pb = ktg_dot3(ap, ab), pc = ktg_dot3(ap, ac), det = bb * cc - bc * bc;
    weights[1] = (cc * pb - bc * pc) / det;
    weights[2] = (bb * pc - bc * pb) / det;
    weights[0] = 1 - weights[1] - weights[2];
}

/* The texture coordinates of a point of face f of the input. */
static ktg_vec2 uv_of_point(const ktg_simplify *s, uint32_t f, ktg_vec3 point) {
    const ktg_mesh *mesh = s->uv.mesh;
    const uint32_t *corner = mesh->faces + 3 * (size_t)f, *uv = mesh->face_uv + 3 * (size_t)f;
    ktg_vec3 p[3];
    ktg_vec2 result = {0, 0};
    double weights[3];
    for (int k = 0; k < 3; k++) /* scaled, so that no product overflows */
        p[k] = ktg_mul3(ktg_sub3(mesh->positions[corner[k]], point), s->scale);
    weigh(p[0], p[1], p[2], (ktg_vec3){0, 0, 0}, weights);
    for (int k = 0; k < 3; k++)
        result = ktg_madd2(result, weights[k], mesh->uvs[uv[k]]);
    return result;
}

/* The corner of face f at `vertex`. */
static ktg_vec2 *corner_uv(const ktg_simplify *s, uint32_t f, uint32_t vertex) {
    const uint32_t *corner = s->faces + 3 * (size_t)f;
    return &s->uv.corners[3 * (size_t)f + (corner[0] == vertex ? 0 : corner[1] == vertex ? 1 : 2)];
}

static double uv_area(const ktg_simplify *s, uint32_t f) {
    const ktg_vec2 *uv = s->uv.corners + 3 * (size_t)f;
    return ktg_cross2(ktg_sub2(uv[1], uv[0]), ktg_sub2(uv[2], uv[0]));
}

/* Whether the faces around a vertex are of one chart and have one texture coordinate at it. */
static bool is_in_chart(const ktg_simplify *s, const uint32_t *faces, uint32_t count,
                        uint32_t vertex) {
    ktg_vec2 first = *corner_uv(s, faces[0], vertex);
    bool same = !ktg_uv_is_none(first);
    for (uint32_t i = 1; same && i < count; i++) {
        ktg_vec2 uv = *corner_uv(s, faces[i], vertex);
        same = uv.x == first.x && uv.y == first.y && s->uv.chart[faces[i]] == s->uv.chart[faces[0]];
    }
    return same;
}

/* Gives the vertex the coordinate unless a face would turn over in the texture. */
static void try_uv(ktg_simplify *s, const uint32_t *faces, uint32_t count, uint32_t vertex,
                   ktg_vec2 uv) {
    bool turned = false;
    ktg_vec2 old = *corner_uv(s, faces[0], vertex);
    for (uint32_t i = 0; i < count; i++) {
        double before = uv_area(s, faces[i]);
        *corner_uv(s, faces[i], vertex) = uv;
        double after = uv_area(s, faces[i]);
        turned |= (before > 0 && !(after > 0)) || (before < 0 && !(after < 0));
    }
    for (uint32_t i = 0; turned && i < count; i++)
        *corner_uv(s, faces[i], vertex) = old;
}

static ktg_status refine_vertex(ktg_simplify *s, const ktg_closest *closest, uint32_t vertex) {
    const uint32_t *faces;
    uint32_t count = ktg_halfedges_faces(s->halfedges, vertex, &faces), at = KTG_NONE;
    ktg_vec3 point;
    if (count == 0 || !is_in_chart(s, faces, count, vertex))
        return KTG_OK;
    KTG_TRY(ktg_closest_point(s->context, closest, s->positions[vertex], &point, &at));
    if (s->uv.chart[at] == s->uv.chart[faces[0]])
        try_uv(s, faces, count, vertex, uv_of_point(s, at, point));
    return KTG_OK;
}

/* The vertices of living faces that are not where they were. */
static void find_moved(const ktg_simplify *s, bool *moved) {
    for (size_t f = 0; f < s->face_count; f++)
        for (size_t k = 0; k < 3 && s->alive[f]; k++) {
            uint32_t v = s->faces[3 * f + k];
            ktg_vec3 p = s->positions[v], q = s->uv.mesh->positions[v];
            moved[v] = p.x != q.x || p.y != q.y || p.z != q.z;
        }
}

ktg_status ktg_simplify_refine_uvs(ktg_simplify *s) {
    ktg_closest *closest = NULL;
    if (!s->uv.corners)
        return KTG_OK;
    bool *moved = ktg_new(s->context, s->vertex_count, bool);
    ktg_status status = moved ? ktg_closest_new(s->context, s->uv.mesh, &closest) : KTG_MEMORY;
    if (status == KTG_OK)
        find_moved(s, moved);
    for (uint32_t v = 0; status == KTG_OK && v < s->vertex_count; v++)
        if (moved[v])
            status = refine_vertex(s, closest, v);
    ktg_closest_free(&closest);
    ktg_free(moved);
    return status;
}

/* ---- given back ----------------------------------------------------------------------------- */

/* Coordinates as they are made: those of one vertex follow each other as a list. */
typedef struct uv_table {
    ktg_vec2 *uvs;
    uint32_t *next;  /* per coordinate: the vertex's next one, KTG_NONE at the end */
    uint32_t *first; /* per vertex */
    uint32_t count;
} uv_table;

static uint32_t number_of(uv_table *table, uint32_t vertex, ktg_vec2 uv) {
    uint32_t *at = &table->first[vertex];
    while (*at != KTG_NONE && (table->uvs[*at].x != uv.x || table->uvs[*at].y != uv.y))
        at = &table->next[*at];
    if (*at != KTG_NONE)
        return *at;
    *at = table->count;
    table->uvs[table->count] = uv;
    table->next[table->count] = KTG_NONE;
    return table->count++;
}

static void fill(const ktg_simplify *s, uv_table *table, uint32_t *face_uv, uint32_t *lost) {
    size_t kept = 0;
    *lost = 0;
    for (size_t f = 0; f < s->face_count; f++) {
        if (!s->alive[f])
            continue;
        const uint32_t *before = s->uv.mesh->face_uv + 3 * f;
        bool none = ktg_uv_is_none(s->uv.corners[3 * f]);
        *lost += none && before[0] != KTG_NONE && before[1] != KTG_NONE && before[2] != KTG_NONE;
        for (size_t k = 0; k < 3; k++)
            face_uv[kept++] =
                none ? KTG_NONE : number_of(table, s->faces[3 * f + k], s->uv.corners[3 * f + k]);
    }
}

ktg_status ktg_simplify_give_uvs(const ktg_simplify *s, ktg_mesh *mesh, uint32_t *lost) {
    size_t corners = 3 * (size_t)s->live_faces;
    *lost = 0;
    if (!s->uv.corners)
        return KTG_OK;
    uv_table table = {.uvs = ktg_new(s->context, corners, ktg_vec2),
                      .next = ktg_new(s->context, corners, uint32_t),
                      .first = ktg_new(s->context, s->vertex_count, uint32_t)};
    uint32_t *face_uv = ktg_new(s->context, corners, uint32_t);
    bool ready = table.uvs && table.next && table.first && face_uv;
    if (ready) {
        memset(table.first, 0xff, s->vertex_count * sizeof *table.first);
        fill(s, &table, face_uv, lost);
        ktg_free(mesh->uvs);
        ktg_free(mesh->face_uv);
        mesh->uvs = table.uvs;
        mesh->face_uv = face_uv;
        mesh->uv_count = table.count;
    } else {
        ktg_free(table.uvs);
        ktg_free(face_uv);
    }
    ktg_free(table.next);
    ktg_free(table.first);
    return ready ? KTG_OK : KTG_MEMORY;
}
