/* Arrangements: their trees, coordinates and conflicts against slow references, and what
 * annealing makes of them. */
#include "tests/short_memory.h"
#include "tests/unfold/arrange_help.h"
#include "unfold/ease.h"
#include "unfold/spread.h"

/* Faces joined by folds lie edge to edge. */
static void assert_laid(const ktg_arrangement *a) {
    for (uint32_t e = 0; e < a->dual->edge_count; e++) {
        if (!a->folded[e])
            continue;
        uint32_t h = a->dual->edges[e].halfedge[0], g = a->dual->edges[e].halfedge[1];
        uint32_t after = g % 3 == 2 ? g - 2 : g + 1;
        assert_true(ktg_length2(ktg_sub2(a->corners[h], a->corners[after])) < 1e-9);
    }
}

static uint32_t slow_conflicts(const ktg_arrangement *a, double depth) {
    uint32_t count = 0;
    for (uint32_t f = 0; f < a->dual->face_count; f++)
        for (uint32_t g = 0; g < f; g++)
            count += a->piece[f] == a->piece[g] &&
                     ktg_triangles_overlap(a->corners + 3 * f, a->dual->lengths + 3 * f,
                                           a->corners + 3 * g, a->dual->lengths + 3 * g, depth);
    return count;
}

static void grafts_keep_the_tree_and_count_their_conflicts(void **state) {
    fixture f = start(*state, shape_bumpy_sphere(*state));
    uint32_t conflicts = 0, done = 0;
    assert_preorder(f.a);
    assert_laid(f.a);
    for (int i = 0; i < 20000 && done < 60; i++) {
        ktg_branch branch;
        ktg_graft graft;
        if (!draw(&f, &branch, &graft))
            continue;
        uint32_t before = ktg_graft_conflicts(f.a, &branch, NULL, UINT32_MAX - 1);
        uint32_t after = ktg_graft_conflicts(f.a, &branch, &graft, UINT32_MAX - 1);
        assert_int_equal(ktg_graft_conflicts(f.a, &branch, &graft, 0) > 0, after > 0);
        assert_int_equal(ktg_arrangement_graft(*state, f.a, &branch, &graft), KTG_OK);
        conflicts += after - before;
        assert_preorder(f.a);
        if (done++ % 10 == 0) {
            assert_laid(f.a);
            assert_int_equal(conflicts, slow_conflicts(f.a, KTG_ARRANGEMENT_DEPTH));
        }
    }
    assert_int_equal(done, 60);
    ktg_arrangement_order(f.a);
    assert_int_equal(ktg_arrangement_settle(*state, f.a), KTG_OK);
    assert_preorder(f.a);
    assert_int_equal(conflicts, slow_conflicts(f.a, KTG_ARRANGEMENT_DEPTH));
    drop(&f);
}

/* Two pieces: what hangs on one may go over to the other. */
static void branches_go_over_to_another_piece(void **state) {
    fixture f = start(*state, shape_icosphere(*state, 2));
    uint32_t over = 0;
    for (uint32_t e = 0; e < f.dual->edge_count; e++)
        if (f.tree[e]) {
            f.tree[e] = false;
            break;
        }
    ktg_arrangement_free(&f.a);
    assert_int_equal(ktg_arrangement_new(*state, f.dual, f.tree, (ktg_vec2){2, 2}, &f.a), KTG_OK);
    assert_int_equal(f.a->piece_count, 2);
    for (int i = 0; i < 20000 && over < 20; i++) {
        ktg_branch branch;
        ktg_graft graft;
        if (!draw(&f, &branch, &graft))
            continue;
        over += f.a->piece[graft.own / 3] != f.a->piece[graft.other / 3];
        assert_int_equal(ktg_arrangement_graft(*state, f.a, &branch, &graft), KTG_OK);
        assert_preorder(f.a);
    }
    assert_int_equal(over, 20);
    assert_laid(f.a);
    drop(&f);
}

/* What changes are said to cost adds up to what the whole costs in the end. */
static void ease_is_counted_as_branches_move(void **state) {
    fixture f = start(*state, shape_bumpy_sphere(*state));
    ktg_ease ease, anew;
    uint32_t done = 0;
    assert_int_equal(ktg_ease_new(*state, f.a, 2, (ktg_vec2){1, 1.5}, 0.2, &ease), KTG_OK);
    double price = ktg_ease_price(&ease), before = price;
    for (int i = 0; i < 20000 && done < 50; i++) {
        ktg_branch branch;
        ktg_graft graft;
        if (!draw(&f, &branch, &graft))
            continue;
        uint32_t fold = f.a->parent_edge[branch.top];
        price +=
            ktg_ease_cuts(&ease, fold, graft.edge) + ktg_ease_distances(&ease, &branch, &graft);
        assert_int_equal(ktg_arrangement_graft(*state, f.a, &branch, &graft), KTG_OK);
        ktg_ease_follow(&ease, fold, graft.edge);
        done++;
    }
    assert_int_equal(done, 50);
    assert_int_equal(ktg_ease_new(*state, f.a, 2, (ktg_vec2){1, 1.5}, 0.2, &anew), KTG_OK);
    assert_true(fabs(price - before) > 1e-3);
    assert_true(fabs(ktg_ease_price(&ease) - price) < 1e-5);
    assert_true(fabs(ktg_ease_price(&anew) - price) < 1e-5);
    ktg_ease_free(&ease);
    ktg_ease_free(&anew);
    drop(&f);
}

/* The mean distance of the copies of cut edges. */
static double mate_distance(ktg_context *context, const fixture *f) {
    ktg_arrangement *a;
    double sum = 0, count = 0;
    assert_int_equal(ktg_arrangement_new(context, f->dual, f->tree, (ktg_vec2){2, 2}, &a), KTG_OK);
    for (uint32_t e = 0; e < f->dual->edge_count; e++) {
        const uint32_t *pair = f->dual->edges[e].halfedge;
        ktg_vec2 to = a->corners[pair[1] % 3 == 2 ? pair[1] - 2 : pair[1] + 1];
        sum += f->tree[e] ? 0 : ktg_length2(ktg_sub2(a->corners[pair[0]], to));
        count += !f->tree[e];
    }
    ktg_arrangement_free(&a);
    return sum / count;
}

static void ease_brings_copies_together(void **state) {
    fixture f = start(*state, shape_bumpy_sphere(*state)),
            easy = start(*state, shape_bumpy_sphere(*state));
    double side = sqrt(ktg_dual_area(f.dual) / 0.4);
    ktg_arrange_goal goal = {
        .half = {0.4 * side, 0.6 * side}, .tabs = &wish, .short_edge = 0.02, .work = 1500000};
    assert_int_equal(ktg_arrange(*state, f.dual, &goal, &f.search, f.tree), KTG_OK);
    goal.ease = 2;
    assert_int_equal(ktg_arrange(*state, easy.dual, &goal, &easy.search, easy.tree), KTG_OK);
    assert_true(mate_distance(*state, &easy) < 0.85 * mate_distance(*state, &f));
    drop(&f);
    drop(&easy);
}

/* Work for several starts, and for all rounds. */
#define SEVERAL_STARTS(faces) (16 * 8000 * (uint64_t)(faces))

static void any_number_of_threads_finds_the_same(void **state) {
    fixture one = start(*state, shape_icosphere(*state, 1));
    ktg_arrange_goal goal = {
        .half = {1, 1.5}, .tabs = &wish, .work = SEVERAL_STARTS(one.dual->face_count)};
    assert_int_equal(ktg_arrange(*state, one.dual, &goal, &one.search, one.tree), KTG_OK);
    for (uint32_t threads = 2; threads < 6; threads += 3) {
        fixture several = start(*state, shape_icosphere(*state, 1));
        ktg_context_set_threads(*state, threads);
        assert_int_equal(ktg_arrange(*state, several.dual, &goal, &several.search, several.tree),
                         KTG_OK);
        ktg_context_set_threads(*state, 1);
        assert_memory_equal(one.tree, several.tree, one.dual->edge_count * sizeof *one.tree);
        drop(&several);
    }
    drop(&one);
}

/* The spread of a tree on a sheet of that size. */
static double spread_of(ktg_context *context, const fixture *f, ktg_vec2 half) {
    ktg_arrangement *a;
    ktg_spread spread;
    assert_int_equal(ktg_arrangement_new(context, f->dual, f->tree, half, &a), KTG_OK);
    assert_int_equal(ktg_spread_new(context, a, half, &spread), KTG_OK);
    assert_int_equal(ktg_spread_pose(context, a, &spread), KTG_OK);
    assert_int_equal(slow_conflicts(a, KTG_OVERLAP_DEPTH), 0);
    double total = spread.total;
    ktg_spread_free(&spread);
    ktg_arrangement_free(&a);
    return total;
}

static void annealing_makes_compact_and_keeps_free_of_overlaps(void **state) {
    for (int tabs = 0; tabs < 2; tabs++) {
        fixture f = start(*state, shape_knot(*state, 40, 8)), again;
        double side = sqrt(ktg_dual_area(f.dual) / 0.4);
        ktg_vec2 half = {0.4 * side, 0.6 * side};
        double before = spread_of(*state, &f, half);
        ktg_arrange_goal goal = {.half = half, .tabs = tabs ? &wish : NULL, .work = 1500000};
        assert_int_equal(ktg_arrange(*state, f.dual, &goal, &f.search, f.tree), KTG_OK);
        assert_true(spread_of(*state, &f, half) < 0.5 * before);
        again = start(*state, shape_knot(*state, 40, 8));
        assert_int_equal(ktg_arrange(*state, again.dual, &goal, &again.search, again.tree), KTG_OK);
        assert_memory_equal(f.tree, again.tree, f.dual->edge_count * sizeof *f.tree);
        drop(&f);
        drop(&again);
    }
}

static void polygons_stay_whole(void **state) {
    fixture f = start(*state, shape_cube(*state, 6));
    ktg_arrange_goal goal = {.half = {1.5, 2}, .tabs = &wish, .work = 200000};
    assert_int_equal(ktg_arrange(*state, f.dual, &goal, &f.search, f.tree), KTG_OK);
    for (uint32_t e = 0; e < f.dual->edge_count; e++)
        assert_true(f.tree[e] || !f.dual->edges[e].rigid);
    drop(&f);
}

static void fail_each(void **state, int subdivisions, uint64_t work, uint64_t step) {
    fixture f = start(*state, shape_icosphere(*state, subdivisions));
    ktg_arrange_goal goal = {
        .half = {1, 1.5}, .tabs = &wish, .ease = 1, .short_edge = 0.1, .work = work};
    ktg_status status = KTG_MEMORY;
    for (uint64_t k = 1; status != KTG_OK; k += 1 + k / step) {
        bool *tree = ktg_copy_array(*state, f.tree, f.dual->edge_count, sizeof *tree);
        ktg_random_seed(&f.search.random, 1);
        ktg_context_fail_allocation(*state, k);
        status = ktg_arrange(*state, f.dual, &goal, &f.search, tree);
        end_short_memory(*state, status);
        assert_true(status == KTG_OK || status == KTG_MEMORY);
        ktg_free(tree);
    }
    drop(&f);
}

static void memory_may_end_anywhere(void **state) {
    fail_each(state, 1, 20000, UINT64_MAX);
    fail_each(state, 0, SEVERAL_STARTS(20), 8);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grafts_keep_the_tree_and_count_their_conflicts),
        cmocka_unit_test(branches_go_over_to_another_piece),
        cmocka_unit_test(ease_is_counted_as_branches_move),
        cmocka_unit_test(ease_brings_copies_together),
        cmocka_unit_test(any_number_of_threads_finds_the_same),
        cmocka_unit_test(annealing_makes_compact_and_keeps_free_of_overlaps),
        cmocka_unit_test(polygons_stay_whole),
        cmocka_unit_test(memory_may_end_anywhere),
    };
    return cmocka_run_group_tests(tests, make_context, drop_context);
}
