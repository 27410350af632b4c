/* flatten/laplacian.c - a Laplacian of the panel's edges: sum w_ij (x_i - x_j), factored. */
#include "core/memory.h"
#include "core/sparse.h"
#include "core/vec.h"
#include "flatten/iterate.h"

#include <string.h>

struct ktg_laplacian {
    const ktg_panel *panel;
    uint32_t count;            /* unknowns */
    uint32_t *number;          /* vertex_count; KTG_NONE for a held vertex */
    double *weights;           /* edge_count */
    ktg_sparse_entry *entries; /* an unknown's diagonal each, then edges between unknowns */
    size_t entry_count;
    double *right; /* 2 count: x column, y column */
    ktg_factor *factor;
};

static void edge_ends(const ktg_panel *panel, uint32_t edge, uint32_t ends[2]) {
    uint32_t h = panel->adjacency->edge_halfedges[panel->adjacency->edge_first[edge]];
    ends[0] = panel->faces[h];
    ends[1] = panel->faces[ktg_halfedge_next(h)];
}

static ktg_status fill(ktg_context *context, const bool *held, ktg_laplacian *made) {
    const ktg_panel *panel = made->panel;
    made->number = ktg_new(context, panel->vertex_count, uint32_t);
    made->weights = ktg_new(context, panel->adjacency->edge_count, double);
    if (!made->number || !made->weights)
        return KTG_MEMORY;
    for (uint32_t v = 0; v < panel->vertex_count; v++)
        made->number[v] = held[v] ? KTG_NONE : made->count++;
    made->entries =
        ktg_new(context, (size_t)made->count + panel->adjacency->edge_count, ktg_sparse_entry);
    made->right = ktg_new(context, 2 * (size_t)made->count, double);
    return made->entries && made->right ? KTG_OK : KTG_MEMORY;
}

ktg_status ktg_laplacian_new(ktg_context *context, const ktg_panel *panel, const bool *held,
                             ktg_laplacian **laplacian) {
    *laplacian = NULL;
    ktg_laplacian *made = ktg_new(context, 1, ktg_laplacian);
    if (!made)
        return KTG_MEMORY;
    made->panel = panel;
    ktg_status status = fill(context, held, made);
    if (status != KTG_OK)
        ktg_laplacian_free(&made);
    *laplacian = made;
    return status;
}

void ktg_laplacian_free(ktg_laplacian **laplacian) {
    if (!laplacian || !*laplacian)
        return;
    ktg_factor_free(&(*laplacian)->factor);
    ktg_free((*laplacian)->number);
    ktg_free((*laplacian)->weights);
    ktg_free((*laplacian)->entries);
    ktg_free((*laplacian)->right);
    ktg_free(*laplacian);
    *laplacian = NULL;
}

static void list_entries(ktg_laplacian *l) {
    l->entry_count = l->count;
    for (uint32_t k = 0; k < l->count; k++)
        l->entries[k] = (ktg_sparse_entry){k, k, 0};
    for (uint32_t e = 0; e < l->panel->adjacency->edge_count; e++) {
        uint32_t ends[2];
        edge_ends(l->panel, e, ends);
        uint32_t i = l->number[ends[0]], j = l->number[ends[1]];
        if (i != KTG_NONE)
            l->entries[i].value += l->weights[e];
        if (j != KTG_NONE)
            l->entries[j].value += l->weights[e];
        if (i != KTG_NONE && j != KTG_NONE)
            l->entries[l->entry_count++] =
                (ktg_sparse_entry){i > j ? i : j, i > j ? j : i, -l->weights[e]};
    }
}

ktg_status ktg_laplacian_factor(ktg_context *context, ktg_laplacian *l, const double *weights) {
    memcpy(l->weights, weights, l->panel->adjacency->edge_count * sizeof *weights);
    list_entries(l);
    if (l->factor)
        return ktg_factor_refill(context, l->factor, l->entries, l->entry_count);
    return ktg_factor_new(context, l->count, l->entries, l->entry_count, &l->factor);
}

static void take_solution(const ktg_laplacian *l, ktg_vec2 *solution) {
    for (uint32_t v = 0; v < l->panel->vertex_count; v++) {
        uint32_t k = l->number[v];
        if (k != KTG_NONE)
            solution[v] = (ktg_vec2){l->right[k], l->right[(size_t)l->count + k]};
    }
}

static void put_right(ktg_laplacian *l, const ktg_vec2 *right) {
    for (uint32_t v = 0; v < l->panel->vertex_count; v++) {
        uint32_t k = l->number[v];
        if (k == KTG_NONE)
            continue;
        l->right[k] = right[v].x;
        l->right[(size_t)l->count + k] = right[v].y;
    }
}

ktg_status ktg_laplacian_solve(ktg_context *context, ktg_laplacian *l, const ktg_vec2 *right,
                               ktg_vec2 *solution) {
    put_right(l, right);
    KTG_TRY(ktg_factor_solve(context, l->factor, l->right, 2, l->right));
    for (uint32_t v = 0; v < l->panel->vertex_count; v++)
        if (l->number[v] == KTG_NONE)
            solution[v] = (ktg_vec2){0, 0};
    take_solution(l, solution);
    return KTG_OK;
}

/* What a held vertex pulls its neighbour towards. */
static void add_held(ktg_laplacian *l, uint32_t vertex, ktg_vec2 held, double weight) {
    uint32_t k = l->number[vertex];
    l->right[k] += weight * held.x;
    l->right[(size_t)l->count + k] += weight * held.y;
}

ktg_status ktg_laplacian_extend(ktg_context *context, ktg_laplacian *l, ktg_vec2 *positions) {
    memset(l->right, 0, 2 * (size_t)l->count * sizeof *l->right);
    for (uint32_t e = 0; e < l->panel->adjacency->edge_count; e++) {
        uint32_t ends[2];
        edge_ends(l->panel, e, ends);
        bool held[2] = {l->number[ends[0]] == KTG_NONE, l->number[ends[1]] == KTG_NONE};
        for (int k = 0; k < 2; k++)
            if (held[k] && !held[1 - k])
                add_held(l, ends[1 - k], positions[ends[k]], l->weights[e]);
    }
    KTG_TRY(ktg_factor_solve(context, l->factor, l->right, 2, l->right));
    take_solution(l, positions);
    return KTG_OK;
}
