/* Regions of a surface before they become pieces, and the parts of a dual graph. */
#include "core/memory.h"
#include "core/vec.h"
#include "tests/unfold/help.h"
#include "unfold/crease.h"
#include "unfold/dual_part.h"
#include "unfold/regions.h"

#include <stdlib.h>
#include <string.h>

static double area_of(const ktg_dual *dual, uint32_t face) {
    const ktg_vec2 *p = dual->flat + 3 * (size_t)face;
    return 0.5 * ktg_cross2(ktg_sub2(p[1], p[0]), ktg_sub2(p[2], p[0]));
}

/* Faces that can be reached from `from` inside its region. */
static uint32_t count_connected(ktg_context *context, const ktg_dual *dual, const uint32_t *region,
                                uint32_t from) {
    bool *seen = ktg_new(context, dual->face_count, bool);
    uint32_t *stack = ktg_new(context, dual->face_count, uint32_t), depth = 1, count = 0;
    stack[0] = from;
    seen[from] = true;
    while (depth > 0) {
        uint32_t face = stack[--depth];
        count++;
        for (uint32_t h = 3 * face; h < 3 * face + 3; h++) {
            uint32_t e = dual->halfedge_edge[h];
            if (e == KTG_NONE)
                continue;
            const uint32_t *pair = dual->edges[e].halfedge;
            uint32_t other = (pair[0] == h ? pair[1] : pair[0]) / 3;
            if (seen[other] || region[other] != region[face])
                continue;
            seen[other] = true;
            stack[depth++] = other;
        }
    }
    ktg_free(seen);
    ktg_free(stack);
    return count;
}

/* Grows regions and checks that each is there, connected, and has at most `most` times the mean
 * area. Returns the regions. */
static uint32_t *grow(ktg_context *context, const ktg_dual *dual, uint32_t count, double most) {
    uint32_t *region = ktg_new(context, dual->face_count, uint32_t), made = 0;
    double *load = ktg_new(context, dual->face_count, double), all = 0;
    double *sums = ktg_new(context, count, double);
    uint32_t *faces = ktg_new(context, count, uint32_t), *first = ktg_new(context, count, uint32_t);
    ktg_random random;
    ktg_random_seed(&random, 1);
    for (uint32_t f = 0; f < dual->face_count; f++)
        all += load[f] = area_of(dual, f);
    assert_int_equal(ktg_regions_grow(context, dual, load, count, &random, region, &made), KTG_OK);
    assert_int_equal(made, count);
    for (uint32_t f = dual->face_count; f-- > 0;) {
        assert_true(region[f] < count);
        faces[region[f]]++;
        first[region[f]] = f;
        sums[region[f]] += load[f];
    }
    for (uint32_t r = 0; r < count; r++) {
        assert_true(faces[r] > 0);
        assert_int_equal(count_connected(context, dual, region, first[r]), faces[r]);
        assert_true(sums[r] <= most * all / count);
    }
    ktg_free(load);
    ktg_free(sums);
    ktg_free(faces);
    ktg_free(first);
    return region;
}

static void regions_are_connected_and_balanced(void **state) {
    ktg_mesh *meshes[] = {shape_icosphere(*state, 3), shape_torus(*state, 24, 12),
                          shape_bumpy_sphere(*state), shape_cylinder(*state, 20, 10)};
    for (size_t i = 0; i < 4; i++) {
        ktg_dual *dual = dual_of(*state, meshes[i]);
        for (uint32_t count = 1; count < 12; count += count)
            ktg_free(grow(*state, dual, count, 1.5));
        ktg_dual_free(&dual);
        ktg_mesh_free(&meshes[i]);
    }
}

static void every_face_can_be_a_region(void **state) {
    ktg_mesh *mesh = shape_icosphere(*state, 0);
    ktg_dual *dual = dual_of(*state, mesh);
    ktg_free(grow(*state, dual, 20, 1.001));
    ktg_dual_free(&dual);
    ktg_mesh_free(&mesh);
}

static void polygons_stay_whole(void **state) {
    ktg_mesh *mesh = shape_cube(*state, 3);
    ktg_dual *dual = dual_of(*state, mesh);
    uint32_t *region = grow(*state, dual, 4, 2);
    uint32_t rigid = 0;
    for (uint32_t e = 0; e < dual->edge_count; e++) {
        const uint32_t *pair = dual->edges[e].halfedge;
        if (dual->edges[e].rigid)
            assert_int_equal(region[pair[0] / 3], region[pair[1] / 3]);
        rigid += dual->edges[e].rigid;
    }
    assert_true(rigid > 0);
    ktg_free(region);
    ktg_dual_free(&dual);
    ktg_mesh_free(&mesh);
}

static void valleys_are_sharper_than_mountains(void **state) {
    ktg_mesh *mesh = shape_star(*state, 0.7); /* pyramids on an icosahedron */
    ktg_dual *dual = dual_of(*state, mesh);
    double mountain = 0, valley = 0;
    for (uint32_t e = 0; e < dual->edge_count; e++) {
        double angle = ktg_dual_angle(dual, &dual->edges[e]);
        double crease = ktg_dual_crease(dual, &dual->edges[e]);
        assert_true(crease >= 0 && crease <= 1);
        if (angle > 0)
            mountain = fmax(mountain, crease);
        else
            valley = fmax(valley, crease);
    }
    assert_true(mountain > 0 && valley > 0 && mountain <= 1);
    ktg_dual_free(&dual);
    ktg_mesh_free(&mesh);
}

static void a_part_keeps_edges_between_its_faces(void **state) {
    ktg_mesh *mesh = shape_icosphere(*state, 1);
    ktg_dual *dual = dual_of(*state, mesh), *part;
    uint32_t faces[] = {3, 8, 9, 10, 11, 40}, *edge_of, inner = 0;
    assert_int_equal(ktg_dual_part(*state, dual, faces, 6, &part, &edge_of), KTG_OK);
    for (uint32_t e = 0; e < dual->edge_count; e++) {
        uint32_t inside = 0;
        for (uint32_t i = 0; i < 6; i++)
            inside += dual->edges[e].halfedge[0] / 3 == faces[i] ||
                      dual->edges[e].halfedge[1] / 3 == faces[i];
        inner += inside == 2;
    }
    assert_int_equal(part->edge_count, inner);
    for (uint32_t e = 0; e < part->edge_count; e++) {
        const ktg_dual_edge *here = &part->edges[e], *there = &dual->edges[edge_of[e]];
        for (int s = 0; s < 2; s++) {
            assert_int_equal(faces[here->halfedge[s] / 3], there->halfedge[s] / 3);
            assert_int_equal(here->halfedge[s] % 3, there->halfedge[s] % 3);
            assert_int_equal(part->halfedge_edge[here->halfedge[s]], e);
        }
        assert_true(here->length == there->length);
    }
    ktg_free(edge_of);
    ktg_dual_free(&part);
    ktg_dual_free(&dual);
    ktg_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(regions_are_connected_and_balanced, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(every_face_can_be_a_region, make_context, drop_context),
        cmocka_unit_test_setup_teardown(polygons_stay_whole, make_context, drop_context),
        cmocka_unit_test_setup_teardown(valleys_are_sharper_than_mountains, make_context,
                                        drop_context),
        cmocka_unit_test_setup_teardown(a_part_keeps_edges_between_its_faces, make_context,
                                        drop_context)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
