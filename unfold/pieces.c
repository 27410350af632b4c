/* unfold/pieces.c - laying pieces flat: each face turned by the sum of the turns on its way from
 * the first one, each vertex stored once. */
#include "unfold/pieces.h"
#include "core/memory.h"
#include "core/vec.h"

#include <stdlib.h>
#include <string.h>

/* Two copies of a vertex are one when they are nearer than this part of the shortest edge there (so
 * that all lengths keep 1e-9), or than what rounding does to normalised coordinates. */
#define COINCIDENT 1e-10
#define ROUNDING   1e-14

typedef struct lay {
    const ktg_dual *dual;
    bool *joined;
    uint32_t *face_piece; /* face_count: piece of each face */
    uint32_t *order;      /* face_count: faces piece by piece, as reached */
    uint32_t *first;      /* piece_count + 1: where a piece's faces begin in order */
    uint32_t piece_count;
    ktg_vec2 *turn;   /* face_count: cosine and sine from the face's own frame */
    uint32_t *point;  /* 3 face_count: number of each corner's point */
    ktg_vec2 *points; /* up to 3 face_count */
    uint32_t *same;   /* per point: union-find parent */
    uint32_t point_count;
} lay;

static ktg_vec2 turned(ktg_vec2 turn, ktg_vec2 v) {
    return (ktg_vec2){turn.x * v.x - turn.y * v.y, turn.y * v.x + turn.x * v.y};
}

/* The half-edge after h in its face, which starts where h ends. */
static uint32_t next_corner(uint32_t h) {
    return h % 3 == 2 ? h - 2 : h + 1;
}

static uint32_t new_point(lay *l, ktg_vec2 at) {
    l->points[l->point_count] = at;
    l->same[l->point_count] = l->point_count;
    return l->point_count++;
}

static void place_first(lay *l, uint32_t face) {
    l->turn[face] = (ktg_vec2){1, 0};
    for (int k = 0; k < 3; k++)
        l->point[3 * face + k] = new_point(l, l->dual->flat[3 * face + k]);
}

/* Lays the face of half-edge `own` against half-edge `other` of a face that lies already. The new
 * corner is set off along the shorter of its two edges, which so keeps its length to the last
 * digits. */
static void place_next(lay *l, uint32_t other, uint32_t own) {
    const ktg_dual *dual = l->dual;
    uint32_t face = own / 3, j = own % 3, next = (j + 1) % 3, last = (j + 2) % 3;
    uint32_t other_next = next_corner(other);
    ktg_vec2 along = turned(l->turn[other / 3], ktg_mul2(dual->flat_vectors[other], -1));
    ktg_vec2 from = dual->flat_vectors[own];
    l->turn[face] = ktg_unit2((ktg_vec2){ktg_dot2(from, along), ktg_cross2(from, along)});
    l->point[3 * face + j] = l->point[other_next];
    l->point[3 * face + next] = l->point[other];
    ktg_vec2 start = l->points[l->point[3 * face + j]], end = l->points[l->point[3 * face + next]];
    ktg_vec2 on = turned(l->turn[face], dual->flat_vectors[3 * face + next]);
    ktg_vec2 back = turned(l->turn[face], dual->flat_vectors[3 * face + last]);
    bool shorter = dual->lengths[3 * face + next] < dual->lengths[3 * face + last];
    l->point[3 * face + last] = new_point(l, shorter ? ktg_add2(end, on) : ktg_sub2(start, back));
}

/* Reaches all faces of the piece of `seed`, breadth first. */
static uint32_t lay_piece(lay *l, uint32_t seed, uint32_t count) {
    uint32_t reached = count;
    l->face_piece[seed] = l->piece_count;
    l->order[reached++] = seed;
    place_first(l, seed);
    for (uint32_t i = count; i < reached; i++) {
        uint32_t face = l->order[i];
        for (uint32_t h = 3 * face; h < 3 * face + 3; h++) {
            uint32_t e = l->dual->halfedge_edge[h];
            if (e == KTG_NONE || !l->joined[e])
                continue;
            const uint32_t *pair = l->dual->edges[e].halfedge;
            uint32_t other = pair[0] == h ? pair[1] : pair[0];
            if (l->face_piece[other / 3] != KTG_NONE)
                continue;
            l->face_piece[other / 3] = l->piece_count;
            l->order[reached++] = other / 3;
            place_next(l, h, other);
        }
    }
    return reached;
}

static void lay_pieces(lay *l) {
    uint32_t n = l->dual->face_count, count = 0;
    memset(l->face_piece, 0xff, n * sizeof *l->face_piece);
    for (uint32_t f = 0; f < n; f++) {
        if (l->face_piece[f] != KTG_NONE)
            continue;
        l->first[l->piece_count] = count;
        count = lay_piece(l, f, count);
        l->piece_count++;
    }
    l->first[l->piece_count] = count;
}

static uint32_t root_of(uint32_t *same, uint32_t point) {
    while (same[point] != point)
        point = same[point] = same[same[point]];
    return point;
}

static double shortest_edge(const lay *l, uint32_t halfedge) {
    const double *lengths = l->dual->lengths + 3 * (size_t)(halfedge / 3);
    return fmin(lengths[0], fmin(lengths[1], lengths[2]));
}

static double apart(const lay *l, uint32_t a, uint32_t b) {
    return ktg_length2(ktg_sub2(l->points[a], l->points[b]));
}

/* True when both sides of the edge lie in one piece and on each other. */
static bool is_closed(const lay *l, const ktg_dual_edge *edge) {
    uint32_t a = edge->halfedge[0], b = edge->halfedge[1];
    if (l->face_piece[a / 3] != l->face_piece[b / 3])
        return false;
    double near = fmax(COINCIDENT * fmin(shortest_edge(l, a), shortest_edge(l, b)), ROUNDING);
    return apart(l, l->point[a], l->point[next_corner(b)]) <= near &&
           apart(l, l->point[next_corner(a)], l->point[b]) <= near;
}

static void close_edge(lay *l, const ktg_dual_edge *edge) {
    uint32_t a = edge->halfedge[0], b = edge->halfedge[1];
    uint32_t a_next = next_corner(a), b_next = next_corner(b);
    const uint32_t pairs[2][2] = {{a, b_next}, {a_next, b}};
    for (int i = 0; i < 2; i++) {
        uint32_t x = root_of(l->same, l->point[pairs[i][0]]);
        uint32_t y = root_of(l->same, l->point[pairs[i][1]]);
        l->same[x > y ? x : y] = x < y ? x : y;
    }
}

/* A cut that is the only one left at an inner vertex and whose copies coincide (the vertex is flat)
 * becomes a fold. That may leave its other end with one cut in turn, hence the repetition.
 * Elsewhere coincident copies stay cut: closing them would close a ring, and a piece's outline is
 * one walk. */
static ktg_status close_flat_cuts(ktg_context *context, lay *l) {
    const ktg_dual *dual = l->dual;
    uint32_t *cuts = ktg_new(context, dual->vertex_count, uint32_t);
    if (!cuts)
        return KTG_MEMORY;
    for (uint32_t h = 0; h < 3 * dual->face_count; h++)
        if (dual->halfedge_edge[h] == KTG_NONE)
            cuts[dual->faces[h]] = 2; /* on the border or a forced cut: never the last one */
    for (uint32_t e = 0; e < dual->edge_count; e++)
        for (int i = 0; i < 2 && !l->joined[e]; i++)
            cuts[dual->edges[e].vertices[i]]++;
    for (bool changed = true; changed;) {
        changed = false;
        for (uint32_t e = 0; e < dual->edge_count; e++) {
            const ktg_dual_edge *edge = &dual->edges[e];
            uint32_t *a = &cuts[edge->vertices[0]], *b = &cuts[edge->vertices[1]];
            if (l->joined[e] || (*a != 1 && *b != 1) || !is_closed(l, edge))
                continue;
            l->joined[e] = changed = true;
            close_edge(l, edge);
            --*a;
            --*b;
        }
    }
    ktg_free(cuts);
    return KTG_OK;
}

static ktg_status fill_piece(ktg_context *context, lay *l, uint32_t index, double scale,
                             uint32_t component, uint32_t *number, ktg_pattern_piece *piece) {
    uint32_t begin = l->first[index], count = l->first[index + 1] - begin;
    *piece = (ktg_pattern_piece){.component = component, .cut_count = 1, .face_count = count};
    piece->faces = ktg_new(context, count, uint32_t);
    piece->corners = ktg_new(context, 3 * (size_t)count, uint32_t);
    piece->vertices = ktg_new(context, (size_t)count + 2, ktg_vec2);
    if (!piece->faces || !piece->corners || !piece->vertices)
        return KTG_MEMORY;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t face = l->order[begin + i];
        piece->faces[i] = l->dual->mesh_face[face];
        for (int k = 0; k < 3; k++) {
            uint32_t point = root_of(l->same, l->point[3 * face + k]);
            if (number[point] == KTG_NONE) {
                number[point] = (uint32_t)piece->vertex_count;
                piece->vertices[piece->vertex_count++] = ktg_mul2(l->points[point], 1 / scale);
            }
            piece->corners[3 * i + k] = number[point];
        }
    }
    return KTG_OK;
}

typedef struct piece_size {
    uint32_t component, index, faces;
} piece_size;

static int larger_first(const void *a, const void *b) {
    const piece_size *x = a, *y = b;
    if (x->component != y->component)
        return x->component < y->component ? -1 : 1;
    if (x->faces != y->faces)
        return x->faces > y->faces ? -1 : 1;
    return (x->index > y->index) - (x->index < y->index);
}

static ktg_status append_pieces(ktg_context *context, lay *l, double scale, uint32_t component,
                                ktg_pattern *pattern, size_t *capacity) {
    KTG_TRY(
        ktg_reserve(context, &pattern->pieces, capacity, pattern->piece_count + l->piece_count));
    piece_size *sizes = ktg_new(context, l->piece_count, piece_size);
    uint32_t *number = ktg_new(context, l->point_count, uint32_t);
    ktg_status status = sizes && number ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        memset(number, 0xff, l->point_count * sizeof *number);
        for (uint32_t i = 0; i < l->piece_count; i++)
            sizes[i] = (piece_size){component, i, l->first[i + 1] - l->first[i]};
        qsort(sizes, l->piece_count, sizeof *sizes, larger_first);
    }
    for (uint32_t i = 0; status == KTG_OK && i < l->piece_count; i++)
        status = fill_piece(context, l, sizes[i].index, scale, component, number,
                            &pattern->pieces[pattern->piece_count++]);
    ktg_free(sizes);
    ktg_free(number);
    return status;
}

ktg_status ktg_pieces_sort(ktg_context *context, ktg_pattern *pattern) {
    size_t count = pattern->piece_count;
    piece_size *sizes = ktg_new(context, count, piece_size);
    ktg_pattern_piece *sorted = ktg_new(context, count, ktg_pattern_piece);
    ktg_status status = sizes && sorted ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        for (uint32_t i = 0; i < count; i++)
            sizes[i] = (piece_size){pattern->pieces[i].component, i,
                                    (uint32_t)pattern->pieces[i].face_count};
        qsort(sizes, count, sizeof *sizes, larger_first);
        for (size_t i = 0; i < count; i++)
            sorted[i] = pattern->pieces[sizes[i].index];
        memcpy(pattern->pieces, sorted, count * sizeof *sorted);
    }
    ktg_free(sizes);
    ktg_free(sorted);
    return status;
}

static ktg_status lay_out(ktg_context *context, const ktg_dual *dual, bool *joined, lay *l) {
    size_t n = dual->face_count;
    *l = (lay){.dual = dual,
               .joined = joined,
               .face_piece = ktg_new(context, n, uint32_t),
               .order = ktg_new(context, n, uint32_t),
               .first = ktg_new(context, n + 1, uint32_t),
               .turn = ktg_new(context, n, ktg_vec2),
               .point = ktg_new(context, 3 * n, uint32_t),
               .points = ktg_new(context, 3 * n, ktg_vec2),
               .same = ktg_new(context, 3 * n, uint32_t)};
    if (!l->face_piece || !l->order || !l->first || !l->turn || !l->point || !l->points || !l->same)
        return KTG_MEMORY;
    lay_pieces(l);
    return close_flat_cuts(context, l);
}

static void free_lay(lay *l) {
    ktg_free(l->face_piece);
    ktg_free(l->order);
    ktg_free(l->first);
    ktg_free(l->turn);
    ktg_free(l->point);
    ktg_free(l->points);
    ktg_free(l->same);
}

ktg_status ktg_pieces_close(ktg_context *context, const ktg_dual *dual, bool *joined) {
    lay l;
    ktg_status status = lay_out(context, dual, joined, &l);
    free_lay(&l);
    return status;
}

ktg_status ktg_pieces_append(ktg_context *context, const ktg_dual *dual, double scale, bool *joined,
                             uint32_t component, ktg_pattern *pattern, size_t *pieces_capacity) {
    lay l;
    ktg_status status = lay_out(context, dual, joined, &l);
    if (status == KTG_OK)
        status = append_pieces(context, &l, scale, component, pattern, pieces_capacity);
    free_lay(&l);
    return status;
}
