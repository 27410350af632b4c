/* Seams chosen where a surface needs them: few, symmetric, smooth, and such that panels fit. */
#include "tests/flatten/surfaces.h"
#include "tests/short_memory.h"

#include <string.h>

/* Chooses seams and slides them where that is right; every panel is within the limit. */
static ktg_seams_report choose(ktg_context *context, garment *g) {
    ktg_seams_report report;
    uint32_t panels;
    ktg_status status = ktg_seams_auto(context, g->mesh, g->adjacency, NULL, g->cut, &report);
    assert_int_equal(status, KTG_OK);
    if (report.slide > 0)
        assert_int_equal(
            ktg_seams_slide(context, g->mesh, g->adjacency, g->cut, NULL, report.slide, NULL),
            KTG_OK);
    double worst = worst_of_panels(context, g, &panels);
    assert_int_equal(report.panels, panels);
    assert_int_equal(report.panels_beyond, 0);
    /* panel by panel, without what makes seams match, a little may be beyond again */
    assert_true(worst <= 0.07 && report.worst_area_beyond <= 0.05);
    return report;
}

static void what_can_be_laid_flat_gets_no_seam(void **state) {
    surface *const surfaces[] = {plane, zigzag, cylinder, cone, shallow_cap};
    for (size_t k = 0; k < sizeof surfaces / sizeof *surfaces; k++) {
        garment g = garment_new(*state, grid_panel(*state, surfaces[k], 12));
        ktg_seams_report report = choose(*state, &g);
        assert_int_equal(report.panels, 1);
        assert_int_equal(report.darts, 0);
        assert_true(report.seam_length == 0);
        garment_drop(&g);
    }
}

static void a_tube_becomes_one_panel(void **state) {
    lattice *const points[] = {tube};
    garment g = lattices(*state, points, 1, 16);
    ktg_seams_report report = choose(*state, &g);
    assert_int_equal(report.panels, 1);
    assert_true(report.seam_length < 4.1);
    garment_drop(&g);
}

static void a_sphere_becomes_a_few_panels(void **state) {
    garment g = sphere(*state, 8);
    ktg_seams_report report = choose(*state, &g);
    assert_true(report.panels + report.darts / 4 <= 8);
    assert_true(report.mirrored);
    garment_drop(&g);
}

static void a_torus_becomes_a_few_panels(void **state) {
    lattice *const points[] = {ring};
    garment g = lattices(*state, points, 1, 24);
    ktg_seams_report report = choose(*state, &g);
    assert_true(report.panels <= 12);
    garment_drop(&g);
}

/* A net without strain; at corners a face or two may stay with the neighbour. */
static void a_cube_is_cut_along_its_creases(void **state) {
    uint32_t seams = 0, aside = 0;
    garment g = cube(*state, 4);
    ktg_seams_report report = choose(*state, &g);
    assert_true(report.panels <= 3);
    assert_true(report.worst_area_beyond < 1e-6);
    for (uint32_t e = 0; e < g.adjacency->edge_count; e++) {
        ktg_vec3 m = edge_middle(&g, e);
        int sides = (fabs(m.x) > 0.999) + (fabs(m.y) > 0.999) + (fabs(m.z) > 0.999);
        seams += g.cut[e];
        aside += g.cut[e] && sides < 2;
    }
    assert_true(seams >= 28 && aside <= 4);
    garment_drop(&g);
}

static void a_bump_gets_a_dart_or_two(void **state) {
    garment g = garment_new(*state, grid_panel(*state, one_bump, 24));
    ktg_seams_report report = choose(*state, &g);
    assert_true(report.panels <= 2);
    assert_true(report.seam_length > 0.5 && report.seam_length < 8);
    garment_drop(&g);
}

/* The nearest seam edge on the other side of x = 0. */
static double distance_from_mirrored(const garment *g, ktg_vec3 p) {
    double least = INFINITY;
    p.x = -p.x;
    for (uint32_t e = 0; e < g->adjacency->edge_count; e++)
        if (g->cut[e])
            least = fmin(least, ktg_length3(ktg_sub3(edge_middle(g, e), p)));
    return least;
}

static void what_is_symmetric_is_cut_alike_on_both_sides(void **state) {
    garment g = garment_new(*state, grid_panel(*state, two_bumps, 24));
    ktg_seams_report report = choose(*state, &g);
    assert_true(report.mirrored && report.seam_length > 0.5);
    uint32_t seams = 0, alone = 0;
    for (uint32_t e = 0; e < g.adjacency->edge_count; e++) {
        seams += g.cut[e];
        alone += g.cut[e] && distance_from_mirrored(&g, edge_middle(&g, e)) > 0.2;
    }
    assert_true(alone * 10 <= seams);
    garment_drop(&g);
}

static void given_seams_stay(void **state) {
    garment g = garment_new(*state, grid_panel(*state, two_bumps, 16));
    bool *given = calloc(g.adjacency->edge_count, sizeof *given);
    assert_non_null(given);
    for (uint32_t e = 0; e < g.adjacency->edge_count; e++) {
        ktg_vec3 a = edge_vertex(&g, e, 0), b = edge_vertex(&g, e, 1);
        given[e] = g.cut[e] = fabs(a.x - 0.5) < 1e-9 && fabs(b.x - 0.5) < 1e-9;
    }
    ktg_seams_report report;
    uint32_t panels;
    assert_int_equal(ktg_seams_auto(*state, g.mesh, g.adjacency, NULL, g.cut, &report), KTG_OK);
    for (uint32_t e = 0; e < g.adjacency->edge_count; e++)
        assert_true(g.cut[e] || !given[e]);
    assert_true(report.slide > 0 || worst_of_panels(*state, &g, &panels) <= 0.07);
    assert_int_equal(ktg_seams_slide(*state, g.mesh, g.adjacency, g.cut, given, 1, NULL), KTG_OK);
    for (uint32_t e = 0; e < g.adjacency->edge_count; e++)
        assert_true(!given[e] || fabs(edge_middle(&g, e).x - 0.5) < 1e-9);
    assert_true(worst_of_panels(*state, &g, &panels) <= 0.07 || report.slide < 1);
    assert_true(panels >= 2);
    free(given);
    garment_drop(&g);
}

/* The search liked a slit of one edge, which opens nothing, and so liked it for ever. */
static void a_slit_of_one_edge_does_not_keep_the_search_busy(void **state) {
    static const double positions[] = {1.65,  19.65, 3.9,  1.65, 20.75, 3.765, -1.65, 20.75, 3.5,
                                       -1.65, 19.65, 3.76, 1.65, 19.65, 3.5,   -1.65, 20.75, 3.9};
    static const uint32_t faces[] = {4, 1, 0, 4, 2, 1, 3, 2, 4, 1, 2, 5,
                                     3, 4, 0, 1, 3, 0, 5, 2, 3, 5, 3, 1};
    ktg_mesh *mesh;
    ktg_seams_report report;
    assert_int_equal(ktg_mesh_new(*state, positions, 6, faces, 8, &mesh), KTG_OK);
    garment g = garment_new(*state, mesh);
    assert_int_equal(ktg_seams_auto(*state, g.mesh, g.adjacency, NULL, g.cut, &report), KTG_OK);
    assert_false(report.exhausted);
    assert_int_equal(report.panels_beyond, 0);
    garment_drop(&g);
}

/* ---- slide -------------------------------------------------------------------------------- */

/* A zigzag across a flat sheet: vertices (i, 6) and (i, 7) in turns, by diagonals. */
static void a_zigzag_is_slid_straight(void **state) {
    enum { side = 12 };
    garment g = garment_new(*state, grid_panel(*state, plane, side));
    for (uint32_t e = 0; e < g.adjacency->edge_count; e++) {
        uint32_t h = g.adjacency->edge_halfedges[g.adjacency->edge_first[e]];
        uint32_t a = g.mesh->faces[h], b = g.mesh->faces[ktg_halfedge_next(h)];
        uint32_t row_a = a / (side + 1), row_b = b / (side + 1);
        bool across = row_a + row_b == 13 && (row_a == 6 || row_a == 7);
        g.cut[e] = across && a % (side + 1) != b % (side + 1);
    }
    double before = seam_length(&g), moved;
    assert_int_equal(ktg_seams_slide(*state, g.mesh, g.adjacency, g.cut, NULL, 1, &moved), KTG_OK);
    assert_true(moved > 0.05 && moved < 0.3);
    assert_true(before > 3.4 && seam_length(&g) < 3.1);
    for (uint32_t f = 0; f < g.mesh->face_count; f++) {
        const ktg_vec3 *p = g.mesh->positions;
        const uint32_t *v = g.mesh->faces + 3 * f;
        ktg_vec3 n = ktg_cross3(ktg_sub3(p[v[1]], p[v[0]]), ktg_sub3(p[v[2]], p[v[0]]));
        assert_true(n.z > 0 && fabs(p[v[0]].z) < 1e-12);
    }
    garment_drop(&g);
}

/* ---- failure ------------------------------------------------------------------------------ */

static ktg_wish stop(void *user) {
    (void)user;
    return KTG_STOP;
}

static ktg_wish finish(void *user) {
    (void)user;
    return KTG_FINISH;
}

static void the_caller_may_stop_it_or_have_it_finish(void **state) {
    garment g = sphere(*state, 6);
    ktg_seams_report report;
    ktg_context_set_cancel(*state, stop, NULL);
    assert_int_equal(ktg_seams_auto(*state, g.mesh, g.adjacency, NULL, g.cut, &report),
                     KTG_CANCELLED);
    assert_true(seam_length(&g) == 0);
    ktg_context_set_cancel(*state, finish, NULL);
    assert_int_equal(ktg_seams_auto(*state, g.mesh, g.adjacency, NULL, g.cut, &report), KTG_OK);
    ktg_context_set_cancel(*state, NULL, NULL);
    assert_true(report.exhausted && report.panels_beyond > 0);
    garment_drop(&g);
}

static void effort_is_work(void **state) {
    uint64_t work[3];
    for (int effort = KTG_EFFORT_QUICK; effort <= KTG_EFFORT_BEST; effort++) {
        garment g = sphere(*state, 6);
        ktg_seams_report report;
        ktg_seams_auto_options options;
        ktg_seams_auto_defaults(&options);
        options.effort = (ktg_effort)effort;
        assert_int_equal(ktg_seams_auto(*state, g.mesh, g.adjacency, &options, g.cut, &report),
                         KTG_OK);
        assert_true(report.panels_beyond == 0);
        work[effort] = report.work;
        garment_drop(&g);
    }
    assert_true(work[0] < work[1] && work[1] <= work[2]);
}

static void a_limit_that_makes_no_sense_is_refused(void **state) {
    garment g = garment_new(*state, grid_panel(*state, plane, 2));
    const double limits[][2] = {{0, 0.95}, {-1, 0.95}, {NAN, 0.95}, {0.05, 0}, {0.05, 1.1}};
    for (size_t k = 0; k < sizeof limits / sizeof *limits; k++) {
        ktg_seams_auto_options options;
        ktg_seams_auto_defaults(&options);
        options.max_strain = limits[k][0];
        options.area_part = limits[k][1];
        assert_int_equal(ktg_seams_auto(*state, g.mesh, g.adjacency, &options, g.cut, NULL),
                         KTG_ARGUMENT);
    }
    garment_drop(&g);
}

/* There are too many allocations to let each fail. */
static void short_memory_leaves_the_seams_as_they_were(void **state) {
    garment g = cube(*state, 2);
    for (uint32_t v = 0; v < g.mesh->vertex_count; v++)
        g.mesh->positions[v] = ktg_unit3(g.mesh->positions[v]);
    ktg_status status = KTG_MEMORY;
    for (uint64_t nth = 1; status == KTG_MEMORY; nth += 1 + nth / 8) {
        assert_true(seam_length(&g) == 0);
        ktg_context_fail_allocation(*state, nth);
        status = ktg_seams_auto(*state, g.mesh, g.adjacency, NULL, g.cut, NULL);
        end_short_memory(*state, status);
    }
    assert_int_equal(status, KTG_OK);
    assert_true(seam_length(&g) > 0);
    garment_drop(&g);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, make_context, drop_context)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(what_can_be_laid_flat_gets_no_seam),
        TEST(a_tube_becomes_one_panel),
        TEST(a_sphere_becomes_a_few_panels),
        TEST(a_torus_becomes_a_few_panels),
        TEST(a_cube_is_cut_along_its_creases),
        TEST(a_bump_gets_a_dart_or_two),
        TEST(what_is_symmetric_is_cut_alike_on_both_sides),
        TEST(given_seams_stay),
        TEST(a_slit_of_one_edge_does_not_keep_the_search_busy),
        TEST(a_zigzag_is_slid_straight),
        TEST(the_caller_may_stop_it_or_have_it_finish),
        TEST(effort_is_work),
        TEST(a_limit_that_makes_no_sense_is_refused),
        TEST(short_memory_leaves_the_seams_as_they_were),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
