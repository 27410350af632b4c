/* flatten/slide.c - vertices moved along the surface, so that seams run smoothly.
 *
 * Each run of seams becomes the smooth line along it; what is around it gives way; and every moved
 * vertex is put back on the surface as it was. Nothing is moved so far that a face would turn over
 * or become a sliver. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/sheet.h"

#include <string.h>

/* Rounds of moving, and rings around seams that give way. */
enum { rounds = 24, rings = 4, most_retreats = 6 };

/* Vertices at a fold of this angle or more stay. */
static const double crease = 45 * KTG_PI / 180;

/* A face must keep this part of its shape, and not turn by more than this angle's cosine. */
static const double least_shape = 0.1, least_cosine = 0.7;

typedef struct slide {
    const ktg_sheet *sheet; /* the surface as it was */
    const bool *cut, *fixed;
    ktg_vec3 *now, *next; /* vertex_count */
    uint32_t *face;       /* vertex_count: where it lies on the surface */
    uint8_t *kind;        /* vertex_count */
    ktg_chains chains;
} slide;

enum { stays, gives_way, on_seam };

/* ---- which vertices move ------------------------------------------------------------------- */

static void hold_creases(slide *s, uint8_t *held) {
    const ktg_sheet *sheet = s->sheet;
    for (uint32_t h = 0; h < sheet->adjacency->halfedge_count; h++) {
        uint32_t twin = sheet->adjacency->twin[h];
        const uint32_t *ends = sheet->ends + 2 * (size_t)sheet->adjacency->halfedge_edge[h];
        bool hold = twin == KTG_NONE;
        if (!hold) {
            ktg_vec3 a = ktg_sheet_area(sheet->mesh, h / 3);
            ktg_vec3 b = ktg_sheet_area(sheet->mesh, twin / 3);
            hold = atan2(ktg_length3(ktg_cross3(a, b)), ktg_dot3(a, b)) > crease;
        }
        if (hold)
            held[ends[0]] = held[ends[1]] = true;
    }
}

/* Vertices of seams, and those near them, as far as they are free. */
static void set_kinds(slide *s, const uint8_t *held) {
    const ktg_sheet *sheet = s->sheet;
    for (uint32_t c = 0; c < s->chains.count; c++) {
        const ktg_chain *chain = &s->chains.chains[c];
        uint32_t v = chain->ends[0];
        for (uint32_t i = 0; i + 1 < chain->count; i++) {
            v = ktg_sheet_other_end(sheet, s->chains.edges[chain->first + i], v);
            s->kind[v] = held[v] ? stays : on_seam;
        }
    }
    for (int ring = 0; ring < rings; ring++) {
        for (uint32_t v = 0; v < sheet->mesh->vertex_count; v++)
            s->face[v] = s->kind[v];
        for (uint32_t e = 0; e < sheet->edge_count; e++)
            for (int k = 0; k < 2; k++) {
                uint32_t v = sheet->ends[2 * (size_t)e + k], w = sheet->ends[2 * (size_t)e + 1 - k];
                if (s->face[w] != stays && s->kind[v] == stays && !held[v])
                    s->kind[v] = gives_way;
            }
    }
}

/* Ends of seams and fixed seams stay. */
static void hold_seams(const slide *s, uint8_t *held) {
    const ktg_sheet *sheet = s->sheet;
    for (uint32_t e = 0; e < sheet->edge_count; e++)
        if (s->fixed && s->fixed[e])
            held[sheet->ends[2 * (size_t)e]] = held[sheet->ends[2 * (size_t)e + 1]] = true;
    for (uint32_t c = 0; c < s->chains.count; c++)
        for (int k = 0; k < 2; k++)
            held[s->chains.chains[c].ends[k]] = true;
}

static void find_faces(slide *s) {
    for (uint32_t h = 0; h < s->sheet->adjacency->halfedge_count; h++)
        s->face[s->sheet->mesh->faces[h]] = h / 3;
}

/* ---- on the surface ------------------------------------------------------------------------ */

static ktg_vec3 closest_on_segment(ktg_vec3 p, ktg_vec3 a, ktg_vec3 b) {
    ktg_vec3 along = ktg_sub3(b, a);
    double t = ktg_dot3(ktg_sub3(p, a), along) / ktg_max(1e-300, ktg_dot3(along, along));
    return ktg_madd3(a, ktg_max(0, ktg_min(1, t)), along);
}

static ktg_vec3 closest_on_face(const ktg_mesh *mesh, uint32_t face, ktg_vec3 p) {
    const uint32_t *v = mesh->faces + 3 * (size_t)face;
    ktg_vec3 normal = ktg_unit3(ktg_sheet_area(mesh, face)), best = mesh->positions[v[0]];
    double least = INFINITY;
    bool above = true;
    for (int k = 0; k < 3; k++) {
        ktg_vec3 a = mesh->positions[v[k]], b = mesh->positions[v[(k + 1) % 3]];
        ktg_vec3 c = closest_on_segment(p, a, b), d = ktg_sub3(p, c);
        above &= ktg_dot3(ktg_cross3(normal, ktg_sub3(b, a)), ktg_sub3(p, a)) >= 0;
        if (ktg_dot3(d, d) < least) {
            least = ktg_dot3(d, d);
            best = c;
        }
    }
    return above ? ktg_madd3(p, -ktg_dot3(normal, ktg_sub3(p, mesh->positions[v[0]])), normal)
                 : best;
}

/* The closest point among the faces around the corners of `face`; *face is where that is. */
static ktg_vec3 closest_around(const ktg_sheet *sheet, uint32_t *face, ktg_vec3 p) {
    const ktg_adjacency *a = sheet->adjacency;
    ktg_vec3 best = closest_on_face(sheet->mesh, *face, p);
    double least = ktg_length3(ktg_sub3(p, best));
    uint32_t here = *face;
    for (int k = 0; k < 3; k++) {
        uint32_t v = sheet->mesh->faces[3 * (size_t)here + k];
        for (uint32_t i = sheet->first[v]; i < sheet->first[v + 1]; i++)
            for (uint32_t j = a->edge_first[sheet->around[i]];
                 j < a->edge_first[sheet->around[i] + 1]; j++) {
                ktg_vec3 c = closest_on_face(sheet->mesh, a->edge_halfedges[j] / 3, p);
                if (ktg_length3(ktg_sub3(p, c)) < least) {
                    least = ktg_length3(ktg_sub3(p, c));
                    best = c;
                    *face = a->edge_halfedges[j] / 3;
                }
            }
    }
    return best;
}

/* ---- one round ----------------------------------------------------------------------------- */

static ktg_vec3 mean_of_neighbours(const slide *s, uint32_t v) {
    ktg_vec3 sum = {0, 0, 0};
    const ktg_sheet *sheet = s->sheet;
    for (uint32_t i = sheet->first[v]; i < sheet->first[v + 1]; i++)
        sum = ktg_add3(sum, s->now[ktg_sheet_other_end(sheet, sheet->around[i], v)]);
    return ktg_mul3(sum, 1.0 / (sheet->first[v + 1] - sheet->first[v]));
}

/* Where a run's smooth line has its vertices. */
static void aim_chain(slide *s, const ktg_chain *chain, ktg_vec3 *points) {
    const uint32_t *edges = s->chains.edges + chain->first;
    uint32_t v = chain->ends[0];
    points[0] = s->now[v];
    for (uint32_t i = 0; i < chain->count; i++)
        points[i + 1] = s->now[v = ktg_sheet_other_end(s->sheet, edges[i], v)];
    ktg_line_smooth(points, chain->count + 1);
    v = chain->ends[0];
    for (uint32_t i = 0; i + 1 < chain->count; i++) {
        v = ktg_sheet_other_end(s->sheet, edges[i], v);
        s->next[v] = points[i + 1];
    }
}

/* In the first rounds part of the way only, so that what is around can follow. */
static void move(slide *s, ktg_vec3 *points, int round) {
    double part = 1.0 / (rounds - round);
    for (uint32_t c = 0; c < s->chains.count; c++)
        aim_chain(s, &s->chains.chains[c], points);
    for (uint32_t v = 0; v < s->sheet->mesh->vertex_count; v++) {
        if (s->kind[v] == stays) {
            s->next[v] = s->now[v];
            continue;
        }
        if (s->kind[v] == gives_way)
            s->next[v] = mean_of_neighbours(s, v);
        double step = s->kind[v] == gives_way ? 0.3 : part;
        s->next[v] = ktg_madd3(s->now[v], step, ktg_sub3(s->next[v], s->now[v]));
        s->next[v] = closest_around(s->sheet, &s->face[v], s->next[v]);
    }
    memcpy(s->now, s->next, s->sheet->mesh->vertex_count * sizeof *s->now);
}

/* ---- back where it went too far ------------------------------------------------------------ */

/* 1 for an equilateral triangle, 0 for a sliver. */
static double shape_of(const ktg_vec3 *p, const uint32_t *v) {
    ktg_vec3 ab = ktg_sub3(p[v[1]], p[v[0]]), bc = ktg_sub3(p[v[2]], p[v[1]]),
             ca = ktg_sub3(p[v[0]], p[v[2]]);
    double squares = ktg_dot3(ab, ab) + ktg_dot3(bc, bc) + ktg_dot3(ca, ca);
    return 2 * sqrt(3) * ktg_length3(ktg_cross3(ab, bc)) / ktg_max(squares, 1e-300);
}

static bool is_spoilt(const slide *s, uint32_t face) {
    const uint32_t *v = s->sheet->mesh->faces + 3 * (size_t)face;
    const ktg_vec3 *p = s->sheet->mesh->positions;
    ktg_vec3 was = ktg_unit3(ktg_sheet_area(s->sheet->mesh, face));
    ktg_vec3 is = ktg_unit3(
        ktg_cross3(ktg_sub3(s->now[v[1]], s->now[v[0]]), ktg_sub3(s->now[v[2]], s->now[v[0]])));
    double shape = shape_of(s->now, v);
    return ktg_dot3(was, is) < least_cosine ||
           (shape < least_shape && shape < 0.9 * shape_of(p, v));
}

/* The corners of a face go back towards where they were, or all the way. True where one moved. */
static bool take_back(slide *s, uint32_t face, double part) {
    const ktg_mesh *mesh = s->sheet->mesh;
    bool any = false;
    for (int c = 0; c < 3; c++) {
        uint32_t v = mesh->faces[3 * (size_t)face + c];
        ktg_vec3 was = mesh->positions[v], to = was;
        if (s->kind[v] == stays)
            continue;
        if (part > 0) {
            uint32_t from = s->face[v];
            to = ktg_madd3(was, part, ktg_sub3(s->now[v], was));
            to = closest_around(s->sheet, &from, to);
        }
        any |= to.x != s->now[v].x || to.y != s->now[v].y || to.z != s->now[v].z;
        s->now[v] = to;
    }
    return any;
}

/* Vertices of spoilt faces go half of the way back some times, and then all of it, until no face is
 * spoilt: one whose corners are all where they were is not. */
static void retreat(slide *s) {
    bool any = true;
    for (int k = 0; any; k++) {
        any = false;
        for (uint32_t f = 0; f < s->sheet->mesh->face_count; f++)
            if (is_spoilt(s, f))
                any |= take_back(s, f, k < most_retreats ? 0.5 : 0);
    }
}

/* ---- all ----------------------------------------------------------------------------------- */

/* Part of the way only. */
static void go_part(slide *s, double part) {
    for (uint32_t v = 0; v < s->sheet->mesh->vertex_count; v++) {
        ktg_vec3 was = s->sheet->mesh->positions[v];
        if (s->kind[v] != stays)
            s->now[v] = closest_around(s->sheet, &s->face[v],
                                       ktg_madd3(was, part, ktg_sub3(s->now[v], was)));
    }
}

static ktg_status run(ktg_context *context, slide *s, double part) {
    const ktg_mesh *mesh = s->sheet->mesh;
    s->now = ktg_copy_array(context, mesh->positions, mesh->vertex_count, sizeof *s->now);
    s->next = ktg_new(context, mesh->vertex_count, ktg_vec3);
    s->face = ktg_new(context, mesh->vertex_count, uint32_t);
    s->kind = ktg_new(context, mesh->vertex_count, uint8_t);
    if (!s->now || !s->next || !s->face || !s->kind)
        return KTG_MEMORY;
    KTG_TRY(ktg_chains_find(context, s->sheet, s->cut, s->fixed, &s->chains));
    uint8_t *held = ktg_new(context, mesh->vertex_count, uint8_t);
    ktg_vec3 *points = ktg_new(context, (size_t)s->sheet->edge_count + 1, ktg_vec3);
    if (held && points) {
        hold_creases(s, held);
        hold_seams(s, held);
        set_kinds(s, held);
        find_faces(s);
        for (int round = 0; round < rounds; round++)
            move(s, points, round);
        if (part < 1)
            go_part(s, part);
        retreat(s);
    }
    bool enough = held && points;
    ktg_free(held);
    ktg_free(points);
    return enough ? KTG_OK : KTG_MEMORY;
}

static void take_over(const slide *s, ktg_mesh *mesh, double *largest) {
    double most = 0;
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        most = ktg_max(most, ktg_length3(ktg_sub3(s->now[v], mesh->positions[v])));
    memcpy(mesh->positions, s->now, mesh->vertex_count * sizeof *s->now);
    if (largest)
        *largest = most;
}

ktg_status ktg_seams_slide(ktg_context *context, ktg_mesh *mesh, const ktg_adjacency *adjacency,
                           const bool *cut, const bool *fixed, double part, double *largest) {
    ktg_sheet *sheet;
    KTG_TRY(ktg_sheet_new(context, mesh, adjacency, &sheet));
    slide s = {.sheet = sheet, .cut = cut, .fixed = fixed};
    ktg_status status = run(context, &s, part);
    if (status == KTG_OK)
        take_over(&s, mesh, largest);
    ktg_free(s.now);
    ktg_free(s.next);
    ktg_free(s.face);
    ktg_free(s.kind);
    ktg_chains_free(&s.chains);
    ktg_sheet_free(&sheet);
    return status;
}
