/* Curvature and the cut-count table (sections 3 and 5.1). */
#include "core/vec.h"
#include "tests/unfold/help.h"
#include "tests/unfold/reference.h"
#include "unfold/cut_table.h"

#include <string.h>

static void assert_needs(ktg_context *context, ktg_mesh *mesh, uint32_t *saddles) {
    ktg_dual *dual = dual_of(context, mesh);
    bool *joined = ktg_new(context, dual->edge_count, bool);
    double *sums = ktg_new(context, mesh->vertex_count, double);
    ktg_cut_table table;
    assert_int_equal(ktg_cut_table_new(context, dual, joined, &table), KTG_OK);
    reference_angle_sums(mesh, sums);
    *saddles = 0;
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        bool saddle = sums[v] > 2 * KTG_PI + 1e-7;
        if (fabs(sums[v] - 2 * KTG_PI) > 1e-7)
            assert_int_equal(table.needed[v], saddle ? 2 : 1);
        *saddles += table.needed[v] == 2;
    }
    ktg_cut_table_free(&table);
    ktg_free(joined);
    ktg_free(sums);
    ktg_dual_free(&dual);
    ktg_mesh_free(&mesh);
}

static void two_are_needed_at_saddles_only(void **state) {
    uint32_t saddles;
    assert_needs(*state, shape_icosphere(*state, 1), &saddles);
    assert_int_equal(saddles, 0);
    assert_needs(*state, shape_star(*state, 0.6), &saddles);
    assert_int_equal(saddles, 12);
    assert_needs(*state, shape_torus(*state, 12, 8), &saddles);
    assert_in_range(saddles, 12, 60);
    assert_needs(*state, shape_bumpy_sphere(*state), &saddles);
    assert_in_range(saddles, 20, 140);
    assert_needs(*state, shape_saddle(*state, 6), &saddles);
    assert_int_equal(saddles, 25); /* every inner vertex, none of the border */
}

static void a_flat_vertex_needs_one_only(void **state) {
    uint32_t saddles;
    assert_needs(*state, shape_flat(*state, 16), &saddles);
    assert_int_equal(saddles, 0);
    ktg_mesh *cube = shape_cube(*state, 5);
    assert_needs(*state, shape_turned(*state, cube, 0.7, (ktg_vec3){5, 4, 3}), &saddles);
    assert_int_equal(saddles, 0);
    ktg_mesh_free(&cube);
}

/* The fans around each vertex: corners of faces, united across joined edges. */
static void count_fans(ktg_context *context, const ktg_dual *dual, const bool *joined,
                       uint32_t *fans) {
    uint32_t corners = 3 * dual->face_count;
    uint32_t *fan = ktg_new(context, corners, uint32_t);
    for (uint32_t c = 0; c < corners; c++)
        fan[c] = c;
    for (bool changed = true; changed;) {
        changed = false;
        for (uint32_t e = 0; e < dual->edge_count; e++) {
            uint32_t a = dual->edges[e].halfedge[0], b = dual->edges[e].halfedge[1];
            uint32_t a_next = a - a % 3 + (a % 3 + 1) % 3, b_next = b - b % 3 + (b % 3 + 1) % 3;
            const uint32_t pair[2][2] = {{a, b_next}, {b, a_next}};
            for (int i = 0; i < 2 && joined[e]; i++) {
                uint32_t *x = &fan[pair[i][0]], *y = &fan[pair[i][1]];
                changed = changed || *x != *y;
                *x = *y = *x < *y ? *x : *y;
            }
        }
    }
    memset(fans, 0, dual->vertex_count * sizeof *fans);
    for (uint32_t c = 0; c < corners; c++)
        fans[dual->faces[c]] += fan[c] == c;
    ktg_free(fan);
}

static void assert_sectors(ktg_context *context, ktg_mesh *mesh) {
    ktg_dual *dual = dual_of(context, mesh);
    bool *joined = ktg_new(context, dual->edge_count, bool);
    uint32_t *fans = ktg_new(context, dual->vertex_count, uint32_t);
    ktg_random random;
    ktg_cut_table table;
    ktg_random_seed(&random, 4);
    for (int round = 0; round < 4; round++) {
        /* a tree never joins a whole ring around a vertex */
        if (round > 0)
            assert_int_equal(ktg_dual_spanning_tree(context, dual, 1, &random, joined), KTG_OK);
        if (round > 1)
            for (uint32_t e = 0; e < dual->edge_count; e++)
                joined[e] = joined[e] && ktg_random_unit(&random) < 0.7;
        assert_int_equal(ktg_cut_table_new(context, dual, joined, &table), KTG_OK);
        count_fans(context, dual, joined, fans);
        assert_memory_equal(table.sectors, fans, dual->vertex_count * sizeof *fans);
        ktg_cut_table_free(&table);
    }
    ktg_free(joined);
    ktg_free(fans);
    ktg_dual_free(&dual);
    ktg_mesh_free(&mesh);
}

static void sectors_are_the_fans_around_a_vertex(void **state) {
    assert_sectors(*state, shape_tetrahedron(*state));
    assert_sectors(*state, shape_bumpy_sphere(*state));
    assert_sectors(*state, shape_torus(*state, 7, 5));
}

static void sectors_are_the_fans_on_a_border_too(void **state) {
    assert_sectors(*state, shape_triangle(*state));
    assert_sectors(*state, shape_two_triangles(*state));
    assert_sectors(*state, shape_cylinder(*state, 7, 3));
    assert_sectors(*state, shape_saddle(*state, 5));
}

static void joins_are_allowed_until_what_is_needed_is_left(void **state) {
    ktg_mesh *mesh = shape_star(*state, 0.6);
    ktg_dual *dual = dual_of(*state, mesh);
    bool *joined = ktg_new(*state, dual->edge_count, bool);
    uint32_t *fans = ktg_new(*state, dual->vertex_count, uint32_t), refused = 0;
    ktg_cut_table table;
    assert_int_equal(ktg_cut_table_new(*state, dual, joined, &table), KTG_OK);
    for (uint32_t e = 0; e < dual->edge_count; e++) {
        const ktg_dual_edge *edge = &dual->edges[e];
        bool allowed = true;
        for (int i = 0; i < 2; i++)
            allowed =
                allowed && table.sectors[edge->vertices[i]] >= 1u + table.needed[edge->vertices[i]];
        assert_true(ktg_cut_table_allows(&table, edge) == allowed);
        refused += !allowed;
        if (!allowed)
            continue;
        ktg_cut_table_join(&table, edge);
        joined[e] = true;
        count_fans(*state, dual, joined, fans);
        assert_memory_equal(table.sectors, fans, dual->vertex_count * sizeof *fans);
    }
    assert_true(refused > 0);
    for (uint32_t v = 0; v < dual->vertex_count; v++)
        assert_true(table.sectors[v] >= table.needed[v]);
    ktg_cut_table_free(&table);
    ktg_free(joined);
    ktg_free(fans);
    ktg_dual_free(&dual);
    ktg_mesh_free(&mesh);
}

static void a_border_vertex_may_be_joined_whole_unless_it_is_a_saddle(void **state) {
    /* six triangles of 60 degrees, and seven, around a vertex on the border */
    for (uint32_t count = 5; count <= 7; count++) {
        ktg_vec3 positions[9] = {{0, 0, 0}};
        uint32_t faces[21];
        for (uint32_t i = 0; i <= count; i++)
            positions[1 + i] = (ktg_vec3){cos(i * KTG_PI / 3), sin(i * KTG_PI / 3), 0.02 * i};
        for (uint32_t i = 0; i < count; i++) {
            faces[3 * i] = 0;
            faces[3 * i + 1] = 1 + i;
            faces[3 * i + 2] = 2 + i;
        }
        ktg_mesh *mesh = shape_mesh(*state, positions, count + 2, faces, count);
        ktg_dual *dual = dual_of(*state, mesh);
        bool joined[6] = {false};
        ktg_cut_table table;
        assert_int_equal(ktg_cut_table_new(*state, dual, joined, &table), KTG_OK);
        assert_int_equal(table.sectors[0], count);
        assert_int_equal(table.needed[0], count == 7 ? 2 : 1);
        for (uint32_t e = 0; e < dual->edge_count; e++) {
            bool last = count == 7 && e == 5;
            assert_true(ktg_cut_table_allows(&table, &dual->edges[e]) == !last);
            if (!last)
                ktg_cut_table_join(&table, &dual->edges[e]);
        }
        ktg_cut_table_free(&table);
        ktg_dual_free(&dual);
        ktg_mesh_free(&mesh);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_are_needed_at_saddles_only),
        cmocka_unit_test(a_flat_vertex_needs_one_only),
        cmocka_unit_test(sectors_are_the_fans_around_a_vertex),
        cmocka_unit_test(sectors_are_the_fans_on_a_border_too),
        cmocka_unit_test(joins_are_allowed_until_what_is_needed_is_left),
        cmocka_unit_test(a_border_vertex_may_be_joined_whole_unless_it_is_a_saddle),
    };
    return cmocka_run_group_tests(tests, make_context, drop_context);
}
