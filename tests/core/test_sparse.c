/* Sparse Cholesky factors and solves. */
#include "core/memory.h"
#include "core/sparse.h"
#include "tests/short_memory.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <suitesparse/SuiteSparse_config.h>

#include <cmocka.h>

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return *state != NULL;
}

/* The Laplacian of a `side` x `side` grid plus `shift` on the diagonal, each edge as four addends
 * of which three are in the lower triangle. Returns the number of entries. */
static size_t grid_laplacian(uint32_t side, double shift, ktg_sparse_entry *entries) {
    size_t count = 0;
    for (uint32_t v = 0; v < side * side; v++) {
        entries[count++] = (ktg_sparse_entry){v, v, shift};
        uint32_t next[2] = {v % side + 1 < side ? v + 1 : v, v + side < side * side ? v + side : v};
        for (int k = 0; k < 2; k++) {
            if (next[k] == v)
                continue;
            entries[count++] = (ktg_sparse_entry){v, v, 1};
            entries[count++] = (ktg_sparse_entry){next[k], next[k], 1};
            entries[count++] = (ktg_sparse_entry){next[k], v, -1};
        }
    }
    return count;
}

static void a_known_system_is_solved(void **state) {
    ktg_context *context = *state;
    /* | 4 1 0 | 1 |   | 6  |
     * | 1 3 2 | 2 | = | 13 |
     * | 0 2 5 | 3 |   | 19 |, the 4 given as 1 + 3 and in no particular order */
    ktg_sparse_entry entries[] = {{2, 1, 2}, {0, 0, 1}, {2, 2, 5}, {1, 0, 1}, {0, 0, 3}, {1, 1, 3}};
    double values[3] = {6, 13, 19};
    ktg_factor *factor;
    assert_int_equal(ktg_factor_new(context, 3, entries, 6, &factor), KTG_OK);
    assert_int_equal(ktg_factor_solve(context, factor, values, 1, values), KTG_OK);
    for (int i = 0; i < 3; i++)
        assert_true(fabs(values[i] - (i + 1)) < 1e-14);
    ktg_vec2 complex_values[3] = {{0, 0}};
    assert_int_equal(ktg_factor_solve_hermitian(context, factor, complex_values, 1, complex_values),
                     KTG_ARGUMENT);
    ktg_factor_free(&factor);
    assert_null(factor);
    ktg_factor_free(&factor);
    ktg_factor_free(NULL);
}

static void several_right_hand_sides_and_solves_share_a_factor(void **state) {
    ktg_context *context = *state;
    enum { side = 12, n = side * side, columns = 7 };
    static ktg_sparse_entry entries[7 * n];
    static double wanted[n * columns], right[n * columns], found[n * columns];
    size_t count = grid_laplacian(side, 0.25, entries);
    ktg_factor *factor;
    assert_int_equal(ktg_factor_new(context, n, entries, count, &factor), KTG_OK);
    for (int round = 0; round < 2; round++) {
        for (size_t i = 0; i < n * columns; i++) {
            wanted[i] = sin((double)i + round);
            right[i] = 0;
        }
        for (size_t k = 0; k < count; k++)
            for (size_t c = 0; c < columns; c++) {
                size_t row = entries[k].row + n * c, column = entries[k].column + n * c;
                right[row] += entries[k].value * wanted[column];
                if (row != column)
                    right[column] += entries[k].value * wanted[row];
            }
        assert_int_equal(ktg_factor_solve(context, factor, right, columns, found), KTG_OK);
        for (size_t i = 0; i < n * columns; i++)
            assert_true(fabs(found[i] - wanted[i]) < 1e-12);
        assert_int_equal(ktg_factor_solve(context, factor, right, 1, found), KTG_OK);
        assert_true(fabs(found[n - 1] - wanted[n - 1]) < 1e-12);
    }
    ktg_factor_free(&factor);
}

static void a_factor_is_refilled_with_other_values(void **state) {
    ktg_context *context = *state;
    enum { side = 12, n = side * side };
    static ktg_sparse_entry entries[7 * n];
    static double wanted[n], right[n];
    size_t count = grid_laplacian(side, 0.25, entries);
    ktg_factor *factor;
    assert_int_equal(ktg_factor_new(context, n, entries, count, &factor), KTG_OK);
    for (int round = 0; round < 4; round++) {
        for (size_t k = 0; k < count; k++) /* diagonals grow more than edges: stays definite */
            entries[k].value *=
                entries[k].row == entries[k].column ? 3 : 1.5 + 0.01 * (double)(k % 7);
        for (size_t i = 0; i < n; i++) {
            wanted[i] = cos((double)i + round);
            right[i] = 0;
        }
        for (size_t k = 0; k < count; k++) {
            right[entries[k].row] += entries[k].value * wanted[entries[k].column];
            if (entries[k].row != entries[k].column)
                right[entries[k].column] += entries[k].value * wanted[entries[k].row];
        }
        assert_int_equal(ktg_factor_refill(context, factor, entries, count), KTG_OK);
        assert_int_equal(ktg_factor_solve(context, factor, right, 1, right), KTG_OK);
        for (size_t i = 0; i < n; i++)
            assert_true(fabs(right[i] - wanted[i]) < 1e-12);
    }
    assert_int_equal(ktg_factor_refill(context, factor, entries, count - 1), KTG_ARGUMENT);
    ktg_factor_free(&factor);
}

/* After a matrix that cannot be factored one that can is as good as new. */
static void a_refill_that_fails_can_be_made_good(void **state) {
    ktg_context *context = *state;
    ktg_sparse_entry good[] = {{0, 0, 2}, {1, 0, 1}, {1, 1, 2}},
                     bad[] = {{0, 0, 1}, {1, 0, 2}, {1, 1, 1}};
    double values[2] = {4, 5};
    ktg_factor *factor;
    assert_int_equal(ktg_factor_new(context, 2, good, 3, &factor), KTG_OK);
    assert_int_equal(ktg_factor_refill(context, factor, bad, 3), KTG_GEOMETRY);
    bad[2].value = NAN;
    assert_int_equal(ktg_factor_refill(context, factor, bad, 3), KTG_GEOMETRY);
    assert_int_equal(ktg_factor_refill(context, factor, good, 3), KTG_OK);
    assert_int_equal(ktg_factor_solve(context, factor, values, 1, values), KTG_OK);
    assert_true(fabs(values[0] - 1) + fabs(values[1] - 2) < 1e-14);
    ktg_factor_free(&factor);
    ktg_hermitian_entry hermitian[] = {{0, 0, {1, 0}}};
    ktg_sparse_entry real[] = {{0, 0, 1}};
    assert_int_equal(ktg_factor_new_hermitian(context, 1, hermitian, 1, &factor), KTG_OK);
    assert_int_equal(ktg_factor_refill(context, factor, real, 1), KTG_ARGUMENT);
    ktg_factor_free(&factor);
}

static void a_hermitian_system_is_solved(void **state) {
    ktg_context *context = *state;
    /* | 3    1-2i | 1+i |   | 3+3i + (1-2i)(2-i) |   | 3-2i  |
     * | 1+2i 5    | 2-i | = | (1+2i)(1+i) + 10-5i | = | 9-2i |; the diagonal's 7i is ignored */
    ktg_hermitian_entry entries[] = {{0, 0, {3, 7}}, {1, 0, {1, 2}}, {1, 1, {5, 0}}};
    ktg_vec2 values[4] = {{3, -2}, {9, -2}, {6, -4}, {18, -4}};
    ktg_factor *factor;
    assert_int_equal(ktg_factor_new_hermitian(context, 2, entries, 3, &factor), KTG_OK);
    assert_int_equal(ktg_factor_solve_hermitian(context, factor, values, 2, values), KTG_OK);
    for (int c = 0; c < 2; c++) {
        assert_true(fabs(values[2 * c].x - (c + 1)) + fabs(values[2 * c].y - (c + 1)) < 1e-14);
        assert_true(fabs(values[2 * c + 1].x - 2 * (c + 1)) < 1e-14);
        assert_true(fabs(values[2 * c + 1].y + (c + 1)) < 1e-14);
    }
    double real_values[2] = {0, 0};
    assert_int_equal(ktg_factor_solve(context, factor, real_values, 1, real_values), KTG_ARGUMENT);
    ktg_factor_free(&factor);
}

static void what_is_not_positive_definite_is_refused(void **state) {
    ktg_context *context = *state;
    ktg_factor *factor;
    ktg_sparse_entry negative[] = {{0, 0, 1}, {1, 0, 2}, {1, 1, 1}};
    assert_int_equal(ktg_factor_new(context, 2, negative, 3, &factor), KTG_GEOMETRY);
    assert_null(factor);
    assert_string_not_equal(ktg_context_message(context), "");
    ktg_sparse_entry not_a_number[] = {{0, 0, 1}, {1, 1, NAN}};
    assert_int_equal(ktg_factor_new(context, 2, not_a_number, 2, &factor), KTG_GEOMETRY);
    ktg_sparse_entry missing_row[] = {{0, 0, 1}};
    assert_int_equal(ktg_factor_new(context, 2, missing_row, 1, &factor), KTG_GEOMETRY);
    ktg_hermitian_entry hermitian[] = {{0, 0, {1, 0}}, {1, 0, {0, 1.5}}, {1, 1, {1, 0}}};
    assert_int_equal(ktg_factor_new_hermitian(context, 2, hermitian, 3, &factor), KTG_GEOMETRY);
}

static void a_singular_matrix_is_refused_at_any_scale(void **state) {
    ktg_context *context = *state;
    enum { side = 9, n = side * side };
    static ktg_sparse_entry entries[7 * n];
    size_t count = grid_laplacian(side, 0, entries);
    ktg_factor *factor;
    for (int exponent = -300; exponent <= 300; exponent += 100) {
        for (size_t k = 0; k < count; k++)
            entries[k].value *= ldexp(0.7, exponent);
        assert_int_equal(ktg_factor_new(context, n, entries, count, &factor), KTG_GEOMETRY);
        for (size_t k = 0; k < count; k++)
            entries[k].value /= ldexp(0.7, exponent);
    }
    /* badly scaled but regular */
    ktg_sparse_entry regular[] = {{0, 0, 1e-30}, {1, 1, 1e30}, {1, 0, 0.5}};
    assert_int_equal(ktg_factor_new(context, 2, regular, 3, &factor), KTG_OK);
    ktg_factor_free(&factor);
}

static void an_empty_system_is_no_error(void **state) {
    ktg_context *context = *state;
    ktg_factor *factor;
    assert_int_equal(ktg_factor_new(context, 0, NULL, 0, &factor), KTG_OK);
    assert_int_equal(ktg_factor_solve(context, factor, NULL, 1, NULL), KTG_OK);
    ktg_factor_free(&factor);
}

/* ---- memory ------------------------------------------------------------------------------- */

static long until_failure; /* CHOLMOD's allocations until one fails */

static void *failing_malloc(size_t size) {
    return --until_failure == 0 ? NULL : malloc(size);
}

static void *failing_calloc(size_t count, size_t size) {
    return --until_failure == 0 ? NULL : calloc(count, size);
}

static void *failing_realloc(void *memory, size_t size) {
    return --until_failure == 0 ? NULL : realloc(memory, size);
}

static ktg_status factor_and_solve(ktg_context *context) {
    enum { side = 6, n = side * side };
    static ktg_sparse_entry entries[7 * n];
    double values[n] = {1};
    size_t count = grid_laplacian(side, 1, entries);
    ktg_factor *factor;
    ktg_status status = ktg_factor_new(context, n, entries, count, &factor);
    if (status == KTG_OK)
        status = ktg_factor_refill(context, factor, entries, count);
    if (status == KTG_OK)
        status = ktg_factor_solve(context, factor, values, 1, values);
    ktg_factor_free(&factor);
    return status;
}

static void every_allocation_may_fail(void **state) {
    ktg_context *context = *state;
    uint64_t nth = 1;
    for (;; nth++) {
        ktg_context_fail_allocation(context, nth);
        ktg_status status = factor_and_solve(context);
        end_short_memory(context, status);
        if (status == KTG_OK)
            break;
        assert_int_equal(status, KTG_MEMORY);
    }
    assert_true(nth > 2);
}

static void every_allocation_of_cholmod_may_fail(void **state) {
    struct SuiteSparse_config_struct saved = SuiteSparse_config;
    SuiteSparse_config.malloc_func = failing_malloc;
    SuiteSparse_config.calloc_func = failing_calloc;
    SuiteSparse_config.realloc_func = failing_realloc;
    long nth = 1;
    ktg_status status = KTG_MEMORY;
    for (; status == KTG_MEMORY; nth++) {
        until_failure = nth;
        status = factor_and_solve(*state);
    }
    SuiteSparse_config = saved;
    assert_int_equal(status, KTG_OK);
    assert_true(nth > 10);
}

static void another_ordering_gives_the_same_solution(void **state) {
    ktg_context *context = *state;
    enum { SIDE = 40, COUNT = SIDE * SIDE };
    ktg_sparse_entry *entries = ktg_new(context, 9 * COUNT, ktg_sparse_entry);
    double *values = ktg_new(context, 2 * COUNT, double);
    assert_true(entries && values);
    size_t count = grid_laplacian(SIDE, 0.01, entries);
    for (int order = 0; order < 2; order++) {
        ktg_factor *factor;
        double *x = values + order * COUNT;
        for (int i = 0; i < COUNT; i++)
            x[i] = sin(i);
        assert_int_equal(ktg_factor_new_ordered(context, COUNT, entries, count,
                                                order ? KTG_ORDER_DISSECTION : KTG_ORDER_AMD,
                                                &factor),
                         KTG_OK);
        assert_int_equal(ktg_factor_refill(context, factor, entries, count), KTG_OK);
        assert_int_equal(ktg_factor_solve(context, factor, x, 1, x), KTG_OK);
        ktg_factor_free(&factor);
    }
    for (int i = 0; i < COUNT; i++)
        assert_true(fabs(values[i] - values[COUNT + i]) < 1e-10);
    ktg_free(entries);
    ktg_free(values);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_known_system_is_solved, make_context, drop_context),
        cmocka_unit_test_setup_teardown(several_right_hand_sides_and_solves_share_a_factor,
                                        make_context, drop_context),
        cmocka_unit_test_setup_teardown(a_factor_is_refilled_with_other_values, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(a_refill_that_fails_can_be_made_good, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(a_hermitian_system_is_solved, make_context, drop_context),
        cmocka_unit_test_setup_teardown(what_is_not_positive_definite_is_refused, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(a_singular_matrix_is_refused_at_any_scale, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(an_empty_system_is_no_error, make_context, drop_context),
        cmocka_unit_test_setup_teardown(every_allocation_may_fail, make_context, drop_context),
        cmocka_unit_test_setup_teardown(every_allocation_of_cholmod_may_fail, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(another_ordering_gives_the_same_solution, make_context,
                                        drop_context),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
