/* tests/pattern/nets.c - small patterns to test with, made without unfold/. */
#include "nets.h"

#include "core/memory.h"
#include "core/random.h"
#include "core/vec.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static surface *surface_of(const double *vertices, uint32_t vertex_count, const uint32_t *faces,
                           uint32_t face_count, double scale) {
    surface *s = calloc(1, sizeof *s);
    s->vertex_count = vertex_count;
    s->face_count = face_count;
    for (uint32_t v = 0; v < vertex_count; v++)
        s->vertices[v] = (ktg_vec3){scale * vertices[3 * v], scale * vertices[3 * v + 1],
                                    scale * vertices[3 * v + 2]};
    memcpy(s->faces, faces, 3 * face_count * sizeof *faces);
    return s;
}

surface *make_tetrahedron(double side) {
    static const double v[] = {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1};
    static const uint32_t f[] = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
    return surface_of(v, 4, f, 4, side / sqrt(8));
}

surface *make_cube(double side) {
    static const double v[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0,
                               0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
    static const uint32_t f[] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
    return surface_of(v, 8, f, 12, side);
}

surface *make_prism(uint32_t n, double side, double height) {
    surface *s = calloc(1, sizeof *s);
    double radius = side / (2 * sin(KTG_PI / n));
    for (uint32_t k = 0; k < n; k++) {
        double x = radius * cos(2 * KTG_PI * k / n), y = radius * sin(2 * KTG_PI * k / n);
        s->vertices[k] = (ktg_vec3){x, y, 0};
        s->vertices[n + k] = (ktg_vec3){x, y, height};
    }
    s->vertex_count = 2 * n;
    uint32_t *f = s->faces;
    for (uint32_t k = 0; k < n; k++) {
        uint32_t next = (k + 1) % n;
        uint32_t wall[6] = {k, next, n + next, k, n + next, n + k};
        memcpy(f, wall, sizeof wall);
        f += 6;
        if (k < 1 || k + 1 >= n)
            continue;
        uint32_t lids[6] = {0, k + 1, k, n, n + k, n + k + 1};
        memcpy(f, lids, sizeof lids);
        f += 6;
    }
    s->face_count = (uint32_t)(f - s->faces) / 3;
    return s;
}

static uint32_t middle_of(surface *s, uint32_t a, uint32_t b) {
    ktg_vec3 p = ktg_unit3(ktg_add3(s->vertices[a], s->vertices[b]));
    for (uint32_t v = 0; v < s->vertex_count; v++)
        if (ktg_length3(ktg_sub3(s->vertices[v], p)) < 1e-9)
            return v;
    s->vertices[s->vertex_count] = p;
    return s->vertex_count++;
}

static void subdivide(surface *s) {
    uint32_t *old = malloc(3 * s->face_count * sizeof *old), count = s->face_count;
    memcpy(old, s->faces, 3 * count * sizeof *old);
    s->face_count = 0;
    for (uint32_t f = 0; f < count; f++) {
        uint32_t *c = &old[3 * f], m[3];
        for (int k = 0; k < 3; k++)
            m[k] = middle_of(s, c[k], c[(k + 1) % 3]);
        uint32_t four[12] = {c[0], m[0], m[2], m[0], c[1], m[1],
                             m[2], m[1], c[2], m[0], m[1], m[2]};
        memcpy(&s->faces[3 * s->face_count], four, sizeof four);
        s->face_count += 4;
    }
    free(old);
}

surface *make_bumpy_ball(double radius, double bumps, int level, uint64_t seed) {
    static const double v[] = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
    static const uint32_t f[] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4,
                                 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    surface *s = surface_of(v, 6, f, 8, 1);
    ktg_random random;
    ktg_random_seed(&random, seed);
    for (int k = 0; k < level; k++)
        subdivide(s);
    for (uint32_t k = 0; k < s->vertex_count; k++)
        s->vertices[k] =
            ktg_mul3(s->vertices[k], radius * (1 + bumps * (ktg_random_unit(&random) - 0.5)));
    return s;
}

surface *make_strip(uint32_t n, double step, double width) {
    surface *s = calloc(1, sizeof *s);
    for (uint32_t k = 0; k <= n; k++) {
        s->vertices[2 * k] = (ktg_vec3){k * step, 0, 0};
        s->vertices[2 * k + 1] = (ktg_vec3){k * step, width, 0};
    }
    s->vertex_count = 2 * n + 2;
    for (uint32_t k = 0; k < n; k++) {
        uint32_t six[6] = {2 * k, 2 * k + 2, 2 * k + 3, 2 * k, 2 * k + 3, 2 * k + 1};
        memcpy(&s->faces[6 * k], six, sizeof six);
    }
    s->face_count = 2 * n;
    return s;
}

/* ---- the net ------------------------------------------------------------------------------ */

typedef struct net {
    const surface *s;
    ktg_pattern *pattern;
    uint32_t *edge_of; /* 3 face_count */
    bool *placed;      /* face_count */
    uint32_t (*corner)[3];
} net;

static ktg_vec3 normal_of(const surface *s, uint32_t f) {
    const ktg_vec3 *v = s->vertices;
    const uint32_t *c = &s->faces[3 * f];
    return ktg_unit3(ktg_cross3(ktg_sub3(v[c[1]], v[c[0]]), ktg_sub3(v[c[2]], v[c[0]])));
}

static void find_edges(ktg_context *context, net *n) {
    const surface *s = n->s;
    ktg_pattern *p = n->pattern;
    p->edges = ktg_new(context, 3 * s->face_count, ktg_pattern_edge);
    for (uint32_t h = 0; h < 3 * s->face_count; h++) {
        uint32_t a = s->faces[h], b = s->faces[h % 3 == 2 ? h - 2 : h + 1], e = 0;
        while (e < p->edge_count && (p->edges[e].vertices[0] != b || p->edges[e].vertices[1] != a))
            e++;
        ktg_pattern_edge *edge = &p->edges[e];
        if (e == p->edge_count) {
            *edge = (ktg_pattern_edge){{a, b}, KTG_EDGE_BORDER, 0, 0, {{0, 0, 0}}, -1, KTG_NONE};
            p->edge_count++;
        } else {
            ktg_vec3 n0 = normal_of(s, edge->sides[0].face), n1 = normal_of(s, h / 3);
            ktg_vec3 d = ktg_sub3(s->vertices[b], s->vertices[a]);
            edge->kind = KTG_EDGE_CUT;
            edge->angle = -atan2(ktg_dot3(ktg_cross3(n0, n1), ktg_unit3(d)), ktg_dot3(n0, n1));
        }
        edge->sides[edge->side_count++] = (ktg_pattern_side){0, h / 3, h % 3};
        n->edge_of[h] = e;
    }
}

/* The third corner of a face whose edge k lies from p to q. */
static ktg_vec2 third(const surface *s, uint32_t f, uint32_t k, ktg_vec2 p, ktg_vec2 q) {
    ktg_vec3 a = s->vertices[s->faces[3 * f + k]], b = s->vertices[s->faces[3 * f + (k + 1) % 3]];
    ktg_vec3 c = s->vertices[s->faces[3 * f + (k + 2) % 3]];
    ktg_vec3 d = ktg_unit3(ktg_sub3(b, a)), v = ktg_sub3(c, a);
    double x = ktg_dot3(v, d), y = ktg_length3(ktg_madd3(v, -x, d));
    ktg_vec2 along = ktg_unit2(ktg_sub2(q, p));
    return ktg_madd2(ktg_madd2(p, x, along), y, ktg_perp2(along));
}

/* Both triangles counter-clockwise: true when no side of either separates them. */
static bool overlap(const ktg_vec2 a[3], const ktg_vec2 b[3], double spare) {
    for (int which = 0; which < 2; which++)
        for (int i = 0; i < 3; i++) {
            const ktg_vec2 *from = which ? b : a, *other = which ? a : b;
            ktg_vec2 n = ktg_unit2(ktg_perp2(ktg_sub2(from[(i + 1) % 3], from[i])));
            double most = -INFINITY;
            for (int k = 0; k < 3; k++)
                most = fmax(most, ktg_dot2(n, ktg_sub2(other[k], from[i])));
            if (most <= spare)
                return false;
        }
    return true;
}

static bool is_free(const ktg_pattern_piece *piece, const ktg_vec2 triangle[3], double spare) {
    for (size_t slot = 0; slot < piece->face_count; slot++) {
        ktg_vec2 other[3];
        for (int k = 0; k < 3; k++)
            other[k] = piece->vertices[piece->corners[3 * slot + k]];
        if (overlap(triangle, other, spare))
            return false;
    }
    return true;
}

static void add_face(net *n, ktg_pattern_piece *piece, uint32_t f, const uint32_t corners[3]) {
    memcpy(&piece->corners[3 * piece->face_count], corners, 3 * sizeof *corners);
    memcpy(n->corner[f], corners, 3 * sizeof *corners);
    piece->faces[piece->face_count++] = f;
    n->placed[f] = true;
    for (uint32_t k = 0; k < 3; k++) {
        ktg_pattern_edge *edge = &n->pattern->edges[n->edge_of[3 * f + k]];
        for (uint32_t s = 0; s < edge->side_count; s++)
            if (edge->sides[s].face == f)
                edge->sides[s].piece = (uint32_t)(piece - n->pattern->pieces);
    }
}

/* Tries to lay down the face across half-edge h of a placed face. */
static bool try_across(net *n, ktg_pattern_piece *piece, uint32_t h) {
    ktg_pattern_edge *edge = &n->pattern->edges[n->edge_of[h]];
    uint32_t other = edge->sides[0].face == h / 3;
    if (edge->side_count < 2 || n->placed[edge->sides[other].face])
        return false;
    uint32_t f = edge->sides[other].face, k = edge->sides[other].corner;
    uint32_t corners[3] = {0, 0, 0};
    corners[k] = n->corner[h / 3][(h % 3 + 1) % 3];
    corners[(k + 1) % 3] = n->corner[h / 3][h % 3];
    corners[(k + 2) % 3] = (uint32_t)piece->vertex_count;
    ktg_vec2 p = piece->vertices[corners[k]], q = piece->vertices[corners[(k + 1) % 3]];
    piece->vertices[piece->vertex_count] = third(n->s, f, k, p, q);
    ktg_vec2 triangle[3];
    for (int i = 0; i < 3; i++)
        triangle[i] = piece->vertices[corners[i]];
    if (!is_free(piece, triangle, 1e-9 * ktg_length2(ktg_sub2(q, p))))
        return false;
    piece->vertex_count++;
    add_face(n, piece, f, corners);
    edge->kind = fabs(edge->angle) < 1e-3 ? KTG_EDGE_FLAT
                 : edge->angle > 0        ? KTG_EDGE_MOUNTAIN
                                          : KTG_EDGE_VALLEY;
    return true;
}

static void grow_piece(ktg_context *context, net *n, uint32_t first, uint32_t most_faces,
                       ktg_random *random) {
    const surface *s = n->s;
    ktg_pattern_piece *piece = &n->pattern->pieces[n->pattern->piece_count++];
    piece->cut_count = 1;
    piece->vertices = ktg_new(context, s->face_count + 2, ktg_vec2);
    piece->faces = ktg_new(context, s->face_count, uint32_t);
    piece->corners = ktg_new(context, 3 * s->face_count, uint32_t);
    const ktg_vec3 *v = s->vertices;
    const uint32_t *c = &s->faces[3 * first];
    piece->vertices[1].x = ktg_length3(ktg_sub3(v[c[1]], v[c[0]]));
    piece->vertices[2] = third(s, first, 0, piece->vertices[0], piece->vertices[1]);
    piece->vertex_count = 3;
    add_face(n, piece, first, (uint32_t[3]){0, 1, 2});
    uint32_t *open = calloc(3 * s->face_count + 3, sizeof *open), count = 0;
    for (uint32_t k = 0; k < 3; k++)
        open[count++] = 3 * first + k;
    while (count > 0 && piece->face_count < most_faces) {
        uint32_t i = (uint32_t)ktg_random_below(random, count), h = open[i];
        open[i] = open[--count];
        if (!try_across(n, piece, h))
            continue;
        uint32_t f = piece->faces[piece->face_count - 1];
        for (uint32_t k = 0; k < 3; k++)
            open[count++] = 3 * f + k;
    }
    free(open);
}

ktg_pattern *grow_net(ktg_context *context, surface *s, uint32_t most_faces, uint64_t seed) {
    ktg_pattern *p = ktg_new(context, 1, ktg_pattern);
    net n = {s, p, calloc(3 * s->face_count, sizeof(uint32_t)), calloc(s->face_count, 1), NULL};
    ktg_random random;
    ktg_random_seed(&random, seed);
    n.corner = calloc(s->face_count, sizeof *n.corner);
    p->mm_per_unit = 1;
    p->vertex_count = s->vertex_count;
    p->face_count = p->model_faces = s->face_count;
    p->vertices = ktg_copy_array(context, s->vertices, s->vertex_count, sizeof *s->vertices);
    p->faces = ktg_copy_array(context, s->faces, 3 * s->face_count, sizeof *s->faces);
    p->components = ktg_new(context, 1, ktg_pattern_component);
    p->components[0].name = ktg_copy_text(context, "ball", 10);
    p->component_count = 1;
    p->pieces = ktg_new(context, s->face_count, ktg_pattern_piece);
    find_edges(context, &n);
    for (uint32_t f = 0; f < s->face_count; f++)
        if (!n.placed[f])
            grow_piece(context, &n, f, most_faces, &random);
    free(n.edge_of);
    free(n.placed);
    free(n.corner);
    free(s);
    return p;
}

ktg_pattern *net_finished(ktg_context *context, surface *s, uint32_t most_faces, uint64_t seed,
                          const ktg_finish_options *options) {
    ktg_pattern *p = grow_net(context, s, most_faces, seed);
    assert_int_equal(ktg_pattern_finish(context, p, options, NULL), KTG_OK);
    return p;
}

bool net_has_text(const ktg_pattern *p, const char *text) {
    for (size_t i = 0; i < p->piece_count; i++)
        for (size_t k = 0; k < p->pieces[i].label_count; k++)
            if (strcmp(p->pieces[i].labels[k].text, text) == 0)
                return true;
    return false;
}
