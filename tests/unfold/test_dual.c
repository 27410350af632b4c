/* The dual graph and its spanning tree (section 4.1). */
#include "core/memory.h"
#include "core/vec.h"
#include "tests/unfold/help.h"
#include "tests/unfold/shapes.h"
#include "unfold/dual.h"

#include <stdlib.h>
#include <string.h>

static bool *tree_of(ktg_context *context, const ktg_dual *dual, double jitter, uint64_t seed) {
    bool *in_tree = ktg_new(context, dual->edge_count, bool);
    ktg_random random;
    ktg_random_seed(&random, seed);
    memset(in_tree, 1, dual->edge_count); /* every flag must be set anew */
    assert_int_equal(ktg_dual_spanning_tree(context, dual, jitter, &random, in_tree), KTG_OK);
    return in_tree;
}

static void every_inner_edge_is_a_dual_edge(void **state) {
    ktg_mesh *mesh = shape_tetrahedron(*state);
    ktg_dual *dual = scaled_dual_of(*state, mesh, 4);
    assert_int_equal(dual->face_count, 4);
    assert_int_equal(dual->vertex_count, 4);
    assert_int_equal(dual->edge_count, 6);
    for (uint32_t e = 0; e < 6; e++) {
        const ktg_dual_edge *edge = &dual->edges[e];
        assert_true(edge->halfedge[0] < edge->halfedge[1]);
        assert_int_equal(dual->halfedge_edge[edge->halfedge[0]], e);
        assert_int_equal(dual->halfedge_edge[edge->halfedge[1]], e);
        assert_int_equal(edge->vertices[0], dual->faces[edge->halfedge[0]]);
        assert_int_equal(edge->vertices[1], dual->faces[edge->halfedge[1]]);
        ktg_vec3 along =
            ktg_sub3(mesh->positions[edge->vertices[1]], mesh->positions[edge->vertices[0]]);
        assert_float_equal(edge->length, 4 * ktg_length3(along), 1e-14);
        assert_false(edge->rigid);
    }
    ktg_dual_free(&dual);
    ktg_mesh_free(&mesh);
}

static void a_border_has_no_dual_edge(void **state) {
    ktg_mesh *mesh = shape_two_triangles(*state);
    ktg_dual *dual = scaled_dual_of(*state, mesh, 1);
    assert_int_equal(dual->edge_count, 1);
    uint32_t none = 0;
    for (uint32_t h = 0; h < 6; h++)
        none += dual->halfedge_edge[h] == KTG_NONE;
    assert_int_equal(none, 4);
    ktg_dual_free(&dual);
    ktg_mesh_free(&mesh);
}

static void one_face_has_an_empty_tree(void **state) {
    ktg_mesh *mesh = shape_triangle(*state);
    ktg_dual *dual = scaled_dual_of(*state, mesh, 1);
    assert_int_equal(dual->edge_count, 0);
    ktg_free(tree_of(*state, dual, 0, 1));
    ktg_dual_free(&dual);
    ktg_mesh_free(&mesh);
}

static void only_the_faces_of_the_component_are_in_it(void **state) {
    ktg_mesh *a = shape_icosphere(*state, 0), *b = shape_tetrahedron(*state);
    ktg_mesh *both = shape_beside(*state, a, b, (ktg_vec3){3, 0, 0});
    ktg_adjacency *adjacency;
    ktg_dual *dual;
    static const uint32_t faces[] = {20, 21, 22, 23};
    assert_int_equal(ktg_adjacency_new(*state, both, &adjacency), KTG_OK);
    assert_int_equal(ktg_dual_new(*state, both, adjacency, faces, 4, 1, &dual), KTG_OK);
    assert_int_equal(dual->vertex_count, 4);
    assert_int_equal(dual->edge_count, 6);
    assert_memory_equal(dual->mesh_face, faces, sizeof faces);
    assert_memory_equal(dual->faces, b->faces, 12 * sizeof(uint32_t));
    ktg_dual_free(&dual);
    ktg_adjacency_free(&adjacency);
    ktg_mesh_free(&a);
    ktg_mesh_free(&b);
    ktg_mesh_free(&both);
}

static void flat_faces_have_the_lengths_of_the_surface(void **state) {
    ktg_mesh *mesh = shape_needle(*state, 7, 1e-7);
    ktg_dual *dual = scaled_dual_of(*state, mesh, 0.5);
    for (uint32_t f = 0; f < dual->face_count; f++) {
        ktg_vec2 sum = {0, 0};
        for (uint32_t k = 0; k < 3; k++) {
            ktg_vec2 v = dual->flat_vectors[3 * f + k];
            ktg_vec2 d = ktg_sub2(dual->flat[3 * f + (k + 1) % 3], dual->flat[3 * f + k]);
            double length = dual->lengths[3 * f + k];
            assert_float_equal(ktg_length2(v), length, 1e-14 * length);
            assert_float_equal(ktg_length2(ktg_sub2(v, d)), 0, 1e-15);
            sum = ktg_add2(sum, v);
        }
        assert_float_equal(ktg_length2(sum), 0, 1e-15);
        assert_true(ktg_cross2(dual->flat_vectors[3 * f], dual->flat_vectors[3 * f + 1]) > 0);
    }
    ktg_dual_free(&dual);
    ktg_mesh_free(&mesh);
}

static uint32_t count_rigid(const ktg_dual *dual) {
    uint32_t count = 0;
    for (uint32_t e = 0; e < dual->edge_count; e++)
        count += dual->edges[e].rigid;
    return count;
}

static void edges_inside_a_flat_polygon_are_rigid(void **state) {
    ktg_mesh *cube = shape_cube(*state, 2);
    ktg_dual *dual = scaled_dual_of(*state, cube, 1);
    assert_int_equal(count_rigid(dual), 24);
    for (uint32_t e = 0; e < dual->edge_count; e++) {
        const ktg_dual_edge *edge = &dual->edges[e];
        bool same = edge->halfedge[0] / 6 == edge->halfedge[1] / 6;
        assert_true(edge->rigid == same);
    }
    bool *in_tree = tree_of(*state, dual, 0, 1);
    for (uint32_t e = 0; e < dual->edge_count; e++)
        assert_true(in_tree[e] || !dual->edges[e].rigid);
    ktg_free(in_tree);
    ktg_dual_free(&dual);
    ktg_mesh_free(&cube);
}

static void edges_inside_a_bent_polygon_are_not_rigid(void **state) {
    ktg_mesh *cube = shape_cube(*state, 1);
    cube->positions[0].x +=
        0.001; /* three quadrangles meet here; the diagonal bends at least one */
    ktg_dual *dual = scaled_dual_of(*state, cube, 1);
    assert_true(count_rigid(dual) < 6);
    ktg_dual_free(&dual);
    for (uint32_t f = 0; f < cube->face_count; f++)
        cube->face_polygon[f] = 0; /* one polygon, but not in one plane */
    dual = scaled_dual_of(*state, cube, 1);
    assert_true(count_rigid(dual) < 6);
    ktg_dual_free(&dual);
    ktg_mesh_free(&cube);
}

/* ---- the tree
 * ----------------------------------------------------------------------------------*/

/* The tree's edges on the way between two faces; depth-first. */
static bool find_way(const ktg_dual *dual, const bool *in_tree, uint32_t from, uint32_t to,
                     uint32_t entry, uint32_t *way, uint32_t *count) {
    if (from == to)
        return true;
    for (uint32_t h = 3 * from; h < 3 * from + 3; h++) {
        uint32_t e = dual->halfedge_edge[h];
        if (e == KTG_NONE || e == entry || !in_tree[e])
            continue;
        const uint32_t *pair = dual->edges[e].halfedge;
        way[(*count)++] = e;
        if (find_way(dual, in_tree, (pair[0] == h ? pair[1] : pair[0]) / 3, to, e, way, count))
            return true;
        --*count;
    }
    return false;
}

static double weight(const ktg_dual *dual, uint32_t e) {
    double least = INFINITY, most = 0;
    for (uint32_t i = 0; i < dual->edge_count; i++) {
        least = fmin(least, dual->edges[i].length);
        most = fmax(most, dual->edges[i].length);
    }
    return dual->edges[e].rigid ? -1 : (most - dual->edges[e].length) / (most - least);
}

/* A spanning tree is minimal exactly if no edge left out weighs less than one on the way around it;
 * equal ones go by their numbers. With a jitter it may be lighter by less than that. */
static void assert_least_tree(ktg_context *context, const ktg_dual *dual, const bool *in_tree,
                              double jitter) {
    uint32_t *way = ktg_new(context, dual->edge_count, uint32_t), edges = 0;
    for (uint32_t e = 0; e < dual->edge_count; e++)
        edges += in_tree[e];
    assert_int_equal(edges, dual->face_count - 1);
    for (uint32_t e = 0; e < dual->edge_count; e++) {
        uint32_t count = 0;
        const uint32_t *ends = dual->edges[e].halfedge;
        assert_true(find_way(dual, in_tree, ends[0] / 3, ends[1] / 3, KTG_NONE, way, &count));
        for (uint32_t i = 0; i < count && !in_tree[e]; i++) {
            double on = weight(dual, way[i]), left = weight(dual, e);
            if (jitter > 0)
                assert_true(on < left + jitter);
            else
                assert_true(on < left || (on == left && way[i] < e));
        }
    }
    ktg_free(way);
}

static void the_tree_spans_and_keeps_the_longest_edges(void **state) {
    ktg_mesh *meshes[] = {shape_tetrahedron(*state), shape_bumpy_sphere(*state),
                          shape_torus(*state, 9, 6), shape_saddle(*state, 5),
                          shape_cube(*state, 3)};
    for (int i = 0; i < 5; i++) {
        ktg_dual *dual = scaled_dual_of(*state, meshes[i], 1);
        bool *in_tree = tree_of(*state, dual, 0, 1);
        assert_least_tree(*state, dual, in_tree, 0);
        ktg_free(in_tree);
        ktg_dual_free(&dual);
        ktg_mesh_free(&meshes[i]);
    }
}

static void ties_go_by_number_every_time(void **state) {
    ktg_mesh *mesh = shape_flat(*state, 8);
    ktg_dual *dual = scaled_dual_of(*state, mesh, 1);
    bool *one = tree_of(*state, dual, 0, 1), *other = tree_of(*state, dual, 0, 2);
    assert_least_tree(*state, dual, one, 0);
    assert_memory_equal(one, other, dual->edge_count);
    ktg_free(one);
    ktg_free(other);
    ktg_dual_free(&dual);
    ktg_mesh_free(&mesh);
}

static void jitter_shakes_the_weights_by_no_more_than_it_says(void **state) {
    ktg_mesh *mesh = shape_bumpy_sphere(*state);
    ktg_dual *small = scaled_dual_of(*state, mesh, 1), *large = scaled_dual_of(*state, mesh, 1024);
    bool *plain = tree_of(*state, small, 0, 1), *shaken = tree_of(*state, small, 0.3, 1);
    assert_least_tree(*state, small, shaken, 0.3);
    assert_memory_not_equal(plain, shaken, small->edge_count);
    bool *again = tree_of(*state, small, 0.3, 1), *other = tree_of(*state, small, 0.3, 2);
    assert_memory_equal(again, shaken, small->edge_count);
    assert_memory_not_equal(other, shaken, small->edge_count);
    bool *scaled = tree_of(*state, large, 0.3, 1);
    assert_memory_equal(scaled, shaken, small->edge_count);
    bool *flags[] = {plain, shaken, again, other, scaled};
    for (int i = 0; i < 5; i++)
        ktg_free(flags[i]);
    ktg_dual_free(&small);
    ktg_dual_free(&large);
    ktg_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_inner_edge_is_a_dual_edge),
        cmocka_unit_test(a_border_has_no_dual_edge),
        cmocka_unit_test(one_face_has_an_empty_tree),
        cmocka_unit_test(only_the_faces_of_the_component_are_in_it),
        cmocka_unit_test(flat_faces_have_the_lengths_of_the_surface),
        cmocka_unit_test(edges_inside_a_flat_polygon_are_rigid),
        cmocka_unit_test(edges_inside_a_bent_polygon_are_not_rigid),
        cmocka_unit_test(the_tree_spans_and_keeps_the_longest_edges),
        cmocka_unit_test(ties_go_by_number_every_time),
        cmocka_unit_test(jitter_shakes_the_weights_by_no_more_than_it_says),
    };
    return cmocka_run_group_tests(tests, make_context, drop_context);
}
