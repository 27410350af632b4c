/* flatten/dense.c - small dense complex systems: L U with row pivoting. */
#include "core/memory.h"
#include "flatten/shape.h"

/* A column that has lost all but this part of its largest entry depends on those before it. */
static const double least_pivot = 1e-13;

static double size_of(ktg_vec2 z) {
    return fmax(fabs(z.x), fabs(z.y));
}

static ktg_vec2 divide(ktg_vec2 a, ktg_vec2 b) {
    return ktg_mul2(ktg_turn_back(b, a), 1 / ktg_dot2(b, b));
}

static void swap_rows(ktg_dense *d, uint32_t i, uint32_t j) {
    uint32_t row = d->row[i];
    d->row[i] = d->row[j];
    d->row[j] = row;
    for (uint32_t k = 0; k < d->n; k++) {
        ktg_vec2 *a = &d->a[(size_t)i * d->n + k], *b = &d->a[(size_t)j * d->n + k], old = *a;
        *a = *b;
        *b = old;
    }
}

/* The row from k on with the largest entry in column k. */
static uint32_t pivot_row(const ktg_dense *d, uint32_t k) {
    uint32_t best = k;
    for (uint32_t i = k + 1; i < d->n; i++)
        if (size_of(d->a[(size_t)i * d->n + k]) > size_of(d->a[(size_t)best * d->n + k]))
            best = i;
    return best;
}

static void eliminate(ktg_dense *d, uint32_t k) {
    const ktg_vec2 *top = d->a + (size_t)k * d->n;
    for (uint32_t i = k + 1; i < d->n; i++) {
        ktg_vec2 *row = d->a + (size_t)i * d->n;
        ktg_vec2 f = row[k] = divide(row[k], top[k]);
        if (f.x == 0 && f.y == 0)
            continue;
        for (uint32_t j = k + 1; j < d->n; j++)
            row[j] = ktg_sub2(row[j], ktg_turn(f, top[j]));
    }
}

static double largest_in_column(const ktg_dense *d, uint32_t k) {
    double largest = 0;
    for (uint32_t i = 0; i < d->n; i++)
        largest = fmax(largest, size_of(d->a[(size_t)i * d->n + k]));
    return largest;
}

ktg_status ktg_dense_factor(ktg_context *context, ktg_dense *d, uint32_t *singular) {
    *singular = KTG_NONE;
    d->row = ktg_new(context, d->n, uint32_t);
    double *largest = ktg_new(context, d->n, double);
    ktg_status status = d->row && largest ? KTG_OK : KTG_MEMORY;
    for (uint32_t k = 0; status == KTG_OK && k < d->n; k++) {
        d->row[k] = k;
        largest[k] = largest_in_column(d, k);
    }
    for (uint32_t k = 0; status == KTG_OK && k < d->n && *singular == KTG_NONE; k++) {
        uint32_t best = pivot_row(d, k);
        if (!(size_of(d->a[(size_t)best * d->n + k]) > least_pivot * largest[k]))
            *singular = k;
        if (best != k)
            swap_rows(d, k, best);
        if (*singular == KTG_NONE)
            eliminate(d, k);
    }
    ktg_free(largest);
    return status;
}

void ktg_dense_solve(const ktg_dense *d, const ktg_vec2 *right, ktg_vec2 *solution) {
    for (uint32_t i = 0; i < d->n; i++) {
        ktg_vec2 sum = right[d->row[i]];
        for (uint32_t j = 0; j < i; j++)
            sum = ktg_sub2(sum, ktg_turn(d->a[(size_t)i * d->n + j], solution[j]));
        solution[i] = sum;
    }
    for (uint32_t i = d->n; i-- > 0;) {
        ktg_vec2 sum = solution[i];
        for (uint32_t j = i + 1; j < d->n; j++)
            sum = ktg_sub2(sum, ktg_turn(d->a[(size_t)i * d->n + j], solution[j]));
        solution[i] = divide(sum, d->a[(size_t)i * d->n + i]);
    }
}

void ktg_dense_drop(ktg_dense *d) {
    ktg_free(d->a);
    ktg_free(d->row);
    *d = (ktg_dense){0};
}
