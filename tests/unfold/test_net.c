/* The net of the transplant search: its conflicts, sides and moves against slow references. */
#include "core/memory.h"
#include "core/random.h"
#include "tests/unfold/help.h"
#include "tests/unfold/reference.h"
#include "tests/unfold/shapes.h"
#include "unfold/net.h"
#include "unfold/overlap.h"
#include "unfold/split.h"
#include "unfold/transplant.h"

#include <string.h>

/* A net of the spanning tree of a knotted tube, full of overlaps. */
typedef struct fixture {
    ktg_mesh *mesh;
    ktg_dual *dual;
    bool *tree;
    ktg_net *net;
} fixture;

static fixture start(ktg_context *context, ktg_mesh *mesh) {
    fixture f = {.mesh = mesh, .dual = dual_of(context, mesh)};
    f.tree = ktg_new(context, f.dual->edge_count, bool);
    assert_int_equal(ktg_dual_spanning_tree(context, f.dual, 0, NULL, f.tree), KTG_OK);
    assert_int_equal(ktg_net_new(context, f.dual, f.tree, &f.net), KTG_OK);
    return f;
}

static void drop(fixture *f) {
    ktg_net_free(&f->net);
    ktg_dual_free(&f->dual);
    ktg_free(f->tree);
    ktg_mesh_free(&f->mesh);
}

/* Overlapping pairs by looking at all of them. */
static size_t slow_conflicts(const ktg_net *net) {
    size_t count = 0;
    for (uint32_t a = 0; a < net->dual->face_count; a++)
        for (uint32_t b = 0; b < a; b++)
            count += ktg_triangles_overlap(net->corners + 3 * a, net->dual->lengths + 3 * a,
                                           net->corners + 3 * b, net->dual->lengths + 3 * b,
                                           KTG_OVERLAP_DEPTH);
    return count;
}

/* The folds are a tree: one fewer than faces, and every face has a way to the root. */
static void assert_tree(const ktg_net *net) {
    uint32_t folds = 0, roots = 0;
    for (uint32_t e = 0; e < net->dual->edge_count; e++)
        folds += net->folded[e];
    assert_int_equal(folds + 1, net->dual->face_count);
    for (uint32_t f = 0; f < net->dual->face_count; f++) {
        uint32_t face = f, steps = 0;
        for (; net->tree.parent_edge[face] != KTG_NONE; steps++) {
            assert_true(net->folded[net->tree.parent_edge[face]]);
            assert_in_range(steps, 0, net->dual->face_count);
            face = ktg_net_across(net, net->tree.parent_edge[face], face) / 3;
        }
        roots += steps == 0;
    }
    assert_int_equal(roots, 1);
}

/* What hangs from a face follows it in the list, in one run. */
static void assert_listed(ktg_context *context, const ktg_net *net) {
    const ktg_net_tree *tree = &net->tree;
    uint32_t n = net->dual->face_count, *below = ktg_new(context, n, uint32_t);
    for (uint32_t k = n; k-- > 0;) {
        uint32_t face = tree->order[k], parent = tree->parent[face];
        assert_int_equal(tree->place[face], k);
        assert_int_equal(++below[face], tree->below[face]);
        if (parent == KTG_NONE)
            continue;
        assert_int_equal(ktg_net_across(net, tree->parent_edge[face], face) / 3, parent);
        assert_true(k - tree->place[parent] < tree->below[parent]);
        assert_true(k + tree->below[face] <= tree->place[parent] + tree->below[parent]);
        below[parent] += below[face];
    }
    ktg_free(below);
}

/* Both faces of every fold lie on each other along it. */
static void assert_laid(const ktg_net *net) {
    for (uint32_t e = 0; e < net->dual->edge_count; e++) {
        if (!net->folded[e])
            continue;
        uint32_t a = net->dual->edges[e].halfedge[0], b = net->dual->edges[e].halfedge[1];
        ktg_vec2 from = net->corners[a], to = net->corners[a / 3 * 3 + (a % 3 + 1) % 3];
        ktg_vec2 other_to = net->corners[b], other_from = net->corners[b / 3 * 3 + (b % 3 + 1) % 3];
        assert_true(ktg_length2(ktg_sub2(from, other_from)) < 1e-12);
        assert_true(ktg_length2(ktg_sub2(to, other_to)) < 1e-12);
    }
}

static void a_fresh_net_knows_all_its_overlaps(void **state) {
    fixture f = start(*state, shape_knot(*state, 40, 8));
    assert_true(f.net->live_count > 10);
    assert_int_equal(f.net->live_count, slow_conflicts(f.net));
    assert_tree(f.net);
    assert_laid(f.net);
    drop(&f);
}

static void paths_and_sides_are_those_of_the_tree(void **state) {
    fixture f = start(*state, shape_knot(*state, 40, 8));
    uint32_t n = f.dual->face_count, *path = ktg_new(*state, n, uint32_t);
    ktg_random random;
    ktg_random_seed(&random, 3);
    for (int trial = 0; trial < 200; trial++) {
        uint32_t a = (uint32_t)ktg_random_below(&random, n);
        uint32_t b = (uint32_t)ktg_random_below(&random, n);
        uint32_t length = ktg_net_path(f.net, a, b, path);
        assert_int_equal(length == 0, a == b);
        for (uint32_t k = 0; k < length; k++) { /* each fold of the way parts the two */
            ktg_body body;
            assert_true(ktg_net_smaller_side(f.net, path[k], n, &body));
            assert_in_range(body.count, 1, n / 2);
            assert_int_not_equal(f.net->mark[a] == body.stamp, f.net->mark[b] == body.stamp);
            if (body.count > 1)
                assert_false(ktg_net_smaller_side(f.net, path[k], body.count - 1, &body));
        }
    }
    ktg_free(path);
    drop(&f);
}

static bool is_among(uint32_t edge, const uint32_t *edges, uint32_t count) {
    for (uint32_t k = 0; k < count; k++)
        if (edges[k] == edge)
            return true;
    return false;
}

static void drawn_and_near_rims_are_rims(void **state) {
    fixture f = start(*state, shape_knot(*state, 40, 8));
    uint32_t *rims = ktg_new(*state, 3 * (size_t)f.dual->face_count, uint32_t), found = 0;
    ktg_random random;
    ktg_random_seed(&random, 7);
    for (uint32_t fold = 0; fold < f.dual->edge_count; fold++) {
        if (!f.net->folded[fold])
            continue;
        ktg_body body = ktg_net_side(f.net, fold);
        uint32_t count = ktg_net_rims(f.net, &body, fold, rims);
        for (uint32_t steps = 1; steps < 20; steps++) {
            uint32_t near = ktg_net_near_rim(f.net, &body, fold, steps, steps % 2);
            uint32_t drawn = ktg_net_draw_rim(f.net, &body, fold, &random);
            assert_true(near == KTG_NONE || is_among(near, rims, count));
            assert_true(drawn == KTG_NONE || is_among(drawn, rims, count));
            found += (near != KTG_NONE) + (drawn != KTG_NONE);
        }
    }
    assert_true(found > f.dual->face_count);
    ktg_free(rims);
    drop(&f);
}

static void weights_count_and_a_guess_never_hides_a_free_place(void **state) {
    fixture f = start(*state, shape_knot(*state, 40, 8));
    uint32_t *rims = ktg_new(*state, 3 * (size_t)f.dual->face_count, uint32_t);
    for (uint32_t fold = 0; fold < f.dual->edge_count; fold++) {
        if (!f.net->folded[fold])
            continue;
        ktg_body body = ktg_net_side(f.net, fold);
        if (ktg_net_rims(f.net, &body, fold, rims) == 0)
            continue;
        ktg_motion2 motion = ktg_net_motion(f.net, &body, rims[0]);
        uint32_t now = ktg_net_conflicts_now(f.net, &body);
        uint32_t then = ktg_net_conflicts_moved(f.net, &body, &motion, 100000);
        uint32_t guess = ktg_net_conflicts_guess(f.net, &body, &motion, 3);
        assert_int_equal(guess == 0, then == 0);
        assert_true(guess > 3 || guess == then);
        for (uint32_t face = 0; face < f.dual->face_count; face++)
            f.net->weight[face] = 2;
        assert_int_equal(ktg_net_conflicts_now(f.net, &body), 5 * now);
        assert_int_equal(ktg_net_conflicts_moved(f.net, &body, &motion, 100000), 5 * then);
        memset(f.net->weight, 0, f.dual->face_count * sizeof *f.net->weight);
    }
    ktg_free(rims);
    drop(&f);
}

static void transplants_keep_the_books(void **state) {
    fixture f = start(*state, shape_knot(*state, 40, 8));
    ktg_random random;
    ktg_random_seed(&random, 5);
    int done = 0, with_root = 0;
    for (int trial = 0; trial < 100000 && done < 150; trial++) {
        uint32_t fold = (uint32_t)ktg_random_below(&random, f.dual->edge_count);
        uint32_t edge = (uint32_t)ktg_random_below(&random, f.dual->edge_count);
        ktg_body body;
        if (!f.net->folded[fold] || f.net->folded[edge] ||
            !ktg_net_smaller_side(f.net, fold, f.dual->face_count, &body))
            continue;
        const uint32_t *pair = f.dual->edges[edge].halfedge;
        if ((f.net->mark[pair[0] / 3] == body.stamp) == (f.net->mark[pair[1] / 3] == body.stamp))
            continue;
        size_t before = f.net->live_count;
        uint32_t now = ktg_net_conflicts_now(f.net, &body);
        ktg_motion2 motion = ktg_net_motion(f.net, &body, edge);
        uint32_t then = ktg_net_conflicts_moved(f.net, &body, &motion, UINT32_MAX - 1);
        assert_int_equal(ktg_net_transplant(*state, f.net, &body, fold, edge), KTG_OK);
        assert_int_equal(f.net->live_count, before - now + then);
        with_root += body.part.gap > 0;
        assert_listed(*state, f.net);
        if (done++ % 10 == 0)
            assert_int_equal(f.net->live_count, slow_conflicts(f.net));
    }
    assert_int_equal(done, 150);
    assert_true(with_root > 0); /* such bodies are two runs of the list */
    assert_tree(f.net);
    assert_laid(f.net);
    size_t live = f.net->live_count;
    assert_int_equal(ktg_net_refresh(*state, f.net), KTG_OK);
    assert_int_equal(f.net->live_count, live);
    drop(&f);
}

static void the_search_ends_without_overlaps(void **state) {
    fixture f = start(*state, shape_knot(*state, 40, 8));
    ktg_search search = {.faces_all = f.dual->face_count};
    ktg_random_seed(&search.random, 1);
    assert_int_equal(ktg_transplant_run(*state, f.net, 5000, &search), KTG_OK);
    assert_int_equal(f.net->live_count, 0);
    assert_int_equal(slow_conflicts(f.net), 0);
    assert_tree(f.net);
    assert_true(search.report.evaluations > 0);
    drop(&f);
}

static void a_split_leaves_no_two_overlapping_faces_together(void **state) {
    fixture f = start(*state, shape_knot(*state, 40, 8));
    uint32_t pieces = 0, cuts = 0, *path = ktg_new(*state, f.dual->face_count, uint32_t);
    size_t conflicts = f.net->live_count;
    assert_int_equal(ktg_split_conflicts(*state, f.net, f.tree, &pieces), KTG_OK);
    for (uint32_t e = 0; e < f.dual->edge_count; e++)
        cuts += f.net->folded[e] && !f.tree[e];
    assert_int_equal(pieces, cuts + 1);
    assert_in_range(pieces, 2, conflicts);
    for (size_t i = 0; i < conflicts; i++) {
        const uint32_t *faces = f.net->conflicts[f.net->live[i]].faces;
        uint32_t length = ktg_net_path(f.net, faces[0], faces[1], path), parted = 0;
        for (uint32_t k = 0; k < length; k++)
            parted += !f.tree[path[k]];
        assert_true(parted > 0);
    }
    ktg_free(path);
    drop(&f);
}

static void large_faces_over_tiny_ones_are_found(void **state) {
    enum { COUNT = 40 };
    double sizes[COUNT + 1];
    ktg_vec2 corners[COUNT + 1][3];
    for (int i = 0; i <= COUNT; i++) { /* sizes from 1e-9 to 1, the last one above them all */
        double size = i == COUNT ? 2 : pow(10, -9 + 9.0 * i / COUNT), x = i * 0.02;
        corners[i][0] = (ktg_vec2){x, 0};
        corners[i][1] = (ktg_vec2){x + size, 0};
        corners[i][2] = (ktg_vec2){x, size};
        sizes[i] = 1.5 * size;
    }
    ktg_net_grid grid;
    assert_int_equal(ktg_net_grid_new(*state, sizes, COUNT + 1, &grid), KTG_OK);
    for (uint32_t i = 0; i <= COUNT; i++) {
        ktg_net_box box = ktg_net_box_of(corners[i]);
        ktg_net_grid_put(&grid, i, ktg_mul2(ktg_add2(box.low, box.high), 0.5));
    }
    for (uint32_t i = 0; i <= COUNT; i++) {
        bool found[COUNT + 1] = {false};
        ktg_net_walk walk;
        assert_true(ktg_net_walk_start(&walk, &grid, corners[i]));
        for (uint32_t g; (g = ktg_net_walk_next(&walk)) != KTG_NONE;) {
            assert_false(found[g]); /* each once */
            found[g] = true;
        }
        for (uint32_t g = 0; g <= COUNT; g++)
            if (corners[g][0].x <= corners[i][1].x && corners[i][0].x <= corners[g][1].x)
                assert_true(found[g]);
    }
    ktg_net_grid_free(&grid);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_fresh_net_knows_all_its_overlaps),
        cmocka_unit_test(paths_and_sides_are_those_of_the_tree),
        cmocka_unit_test(drawn_and_near_rims_are_rims),
        cmocka_unit_test(weights_count_and_a_guess_never_hides_a_free_place),
        cmocka_unit_test(transplants_keep_the_books),
        cmocka_unit_test(the_search_ends_without_overlaps),
        cmocka_unit_test(large_faces_over_tiny_ones_are_found),
        cmocka_unit_test(a_split_leaves_no_two_overlapping_faces_together),
    };
    return cmocka_run_group_tests(tests, make_context, drop_context);
}
