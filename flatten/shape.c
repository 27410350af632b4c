/* flatten/shape.c - registration: the rest shape, and the factors of both steps.
 *
 * Igarashi & Igarashi 2009, section 6. What the paper factors when handles are added depends on the
 * rest shape alone here (flatten/shape.h), so that all of it is done once. */
#include "flatten/shape.h"
#include "core/memory.h"

/* How far from its plane a vertex may be, by the shape's size. */
static const double flat_enough = 1e-9;

/* ---- the rest shape ----------------------------------------------------------------------- */

static double signed_area(const ktg_mesh *mesh, uint32_t f) {
    const ktg_vec3 *p = mesh->positions;
    const uint32_t *v = mesh->faces + 3 * (size_t)f;
    ktg_vec3 ab = ktg_sub3(p[v[1]], p[v[0]]), ac = ktg_sub3(p[v[2]], p[v[0]]);
    return ab.x * ac.y - ab.y * ac.x;
}

static double side_of(const ktg_mesh *mesh) {
    double sum = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++)
        sum += signed_area(mesh, f);
    return sum < 0 ? -1 : 1;
}

static ktg_status check_flat(ktg_context *context, const ktg_shape *s, const ktg_mesh *rest) {
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++)
        if (s->panel->positions[v].z > flat_enough)
            return ktg_fail(context, KTG_GEOMETRY,
                            "the shape is not flat: z is not the same at all vertices; flatten it "
                            "first");
    for (uint32_t f = 0; f < rest->face_count; f++)
        if (!(signed_area(s->mesh, f) > 0))
            return ktg_fail(context, KTG_GEOMETRY,
                            "face %u of the shape lies upside down: the shape is folded over",
                            f + 1);
    return KTG_OK;
}

static ktg_status check_shape(ktg_context *context, const ktg_shape *s, const ktg_mesh *rest) {
    uint32_t *component = NULL, count = 0;
    KTG_TRY(check_flat(context, s, rest));
    KTG_TRY(ktg_check_sheet(context, s->mesh, s->panel->adjacency));
    ktg_status status =
        ktg_mesh_components(context, s->mesh, s->panel->adjacency, &component, &count);
    ktg_free(component);
    if (status == KTG_OK && count > 1)
        status = ktg_fail(context, KTG_GEOMETRY,
                          "the shape has %u separate parts; handles move one part, so take each by "
                          "itself",
                          count);
    return status;
}

/* Where the panel's normalised positions begin. */
static void find_origin(ktg_shape *s) {
    const ktg_vec3 *p = s->mesh->positions;
    ktg_vec2 low = {INFINITY, INFINITY};
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++)
        low = (ktg_vec2){fmin(low.x, p[v].x), fmin(low.y, p[v].y)};
    s->scale = ldexp(1, s->panel->exponent);
    s->origin = (ktg_vec2){low.x, s->side * low.y};
}

static void set_rest(ktg_shape *s, const ktg_mesh *rest) {
    ktg_vec2 sum = {0, 0};
    uint32_t used = 0;
    for (uint32_t v = 0; v < rest->vertex_count; v++) {
        s->given[v] = (ktg_vec2){rest->positions[v].x, rest->positions[v].y};
        s->rest[v] = (ktg_vec2){s->panel->positions[v].x, s->panel->positions[v].y};
        if (s->panel->leaving[v] == KTG_NONE)
            continue;
        sum = ktg_add2(sum, s->rest[v]);
        used++;
    }
    for (uint32_t v = 0; v < rest->vertex_count; v++)
        if (s->panel->leaving[v] != KTG_NONE)
            s->centred[v] = ktg_madd2(s->rest[v], -1.0 / used, sum);
}

static ktg_status copy_mesh(ktg_context *context, const ktg_mesh *rest, ktg_shape *s) {
    if (rest->vertex_count == 0 || rest->face_count == 0)
        return ktg_fail(context, KTG_GEOMETRY, "the shape has no faces");
    KTG_TRY(ktg_mesh_new(context, &rest->positions[0].x, rest->vertex_count, rest->faces,
                         rest->face_count, &s->mesh));
    s->side = side_of(rest);
    for (uint32_t v = 0; v < rest->vertex_count; v++)
        s->mesh->positions[v].y *= s->side;
    return KTG_OK;
}

static ktg_status take_rest(ktg_context *context, const ktg_mesh *rest, ktg_shape *s) {
    uint32_t count = rest->vertex_count;
    KTG_TRY(copy_mesh(context, rest, s));
    KTG_TRY(ktg_panel_new(context, s->mesh, &s->panel));
    KTG_TRY(check_shape(context, s, rest));
    KTG_TRY(ktg_rests_new(context, s->panel, &s->rests));
    s->given = ktg_new(context, count, ktg_vec2);
    s->rest = ktg_new(context, count, ktg_vec2);
    s->centred = ktg_new(context, count, ktg_vec2);
    s->pulls = ktg_new(context, count, ktg_vec2);
    s->now = ktg_new(context, count, ktg_vec2);
    s->right = ktg_new(context, 2 * (size_t)count, double);
    if (!s->given || !s->rest || !s->centred || !s->pulls || !s->now || !s->right)
        return KTG_MEMORY;
    find_origin(s);
    set_rest(s, rest);
    return KTG_OK;
}

/* ---- unknowns ----------------------------------------------------------------------------- */

static uint32_t farthest_from(const ktg_shape *s, ktg_vec2 p) {
    uint32_t best = KTG_NONE;
    double most = -1;
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++) {
        double away = ktg_length2(ktg_sub2(s->rest[v], p));
        if (s->panel->leaving[v] == KTG_NONE || away <= most)
            continue;
        most = away;
        best = v;
    }
    return best;
}

/* Two vertices far apart are anchors in step 1, one of them in step 2. */
static ktg_status number_unknowns(ktg_context *context, ktg_shape *s) {
    uint32_t first = farthest_from(s, (ktg_vec2){0, 0}), second = farthest_from(s, s->rest[first]);
    s->number1 = ktg_new(context, s->mesh->vertex_count, uint32_t);
    s->number2 = ktg_new(context, s->mesh->vertex_count, uint32_t);
    if (!s->number1 || !s->number2)
        return KTG_MEMORY;
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++) {
        bool none = s->panel->leaving[v] == KTG_NONE || v == first;
        s->number1[v] = none || v == second ? KTG_NONE : s->count1++;
        s->number2[v] = none ? KTG_NONE : s->count2++;
    }
    return KTG_OK;
}

/* ---- step 1 ------------------------------------------------------------------------------- */

enum { entries_per_edge = 10 }; /* of a 4 x 4 lower triangle */

/* Adds the edge's two residuals, squared, to the matrix. */
static void add_edge(const ktg_shape *s, const ktg_neighbourhood *n, ktg_hermitian_entry *entries,
                     size_t *count) {
    ktg_vec2 from_a[4], from_b[4];
    ktg_neighbourhood_residual(n, 0, from_a);
    ktg_neighbourhood_residual(n, 1, from_b);
    for (uint32_t u = 0; u < n->count; u++)
        for (uint32_t v = 0; v < n->count; v++) {
            uint32_t row = s->number1[n->vertices[u]], column = s->number1[n->vertices[v]];
            if (row == KTG_NONE || column == KTG_NONE || row < column)
                continue;
            ktg_vec2 value =
                ktg_add2(ktg_turn_back(from_a[u], from_a[v]), ktg_turn_back(from_b[u], from_b[v]));
            entries[(*count)++] = (ktg_hermitian_entry){row, column, ktg_mul2(value, n->weight)};
        }
}

static ktg_status factor_step1(ktg_context *context, const ktg_neighbourhood *all, ktg_shape *s) {
    uint32_t edge_count = s->panel->adjacency->edge_count;
    size_t count = 0;
    ktg_hermitian_entry *entries =
        ktg_new(context, (size_t)edge_count * entries_per_edge, ktg_hermitian_entry);
    if (!entries)
        return KTG_MEMORY;
    for (uint32_t e = 0; e < edge_count; e++)
        add_edge(s, &all[e], entries, &count);
    ktg_status status = ktg_factor_new_hermitian(context, s->count1, entries, count, &s->factor1);
    ktg_free(entries);
    return status;
}

/* ---- step 2 ------------------------------------------------------------------------------- */

/* What the turn of an edge is read from: the mean of the similarities about its two ends, which is
 * normalised afterwards (section 4.3 with 1 / sqrt(c^2 + s^2)). */
static ktg_shape_edge shape_edge(const ktg_neighbourhood *n) {
    ktg_shape_edge edge = {.pull = 2 * n->weight * n->flat[1].x};
    ktg_vec2 from_b[4];
    ktg_neighbourhood_similarity(n, 0, edge.factors);
    ktg_neighbourhood_similarity(n, 1, from_b);
    for (uint32_t v = 0; v < 4; v++) {
        edge.vertices[v] = n->vertices[v < n->count ? v : 0];
        edge.factors[v] = v < n->count ? ktg_add2(edge.factors[v], from_b[v]) : (ktg_vec2){0, 0};
    }
    return edge;
}

static ktg_status factor_step2(ktg_context *context, const ktg_neighbourhood *all, ktg_shape *s) {
    uint32_t edge_count = s->panel->adjacency->edge_count;
    size_t count = 0;
    ktg_sparse_entry *entries = ktg_new(context, (size_t)edge_count * 3, ktg_sparse_entry);
    if (!entries)
        return KTG_MEMORY;
    for (uint32_t e = 0; e < edge_count; e++) {
        uint32_t i = s->number2[all[e].vertices[0]], j = s->number2[all[e].vertices[1]];
        double weight = 2 * all[e].weight; /* both directions */
        if (i != KTG_NONE)
            entries[count++] = (ktg_sparse_entry){i, i, weight};
        if (j != KTG_NONE)
            entries[count++] = (ktg_sparse_entry){j, j, weight};
        if (i != KTG_NONE && j != KTG_NONE)
            entries[count++] = (ktg_sparse_entry){i > j ? i : j, i > j ? j : i, -weight};
    }
    ktg_status status = ktg_factor_new(context, s->count2, entries, count, &s->factor2);
    ktg_free(entries);
    return status;
}

/* ---- both --------------------------------------------------------------------------------- */

static ktg_status factor_both(ktg_context *context, ktg_edge_weight weight, ktg_shape *s) {
    uint32_t edge_count = s->panel->adjacency->edge_count;
    ktg_neighbourhood *all = NULL;
    KTG_TRY(number_unknowns(context, s));
    s->edges = ktg_new(context, edge_count, ktg_shape_edge);
    ktg_status status =
        s->edges ? ktg_neighbourhoods_new(context, s->panel, weight, &all) : KTG_MEMORY;
    for (uint32_t e = 0; status == KTG_OK && e < edge_count; e++)
        s->edges[e] = shape_edge(&all[e]);
    if (status == KTG_OK)
        status = factor_step1(context, all, s);
    if (status == KTG_OK)
        status = factor_step2(context, all, s);
    ktg_free(all);
    return status;
}

ktg_status ktg_shape_register(ktg_context *context, const ktg_mesh *rest, ktg_edge_weight weight,
                              ktg_shape **shape) {
    *shape = NULL;
    ktg_shape *made = ktg_new(context, 1, ktg_shape);
    if (!made)
        return KTG_MEMORY;
    ktg_status status = take_rest(context, rest, made);
    if (status == KTG_OK)
        status = factor_both(context, weight, made);
    if (status != KTG_OK)
        ktg_shape_free(&made);
    *shape = made;
    return status;
}

void ktg_shape_free(ktg_shape **shape) {
    if (!shape || !*shape)
        return;
    ktg_shape *s = *shape;
    ktg_shape_drop_handles(s);
    ktg_factor_free(&s->factor1);
    ktg_factor_free(&s->factor2);
    ktg_panel_free(&s->panel);
    ktg_mesh_free(&s->mesh);
    ktg_free(s->rests);
    ktg_free(s->given);
    ktg_free(s->rest);
    ktg_free(s->centred);
    ktg_free(s->number1);
    ktg_free(s->number2);
    ktg_free(s->edges);
    ktg_free(s->right);
    ktg_free(s->pulls);
    ktg_free(s->now);
    ktg_free(s);
    *shape = NULL;
}
