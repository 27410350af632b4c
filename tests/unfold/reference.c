/* tests/unfold/reference.c - slow and plain forms of what unfold/ computes. */
#include "tests/unfold/reference.h"
#include "core/memory.h"
#include "core/vec.h"
#include "tests/unfold/shapes.h"

#include <stdlib.h>
#include <string.h>

/* ---- overlap ----------------------------------------------------------------------------------
 */

static int by_x(const void *left, const void *right) {
    const ktg_vec2 *a = left, *b = right;
    if (a->x != b->x)
        return a->x < b->x ? -1 : 1;
    return (a->y > b->y) - (a->y < b->y);
}

/* Andrew's monotone chain. */
static int convex_hull(ktg_vec2 *points, int count, ktg_vec2 *hull) {
    int n = 0;
    qsort(points, (size_t)count, sizeof *points, by_x);
    for (int pass = 0; pass < 2; pass++) {
        int floor = n + 1;
        for (int i = 0; i < count; i++) {
            ktg_vec2 p = points[pass ? count - 1 - i : i];
            while (n > floor &&
                   ktg_cross2(ktg_sub2(hull[n - 1], hull[n - 2]), ktg_sub2(p, hull[n - 2])) <= 0)
                n--;
            hull[n++] = p;
        }
        n--; /* the next pass begins with it */
    }
    return n;
}

double reference_depth(const ktg_vec2 a[3], const ktg_vec2 b[3]) {
    ktg_vec2 points[9], hull[20];
    for (int i = 0; i < 9; i++)
        points[i] = ktg_sub2(a[i / 3], b[i % 3]);
    int n = convex_hull(points, 9, hull);
    double depth = INFINITY;
    for (int i = 0; i < n; i++) {
        ktg_vec2 edge = ktg_sub2(hull[(i + 1) % n], hull[i]);
        double length = ktg_length2(edge);
        if (length > 0)
            depth = fmin(depth, ktg_cross2(edge, ktg_mul2(hull[i], -1)) / length);
    }
    return depth;
}

static int clip(const ktg_vec2 *in, int count, ktg_vec2 p, ktg_vec2 q, ktg_vec2 *out) {
    int n = 0;
    for (int i = 0; i < count; i++) {
        ktg_vec2 here = in[i], next = in[(i + 1) % count];
        double s = ktg_cross2(ktg_sub2(q, p), ktg_sub2(here, p));
        double t = ktg_cross2(ktg_sub2(q, p), ktg_sub2(next, p));
        if (s >= 0)
            out[n++] = here;
        if ((s > 0 && t < 0) || (s < 0 && t > 0))
            out[n++] = ktg_madd2(here, s / (s - t), ktg_sub2(next, here));
    }
    return n;
}

double reference_common_area(const ktg_vec2 a[3], const ktg_vec2 b[3]) {
    ktg_vec2 polygon[16], other[16];
    int n = 3;
    memcpy(polygon, a, 3 * sizeof *a);
    for (int k = 0; k < 3; k++) {
        n = clip(polygon, n, b[k], b[(k + 1) % 3], other);
        memcpy(polygon, other, sizeof polygon);
    }
    double area = 0;
    for (int i = 0; i < n; i++)
        area += 0.5 * ktg_cross2(ktg_sub2(polygon[i], polygon[0]),
                                 ktg_sub2(polygon[(i + 1) % n], polygon[0]));
    return area;
}

double reference_deepest(const ktg_vec2 *corners, uint32_t count) {
    double deepest = -INFINITY;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = i + 1; j < count; j++)
            deepest = fmax(deepest, reference_depth(corners + 3 * i, corners + 3 * j));
    return deepest;
}

/* ---- laying flat ------------------------------------------------------------------------------
 */

static double length_of(const ktg_mesh *mesh, uint32_t halfedge) {
    uint32_t next = halfedge % 3 == 2 ? halfedge - 2 : halfedge + 1;
    return ktg_length3(
        ktg_sub3(mesh->positions[mesh->faces[next]], mesh->positions[mesh->faces[halfedge]]));
}

/* The third corner on the left of from -> to, which are half-edge h's ends. */
static ktg_vec2 third_corner(const ktg_mesh *mesh, uint32_t h, ktg_vec2 from, ktg_vec2 to) {
    uint32_t f = h - h % 3;
    ktg_vec3 p = mesh->positions[mesh->faces[h]];
    ktg_vec3 along = ktg_sub3(mesh->positions[mesh->faces[f + (h + 1 - f) % 3]], p);
    ktg_vec3 apex = ktg_sub3(mesh->positions[mesh->faces[f + (h + 2 - f) % 3]], p);
    double square = ktg_dot3(along, along);
    ktg_vec2 u = ktg_sub2(to, from);
    return ktg_madd2(ktg_madd2(from, ktg_dot3(along, apex) / square, u),
                     ktg_length3(ktg_cross3(along, apex)) / square, ktg_perp2(u));
}

static void lay_on(const ktg_mesh *mesh, const ktg_adjacency *a, const bool *is_fold, uint32_t face,
                   ktg_vec2 *corners, bool *reached) {
    reached[face] = true;
    for (uint32_t h = 3 * face; h < 3 * face + 3; h++) {
        uint32_t twin = a->twin[h], base = twin - twin % 3;
        if (twin == KTG_NONE || !is_fold[a->halfedge_edge[h]] || reached[twin / 3])
            continue;
        ktg_vec2 from = corners[3 * face + (h % 3 + 1) % 3], to = corners[h];
        corners[twin] = from;
        corners[base + (twin % 3 + 1) % 3] = to;
        corners[base + (twin % 3 + 2) % 3] = third_corner(mesh, twin, from, to);
        lay_on(mesh, a, is_fold, twin / 3, corners, reached);
    }
}

void reference_lay(const ktg_mesh *mesh, const ktg_adjacency *adjacency, const bool *is_fold,
                   uint32_t seed, ktg_vec2 *corners, bool *reached) {
    memset(reached, 0, mesh->face_count * sizeof *reached);
    ktg_vec2 *first = corners + 3 * seed;
    first[0] = (ktg_vec2){0, 0};
    first[1] = (ktg_vec2){length_of(mesh, 3 * seed), 0};
    first[2] = third_corner(mesh, 3 * seed, first[0], first[1]);
    lay_on(mesh, adjacency, is_fold, seed, corners, reached);
}

void reference_angle_sums(const ktg_mesh *mesh, double *sums) {
    memset(sums, 0, mesh->vertex_count * sizeof *sums);
    for (uint32_t h = 0; h < 3 * mesh->face_count; h++) {
        uint32_t f = h - h % 3;
        double a = length_of(mesh, h), b = length_of(mesh, f + (h + 1 - f) % 3);
        double c = length_of(mesh, f + (h + 2 - f) % 3);
        sums[mesh->faces[h]] += acos((a * a + c * c - b * b) / (2 * a * c));
    }
}

/* ---- nets -------------------------------------------------------------------------------------
 */

/* The largest side of the box around all faces. */
static double extent_of(const ktg_mesh *mesh) {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = 0; i < 3 * mesh->face_count; i++) {
        ktg_vec3 p = mesh->positions[mesh->faces[i]];
        const double at[3] = {p.x, p.y, p.z};
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], at[k]);
            high[k] = fmax(high[k], at[k]);
        }
    }
    return fmax(high[0] - low[0], fmax(high[1] - low[1], high[2] - low[2]));
}

/* Where a face of the surface lies: its piece and its place in it. */
typedef struct place {
    uint32_t piece, index;
} place;

static void assert_each_face_once(const ktg_mesh *mesh, const ktg_pattern *p, place *places) {
    size_t count = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++)
        places[f].piece = KTG_NONE;
    for (uint32_t i = 0; i < p->piece_count; i++)
        for (uint32_t k = 0; k < p->pieces[i].face_count; k++, count++) {
            uint32_t face = p->pieces[i].faces[k];
            assert_in_range(face, 0, mesh->face_count - 1);
            assert_int_equal(places[face].piece, KTG_NONE);
            places[face] = (place){i, k};
        }
    assert_int_equal(count, mesh->face_count);
}

static void corners_of(const ktg_pattern_piece *piece, uint32_t index, ktg_vec2 corners[3]) {
    for (int k = 0; k < 3; k++)
        corners[k] = piece->vertices[piece->corners[3 * index + (uint32_t)k]];
}

/* Lengths to 1e-9 of themselves (and the last digits of the coordinates), corners in range. */
static void assert_true_to_size(const ktg_mesh *mesh, const ktg_pattern_piece *piece) {
    double size = 0;
    for (size_t v = 0; v < piece->vertex_count; v++)
        size = fmax(size, ktg_length2(piece->vertices[v]));
    for (uint32_t i = 0; i < piece->face_count; i++) {
        ktg_vec2 c[3];
        for (int k = 0; k < 3; k++)
            assert_in_range(piece->corners[3 * i + (uint32_t)k], 0, piece->vertex_count - 1);
        corners_of(piece, i, c);
        for (uint32_t k = 0; k < 3; k++) {
            double want = length_of(mesh, 3 * piece->faces[i] + k);
            double have = ktg_length2(ktg_sub2(c[(k + 1) % 3], c[k]));
            assert_true(fabs(have - want) <= 1e-9 * want + 1e-15 * size);
        }
        assert_true(ktg_cross2(ktg_sub2(c[1], c[0]), ktg_sub2(c[2], c[0])) >= 0);
    }
}

static void assert_no_overlap(ktg_context *context, const ktg_pattern_piece *piece, double extent) {
    ktg_vec2 *corners = ktg_new(context, 3 * piece->face_count, ktg_vec2);
    for (uint32_t i = 0; i < piece->face_count; i++)
        corners_of(piece, i, corners + 3 * i);
    assert_true(reference_deepest(corners, (uint32_t)piece->face_count) <= 1.001e-7 * extent);
    ktg_free(corners);
}

/* Which of the piece's vertices is the surface's vertex `v` in `face`. */
static uint32_t copy_of(const ktg_pattern *p, const place *places, uint32_t face, uint32_t v) {
    const ktg_pattern_piece *piece = &p->pieces[places[face].piece];
    for (uint32_t k = 0; k < 3; k++)
        if (p->faces[3 * face + k] == v)
            return piece->corners[3 * places[face].index + k];
    fail();
    return KTG_NONE;
}

/* The turn from the face left of the edge to the face right of it, from the heights of their third
 * corners. */
static double turn_between(const ktg_pattern *p, const ktg_pattern_edge *edge) {
    ktg_vec3 from = p->vertices[edge->vertices[0]];
    ktg_vec3 along = ktg_unit3(ktg_sub3(p->vertices[edge->vertices[1]], from)), away[2];
    for (int i = 0; i < 2; i++) {
        const ktg_pattern_side *side = &edge->sides[i];
        uint32_t apex = p->faces[3 * side->face + (side->corner + 2) % 3];
        ktg_vec3 d = ktg_sub3(p->vertices[apex], from);
        away[i] = ktg_unit3(ktg_madd3(d, -ktg_dot3(d, along), along));
    }
    /* flat: away[1] == -away[0]; a mountain: both lean to the inside */
    double s = ktg_dot3(ktg_cross3(away[1], along), away[0]);
    return atan2(-s, -ktg_dot3(away[0], away[1]));
}

static void assert_edge(const ktg_pattern *p, const place *places, const ktg_pattern_edge *edge) {
    for (uint32_t i = 0; i < edge->side_count; i++) {
        const ktg_pattern_side *side = &edge->sides[i];
        assert_int_equal(side->piece, places[side->face].piece);
        assert_int_equal(p->faces[3 * side->face + side->corner], edge->vertices[i]);
        assert_int_equal(p->faces[3 * side->face + (side->corner + 1) % 3], edge->vertices[1 - i]);
    }
    assert_int_equal(edge->tab_on, -1);
    assert_int_equal(edge->seam, KTG_NONE);
    if (edge->side_count == 1) {
        assert_int_equal(edge->kind, KTG_EDGE_BORDER);
        assert_true(edge->angle == 0);
        return;
    }
    assert_int_equal(edge->side_count, 2);
    double turn = turn_between(p, edge), off = fabs(turn - edge->angle);
    assert_true(fmin(off, 2 * KTG_PI - off) < 1e-6);
    bool together = edge->sides[0].piece == edge->sides[1].piece;
    for (int i = 0; together && i < 2; i++)
        together = copy_of(p, places, edge->sides[0].face, edge->vertices[i]) ==
                   copy_of(p, places, edge->sides[1].face, edge->vertices[i]);
    assert_true(together == (edge->kind != KTG_EDGE_CUT));
    if (edge->kind == KTG_EDGE_FLAT)
        assert_true(fabs(edge->angle) < 1e-3);
    else if (edge->kind != KTG_EDGE_CUT)
        assert_int_equal(edge->kind, edge->angle > 0 ? KTG_EDGE_MOUNTAIN : KTG_EDGE_VALLEY);
}

static uint32_t root_of(uint32_t *parent, uint32_t f) {
    while (parent[f] != f)
        f = parent[f] = parent[parent[f]];
    return f;
}

/* A piece hangs together by folds and, seen as a complex, is a disk: V - E + F = 1. */
static void assert_disks(ktg_context *context, const ktg_pattern *p) {
    uint32_t *parent = ktg_new(context, p->face_count, uint32_t);
    size_t *folds = ktg_new(context, p->piece_count, size_t);
    for (uint32_t f = 0; f < p->face_count; f++)
        parent[f] = f;
    for (size_t e = 0; e < p->edge_count; e++) {
        const ktg_pattern_edge *edge = &p->edges[e];
        if (edge->kind == KTG_EDGE_CUT || edge->kind == KTG_EDGE_BORDER)
            continue;
        folds[edge->sides[0].piece]++;
        parent[root_of(parent, edge->sides[0].face)] = root_of(parent, edge->sides[1].face);
    }
    for (size_t i = 0; i < p->piece_count; i++) {
        const ktg_pattern_piece *piece = &p->pieces[i];
        size_t edges = 3 * piece->face_count - folds[i];
        assert_int_equal(piece->vertex_count + piece->face_count, edges + 1);
        for (uint32_t k = 1; k < piece->face_count; k++)
            assert_int_equal(root_of(parent, piece->faces[k]), root_of(parent, piece->faces[0]));
    }
    ktg_free(parent);
    ktg_free(folds);
}

static void assert_pieces(const ktg_pattern *p) {
    for (size_t i = 0; i < p->piece_count; i++) {
        const ktg_pattern_piece *piece = &p->pieces[i];
        assert_in_range(piece->component, 0, p->component_count - 1);
        assert_string_equal(piece->name, p->components[piece->component].name);
        assert_int_equal(piece->cut_count, 1);
        assert_int_equal(piece->cut_mirrored, 0);
        if (i == 0)
            continue;
        assert_true(piece->component >= piece[-1].component);
        if (piece->component == piece[-1].component)
            assert_true(piece->face_count <= piece[-1].face_count);
    }
}

void assert_sound_net(ktg_context *context, const ktg_mesh *mesh, const ktg_pattern *pattern) {
    place *places = ktg_new(context, mesh->face_count, place);
    assert_int_equal(pattern->mode, KTG_PAPER);
    assert_int_equal(pattern->face_count, mesh->face_count);
    assert_int_equal(pattern->vertex_count, mesh->vertex_count);
    assert_memory_equal(pattern->faces, mesh->faces, 12 * (size_t)mesh->face_count);
    assert_memory_equal(pattern->vertices, mesh->positions, 24 * (size_t)mesh->vertex_count);
    assert_each_face_once(mesh, pattern, places);
    assert_pieces(pattern);
    for (size_t i = 0; i < pattern->piece_count; i++) {
        assert_true_to_size(mesh, &pattern->pieces[i]);
        assert_no_overlap(context, &pattern->pieces[i], extent_of(mesh));
    }
    size_t sides = 0;
    for (size_t e = 0; e < pattern->edge_count; e++) {
        assert_edge(pattern, places, &pattern->edges[e]);
        sides += pattern->edges[e].side_count;
    }
    assert_int_equal(sides, 3 * (size_t)mesh->face_count);
    assert_disks(context, pattern);
    ktg_free(places);
}

void assert_same_net(const ktg_pattern *a, const ktg_pattern *b, double factor) {
    assert_int_equal(a->piece_count, b->piece_count);
    assert_int_equal(a->edge_count, b->edge_count);
    for (size_t i = 0; i < a->piece_count; i++) {
        const ktg_pattern_piece *p = &a->pieces[i], *q = &b->pieces[i];
        assert_int_equal(p->face_count, q->face_count);
        assert_int_equal(p->vertex_count, q->vertex_count);
        assert_memory_equal(p->faces, q->faces, p->face_count * sizeof *p->faces);
        assert_memory_equal(p->corners, q->corners, 3 * p->face_count * sizeof *p->corners);
        for (size_t v = 0; v < p->vertex_count; v++) {
            assert_true(p->vertices[v].x * factor == q->vertices[v].x);
            assert_true(p->vertices[v].y * factor == q->vertices[v].y);
        }
    }
    assert_true(same_folds(a, b));
    for (size_t e = 0; e < a->edge_count; e++) {
        const ktg_pattern_edge *p = &a->edges[e], *q = &b->edges[e];
        assert_true(p->angle == q->angle);
        for (uint32_t s = 0; s < p->side_count; s++)
            assert_memory_equal(&p->sides[s], &q->sides[s], sizeof p->sides[s]);
    }
}

bool same_folds(const ktg_pattern *a, const ktg_pattern *b) {
    for (size_t e = 0; e < a->edge_count; e++)
        if (a->edges[e].kind != b->edges[e].kind)
            return false;
    return true;
}
