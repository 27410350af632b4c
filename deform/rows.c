/* deform/rows.c - the surface as rows: one discrete mean curvature normal for each fan of faces.
 *
 * A fan (section 3.2 of the paper) is what hangs together around a vertex through edges with
 * exactly two faces: an inner vertex has one that is closed, a vertex on a border one that is open,
 * a vertex where a rib stands three. Each gives a row of its own, L_m(x)_0 = 1 / (4 A_m) sum c_i
 * (x_0 - x_i), c_i the cotangents opposite the spoke in the fan's faces (equations 1 and 11, with
 * the sign of 1), A_m the mixed Voronoi area of Meyer et al. 2003. */
#include "core/memory.h"
#include "core/sets.h"
#include "deform/solver.h"

/* Cotangents of slivers are cut off here. Nothing is lost: any weights reproduce the rest shape and
 * its rigid motions, because targets are made by the same rows. */
static const double most_cotangent = 50;
/* And no face counts for less than this part of its longest side's square. */
static const double least_area = 1e-4;

typedef struct fans {
    const ktg_mesh *mesh;
    const ktg_vec3 *positions;
    uint32_t *parent;  /* a corner's set; later its fan */
    uint32_t *members; /* corners sorted by fan */
    size_t *first;     /* where a fan starts in members */
    uint32_t *place;   /* vertex_count: where a vertex stands in the row, + 1 */
} fans;

static bool is_triangle(const uint32_t *c) {
    return c[0] != c[1] && c[1] != c[2] && c[2] != c[0];
}

/* The corner of half-edge h's face that is at the vertex: one of the half-edge's two ends. */
static uint32_t corner_at(const ktg_mesh *mesh, uint32_t h, uint32_t vertex) {
    return mesh->faces[h] == vertex ? h : h % 3 == 2 ? h - 2 : h + 1;
}

/* Joins the corners on both sides of an edge when exactly two triangles meet there. */
static void join_over_edge(fans *f, const ktg_adjacency *a, uint32_t edge) {
    uint32_t sides[2], count = 0, ends[2];
    for (uint32_t i = a->edge_first[edge]; i < a->edge_first[edge + 1]; i++) {
        uint32_t h = a->edge_halfedges[i];
        if (!is_triangle(f->mesh->faces + 3 * (size_t)(h / 3)))
            continue;
        if (count < 2)
            sides[count] = h;
        count++;
    }
    if (count != 2)
        return;
    ktg_edge_ends(f->mesh, a, edge, ends);
    for (int k = 0; k < 2; k++)
        ktg_set_join(f->parent, corner_at(f->mesh, sides[0], ends[k]),
                     corner_at(f->mesh, sides[1], ends[k]));
}

/* Numbers the fans in the order of their first corners; parent becomes a corner's fan. */
static uint32_t number_fans(fans *f) {
    uint32_t count = 0, corners = 3 * f->mesh->face_count;
    for (uint32_t h = 0; h < corners; h++) {
        if (!is_triangle(f->mesh->faces + 3 * (size_t)(h / 3)))
            f->parent[h] = KTG_NONE;
        else if (f->parent[h] == h)
            f->parent[h] = count++;
        else
            f->parent[h] = f->parent[f->parent[h]]; /* its root is lower and has its number */
    }
    return count;
}

static void flatten_sets(fans *f) {
    for (uint32_t h = 0; h < 3 * f->mesh->face_count; h++)
        f->parent[h] = ktg_set_of(f->parent, h);
}

static void sort_corners(fans *f, uint32_t fan_count) {
    uint32_t corners = 3 * f->mesh->face_count;
    for (uint32_t h = 0; h < corners; h++)
        if (f->parent[h] != KTG_NONE)
            f->first[f->parent[h] + 1]++;
    for (uint32_t m = 0; m < fan_count; m++)
        f->first[m + 1] += f->first[m];
    for (uint32_t h = corners; h-- > 0;)
        if (f->parent[h] != KTG_NONE)
            f->members[--f->first[f->parent[h] + 1]] = h;
    for (uint32_t m = 0; m < fan_count; m++) /* each moved one place */
        f->first[m] = f->first[m + 1];
    f->first[fan_count] = 0;
    for (uint32_t h = 0; h < corners; h++)
        f->first[fan_count] += f->parent[h] != KTG_NONE;
}

/* ---- one row -------------------------------------------------------------------------------- */

static double cotangent(ktg_vec3 a, ktg_vec3 b) {
    double across = ktg_length3(ktg_cross3(a, b)), along = ktg_dot3(a, b);
    if (!(fabs(along) < most_cotangent * across))
        return along < 0 ? -most_cotangent : most_cotangent;
    return along / across;
}

/* A triangle as its corner 0 sees it: cotangents at corners 1 and 2, and the part of its area. */
typedef struct corner_share {
    double cot1, cot2, area;
} corner_share;

static corner_share share_of(ktg_vec3 p0, ktg_vec3 p1, ktg_vec3 p2) {
    ktg_vec3 a = ktg_sub3(p1, p0), b = ktg_sub3(p2, p0), c = ktg_sub3(p2, p1);
    double aa = ktg_dot3(a, a), bb = ktg_dot3(b, b), cc = ktg_dot3(c, c);
    double area = ktg_length3(ktg_cross3(a, b)) / 2;
    corner_share share = {cotangent(ktg_mul3(a, -1), c), cotangent(b, c), 0};
    if (ktg_dot3(a, b) < 0) /* obtuse here */
        share.area = area / 2;
    else if (share.cot1 < 0 || share.cot2 < 0)
        share.area = area / 4;
    else
        share.area = (aa * share.cot2 + bb * share.cot1) / 8;
    share.area = ktg_max(share.area, least_area * ktg_max(aa, ktg_max(bb, cc)));
    return share;
}

static void add_spoke(fans *f, ktg_rows *rows, size_t start, size_t *end, uint32_t vertex,
                      double value) {
    if (f->place[vertex] == 0) {
        rows->column[*end] = vertex;
        rows->value[*end] = 0;
        f->place[vertex] = (uint32_t)(++*end - start);
    }
    rows->value[start + f->place[vertex] - 1] -= value;
    rows->value[start] += value;
}

static void fill_row(fans *f, ktg_rows *rows, uint32_t m, size_t *end) {
    size_t start = *end;
    double area = 0;
    rows->vertex[m] = f->mesh->faces[f->members[f->first[m]]];
    rows->column[start] = rows->vertex[m];
    rows->value[start] = 0;
    f->place[rows->vertex[m]] = 1;
    ++*end;
    for (size_t i = f->first[m]; i < f->first[m + 1]; i++) {
        uint32_t h = f->members[i], face = h / 3 * 3, k = h % 3;
        uint32_t v1 = f->mesh->faces[face + (k + 1) % 3], v2 = f->mesh->faces[face + (k + 2) % 3];
        corner_share s =
            share_of(f->positions[rows->vertex[m]], f->positions[v1], f->positions[v2]);
        add_spoke(f, rows, start, end, v1, s.cot2);
        add_spoke(f, rows, start, end, v2, s.cot1);
        area += s.area;
    }
    double scale = area > 0 ? 1 / (4 * sqrt(area)) : 0;
    for (size_t i = start; i < *end; i++) {
        rows->value[i] *= scale;
        f->place[rows->column[i]] = 0;
    }
}

/* ---- the whole ------------------------------------------------------------------------------ */

static ktg_status fill_rows(ktg_context *context, fans *f, ktg_rows *rows) {
    size_t room = (size_t)rows->count + 2 * f->first[rows->count], end = 0;
    rows->vertex = ktg_new(context, rows->count, uint32_t);
    rows->first = ktg_new(context, (size_t)rows->count + 1, size_t);
    rows->column = ktg_new(context, room, uint32_t);
    rows->value = ktg_new(context, room, double);
    if (!rows->vertex || !rows->first || !rows->column || !rows->value)
        return KTG_MEMORY;
    for (uint32_t m = 0; m < rows->count; m++) {
        rows->first[m] = end;
        fill_row(f, rows, m, &end);
    }
    rows->first[rows->count] = end;
    return KTG_OK;
}

static ktg_status make(ktg_context *context, const ktg_adjacency *adjacency, fans *f,
                       ktg_rows *rows) {
    size_t corners = 3 * (size_t)f->mesh->face_count;
    f->parent = ktg_new(context, corners, uint32_t);
    f->members = ktg_new(context, corners, uint32_t);
    f->first = ktg_new(context, corners + 2, size_t);
    f->place = ktg_new(context, f->mesh->vertex_count, uint32_t);
    if (!f->parent || !f->members || !f->first || !f->place)
        return KTG_MEMORY;
    for (uint32_t h = 0; h < corners; h++)
        f->parent[h] = h;
    for (uint32_t e = 0; e < adjacency->edge_count; e++)
        join_over_edge(f, adjacency, e);
    flatten_sets(f);
    rows->count = number_fans(f);
    sort_corners(f, rows->count);
    return fill_rows(context, f, rows);
}

ktg_status ktg_rows_new(ktg_context *context, const ktg_mesh *mesh, const ktg_adjacency *adjacency,
                        const ktg_vec3 *positions, ktg_rows **rows) {
    fans f = {.mesh = mesh, .positions = positions};
    *rows = ktg_new(context, 1, ktg_rows);
    ktg_status status = *rows ? make(context, adjacency, &f, *rows) : KTG_MEMORY;
    ktg_free(f.parent);
    ktg_free(f.members);
    ktg_free(f.first);
    ktg_free(f.place);
    if (status != KTG_OK)
        ktg_rows_free(rows);
    return status;
}

void ktg_rows_free(ktg_rows **rows) {
    if (!rows || !*rows)
        return;
    ktg_free((*rows)->vertex);
    ktg_free((*rows)->first);
    ktg_free((*rows)->column);
    ktg_free((*rows)->value);
    ktg_free(*rows);
    *rows = NULL;
}

void ktg_rows_apply(const ktg_rows *rows, const ktg_vec3 *x, ktg_vec3 *result) {
    for (uint32_t m = 0; m < rows->count; m++) {
        ktg_vec3 sum = {0, 0, 0};
        for (size_t i = rows->first[m]; i < rows->first[m + 1]; i++)
            sum = ktg_madd3(sum, rows->value[i], x[rows->column[i]]);
        result[m] = sum;
    }
}
