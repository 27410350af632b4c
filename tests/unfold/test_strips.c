/* Strips (section 4.2). */
#include "core/memory.h"
#include "tests/unfold/help.h"
#include "tests/unfold/shapes.h"
#include "unfold/strips.h"

#include <string.h>

/* The tree, and what strips leave of it. */
typedef struct cutting {
    ktg_dual *dual;
    bool *tree, *strips;
} cutting;

static cutting cut_mesh(ktg_context *context, const ktg_mesh *mesh, double jitter, uint64_t seed) {
    cutting c = {.dual = dual_of(context, mesh)};
    ktg_random random;
    ktg_random_seed(&random, seed);
    c.tree = ktg_new(context, c.dual->edge_count, bool);
    assert_int_equal(ktg_dual_spanning_tree(context, c.dual, jitter, &random, c.tree), KTG_OK);
    c.strips = ktg_copy_array(context, c.tree, c.dual->edge_count, sizeof(bool));
    assert_int_equal(ktg_strips_cut(context, c.dual, c.strips), KTG_OK);
    return c;
}

static void cutting_free(cutting *c) {
    ktg_free(c->tree);
    ktg_free(c->strips);
    ktg_dual_free(&c->dual);
}

static uint32_t root_of(uint32_t *parent, uint32_t f) {
    while (parent[f] != f)
        f = parent[f];
    return f;
}

/* A longer (or equally long) edge is kept at one of the polygons a cut edge leaves. */
static bool longer_branch_stays(const cutting *c, const uint32_t *polygon, uint32_t cut) {
    for (uint32_t e = 0; e < c->dual->edge_count; e++) {
        const ktg_dual_edge *a = &c->dual->edges[e], *b = &c->dual->edges[cut];
        if (!c->strips[e] || a->rigid || a->length < b->length)
            continue;
        for (int i = 0; i < 4; i++)
            if (polygon[a->halfedge[i / 2] / 3] == polygon[b->halfedge[i % 2] / 3])
                return true;
    }
    return false;
}

static void assert_strips(ktg_context *context, const cutting *c) {
    uint32_t n = c->dual->face_count;
    uint32_t *polygon = ktg_new(context, n, uint32_t), *degree = ktg_new(context, n, uint32_t);
    for (uint32_t f = 0; f < n; f++)
        polygon[f] = f;
    for (uint32_t e = 0; e < c->dual->edge_count; e++) {
        const ktg_dual_edge *edge = &c->dual->edges[e];
        assert_true(c->tree[e] || !c->strips[e]);
        if (!edge->rigid || !c->tree[e])
            continue;
        assert_true(c->strips[e]);
        polygon[root_of(polygon, edge->halfedge[0] / 3)] = root_of(polygon, edge->halfedge[1] / 3);
    }
    for (uint32_t f = 0; f < n; f++)
        polygon[f] = root_of(polygon, f);
    for (uint32_t e = 0; e < c->dual->edge_count; e++) {
        const uint32_t *ends = c->dual->edges[e].halfedge;
        if (c->dual->edges[e].rigid || !c->tree[e])
            continue;
        if (c->strips[e]) /* part of a tree, hence a path if no polygon has a third neighbour */
            for (int i = 0; i < 2; i++)
                assert_true(++degree[polygon[ends[i] / 3]] <= 2);
        else
            assert_true(longer_branch_stays(c, polygon, e));
    }
    ktg_free(polygon);
    ktg_free(degree);
}

static void every_part_is_a_path_of_polygons(void **state) {
    ktg_mesh *meshes[] = {
        shape_triangle(*state),       shape_two_triangles(*state), shape_tetrahedron(*state),
        shape_icosphere(*state, 2),   shape_bumpy_sphere(*state),  shape_torus(*state, 12, 7),
        shape_cylinder(*state, 9, 3), shape_cube(*state, 3),       shape_star(*state, 0.5)};
    for (int i = 0; i < 9; i++) {
        for (uint64_t seed = 1; seed <= 5; seed++) {
            cutting c = cut_mesh(*state, meshes[i], seed > 1 ? 0.5 : 0, seed);
            assert_strips(*state, &c);
            cutting_free(&c);
        }
        ktg_mesh_free(&meshes[i]);
    }
}

/* Figure 4: a face with three neighbours. Its edges 0, 1, 2 are 5, 4 and 3 long, and the neighbour
 * across edge `first` is face 0, where the walk begins. */
static ktg_mesh *branching(ktg_context *context, uint32_t first) {
    static const ktg_vec3 positions[] = {{0, 0, 0},  {5, 0, 0}, {1.8, 2.4, 0},
                                         {2, -3, 0}, {5, 3, 0}, {-1, 2, 0}};
    uint32_t faces[12] = {[9] = 0, [10] = 1, [11] = 2};
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t edge = (first + k) % 3, *face = faces + 3 * k;
        face[0] = (edge + 1) % 3;
        face[1] = edge;
        face[2] = 3 + edge;
    }
    return shape_mesh(context, positions, 6, faces, 4);
}

static void where_the_way_branches_the_shorter_branch_is_cut(void **state) {
    static const uint32_t cut_edge[3] = {2, 2, 1}; /* entered through edge 0, 1, 2 */
    for (uint32_t first = 0; first < 3; first++) {
        ktg_mesh *mesh = branching(*state, first);
        cutting c = cut_mesh(*state, mesh, 0, 1);
        assert_int_equal(c.dual->edge_count, 3);
        for (uint32_t k = 0; k < 3; k++) {
            assert_true(c.tree[c.dual->halfedge_edge[9 + k]]);
            assert_true(c.strips[c.dual->halfedge_edge[9 + k]] == (k != cut_edge[first]));
        }
        cutting_free(&c);
        ktg_mesh_free(&mesh);
    }
}

static void polygons_of_the_input_stay_whole(void **state) {
    ktg_mesh *cube = shape_cube(*state, 4);
    cutting c = cut_mesh(*state, cube, 0.5, 3);
    for (uint32_t e = 0; e < c.dual->edge_count; e++)
        assert_true(c.strips[e] || !c.dual->edges[e].rigid);
    cutting_free(&c);
    ktg_mesh_free(&cube);
}

static void jitter_gives_other_strips_and_the_seed_repeats_them(void **state) {
    ktg_mesh *mesh = shape_bumpy_sphere(*state);
    cutting plain = cut_mesh(*state, mesh, 0, 1), one = cut_mesh(*state, mesh, 0.5, 1);
    cutting same = cut_mesh(*state, mesh, 0.5, 1), other = cut_mesh(*state, mesh, 0.5, 2);
    size_t size = plain.dual->edge_count * sizeof(bool);
    assert_memory_not_equal(plain.strips, one.strips, size);
    assert_memory_equal(same.strips, one.strips, size);
    assert_memory_not_equal(other.strips, one.strips, size);
    cutting_free(&plain);
    cutting_free(&one);
    cutting_free(&same);
    cutting_free(&other);
    ktg_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_part_is_a_path_of_polygons),
        cmocka_unit_test(where_the_way_branches_the_shorter_branch_is_cut),
        cmocka_unit_test(polygons_of_the_input_stay_whole),
        cmocka_unit_test(jitter_gives_other_strips_and_the_seed_repeats_them),
    };
    return cmocka_run_group_tests(tests, make_context, drop_context);
}
