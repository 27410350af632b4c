/* core/sparse.c - sparse Cholesky factors and their solves, by CHOLMOD.
 *
 * CHOLMOD is asked for a simplicial LL^T, with AMD ordering unless told otherwise: up to some
 * 100,000 unknowns of a surface it is faster than the supernodal method on the reference BLAS, and
 * as it calls no BLAS at all the bytes of a solution do not depend on how many threads a BLAS uses.
 * Its indices have 32 bits: that is an eighth faster than 64, and enough for every factor that
 * memory holds. */
#include "core/sparse.h"
#include "core/memory.h"

#include <assert.h>
#include <float.h>
#include <string.h>
#include <suitesparse/cholmod.h>

struct ktg_factor {
    cholmod_common common; /* CHOLMOD's state; one per factor, so that nothing is global */
    cholmod_sparse *a;     /* the matrix; kept when real, so that it can be refilled */
    size_t *places; /* entry_count: where in a's values each entry goes; made when first asked */
    size_t entry_count;
    cholmod_factor *l;
    cholmod_dense *x, *y, *e; /* the last solution and workspace, kept from solve to solve */
    size_t n;
    int xtype; /* CHOLMOD_REAL or CHOLMOD_COMPLEX */
};

/* A pivot that has lost all but this part of its diagonal entry is rounding noise: the matrix is
 * singular to working precision. */
static const double pivot_noise = 64 * DBL_EPSILON;

static ktg_status not_definite(ktg_context *context) {
    return ktg_fail(context, KTG_GEOMETRY,
                    "a linear system is not positive definite: the shape is degenerate");
}

/* What CHOLMOD's status means to us. Call after a call that returned failure. */
static ktg_status fail_like_cholmod(ktg_context *context, const ktg_factor *factor) {
    switch (factor->common.status) {
    case CHOLMOD_OUT_OF_MEMORY:
        return ktg_fail(context, KTG_MEMORY, "out of memory (sparse system of %zu unknowns)",
                        factor->n);
    case CHOLMOD_TOO_LARGE:
        return ktg_fail(context, KTG_LIMIT, "a sparse system of %zu unknowns is too large",
                        factor->n);
    case CHOLMOD_NOT_POSDEF:
        return not_definite(context);
    default:
        return ktg_fail(context, KTG_INTERNAL, "CHOLMOD failed with status %d",
                        factor->common.status);
    }
}

static ktg_status start(ktg_context *context, size_t n, int xtype, ktg_factor **factor) {
    ktg_factor *made = ktg_new(context, 1, ktg_factor);
    if (!made)
        return KTG_MEMORY;
    made->n = n;
    made->xtype = xtype;
    cholmod_common *common = &made->common;
    cholmod_start(common);
    common->print = 0;
    common->error_handler = NULL;
    common->nmethods = 1;
    common->method[0].ordering = CHOLMOD_AMD;
    common->postorder = true;
    common->supernodal = CHOLMOD_SIMPLICIAL;
    common->final_ll = true;
    *factor = made;
    return KTG_OK;
}

/* An empty list of entries for the lower triangle; NULL when memory is short. */
static cholmod_triplet *new_triplet(ktg_factor *factor, size_t entry_count) {
    cholmod_triplet *triplet = cholmod_allocate_triplet(factor->n, factor->n, entry_count, -1,
                                                        factor->xtype, &factor->common);
    if (triplet)
        triplet->nnz = entry_count;
    return triplet;
}

static void put_place(cholmod_triplet *triplet, size_t k, uint32_t row, uint32_t column) {
    assert(row < triplet->nrow && column <= row);
    ((int *)triplet->i)[k] = (int)row; /* CHOLMOD refused more rows than that holds */
    ((int *)triplet->j)[k] = (int)column;
}

/* diagonal[i] = A_ii; both kinds of value. */
static void read_diagonal(const cholmod_sparse *a, double *diagonal) {
    const int *first = a->p, *row = a->i;
    const double *value = a->x;
    size_t step = a->xtype == CHOLMOD_COMPLEX ? 2 : 1;
    for (size_t column = 0; column < a->ncol; column++)
        for (int k = first[column]; k < first[column + 1]; k++)
            if ((size_t)row[k] == column)
                diagonal[column] = value[step * (size_t)k];
}

/* CHOLMOD stops only at a pivot <= 0; rounding can leave a tiny positive one (or NaN) instead. Each
 * pivot is compared with the diagonal entry it came from, so that scaling does not matter. */
static bool pivots_are_sound(const ktg_factor *factor, const double *diagonal) {
    const cholmod_factor *l = factor->l;
    const int *first = l->p, *permutation = l->Perm;
    const double *value = l->x;
    size_t step = factor->xtype == CHOLMOD_COMPLEX ? 2 : 1;
    for (size_t j = 0; j < factor->n; j++) {
        double pivot = value[step * (size_t)first[j]];
        if (!(pivot * pivot > pivot_noise * diagonal[permutation[j]]))
            return false;
    }
    return true;
}

static ktg_status check_pivots(ktg_context *context, const ktg_factor *factor,
                               const cholmod_sparse *a) {
    double *diagonal = ktg_new(context, factor->n, double);
    if (!diagonal)
        return KTG_MEMORY;
    read_diagonal(a, diagonal);
    bool sound = pivots_are_sound(factor, diagonal);
    ktg_free(diagonal);
    return sound ? KTG_OK : not_definite(context);
}

/* Factors and checks factor->a, which has been analysed. */
static ktg_status factor_matrix(ktg_context *context, ktg_factor *factor) {
    cholmod_common *common = &factor->common;
    if (!cholmod_factorize(factor->a, factor->l, common) || common->status != CHOLMOD_OK)
        return fail_like_cholmod(context, factor);
    return check_pivots(context, factor, factor->a);
}

/* Orders, factors and checks the matrix that `triplet` lists. */
static ktg_status factor_triplet(ktg_context *context, ktg_factor *factor,
                                 cholmod_triplet *triplet) {
    cholmod_common *common = &factor->common;
    factor->a = cholmod_triplet_to_sparse(triplet, 0, common);
    factor->entry_count = triplet->nnz;
    if (factor->a)
        factor->l = cholmod_analyze(factor->a, common);
    if (!factor->l && common->status == CHOLMOD_NOT_INSTALLED) {
        common->method[0].ordering = CHOLMOD_AMD;
        factor->l = cholmod_analyze(factor->a, common);
    }
    if (!factor->l)
        return fail_like_cholmod(context, factor);
    ktg_status status = factor_matrix(context, factor);
    if (factor->xtype != CHOLMOD_REAL)
        cholmod_free_sparse(&factor->a, common);
    return status;
}

/* Factors and frees the triplet (NULL: memory was short); on failure frees the factor too. */
static ktg_status finish(ktg_context *context, ktg_factor *made, cholmod_triplet *triplet,
                         ktg_factor **factor) {
    ktg_status status =
        triplet ? factor_triplet(context, made, triplet) : fail_like_cholmod(context, made);
    cholmod_free_triplet(&triplet, &made->common);
    if (status != KTG_OK)
        ktg_factor_free(&made);
    *factor = made;
    return status;
}

ktg_status ktg_factor_new(ktg_context *context, uint32_t n, const ktg_sparse_entry *entries,
                          size_t entry_count, ktg_factor **factor) {
    return ktg_factor_new_ordered(context, n, entries, entry_count, KTG_ORDER_AMD, factor);
}

ktg_status ktg_factor_new_ordered(ktg_context *context, uint32_t n, const ktg_sparse_entry *entries,
                                  size_t entry_count, ktg_ordering ordering, ktg_factor **factor) {
    *factor = NULL;
    ktg_factor *made;
    KTG_TRY(start(context, n, CHOLMOD_REAL, &made));
    if (ordering == KTG_ORDER_DISSECTION)
        made->common.method[0].ordering = CHOLMOD_METIS;
    cholmod_triplet *triplet = new_triplet(made, entry_count);
    for (size_t k = 0; triplet && k < entry_count; k++) {
        put_place(triplet, k, entries[k].row, entries[k].column);
        ((double *)triplet->x)[k] = entries[k].value;
    }
    return finish(context, made, triplet, factor);
}

/* The place of (row, column) among a's values, whose rows are sorted; it is there. */
static size_t find_place(const cholmod_sparse *a, uint32_t row, uint32_t column) {
    const int *rows = a->i, *first = a->p;
    int low = first[column], high = first[column + 1];
    while (high - low > 1) {
        int middle = low + (high - low) / 2;
        if (rows[middle] <= (int)row)
            low = middle;
        else
            high = middle;
    }
    assert(rows[low] == (int)row);
    return (size_t)low;
}

static ktg_status find_places(ktg_context *context, ktg_factor *factor,
                              const ktg_sparse_entry *entries) {
    if (factor->places)
        return KTG_OK;
    factor->places = ktg_new(context, factor->entry_count, size_t);
    if (!factor->places)
        return KTG_MEMORY;
    for (size_t k = 0; k < factor->entry_count; k++)
        factor->places[k] = find_place(factor->a, entries[k].row, entries[k].column);
    return KTG_OK;
}

ktg_status ktg_factor_refill(ktg_context *context, ktg_factor *factor,
                             const ktg_sparse_entry *entries, size_t entry_count) {
    if (factor->xtype != CHOLMOD_REAL || entry_count != factor->entry_count)
        return ktg_fail(context, KTG_ARGUMENT, "the factor is that of another kind of matrix");
    KTG_TRY(find_places(context, factor, entries));
    double *values = factor->a->x;
    memset(values, 0, factor->a->nzmax * sizeof *values);
    for (size_t k = 0; k < entry_count; k++)
        values[factor->places[k]] += entries[k].value;
    return factor_matrix(context, factor);
}

ktg_status ktg_factor_new_hermitian(ktg_context *context, uint32_t n,
                                    const ktg_hermitian_entry *entries, size_t entry_count,
                                    ktg_factor **factor) {
    *factor = NULL;
    ktg_factor *made;
    KTG_TRY(start(context, n, CHOLMOD_COMPLEX, &made));
    cholmod_triplet *triplet = new_triplet(made, entry_count);
    for (size_t k = 0; triplet && k < entry_count; k++) {
        put_place(triplet, k, entries[k].row, entries[k].column);
        ktg_vec2 value = entries[k].value;
        /* simplicial CHOLMOD does not look at the diagonal's imaginary part but adds it up */
        if (entries[k].row == entries[k].column)
            value.y = 0;
        ((ktg_vec2 *)triplet->x)[k] = value;
    }
    return finish(context, made, triplet, factor);
}

/* `values` are n x columns numbers of the factor's kind. */
static ktg_status solve(ktg_context *context, ktg_factor *factor, const void *values,
                        uint32_t columns, void *solution) {
    size_t count = factor->n * columns;
    if (count == 0)
        return KTG_OK;
    size_t doubles = factor->xtype == CHOLMOD_COMPLEX ? 2 : 1;
    cholmod_dense right = {.nrow = factor->n,
                           .ncol = columns,
                           .nzmax = count,
                           .d = factor->n,
                           .x = (void *)(uintptr_t)values, /* CHOLMOD only reads it */
                           .xtype = factor->xtype,
                           .dtype = CHOLMOD_DOUBLE};
    if (!cholmod_solve2(CHOLMOD_A, factor->l, &right, NULL, &factor->x, NULL, &factor->y,
                        &factor->e, &factor->common))
        return fail_like_cholmod(context, factor);
    memcpy(solution, factor->x->x, count * doubles * sizeof(double));
    return KTG_OK;
}

ktg_status ktg_factor_solve(ktg_context *context, ktg_factor *factor, const double *right,
                            uint32_t columns, double *solution) {
    if (factor->xtype != CHOLMOD_REAL)
        return ktg_fail(context, KTG_ARGUMENT, "the factor is that of a Hermitian matrix");
    return solve(context, factor, right, columns, solution);
}

ktg_status ktg_factor_solve_hermitian(ktg_context *context, ktg_factor *factor,
                                      const ktg_vec2 *right, uint32_t columns, ktg_vec2 *solution) {
    if (factor->xtype != CHOLMOD_COMPLEX)
        return ktg_fail(context, KTG_ARGUMENT, "the factor is not that of a Hermitian matrix");
    return solve(context, factor, right, columns, solution);
}

void ktg_factor_free(ktg_factor **factor) {
    if (!factor || !*factor)
        return;
    ktg_factor *old = *factor;
    cholmod_free_dense(&old->x, &old->common);
    cholmod_free_dense(&old->y, &old->common);
    cholmod_free_dense(&old->e, &old->common);
    cholmod_free_factor(&old->l, &old->common);
    cholmod_free_sparse(&old->a, &old->common);
    cholmod_finish(&old->common);
    ktg_free(old->places);
    ktg_free(old);
    *factor = NULL;
}
