/* core/sparse.h - sparse symmetric (Hermitian) positive definite systems through CHOLMOD (shared
 * between folders, not installed).
 *
 * The pattern of use: describe the lower triangle by entries, factor once, solve many right-hand
 * sides by back-substitution; where only the values change, refill it. A factor is used by one
 * thread at a time. */
#ifndef KTG_CORE_SPARSE_H
#define KTG_CORE_SPARSE_H

#include "core/core.h"

/* One addend of the symmetric matrix; entries at the same place add up. Only row >= column is
 * given. */
typedef struct ktg_sparse_entry {
    uint32_t row, column;
    double value;
} ktg_sparse_entry;

/* One addend of a Hermitian matrix: x is the real, y the imaginary part. On the diagonal, which is
 * real, y is ignored. */
typedef struct ktg_hermitian_entry {
    uint32_t row, column;
    ktg_vec2 value;
} ktg_hermitian_entry;

/* The Cholesky factor of a symmetric or Hermitian positive definite matrix. */
typedef struct ktg_factor ktg_factor;

/* How unknowns are ordered before the matrix is factored. AMD is quick to find; nested dissection
 * (METIS) halves the factor of a surface of 50,000 vertices whose rows reach two rings far, and
 * with it the time of a solve. Where CHOLMOD was built without METIS, AMD takes its place.
 * METIS seeds and draws from rand(), so that the order, and with it the last digits, may differ
 * when another thread does so meanwhile. */
typedef enum ktg_ordering { KTG_ORDER_AMD, KTG_ORDER_DISSECTION } ktg_ordering;

/* Factors the n x n matrix given by its lower triangle (`entries`, entry_count, any order).
 * KTG_GEOMETRY when it is not positive definite to working precision (NaN included), KTG_MEMORY,
 * KTG_LIMIT. *factor: freed by ktg_factor_free, NULL on failure. */
KTG_NODISCARD ktg_status ktg_factor_new(ktg_context *context, uint32_t n,
                                        const ktg_sparse_entry *entries, size_t entry_count,
                                        ktg_factor **factor);

/* The same with another ordering than AMD. */
KTG_NODISCARD ktg_status ktg_factor_new_ordered(ktg_context *context, uint32_t n,
                                                const ktg_sparse_entry *entries, size_t entry_count,
                                                ktg_ordering ordering, ktg_factor **factor);

/* Factors another matrix: the same entries as ktg_factor_new got, in the same order, with other
 * values. The ordering and the pattern are taken over, which is what makes it cheaper. The same
 * failures, and KTG_ARGUMENT for another number of entries or the factor of a Hermitian matrix;
 * after one the factor can only be refilled or freed. */
KTG_NODISCARD ktg_status ktg_factor_refill(ktg_context *context, ktg_factor *factor,
                                           const ktg_sparse_entry *entries, size_t entry_count);

/* The same as ktg_factor_new for a Hermitian matrix. */
KTG_NODISCARD ktg_status ktg_factor_new_hermitian(ktg_context *context, uint32_t n,
                                                  const ktg_hermitian_entry *entries,
                                                  size_t entry_count, ktg_factor **factor);

/* Solves for `columns` right-hand sides: `right` and `solution` are n x columns, column by column
 * (solution may be the same array as right). KTG_ARGUMENT for the factor of a Hermitian matrix. */
KTG_NODISCARD ktg_status ktg_factor_solve(ktg_context *context, ktg_factor *factor,
                                          const double *right, uint32_t columns, double *solution);

/* The same with complex numbers, for the factor of a Hermitian matrix (else KTG_ARGUMENT). */
KTG_NODISCARD ktg_status ktg_factor_solve_hermitian(ktg_context *context, ktg_factor *factor,
                                                    const ktg_vec2 *right, uint32_t columns,
                                                    ktg_vec2 *solution);

void ktg_factor_free(ktg_factor **factor);

#endif
