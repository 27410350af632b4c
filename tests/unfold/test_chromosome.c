/* Orders of joins: crossover and mutation (section 5.3, figure 6). */
#include "core/memory.h"
#include "tests/unfold/shapes.h"
#include "unfold/chromosome.h"

#include <stdlib.h>
#include <string.h>

#define MOST 64

static void scratch_new(ktg_context *context, ktg_crossover_scratch *s) {
    *s = (ktg_crossover_scratch){.success = ktg_new(context, MOST, uint8_t),
                                 .first = ktg_new(context, MOST, uint32_t),
                                 .second = ktg_new(context, MOST, uint32_t),
                                 .first_place = ktg_new(context, MOST, uint32_t),
                                 .second_place = ktg_new(context, MOST, uint32_t),
                                 .position = ktg_new(context, MOST, uint32_t)};
}

static void scratch_free(ktg_crossover_scratch *s) {
    ktg_free(s->success);
    ktg_free(s->first);
    ktg_free(s->second);
    ktg_free(s->first_place);
    ktg_free(s->second_place);
    ktg_free(s->position);
}

static void assert_permutation(const uint32_t *genes, uint32_t n) {
    bool seen[MOST] = {false};
    for (uint32_t i = 0; i < n; i++) {
        assert_in_range(genes[i], 0, n - 1);
        assert_false(seen[genes[i]]);
        seen[genes[i]] = true;
    }
}

static void a_shuffle_is_a_permutation_that_the_seed_repeats(void **state) {
    (void)state;
    uint32_t one[MOST], other[MOST], stood_first[8] = {0};
    ktg_chromosome a = {.genes = one, .decoded = true}, b = {.genes = other};
    ktg_random random;
    ktg_random_seed(&random, 7);
    ktg_chromosome_shuffle(&a, MOST, &random);
    assert_permutation(one, MOST);
    assert_false(a.decoded);
    ktg_random_seed(&random, 7);
    ktg_chromosome_shuffle(&b, MOST, &random);
    assert_memory_equal(one, other, sizeof one);
    for (int i = 0; i < 8000; i++) {
        ktg_chromosome_shuffle(&a, 8, &random);
        stood_first[one[0]]++;
    }
    for (int g = 0; g < 8; g++)
        assert_in_range(stood_first[g], 850, 1150);
}

/* The paper's example: #4 succeeds in both parents, #2, #3, #5, #7 fail in both, so #0, #1, #6 are
 * the middle. Where the range is the first place of it, p's #6 is replaced by q's #0 and p's #0
 * becomes #6; the same in q. */
static const uint32_t p1[8] = {6, 4, 1, 2, 0, 3, 5, 7}, q1[8] = {4, 0, 6, 5, 1, 3, 7, 2};
static const uint32_t p4[8] = {0, 4, 1, 2, 6, 3, 5, 7}, q4[8] = {4, 6, 0, 5, 1, 3, 7, 2};

static void cross_example(ktg_context *context, uint64_t seed, uint32_t *p, uint32_t *q) {
    uint32_t p_genes[8], q_genes[8];
    memcpy(p_genes, p1, sizeof p1);
    memcpy(q_genes, q1, sizeof q1);
    ktg_chromosome a = {.genes = p_genes, .accepted = 3, .decoded = true};
    ktg_chromosome b = {.genes = q_genes, .accepted = 2, .decoded = true};
    ktg_chromosome a_child = {.genes = p}, b_child = {.genes = q};
    ktg_crossover_scratch scratch;
    scratch_new(context, &scratch);
    ktg_random random;
    ktg_random_seed(&random, seed);
    ktg_chromosome_cross(&a, &b, 8, &random, &scratch, &a_child, &b_child);
    assert_memory_equal(p_genes, p1, sizeof p1);
    assert_memory_equal(q_genes, q1, sizeof q1);
    assert_false(a_child.decoded);
    assert_false(b_child.decoded);
    scratch_free(&scratch);
}

static void the_crossover_of_figure_6_comes_out(void **state) {
    uint32_t p[8], q[8], hits = 0, same = 0;
    for (uint64_t seed = 1; seed <= 2000; seed++) {
        cross_example(*state, seed, p, q);
        assert_permutation(p, 8);
        assert_permutation(q, 8);
        hits += memcmp(p, p4, sizeof p4) == 0 && memcmp(q, q4, sizeof q4) == 0;
        /* a range over the last place alone exchanges p's #0 with q's #1 */
        static const uint32_t p_last[8] = {6, 4, 0, 2, 1, 3, 5, 7};
        static const uint32_t q_last[8] = {4, 1, 6, 5, 0, 3, 7, 2};
        same += memcmp(p, p_last, sizeof p) == 0 && memcmp(q, q_last, sizeof q) == 0;
    }
    /* one of three places as begin and as end: two ranges of nine have but the first, ... */
    assert_in_range(hits, 150, 320);
    assert_in_range(same, 150, 320);
}

static void common_successes_and_failures_stay_where_they_are(void **state) {
    uint32_t p[8], q[8];
    for (uint64_t seed = 1; seed <= 200; seed++) {
        cross_example(*state, seed, p, q);
        for (int i = 0; i < 8; i++) {
            if (p1[i] == 4 || p1[i] == 2 || p1[i] == 3 || p1[i] == 5 || p1[i] == 7)
                assert_int_equal(p[i], p1[i]);
            if (q1[i] == 4 || q1[i] == 2 || q1[i] == 3 || q1[i] == 5 || q1[i] == 7)
                assert_int_equal(q[i], q1[i]);
        }
    }
}

/* Two random decoded parents of n genes. */
static void random_parents(ktg_random *random, uint32_t n, ktg_chromosome *a, ktg_chromosome *b) {
    ktg_chromosome_shuffle(a, n, random);
    ktg_chromosome_shuffle(b, n, random);
    a->accepted = (uint32_t)ktg_random_below(random, n + 1);
    b->accepted = (uint32_t)ktg_random_below(random, n + 1);
    a->decoded = b->decoded = true;
    a->fitness = 1;
    b->fitness = 2;
}

static void children_are_permutations_of_every_length(void **state) {
    uint32_t genes[4][MOST];
    ktg_chromosome c[4];
    ktg_crossover_scratch scratch;
    ktg_random random;
    ktg_random_seed(&random, 3);
    scratch_new(*state, &scratch);
    for (int i = 0; i < 4; i++)
        c[i] = (ktg_chromosome){.genes = genes[i]};
    for (uint32_t round = 0; round < 20000; round++) {
        uint32_t n = 1 + round % MOST;
        random_parents(&random, n, &c[0], &c[1]);
        ktg_chromosome_cross(&c[0], &c[1], n, &random, &scratch, &c[2], &c[3]);
        assert_permutation(genes[2], n);
        assert_permutation(genes[3], n);
        for (int i = 2; i < 4; i++)
            if (c[i].decoded) /* what is not decoded again must be its parent */
                assert_memory_equal(genes[i], genes[i - 2], n * sizeof(uint32_t));
    }
    scratch_free(&scratch);
}

/* Seven genes of `own` with those of `wanted` in places from .. to, others giving way. */
static void exchange(const uint32_t *own, const uint32_t *wanted, int from, int to,
                     uint32_t *child) {
    memcpy(child, own, 7 * sizeof *own);
    for (int k = from; k <= to; k++)
        for (int i = 0; i < 7; i++)
            if (child[i] == wanted[k]) {
                child[i] = child[k];
                child[k] = wanted[k];
                break;
            }
}

static void crossing_exchanges_a_range_gene_by_gene(void **state) {
    /* nothing in common: all genes but the last are the middle */
    uint32_t a[] = {0, 1, 2, 3, 4, 5, 6}, b[] = {3, 4, 5, 0, 1, 2, 6}, p[7], q[7];
    ktg_chromosome c[4] = {{.genes = a, .accepted = 3, .decoded = true},
                           {.genes = b, .accepted = 3, .decoded = true},
                           {.genes = p},
                           {.genes = q}};
    ktg_crossover_scratch scratch;
    ktg_random random;
    ktg_random_seed(&random, 3);
    scratch_new(*state, &scratch);
    uint32_t seen[6][6] = {{0}};
    for (int round = 0; round < 2000; round++) {
        ktg_chromosome_cross(&c[0], &c[1], 7, &random, &scratch, &c[2], &c[3]);
        bool found = false;
        for (int from = 0; from < 6 && !found; from++)
            for (int to = from; to < 6 && !found; to++) {
                uint32_t one[7], other[7];
                exchange(a, b, from, to, one);
                exchange(b, a, from, to, other);
                found = memcmp(p, one, sizeof one) == 0 && memcmp(q, other, sizeof other) == 0;
                seen[from][to] += found;
            }
        assert_true(found);
    }
    /* short ranges and long ones, early ones and late ones */
    assert_true(seen[0][0] > 50 && seen[2][2] > 50 && seen[0][1] > 50 && seen[1][2] > 50);
    assert_true(seen[0][2] > 50);
    scratch_free(&scratch);
}

static void equal_parents_have_equal_children(void **state) {
    uint32_t genes[3][5] = {{3, 1, 4, 0, 2}};
    ktg_chromosome parent = {.genes = genes[0], .accepted = 2, .fitness = 5, .decoded = true};
    ktg_chromosome one = {.genes = genes[1]}, two = {.genes = genes[2]};
    ktg_crossover_scratch scratch;
    ktg_random random;
    ktg_random_seed(&random, 3);
    scratch_new(*state, &scratch);
    ktg_chromosome_cross(&parent, &parent, 5, &random, &scratch, &one, &two);
    assert_memory_equal(genes[1], genes[0], sizeof genes[0]);
    assert_memory_equal(genes[2], genes[0], sizeof genes[0]);
    assert_true(one.decoded && two.decoded && one.accepted == 2 && one.fitness == 5);
    scratch_free(&scratch);
}

static void a_mutation_swaps_a_success_with_a_failure(void **state) {
    (void)state;
    ktg_random random;
    ktg_random_seed(&random, 9);
    uint32_t before[MOST], genes[MOST], moved[MOST] = {0};
    for (uint32_t round = 0; round < 5000; round++) {
        uint32_t n = 2 + round % (MOST - 2), accepted = 1 + round % (n - 1), i, j;
        ktg_chromosome c = {.genes = genes};
        ktg_chromosome_shuffle(&c, n, &random);
        memcpy(before, genes, n * sizeof *genes);
        c.accepted = accepted;
        c.decoded = true;
        ktg_chromosome_mutate(&c, n, &random);
        assert_false(c.decoded);
        assert_permutation(genes, n);
        for (i = 0; i < n && genes[i] == before[i]; i++)
            ;
        for (j = n; j-- > 0 && genes[j] == before[j];)
            ;
        assert_true(i < accepted && j >= accepted && j < n);
        assert_true(genes[i] == before[j] && genes[j] == before[i]);
        for (uint32_t k = i + 1; k < j; k++)
            assert_int_equal(genes[k], before[k]);
        moved[i]++;
        moved[j]++;
    }
    for (uint32_t k = 0; k < MOST - 4; k++)
        assert_true(moved[k] > 0);
}

static void nothing_mutates_where_all_or_none_succeed(void **state) {
    (void)state;
    ktg_random random;
    ktg_random_seed(&random, 9);
    uint32_t genes[3] = {2, 0, 1};
    for (uint32_t accepted = 0; accepted <= 3; accepted += 3) {
        ktg_chromosome c = {.genes = genes, .accepted = accepted, .decoded = true};
        ktg_chromosome_mutate(&c, 3, &random);
        assert_true(c.decoded && genes[0] == 2 && genes[1] == 0 && genes[2] == 1);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_shuffle_is_a_permutation_that_the_seed_repeats),
        cmocka_unit_test(the_crossover_of_figure_6_comes_out),
        cmocka_unit_test(common_successes_and_failures_stay_where_they_are),
        cmocka_unit_test(children_are_permutations_of_every_length),
        cmocka_unit_test(crossing_exchanges_a_range_gene_by_gene),
        cmocka_unit_test(equal_parents_have_equal_children),
        cmocka_unit_test(a_mutation_swaps_a_success_with_a_failure),
        cmocka_unit_test(nothing_mutates_where_all_or_none_succeed),
    };
    return cmocka_run_group_tests(tests, make_context, drop_context);
}
