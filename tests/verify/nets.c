/* tests/verify/nets.c - sound patterns to damage. */
#include "nets.h"
#include "core/memory.h"
#include "core/vec.h"

#include <stdlib.h>
#include <string.h>

/* ---- the surfaces ------------------------------------------------------------------------- */

#define NET(name, cuts)                                                                            \
    {                                                                                              \
        name##_vertices, sizeof name##_vertices / sizeof *name##_vertices, name##_faces,           \
            sizeof name##_faces / sizeof *name##_faces, cuts, sizeof cuts / sizeof *cuts, 2, false \
    }

static const ktg_vec3 tetrahedron_vertices[] = {{0, 0, 0}, {40, 0, 0}, {10, 35, 0}, {15, 12, 30}};
static const uint32_t tetrahedron_faces[][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
static const uint32_t tetrahedron_cuts[][2] = {{0, 3}, {1, 3}, {2, 3}};
const net tetrahedron = NET(tetrahedron, tetrahedron_cuts);

static const ktg_vec3 cube_vertices[] = {{0, 0, 0},  {30, 0, 0},  {30, 30, 0},  {0, 30, 0},
                                         {0, 0, 30}, {30, 0, 30}, {30, 30, 30}, {0, 30, 30}};
static const uint32_t cube_faces[][3] = {{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4},
                                         {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6},
                                         {3, 0, 4}, {3, 4, 7}, {4, 5, 6}, {4, 6, 7}};
static const uint32_t cube_cuts[][2] = {{0, 4}, {1, 5}, {2, 6}, {3, 7}, {5, 6}, {6, 7}, {7, 4}};
const net cube = NET(cube, cube_cuts);

static const uint32_t lid_cuts[][2] = {{0, 4}, {1, 5}, {2, 6}, {3, 7},
                                       {4, 5}, {5, 6}, {6, 7}, {7, 4}};
const net box_and_lid = NET(cube, lid_cuts);

static const uint32_t open_cuts[][2] = {{0, 4}, {1, 5}, {2, 6}, {3, 7}};
const net open_box = {cube_vertices, 8, cube_faces, 10, open_cuts, 4, 2, false};

/* A pyramid without a base; vertex 5 is in the middle of its edge from 0 to the apex 4, and flat.
 */
static const ktg_vec3 slit_vertices[] = {{-20, -20, 0}, {20, -20, 0}, {20, 20, 0},
                                         {-20, 20, 0},  {0, 0, 16},   {-10, -10, 8}};
static const uint32_t slit_faces[][3] = {{0, 1, 5}, {5, 1, 4}, {1, 2, 4},
                                         {2, 3, 4}, {3, 0, 5}, {3, 5, 4}};
static const uint32_t slit_cuts[][2] = {{0, 5}, {5, 4}};
const net slit = NET(slit, slit_cuts);
static const uint32_t useless_cuts[][2] = {{0, 5}, {2, 4}};
const net useless_slit = NET(slit, useless_cuts);

/* Eight faces about a vertex, together more than a full turn, cut open along one edge. */
static const ktg_vec3 saddle_vertices[] = {{0, 0, 0},       {20, 0, 20},    {14, 14, -20},
                                           {0, 20, 20},     {-14, 14, -20}, {-20, 0, 20},
                                           {-14, -14, -20}, {0, -20, 20},   {14, -14, -20}};
static const uint32_t saddle_faces[][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5},
                                           {0, 5, 6}, {0, 6, 7}, {0, 7, 8}, {0, 8, 1}};
static const uint32_t saddle_cuts[][2] = {{0, 1}};
const net saddle = NET(saddle, saddle_cuts);

/* A flat square with a square hole, in one ring and cut open along one edge. */
static const ktg_vec3 ring_vertices[] = {{0, 0, 0},   {60, 0, 0},  {60, 60, 0}, {0, 60, 0},
                                         {20, 20, 0}, {40, 20, 0}, {40, 40, 0}, {20, 40, 0}};
static const uint32_t ring_faces[][3] = {{0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 6, 5},
                                         {2, 3, 6}, {3, 7, 6}, {3, 0, 7}, {0, 4, 7}};
static const uint32_t ring_cuts[][2] = {{0, 4}};
const net ring = {ring_vertices, 8, ring_faces, 8, NULL, 0, 0, false};
const net opened_ring = {ring_vertices, 8, ring_faces, 8, ring_cuts, 1, 0, false};

static const ktg_vec3 two_vertices[] = {{0, 0, 0},  {40, 0, 0},  {10, 35, 0},  {15, 12, 30},
                                        {0, 0, 90}, {40, 0, 90}, {10, 35, 90}, {15, 12, 120}};
static const uint32_t two_faces[][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3},
                                        {4, 6, 5}, {4, 5, 7}, {5, 6, 7}, {6, 4, 7}};
static const uint32_t two_cuts[][2] = {{0, 3}, {1, 3}, {2, 3}, {4, 7}, {5, 7}, {6, 7}};
const net two_parts = NET(two, two_cuts);

/* ---- unfolding ---------------------------------------------------------------------------- */

typedef struct maker {
    ktg_context *context;
    const net *net;
    ktg_pattern *p;
    uint32_t *twin, *edge_of; /* by half-edge */
    bool *fold;
    uint32_t *piece_of, *copy; /* by face; by corner: vertex of its piece */
} maker;

static void *take(ktg_context *context, size_t count, size_t size) {
    void *memory = ktg_alloc(context, count, size);
    if (!memory)
        abort();
    return memory;
}

static uint32_t next(uint32_t h) {
    return h % 3 == 2 ? h - 2 : h + 1;
}

static uint32_t from(const maker *m, uint32_t h) {
    return m->p->faces[h];
}

static uint32_t to(const maker *m, uint32_t h) {
    return m->p->faces[next(h)];
}

static bool is_cut(const net *n, uint32_t a, uint32_t b) {
    for (uint32_t i = 0; i < n->cut_count; i++)
        if ((n->cuts[i][0] == a && n->cuts[i][1] == b) ||
            (n->cuts[i][0] == b && n->cuts[i][1] == a))
            return true;
    return false;
}

/* Chains half-edges by their starting vertex to find twins; true for a fold. */
static void find_twins(maker *m) {
    uint32_t count = 3 * m->p->face_count;
    uint32_t *first = take(m->context, m->p->vertex_count, sizeof *first);
    uint32_t *chain = take(m->context, count, sizeof *chain);
    memset(first, 0xff, m->p->vertex_count * sizeof *first);
    for (uint32_t h = 0; h < count; h++) {
        chain[h] = first[from(m, h)];
        first[from(m, h)] = h;
    }
    for (uint32_t h = 0; h < count; h++) {
        m->twin[h] = KTG_NONE;
        for (uint32_t g = first[to(m, h)]; g != KTG_NONE; g = chain[g])
            if (to(m, g) == from(m, h))
                m->twin[h] = g;
        m->fold[h] = m->twin[h] != KTG_NONE && !is_cut(m->net, from(m, h), to(m, h));
    }
    ktg_free(first);
    ktg_free(chain);
}

static ktg_vec3 normal(const ktg_pattern *p, uint32_t face) {
    const uint32_t *f = p->faces + 3 * (size_t)face;
    ktg_vec3 a = p->vertices[f[0]];
    return ktg_unit3(ktg_cross3(ktg_sub3(p->vertices[f[1]], a), ktg_sub3(p->vertices[f[2]], a)));
}

static double turn(const maker *m, uint32_t h) {
    const ktg_vec3 *v = m->p->vertices;
    ktg_vec3 a = normal(m->p, h / 3), b = normal(m->p, m->twin[h] / 3);
    ktg_vec3 along = ktg_unit3(ktg_sub3(v[to(m, h)], v[from(m, h)]));
    return atan2(ktg_dot3(ktg_cross3(a, b), along), ktg_dot3(a, b));
}

static void make_edges(maker *m) {
    ktg_pattern *p = m->p;
    p->edges = take(m->context, 3 * (size_t)p->face_count, sizeof *p->edges);
    for (uint32_t h = 0; h < 3 * p->face_count; h++) {
        if (m->twin[h] != KTG_NONE && m->twin[h] < h)
            continue;
        uint32_t t = m->twin[h];
        ktg_pattern_edge *edge = &p->edges[p->edge_count];
        *edge = (ktg_pattern_edge){{from(m, h), to(m, h)},
                                   KTG_EDGE_BORDER,
                                   t == KTG_NONE ? 0 : turn(m, h),
                                   t == KTG_NONE ? 1 : 2,
                                   {{m->piece_of[h / 3], h / 3, h % 3}},
                                   -1,
                                   KTG_NONE};
        m->edge_of[h] = (uint32_t)p->edge_count++;
        if (t == KTG_NONE)
            continue;
        m->edge_of[t] = m->edge_of[h];
        edge->sides[1] = (ktg_pattern_side){m->piece_of[t / 3], t / 3, t % 3};
        edge->kind = !m->fold[h]                ? KTG_EDGE_CUT
                     : fabs(edge->angle) < 1e-3 ? KTG_EDGE_FLAT
                     : edge->angle > 0          ? KTG_EDGE_MOUNTAIN
                                                : KTG_EDGE_VALLEY;
    }
}

/* Goes round the vertex at the start of h across folds, giving all corners the same copy. */
static void spread_copy(maker *m, uint32_t h, uint32_t copy) {
    uint32_t g = h;
    do {
        m->copy[g] = copy;
        g = m->fold[g] ? next(m->twin[g]) : KTG_NONE;
    } while (g != KTG_NONE && g != h);
    for (g = next(next(h)); g != KTG_NONE && m->fold[g]; g = next(next(m->twin[g]))) {
        if (m->copy[m->twin[g]] == copy)
            break;
        m->copy[m->twin[g]] = copy;
    }
}

static double length3(const maker *m, uint32_t h) {
    return ktg_length3(ktg_sub3(m->p->vertices[to(m, h)], m->p->vertices[from(m, h)]));
}

/* The third point of a face, left of the side from a to b; `h` runs from a to b. */
static ktg_vec2 third(const maker *m, uint32_t h, ktg_vec2 a, ktg_vec2 b) {
    double base = length3(m, h), right = length3(m, next(h)), left = length3(m, next(next(h)));
    ktg_vec3 u = ktg_sub3(m->p->vertices[to(m, h)], m->p->vertices[from(m, h)]);
    ktg_vec3 v = ktg_sub3(m->p->vertices[from(m, next(next(h)))], m->p->vertices[from(m, h)]);
    double height = ktg_length3(ktg_cross3(u, v)) / base;
    double along = (left * left + base * base - right * right) / (2 * base);
    ktg_vec2 x = ktg_unit2(ktg_sub2(b, a));
    return ktg_madd2(ktg_madd2(a, along, x), height, ktg_perp2(x));
}

static void place_face(maker *m, ktg_pattern_piece *piece, uint32_t h, bool *known) {
    uint32_t c[3] = {m->copy[h], m->copy[next(h)], m->copy[next(next(h))]};
    if (!known[c[2]])
        piece->vertices[c[2]] = third(m, h, piece->vertices[c[0]], piece->vertices[c[1]]);
    known[c[2]] = true;
}

/* Grows a piece from `seed`, face by face across folds. */
static void make_piece(maker *m, uint32_t seed) {
    ktg_pattern *p = m->p;
    uint32_t id = (uint32_t)p->piece_count++;
    ktg_pattern_piece *piece = &p->pieces[id];
    size_t room = p->face_count;
    piece->vertices = take(m->context, 3 * room, sizeof *piece->vertices);
    piece->faces = take(m->context, room, sizeof *piece->faces);
    piece->corners = take(m->context, 3 * room, sizeof *piece->corners);
    bool *known = take(m->context, 3 * room, sizeof *known);
    uint32_t *entry = take(m->context, room, sizeof *entry);
    piece->cut_count = 1;
    piece->faces[piece->face_count++] = seed;
    entry[0] = 3 * seed;
    m->piece_of[seed] = id;
    for (size_t i = 0; i < piece->face_count; i++) {
        uint32_t f = piece->faces[i];
        for (uint32_t h = 3 * f; h < 3 * f + 3; h++)
            if (m->copy[h] == KTG_NONE)
                spread_copy(m, h, (uint32_t)piece->vertex_count++);
        if (i == 0) {
            known[m->copy[3 * f]] = known[m->copy[3 * f + 1]] = true;
            piece->vertices[m->copy[3 * f + 1]] = (ktg_vec2){length3(m, 3 * f), 0};
        }
        place_face(m, piece, entry[i], known);
        memcpy(piece->corners + 3 * i, m->copy + 3 * (size_t)f, 3 * sizeof *piece->corners);
        for (uint32_t h = 3 * f; h < 3 * f + 3; h++)
            if (m->fold[h] && m->piece_of[m->twin[h] / 3] == KTG_NONE) {
                m->piece_of[m->twin[h] / 3] = id;
                entry[piece->face_count] = m->twin[h];
                piece->faces[piece->face_count++] = m->twin[h] / 3;
            }
    }
    ktg_free(known);
    ktg_free(entry);
}

/* Component of a piece: that of the lowest face that twins lead to, by repeated lowering. */
static void make_components(maker *m) {
    ktg_pattern *p = m->p;
    uint32_t *lowest = take(m->context, p->face_count, sizeof *lowest);
    uint32_t *number = take(m->context, p->face_count, sizeof *number);
    for (uint32_t f = 0; f < p->face_count; f++)
        lowest[f] = f;
    for (bool again = true; again;) {
        again = false;
        for (uint32_t h = 0; h < 3 * p->face_count; h++)
            if (m->twin[h] != KTG_NONE && lowest[m->twin[h] / 3] < lowest[h / 3]) {
                lowest[h / 3] = lowest[m->twin[h] / 3];
                again = true;
            }
    }
    p->components = take(m->context, p->face_count, sizeof *p->components);
    for (uint32_t f = 0; f < p->face_count; f++)
        if (lowest[f] == f) {
            number[f] = (uint32_t)p->component_count;
            p->components[p->component_count++].name = ktg_copy_text(m->context, "part", 5);
        }
    for (size_t i = 0; i < p->piece_count; i++)
        p->pieces[i].component = number[lowest[p->pieces[i].faces[0]]];
    ktg_free(lowest);
    ktg_free(number);
}

/* ---- finishing ---------------------------------------------------------------------------- */

static ktg_vec2 at(const maker *m, uint32_t h) {
    return m->p->pieces[m->piece_of[h / 3]].vertices[m->copy[h]];
}

static void make_tabs(maker *m) {
    ktg_pattern *p = m->p;
    for (size_t i = 0; i < p->piece_count; i++)
        p->pieces[i].tabs = take(m->context, p->edge_count, sizeof *p->pieces[i].tabs);
    for (uint32_t e = 0; e < p->edge_count && m->net->tab_mm > 0; e++) {
        ktg_pattern_edge *edge = &p->edges[e];
        if (edge->kind != KTG_EDGE_CUT)
            continue;
        uint32_t h = 3 * edge->sides[0].face + edge->sides[0].corner;
        ktg_pattern_piece *piece = &p->pieces[edge->sides[0].piece];
        ktg_vec2 a = at(m, h), b = at(m, next(h)), x = ktg_unit2(ktg_sub2(b, a));
        ktg_vec2 out = ktg_mul2(ktg_perp2(x), -m->net->tab_mm);
        double in = 4 * m->net->tab_mm; /* flat flanks, so that none collide under a mate */
        edge->tab_on = 0;
        piece->tabs[piece->tab_count++] = (ktg_pattern_tab){
            e,
            4,
            {a, ktg_add2(ktg_madd2(a, in, x), out), ktg_add2(ktg_madd2(b, -in, x), out), b},
            KTG_TAB_FULL};
    }
}

static void make_outline(ktg_context *context, maker *m, uint32_t id) {
    ktg_pattern *p = m->p;
    ktg_pattern_piece *piece = &p->pieces[id];
    uint32_t start = 3 * piece->faces[0];
    while (m->fold[start] || m->piece_of[start / 3] != id)
        start = (start + 1) % (3 * p->face_count);
    ktg_free(piece->outline);
    piece->outline = take(context, 30 * piece->face_count, sizeof *piece->outline);
    piece->outline_count = 0;
    uint32_t h = start;
    do {
        const ktg_pattern_edge *edge = &p->edges[m->edge_of[h]];
        uint32_t carrier = edge->tab_on < 0 ? KTG_NONE
                                            : 3 * edge->sides[edge->tab_on].face +
                                                  edge->sides[edge->tab_on].corner;
        if (carrier != h)
            piece->outline[piece->outline_count++] = at(m, h);
        for (size_t i = 0; carrier == h && i < piece->tab_count; i++)
            if (piece->tabs[i].edge == m->edge_of[h]) /* it begins and ends at the edge's ends */
                for (uint32_t k = 0; k < piece->tabs[i].corner_count; k++)
                    piece->outline[piece->outline_count++] = piece->tabs[i].corners[k];
        h = next(h);
        while (m->fold[h])
            h = next(m->twin[h]);
    } while (h != start);
}

/* One seam for each cut. */
static void make_seams(maker *m) {
    ktg_pattern *p = m->p;
    p->seams = take(m->context, p->edge_count, sizeof *p->seams);
    for (uint32_t e = 0; e < p->edge_count; e++) {
        ktg_pattern_edge *edge = &p->edges[e];
        if (edge->kind != KTG_EDGE_CUT)
            continue;
        ktg_pattern_seam *seam = &p->seams[p->seam_count];
        seam->edges = take(m->context, 1, sizeof *seam->edges);
        seam->first_side = take(m->context, 1, sizeof *seam->first_side);
        seam->edge_count = 1;
        seam->edges[0] = e;
        for (int s = 0; s < 2; s++) {
            uint32_t h = 3 * edge->sides[s].face + edge->sides[s].corner;
            seam->pieces[s] = edge->sides[s].piece;
            seam->lengths_mm[s] = ktg_length2(ktg_sub2(at(m, next(h)), at(m, h)));
        }
        edge->seam = (uint32_t)p->seam_count++;
    }
}

static void make_sheets(maker *m) {
    ktg_pattern *p = m->p;
    p->sheets = take(m->context, p->piece_count, sizeof *p->sheets);
    for (uint32_t i = 0; i < p->piece_count; i++) {
        ktg_pattern_placement *placement = take(m->context, 1, sizeof *placement);
        *placement = (ktg_pattern_placement){i, 200, 180, KTG_PI / 2};
        p->sheets[i] = (ktg_pattern_sheet){KTG_SHEET, 400, 400, {10, 10, 390, 390}, 1, placement};
        ktg_pattern_piece *piece = &p->pieces[i];
        piece->labels = take(m->context, 1, sizeof *piece->labels);
        piece->label_count = 1;
        piece->labels[0] =
            (ktg_pattern_label){"1", piece->vertices[0], 0, 2.4, p->edge_count ? 0 : KTG_NONE};
    }
    p->sheet_count = p->piece_count;
}

static void prepare(maker *m) {
    size_t count = 3 * (size_t)m->p->face_count;
    m->twin = take(m->context, count, sizeof *m->twin);
    m->edge_of = take(m->context, count, sizeof *m->edge_of);
    m->fold = take(m->context, count, sizeof *m->fold);
    m->copy = take(m->context, count, sizeof *m->copy);
    m->piece_of = take(m->context, m->p->face_count, sizeof *m->piece_of);
    memset(m->copy, 0xff, count * sizeof *m->copy);
    memset(m->piece_of, 0xff, m->p->face_count * sizeof *m->piece_of);
}

static void drop(maker *m) {
    ktg_free(m->twin);
    ktg_free(m->edge_of);
    ktg_free(m->fold);
    ktg_free(m->copy);
    ktg_free(m->piece_of);
}

ktg_pattern *net_make(ktg_context *context, const net *n) {
    ktg_pattern *p = take(context, 1, sizeof *p);
    maker m = {.context = context, .net = n, .p = p};
    p->mm_per_unit = n->bare ? 0 : 1;
    p->model_faces = p->face_count = n->face_count;
    p->vertex_count = n->vertex_count;
    p->vertices = ktg_copy_array(context, n->positions, n->vertex_count, sizeof(ktg_vec3));
    p->faces = ktg_copy_array(context, n->faces, 3 * (size_t)n->face_count, sizeof(uint32_t));
    p->pieces = take(context, n->face_count, sizeof *p->pieces);
    prepare(&m);
    find_twins(&m);
    for (uint32_t f = 0; f < p->face_count; f++)
        if (m.piece_of[f] == KTG_NONE)
            make_piece(&m, f);
    make_components(&m);
    make_edges(&m);
    if (!n->bare) {
        make_tabs(&m);
        for (uint32_t i = 0; i < p->piece_count; i++)
            make_outline(context, &m, i);
        make_seams(&m);
        make_sheets(&m);
    }
    drop(&m);
    return p;
}

void net_outlines(ktg_context *context, ktg_pattern *p) {
    const net all_folds = {.cut_count = 0};
    maker m = {.context = context, .net = &all_folds, .p = p};
    prepare(&m);
    find_twins(&m);
    for (uint32_t i = 0; i < p->piece_count; i++)
        for (size_t k = 0; k < p->pieces[i].face_count; k++) {
            m.piece_of[p->pieces[i].faces[k]] = i;
            memcpy(m.copy + 3 * (size_t)p->pieces[i].faces[k], p->pieces[i].corners + 3 * k,
                   3 * sizeof *m.copy);
        }
    for (uint32_t e = 0; e < p->edge_count; e++)
        for (uint32_t s = 0; s < p->edges[e].side_count; s++) {
            uint32_t h = 3 * p->edges[e].sides[s].face + p->edges[e].sides[s].corner;
            m.edge_of[h] = e;
            m.fold[h] = p->edges[e].kind != KTG_EDGE_CUT && p->edges[e].kind != KTG_EDGE_BORDER;
        }
    for (uint32_t i = 0; i < p->piece_count; i++)
        make_outline(context, &m, i);
    drop(&m);
}

uint32_t net_edge_index(const ktg_pattern *p, uint32_t a, uint32_t b) {
    for (uint32_t e = 0; e < p->edge_count; e++)
        if ((p->edges[e].vertices[0] == a && p->edges[e].vertices[1] == b) ||
            (p->edges[e].vertices[0] == b && p->edges[e].vertices[1] == a))
            return e;
    abort();
}

ktg_pattern_edge *net_edge(ktg_pattern *p, uint32_t a, uint32_t b) {
    return &p->edges[net_edge_index(p, a, b)];
}
