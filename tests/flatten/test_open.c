/* Panels that are no disks are cut open, by as little as will do. */
#include "tests/flatten/surfaces.h"
#include "tests/short_memory.h"

static void open_and_check(ktg_context *context, garment *g, double least, double most) {
    uint32_t panels;
    assert_int_equal(ktg_seams_open(context, g->mesh, g->adjacency, g->cut), KTG_OK);
    assert_true(seam_length(g) > least && seam_length(g) < most);
    (void)worst_of_panels(context, g, &panels);
    assert_int_equal(panels, 1);
    garment_drop(g);
}

static void a_tube_is_slit_along(void **state) {
    lattice *const points[] = {tube};
    garment g = lattices(*state, points, 1, 16);
    open_and_check(*state, &g, 4 - 1e-9, 4 + 1e-9);
}

static void a_sphere_is_slit_from_end_to_end(void **state) {
    garment g = sphere(*state, 6);
    open_and_check(*state, &g, 3, 4);
}

/* A slit of one edge opens nothing; of its corners, no two are further apart. */
static void a_tetrahedron_is_slit_along_two_edges(void **state) {
    static const double positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const uint32_t faces[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    ktg_mesh *mesh;
    assert_int_equal(ktg_mesh_new(*state, positions, 4, faces, 4, &mesh), KTG_OK);
    garment g = garment_new(*state, mesh);
    open_and_check(*state, &g, 2 - 1e-9, 1 + sqrt(2) + 1e-9);
}

static void a_torus_is_cut_around_and_along(void **state) {
    lattice *const points[] = {ring};
    garment g = lattices(*state, points, 1, 20);
    /* around the tube, 2 pi, and along its inside, 4 pi */
    open_and_check(*state, &g, 17, 20);
}

static void holes_are_joined_to_the_border(void **state) {
    ktg_mesh *mesh = grid_panel(*state, plane, 12);
    uint32_t kept = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        uint32_t i = f / 2 % 12, j = f / 24;
        bool hole = j == 5 && (i == 3 || i == 8);
        for (int k = 0; k < 3 && !hole; k++)
            mesh->faces[3 * kept + k] = mesh->faces[3 * f + k];
        kept += !hole;
    }
    mesh->face_count = kept;
    garment g = garment_new(*state, mesh);
    open_and_check(*state, &g, 1.5 - 1e-9, 1.5 + 1e-9);
}

static void many_holes_are_joined_at_once(void **state) {
    ktg_mesh *mesh = grid_panel(*state, plane, 24);
    uint32_t kept = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        uint32_t i = f / 2 % 24, j = f / 48;
        bool hole = i % 4 == 2 && j % 4 == 2;
        for (int k = 0; k < 3 && !hole; k++)
            mesh->faces[3 * kept + k] = mesh->faces[3 * f + k];
        kept += !hole;
    }
    mesh->face_count = kept;
    garment g = garment_new(*state, mesh);
    open_and_check(*state, &g, 6, 16); /* 36 holes, at least 2 or 3 edges each */
}

static void a_disk_stays_whole(void **state) {
    garment g = garment_new(*state, grid_panel(*state, saddle, 6));
    open_and_check(*state, &g, -1, 1e-9);
}

static void short_memory_leaves_the_seams_as_they_were(void **state) {
    lattice *const points[] = {ring};
    garment g = lattices(*state, points, 1, 6);
    ktg_status status = KTG_MEMORY;
    uint64_t nth = 0;
    while (status == KTG_MEMORY) {
        assert_true(seam_length(&g) == 0);
        ktg_context_fail_allocation(*state, ++nth);
        status = ktg_seams_open(*state, g.mesh, g.adjacency, g.cut);
        end_short_memory(*state, status);
    }
    assert_int_equal(status, KTG_OK);
    assert_true(nth > 50 && seam_length(&g) > 0);
    garment_drop(&g);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, make_context, drop_context)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(a_tube_is_slit_along),
        TEST(a_sphere_is_slit_from_end_to_end),
        TEST(a_tetrahedron_is_slit_along_two_edges),
        TEST(a_torus_is_cut_around_and_along),
        TEST(holes_are_joined_to_the_border),
        TEST(many_holes_are_joined_at_once),
        TEST(a_disk_stays_whole),
        TEST(short_memory_leaves_the_seams_as_they_were),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
