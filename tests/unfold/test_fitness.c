/* The fitness of a set of patches (section 5.4). */
#include "core/memory.h"
#include "tests/unfold/help.h"
#include "unfold/fitness.h"

/* Joins the first `joins` edges that can be, and measures. */
static double fitness_of(ktg_context *context, const ktg_mesh *mesh, double scale, uint32_t joins) {
    ktg_dual *dual = scaled_dual_of(context, mesh, scale);
    ktg_patches *patches;
    ktg_row_box *boxes = ktg_new(context, dual->face_count, ktg_row_box);
    double fitness;
    assert_int_equal(ktg_patches_new(context, dual, &patches), KTG_OK);
    for (uint32_t e = 0; e < dual->edge_count && joins > 0; e++) {
        ktg_join result;
        assert_int_equal(ktg_patches_join(context, patches, e, &result), KTG_OK);
        joins -= result == KTG_JOINED;
    }
    assert_int_equal(joins, 0);
    assert_int_equal(ktg_fitness(context, patches, boxes, &fitness), KTG_OK);
    ktg_patches_free(&patches);
    ktg_free(boxes);
    ktg_dual_free(&dual);
    return fitness;
}

static void one_square_patch_that_fills_its_sheet_is_worth_minus_one(void **state) {
    ktg_mesh *square = shape_flat(*state, 1);
    assert_float_equal(fitness_of(*state, square, 1, 1), 1 - 1 - 1, 1e-12);
    ktg_mesh_free(&square);
}

static void rows_of_single_triangles_are_measured(void **state) {
    /* each half of the unit square lies on its hypotenuse at best: sqrt(2) x sqrt(1/2) or 1 x 1;
     * one above the other, as the sheet is as wide as the widest or the root of all boxes */
    ktg_mesh *square = shape_flat(*state, 1);
    assert_float_equal(fitness_of(*state, square, 1, 0), 2 - 0.5 - 0.5, 1e-12);
    ktg_mesh_free(&square);
}

static void fewer_patches_are_always_better(void **state) {
    ktg_mesh *mesh = shape_icosphere(*state, 1);
    double before = fitness_of(*state, mesh, 1, 0);
    assert_true(before > 78 && before < 80); /* 80 patches; the other terms are 0 to 1 each */
    for (uint32_t joins = 1; joins < 60; joins++) {
        double fitness = fitness_of(*state, mesh, 1, joins);
        assert_true(fitness > 78.0 - joins && fitness < 80.0 - joins);
    }
    ktg_mesh_free(&mesh);
}

static void one_large_patch_is_better_than_two_halves(void **state) {
    /* eight triangles in a row: joined as 6 + 1 + 1 or as 3 + 3 + 2, their sheets about alike */
    static const bool uneven[7] = {1, 1, 1, 1, 1, 0, 0}, even[7] = {1, 1, 0, 1, 1, 0, 1};
    ktg_vec3 positions[10];
    uint32_t faces[24];
    for (uint32_t i = 0; i < 10; i++)
        positions[i] = (ktg_vec3){0.1 * i, i % 2 ? 1 : 0, 0};
    for (uint32_t i = 0; i < 8; i++) {
        faces[3 * i] = i;
        faces[3 * i + 1] = i + (i % 2 ? 2 : 1);
        faces[3 * i + 2] = i + (i % 2 ? 1 : 2);
    }
    ktg_mesh *strip = shape_mesh(*state, positions, 10, faces, 8);
    ktg_dual *dual = dual_of(*state, strip);
    assert_int_equal(dual->edge_count, 7);
    double fitness[2];
    for (int k = 0; k < 2; k++) {
        ktg_patches *patches;
        ktg_row_box boxes[8];
        ktg_join result;
        assert_int_equal(ktg_patches_new(*state, dual, &patches), KTG_OK);
        for (uint32_t e = 0; e < 7; e++)
            if ((k ? even : uneven)[e])
                assert_int_equal(ktg_patches_join(*state, patches, e, &result), KTG_OK);
        assert_int_equal(patches->patch_count, 3);
        assert_int_equal(patches->largest, k ? 3 : 6);
        assert_int_equal(ktg_fitness(*state, patches, boxes, &fitness[k]), KTG_OK);
        ktg_patches_free(&patches);
    }
    assert_true(fitness[0] < fitness[1]);
    ktg_dual_free(&dual);
    ktg_mesh_free(&strip);
}

static void the_unit_does_not_matter(void **state) {
    ktg_mesh *mesh = shape_bumpy_sphere(*state);
    assert_true(fitness_of(*state, mesh, 1, 100) == fitness_of(*state, mesh, 1024, 100));
    ktg_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_square_patch_that_fills_its_sheet_is_worth_minus_one),
        cmocka_unit_test(rows_of_single_triangles_are_measured),
        cmocka_unit_test(fewer_patches_are_always_better),
        cmocka_unit_test(one_large_patch_is_better_than_two_halves),
        cmocka_unit_test(the_unit_does_not_matter),
    };
    return cmocka_run_group_tests(tests, make_context, drop_context);
}
