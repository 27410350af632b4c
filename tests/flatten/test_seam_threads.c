/* Seams chosen by several threads are those that one chooses; also for the thread sanitizer
 * (tools/check). */
#include "tests/flatten/surfaces.h"

static void threads_change_nothing(void **state) {
    garment one = garment_new(*state, grid_panel(*state, hemisphere, 12));
    garment three = garment_new(*state, grid_panel(*state, hemisphere, 12));
    assert_int_equal(ktg_seams_auto(*state, one.mesh, one.adjacency, NULL, one.cut, NULL), KTG_OK);
    ktg_context_set_threads(*state, 3);
    assert_int_equal(ktg_seams_auto(*state, three.mesh, three.adjacency, NULL, three.cut, NULL),
                     KTG_OK);
    assert_true(seam_length(&one) > 0);
    assert_memory_equal(one.cut, three.cut, one.adjacency->edge_count);
    garment_drop(&one);
    garment_drop(&three);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(threads_change_nothing, make_context, drop_context)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
