/* flatten/two_step.c - the two linear solves of the paper: similarities, then scale adjustment.
 *
 * Igarashi & Igarashi 2009, sections 4.2 (equations 4 and 5) and 4.3 (equations 6 and 7), with each
 * edge taken in both directions. Positions of the plane are complex numbers, so that step 1 is one
 * Hermitian system of V unknowns instead of a real one of 2 V. Pins are exact: their columns go to
 * the right-hand side. */
#include "core/memory.h"
#include "core/sparse.h"
#include "core/vec.h"
#include "flatten/kernel.h"

#include <string.h>

/* The vertices that are not pinned, numbered. */
typedef struct unknowns {
    uint32_t count;
    uint32_t *number; /* vertex_count; KTG_NONE for a pinned vertex */
} unknowns;

static ktg_status number_unknowns(ktg_context *context, const ktg_edges *edges,
                                  const ktg_pins *pins, unknowns *free_vertices) {
    free_vertices->count = 0;
    free_vertices->number = ktg_new(context, edges->vertex_count, uint32_t);
    if (!free_vertices->number)
        return KTG_MEMORY;
    for (uint32_t k = 0; k < pins->count; k++)
        free_vertices->number[pins->vertices[k]] = KTG_NONE;
    for (uint32_t v = 0; v < edges->vertex_count; v++)
        if (free_vertices->number[v] != KTG_NONE)
            free_vertices->number[v] = free_vertices->count++;
    return KTG_OK;
}

static void set_pins(const ktg_pins *pins, ktg_vec2 *positions) {
    for (uint32_t k = 0; k < pins->count; k++)
        positions[pins->vertices[k]] = pins->positions[k];
}

/* ---- step 1 ------------------------------------------------------------------------------- */

/* A Hermitian system being put together; entries has room for all. */
typedef struct hermitian_system {
    const unknowns *free_vertices;
    const ktg_vec2 *pinned; /* positions, read for pinned vertices only */
    ktg_hermitian_entry *entries;
    size_t entry_count;
    ktg_vec2 *right;
} hermitian_system;

/* Adds `value`, what two vertices have to do with each other in the sum of squares: to the matrix,
 * or to the right-hand side where the second one is pinned. */
static void add_coupling(hermitian_system *system, uint32_t row_vertex, uint32_t column_vertex,
                         ktg_vec2 value) {
    uint32_t row = system->free_vertices->number[row_vertex];
    uint32_t column = system->free_vertices->number[column_vertex];
    if (row == KTG_NONE)
        return;
    if (column == KTG_NONE)
        system->right[row] =
            ktg_sub2(system->right[row], ktg_turn(value, system->pinned[column_vertex]));
    else if (row >= column)
        system->entries[system->entry_count++] = (ktg_hermitian_entry){row, column, value};
}

static void add_edge(hermitian_system *system, const ktg_neighbourhood *n) {
    ktg_vec2 from_a[4], from_b[4];
    ktg_neighbourhood_residual(n, 0, from_a);
    ktg_neighbourhood_residual(n, 1, from_b);
    for (uint32_t u = 0; u < n->count; u++)
        for (uint32_t v = 0; v < n->count; v++) {
            ktg_vec2 value =
                ktg_add2(ktg_turn_back(from_a[u], from_a[v]), ktg_turn_back(from_b[u], from_b[v]));
            add_coupling(system, n->vertices[u], n->vertices[v], ktg_mul2(value, n->weight));
        }
}

/* The 10 entries at most of an edge's 4 x 4 lower triangle. */
enum { entries_per_edge = 10 };

static ktg_status factor_similarity(ktg_context *context, const ktg_edges *edges,
                                    hermitian_system *system, ktg_factor **factor) {
    system->entries =
        ktg_new(context, (size_t)edges->edge_count * entries_per_edge, ktg_hermitian_entry);
    if (!system->entries)
        return KTG_MEMORY;
    for (uint32_t e = 0; e < edges->edge_count; e++)
        add_edge(system, &edges->neighbourhoods[e]);
    ktg_status status = ktg_factor_new_hermitian(context, system->free_vertices->count,
                                                 system->entries, system->entry_count, factor);
    ktg_free(system->entries);
    system->entries = NULL;
    return status;
}

/* right = - gradient of the sum of squares at `positions`, made from the residuals themselves. */
static void descend(hermitian_system *system, const ktg_edges *edges, const ktg_vec2 *positions) {
    memset(system->right, 0, system->free_vertices->count * sizeof *system->right);
    for (uint32_t e = 0; e < edges->edge_count; e++) {
        const ktg_neighbourhood *n = &edges->neighbourhoods[e];
        for (uint32_t base = 0; base < 2; base++) {
            ktg_vec2 factors[4], residual = {0, 0};
            ktg_neighbourhood_residual(n, base, factors);
            for (uint32_t v = 0; v < n->count; v++)
                residual = ktg_add2(residual, ktg_turn(factors[v], positions[n->vertices[v]]));
            for (uint32_t v = 0; v < n->count; v++) {
                uint32_t row = system->free_vertices->number[n->vertices[v]];
                if (row != KTG_NONE)
                    system->right[row] = ktg_madd2(system->right[row], -n->weight,
                                                   ktg_turn_back(factors[v], residual));
            }
        }
    }
}

/* The matrix has the squared condition of the residuals, so that a fine panel would lose half its
 * digits. Two corrections from residuals computed afresh bring them back: the largest strain of a
 * slit flat ring of 4,600 faces falls from 7e-8 to 8e-12. */
enum { corrections = 2 };

static ktg_status solve_similarity(ktg_context *context, const ktg_edges *edges,
                                   hermitian_system *system, ktg_factor *factor,
                                   ktg_vec2 *positions) {
    for (int round = 0; round <= corrections; round++) {
        if (round > 0)
            descend(system, edges, positions);
        KTG_TRY(ktg_factor_solve_hermitian(context, factor, system->right, 1, system->right));
        for (uint32_t v = 0; v < edges->vertex_count; v++) {
            uint32_t k = system->free_vertices->number[v];
            if (k != KTG_NONE)
                positions[v] =
                    round > 0 ? ktg_add2(positions[v], system->right[k]) : system->right[k];
        }
    }
    return KTG_OK;
}

static ktg_status similarity(ktg_context *context, const ktg_edges *edges,
                             const unknowns *free_vertices, ktg_vec2 *positions) {
    hermitian_system system = {.free_vertices = free_vertices, .pinned = positions};
    ktg_factor *factor = NULL;
    system.right = ktg_new(context, free_vertices->count, ktg_vec2);
    ktg_status status = system.right ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK)
        status = factor_similarity(context, edges, &system, &factor);
    if (status == KTG_OK)
        status = solve_similarity(context, edges, &system, factor, positions);
    ktg_factor_free(&factor);
    ktg_free(system.right);
    return status;
}

ktg_status ktg_similarity_step(ktg_context *context, const ktg_edges *edges, const ktg_pins *pins,
                               ktg_vec2 *positions) {
    unknowns free_vertices;
    KTG_TRY(number_unknowns(context, edges, pins, &free_vertices));
    set_pins(pins, positions);
    ktg_status status = similarity(context, edges, &free_vertices, positions);
    ktg_free(free_vertices.number);
    return status;
}

/* ---- step 2 ------------------------------------------------------------------------------- */

/* A real system with a right-hand side each for x and y. */
typedef struct real_system {
    const unknowns *free_vertices;
    const ktg_vec2 *pinned;
    ktg_sparse_entry *entries;
    size_t entry_count;
    double *right; /* 2 count: x column, y column */
} real_system;

/* The edge's flat vector turned by the normalised rotations of both directions (equation 6, with
 * the factor 1 / sqrt(c^2 + s^2)); their mean is what the two residuals together ask for. */
static ktg_vec2 turned_edge(const ktg_neighbourhood *n, const ktg_vec2 *positions) {
    ktg_vec2 factors[4], sum = {0, 0};
    for (uint32_t base = 0; base < 2; base++) {
        ktg_vec2 similarity = {0, 0};
        ktg_neighbourhood_similarity(n, base, factors);
        for (uint32_t v = 0; v < n->count; v++)
            similarity = ktg_add2(similarity, ktg_turn(factors[v], positions[n->vertices[v]]));
        sum = ktg_madd2(sum, 0.5, ktg_unit2(similarity));
    }
    return ktg_mul2(sum, n->flat[1].x);
}

/* One end's half of weight |z_to - z_from - vector|^2. */
static void add_end(real_system *system, uint32_t from, uint32_t to, ktg_vec2 vector,
                    double weight) {
    uint32_t count = system->free_vertices->count;
    uint32_t row = system->free_vertices->number[to], column = system->free_vertices->number[from];
    if (row == KTG_NONE)
        return;
    if (column == KTG_NONE)
        vector = ktg_add2(vector, system->pinned[from]);
    else if (row > column)
        system->entries[system->entry_count++] = (ktg_sparse_entry){row, column, -weight};
    system->entries[system->entry_count++] = (ktg_sparse_entry){row, row, weight};
    system->right[row] += weight * vector.x;
    system->right[(size_t)count + row] += weight * vector.y;
}

static ktg_status solve_real(ktg_context *context, real_system *system) {
    ktg_factor *factor;
    KTG_TRY(ktg_factor_new(context, system->free_vertices->count, system->entries,
                           system->entry_count, &factor));
    ktg_status status = ktg_factor_solve(context, factor, system->right, 2, system->right);
    ktg_factor_free(&factor);
    return status;
}

/* `pinned` holds the pins, `positions` the result of step 1; the new positions replace it. */
static ktg_status adjust_scale(ktg_context *context, const ktg_edges *edges,
                               const unknowns *free_vertices, const ktg_vec2 *pinned,
                               ktg_vec2 *positions) {
    real_system system = {.free_vertices = free_vertices, .pinned = pinned};
    system.entries = ktg_new(context, (size_t)edges->edge_count * 3, ktg_sparse_entry);
    system.right = ktg_new(context, 2 * (size_t)free_vertices->count, double);
    ktg_status status = system.entries && system.right ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        for (uint32_t e = 0; e < edges->edge_count; e++) {
            const ktg_neighbourhood *n = &edges->neighbourhoods[e];
            ktg_vec2 ab = turned_edge(n, positions);
            add_end(&system, n->vertices[0], n->vertices[1], ab, n->weight);
            add_end(&system, n->vertices[1], n->vertices[0], ktg_mul2(ab, -1), n->weight);
        }
        status = solve_real(context, &system);
    }
    for (uint32_t v = 0; status == KTG_OK && v < edges->vertex_count; v++) {
        uint32_t k = free_vertices->number[v];
        positions[v] = k == KTG_NONE ? pinned[v]
                                     : (ktg_vec2){system.right[k],
                                                  system.right[(size_t)free_vertices->count + k]};
    }
    ktg_free(system.entries);
    ktg_free(system.right);
    return status;
}

ktg_status ktg_scale_step(ktg_context *context, const ktg_edges *edges, const ktg_pins *pins,
                          ktg_vec2 *positions) {
    unknowns free_vertices;
    KTG_TRY(number_unknowns(context, edges, pins, &free_vertices));
    ktg_vec2 *pinned = ktg_new(context, edges->vertex_count, ktg_vec2);
    ktg_status status = KTG_MEMORY;
    if (pinned) {
        set_pins(pins, pinned);
        status = adjust_scale(context, edges, &free_vertices, pinned, positions);
    }
    ktg_free(pinned);
    ktg_free(free_vertices.number);
    return status;
}
