/* core/sparse.h - sparse symmetric positive definite systems through CHOLMOD (shared between
 * folders, not installed).
 *
 * The pattern of use: describe the lower triangle by entries, factor once, solve many right-hand
 * sides by back-substitution. */
#ifndef KTG_CORE_SPARSE_H
#define KTG_CORE_SPARSE_H

#include "core/core.h"

/* One addend of the symmetric matrix; entries at the same place add up. Only row >= column is
 * given. */
typedef struct ktg_sparse_entry {
    uint32_t row, column;
    double value;
} ktg_sparse_entry;

/* The Cholesky factor of a symmetric positive definite matrix. */
typedef struct ktg_factor ktg_factor;

/* Factors the n x n matrix given by its lower triangle (`entries`, entry_count, any order).
 * KTG_GEOMETRY when it is not positive definite, KTG_MEMORY. *factor: freed by ktg_factor_free. */
KTG_NODISCARD ktg_status ktg_factor_new(ktg_context *context, uint32_t n,
                                        const ktg_sparse_entry *entries, size_t entry_count,
                                        ktg_factor **factor);

/* Solves for `columns` right-hand sides: `right` and `solution` are n x columns, column by column
 * (solution may be the same array as right). */
KTG_NODISCARD ktg_status ktg_factor_solve(ktg_context *context, ktg_factor *factor,
                                          const double *right, uint32_t columns, double *solution);

void ktg_factor_free(ktg_factor **factor);

#endif
