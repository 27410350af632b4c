/* A whole surface: seams from what the model says, panels with their names, both sides of a seam
 * equally long, grain and fabric. */
#include "flatten/kernel.h"
#include "tests/flatten/panels.h"
#include "tests/short_memory.h"

#include <string.h>

enum { SIDE = 12 };

static ktg_vec3 dome(double u, double v) {
    double x = 2 * u - 1, y = 2 * v - 1;
    return (ktg_vec3){x, y, 0.6 * (1 - x * x) * (1 - y * y)};
}

static void add_name(ktg_context *context, ktg_names *names, const char *text) {
    char **grown = ktg_new(context, names->count + 1, char *);
    for (uint32_t k = 0; k < names->count; k++)
        grown[k] = names->text[k];
    grown[names->count++] = ktg_copy_text(context, text, SIZE_MAX);
    ktg_free(names->text);
    names->text = grown;
}

/* The column of a grid's square that a face lies in. */
static uint32_t column_of(uint32_t face) {
    return face / 2 % SIDE;
}

/* A grid whose faces are in group "small" left of `column` and in "large" right of it. */
static ktg_mesh *in_two_groups(ktg_context *context, surface *shape, uint32_t column) {
    ktg_mesh *mesh = grid_panel(context, shape, SIDE);
    add_name(context, &mesh->groups, "small");
    add_name(context, &mesh->groups, "large");
    mesh->face_group = ktg_new(context, mesh->face_count, uint32_t);
    for (uint32_t f = 0; f < mesh->face_count; f++)
        mesh->face_group[f] = column_of(f) >= column;
    return mesh;
}

static ktg_pattern *flatten(ktg_context *context, const ktg_mesh *mesh,
                            const ktg_flatten_options *options, ktg_flatten_report *report) {
    ktg_pattern *pattern;
    assert_int_equal(ktg_flatten(context, mesh, "thing", options, &pattern, report), KTG_OK);
    return pattern;
}

static uint32_t count_kind(const ktg_pattern *pattern, ktg_edge_kind kind) {
    uint32_t count = 0;
    for (size_t e = 0; e < pattern->edge_count; e++)
        count += pattern->edges[e].kind == kind;
    return count;
}

/* ---- where seams are ---------------------------------------------------------------------- */

static void groups_become_panels(void **state) {
    ktg_mesh *mesh = in_two_groups(*state, plane, 5);
    ktg_flatten_report report;
    ktg_pattern *pattern = flatten(*state, mesh, NULL, &report);
    assert_int_equal(pattern->piece_count, 2);
    assert_string_equal(pattern->pieces[0].name, "small");
    assert_string_equal(pattern->pieces[1].name, "large");
    assert_int_equal(pattern->pieces[0].face_count, 2 * 5 * SIDE);
    assert_int_equal(pattern->component_count, 1);
    assert_int_equal(report.panel_count, 2);
    assert_int_equal(report.panels[1].faces, 2 * 7 * SIDE);
    assert_int_equal(report.seam_edges, SIDE);
    assert_int_equal(count_kind(pattern, KTG_EDGE_CUT), SIDE);
    assert_int_equal(count_kind(pattern, KTG_EDGE_BORDER), 4 * SIDE);
    ktg_flatten_report_free(&report);
    ktg_pattern_free(&pattern);
    ktg_flatten_options options;
    ktg_flatten_defaults(&options);
    options.seams = KTG_SEAMS_MATERIALS; /* of which there are none */
    pattern = flatten(*state, mesh, &options, NULL);
    assert_int_equal(pattern->piece_count, 1);
    assert_string_equal(pattern->pieces[0].name, "thing");
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
}

static void a_marked_edge_is_a_slit(void **state) {
    ktg_mesh *mesh = grid_panel(*state, plane, SIDE);
    const uint32_t row = SIDE + 1, edges[] = {6, 6 + row, 6 + row, 6 + 2 * row};
    assert_int_equal(ktg_mesh_mark(*state, mesh, edges, 2), KTG_OK);
    ktg_pattern *pattern = flatten(*state, mesh, NULL, NULL);
    assert_int_equal(pattern->piece_count, 1);
    assert_int_equal(count_kind(pattern, KTG_EDGE_CUT), 2);
    assert_int_equal(pattern->pieces[0].vertex_count, mesh->vertex_count + 2);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
}

/* Its two sides lie between the same two vertices: nothing would open there. */
static void a_marked_edge_that_parts_nothing_is_no_seam(void **state) {
    ktg_mesh *mesh = grid_panel(*state, plane, SIDE);
    const uint32_t row = SIDE + 1, edges[] = {6, 6 + row, 5 + 6 * row, 5 + 7 * row};
    assert_int_equal(ktg_mesh_mark(*state, mesh, edges, 2), KTG_OK);
    ktg_pattern *pattern = flatten(*state, mesh, NULL, NULL);
    assert_int_equal(pattern->piece_count, 1);
    assert_int_equal(count_kind(pattern, KTG_EDGE_CUT), 1); /* the one at the border */
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
}

/* Eight equilateral triangles around a point, slit: laid flat as they are, the last two lie on the
 * first two, corner on corner, so that no edges of the border cross. */
static void a_slit_whose_sides_pass_each_other_is_found(void **state) {
    double positions[3 * 9] = {0}, height = sqrt((sqrt(2) - 1) / 3);
    uint32_t faces[3 * 8];
    for (uint32_t k = 0; k < 8; k++) {
        positions[3 * k + 3] = cos(k * KTG_PI / 4);
        positions[3 * k + 4] = sin(k * KTG_PI / 4);
        positions[3 * k + 5] = k % 2 ? height : -height;
        faces[3 * k] = 0;
        faces[3 * k + 1] = k + 1;
        faces[3 * k + 2] = (k + 1) % 8 + 1;
    }
    ktg_mesh *mesh;
    assert_int_equal(ktg_mesh_new(*state, positions, 9, faces, 8, &mesh), KTG_OK);
    const uint32_t slit[] = {0, 1};
    assert_int_equal(ktg_mesh_mark(*state, mesh, slit, 1), KTG_OK);
    ktg_pattern *pattern;
    ktg_flatten_options options;
    ktg_flatten_defaults(&options);
    options.seams = KTG_SEAMS_MARKED; /* and no others */
    assert_int_equal(ktg_flatten(*state, mesh, "thing", &options, &pattern, NULL), KTG_GEOMETRY);
    assert_non_null(strstr(ktg_context_message(*state), "lies on itself"));
    ktg_mesh_free(&mesh);
}

static void creases_and_jumps_of_texture_are_seams_where_wanted(void **state) {
    ktg_mesh *mesh = grid_panel(*state, zigzag, SIDE);
    ktg_flatten_options options;
    ktg_flatten_defaults(&options);
    options.seams = KTG_SEAMS_CREASE;
    ktg_pattern *pattern = flatten(*state, mesh, &options, NULL);
    assert_int_equal(pattern->piece_count, 4);
    ktg_pattern_free(&pattern);
    options.crease = KTG_PI; /* it does not turn that far */
    pattern = flatten(*state, mesh, &options, NULL);
    assert_int_equal(pattern->piece_count, 1);
    ktg_pattern_free(&pattern);
    mesh->uvs = ktg_new(*state, 2 * mesh->vertex_count, ktg_vec2);
    mesh->uv_count = 2 * mesh->vertex_count;
    mesh->face_uv = ktg_new(*state, 3 * mesh->face_count, uint32_t);
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        mesh->uvs[v] = (ktg_vec2){v, 0};
        mesh->uvs[mesh->vertex_count + v] = (ktg_vec2){v, 1};
    }
    for (uint32_t h = 0; h < 3 * mesh->face_count; h++)
        mesh->face_uv[h] = mesh->faces[h] + (column_of(h / 3) >= 4 ? mesh->vertex_count : 0);
    options.seams = KTG_SEAMS_UV;
    pattern = flatten(*state, mesh, &options, NULL);
    assert_int_equal(pattern->piece_count, 2);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
}

/* ---- seams match -------------------------------------------------------------------------- */

/* The largest difference of the two sides of an edge that is sewn, measured in the pattern. */
static double edge_error(const ktg_pattern *pattern) {
    double worst = 0;
    for (size_t e = 0; e < pattern->edge_count; e++) {
        const ktg_pattern_edge *edge = &pattern->edges[e];
        double length[2];
        if (edge->kind != KTG_EDGE_CUT)
            continue;
        for (int s = 0; s < 2; s++) {
            const ktg_pattern_piece *piece = &pattern->pieces[edge->sides[s].piece];
            size_t f = 0;
            while (piece->faces[f] != edge->sides[s].face)
                f++;
            uint32_t k = edge->sides[s].corner;
            ktg_vec2 a = piece->vertices[piece->corners[3 * f + k]];
            ktg_vec2 b = piece->vertices[piece->corners[3 * f + (k + 1) % 3]];
            length[s] = ktg_length2(ktg_sub2(b, a));
        }
        worst = fmax(worst, 2 * fabs(length[0] - length[1]) / (length[0] + length[1]));
    }
    return worst;
}

static void both_sides_of_a_seam_become_equally_long(void **state) {
    ktg_mesh *mesh = in_two_groups(*state, dome, 3);
    ktg_flatten_options options;
    ktg_flatten_defaults(&options);
    for (ktg_flatten_method m = KTG_FLATTEN_ARAP; m <= KTG_FLATTEN_TWO_STEP; m++) {
        ktg_flatten_report report;
        options.method = m;
        options.match_seams = false;
        ktg_pattern *pattern = flatten(*state, mesh, &options, &report);
        double before = report.whole.arap_energy;
        assert_true(edge_error(pattern) > 0.02);
        ktg_flatten_report_free(&report);
        ktg_pattern_free(&pattern);
        options.match_seams = true;
        pattern = flatten(*state, mesh, &options, &report);
        assert_true(edge_error(pattern) <= 0.002);
        assert_true(fabs(edge_error(pattern) - report.seam_error) < 1e-12);
        assert_int_equal(report.whole.flipped_faces, 0);
        assert_true(report.whole.arap_energy < 1.5 * before + 1e-4);
        ktg_flatten_report_free(&report);
        ktg_pattern_free(&pattern);
    }
    ktg_mesh_free(&mesh);
}

static void seams_that_fit_leave_panels_alone(void **state) {
    ktg_mesh *mesh = in_two_groups(*state, dome, SIDE / 2); /* mirror images */
    ktg_flatten_options options;
    ktg_flatten_defaults(&options);
    ktg_pattern *matched = flatten(*state, mesh, &options, NULL);
    options.match_seams = false;
    ktg_pattern *free_ = flatten(*state, mesh, &options, NULL);
    for (int p = 0; p < 2; p++)
        assert_memory_equal(matched->pieces[p].vertices, free_->pieces[p].vertices,
                            free_->pieces[p].vertex_count * sizeof(ktg_vec2));
    ktg_pattern_free(&matched);
    ktg_pattern_free(&free_);
    ktg_mesh_free(&mesh);
}

/* ---- grain and fabric --------------------------------------------------------------------- */

static ktg_vec2 size_of(const ktg_pattern_piece *piece) {
    ktg_vec2 high = {0, 0}; /* its lower left corner is the origin */
    for (size_t v = 0; v < piece->vertex_count; v++)
        high = (ktg_vec2){fmax(high.x, piece->vertices[v].x), fmax(high.y, piece->vertices[v].y)};
    return high;
}

static ktg_vec3 oblong(double u, double v) {
    return (ktg_vec3){3 * u, v, 0};
}

static void grain_turns_a_panel(void **state) {
    ktg_mesh *mesh = grid_panel(*state, oblong, SIDE);
    ktg_panel_grain grain = {"thing", KTG_PI / 2};
    ktg_flatten_options options;
    ktg_flatten_defaults(&options);
    ktg_pattern *pattern = flatten(*state, mesh, &options, NULL);
    ktg_vec2 size = size_of(pattern->pieces);
    assert_true(fabs(size.x - 3) < 1e-9 && fabs(size.y - 1) < 1e-9);
    ktg_pattern_free(&pattern);
    options.grains = &grain;
    options.grain_count = 1;
    pattern = flatten(*state, mesh, &options, NULL);
    size = size_of(pattern->pieces);
    assert_true(fabs(size.x - 1) < 1e-9 && fabs(size.y - 3) < 1e-9);
    ktg_pattern_free(&pattern);
    options.grain_count = 0;
    options.up = 0; /* the model's x is upright */
    pattern = flatten(*state, mesh, &options, NULL);
    size = size_of(pattern->pieces);
    assert_true(fabs(size.x - 1) < 1e-9 && fabs(size.y - 3) < 1e-9);
    ktg_pattern_free(&pattern);
    ktg_mesh_free(&mesh);
}

/* A face whose flat piece becomes, on the model, `along` and `across` times as long, sheared. */
static bool bears(const ktg_fabric *fabric, double along, double across, double shear) {
    const ktg_vec3 positions[] = {
        {0, 0, 0}, {across, 0, 0}, {along * sin(shear), along * cos(shear), 0}};
    const uint32_t faces[] = {0, 1, 2};
    const ktg_vec2 flat[] = {{0, 0}, {1, 0}, {0, 1}};
    ktg_panel panel = {
        .vertex_count = 3, .face_count = 1, .faces = faces, .positions = (ktg_vec3 *)positions};
    ktg_face_map map = ktg_face_map_of(&panel, 0, flat);
    return ktg_fabric_bears(fabric, &map);
}

static void a_fabric_bears_what_it_says(void **state) {
    const ktg_fabric fabric = {0.1, 0.2, 0.05, 0.15, 10 * KTG_PI / 180};
    (void)state;
    assert_true(bears(&fabric, 1, 1, 0));
    assert_true(bears(&fabric, 1.09, 1.19, 0) && bears(&fabric, 0.96, 0.86, 0));
    assert_false(bears(&fabric, 1.11, 1, 0) || bears(&fabric, 1, 1.21, 0));
    assert_false(bears(&fabric, 0.94, 1, 0) || bears(&fabric, 1, 0.84, 0));
    assert_true(bears(&fabric, 1, 1, 9 * KTG_PI / 180) && bears(&fabric, 1, 1, -9 * KTG_PI / 180));
    assert_false(bears(&fabric, 1, 1, 11 * KTG_PI / 180));
}

/* The same dome wants more cuts of cloth that gives less, and each panel bears what is left. */
static void chosen_seams_suit_the_fabric(void **state) {
    static const ktg_fabric fabrics[] = {{0.3, 0.3, 0.3, 0.3, 1}, {0.02, 0.02, 0.02, 0.02, 0.04}};
    ktg_mesh *mesh = grid_panel(*state, dome, 2 * SIDE);
    ktg_flatten_options options;
    uint32_t seam_edges[2];
    ktg_flatten_defaults(&options);
    options.seams = KTG_SEAMS_AUTO;
    for (int k = 0; k < 2; k++) {
        ktg_flatten_report report;
        options.fabric = &fabrics[k];
        ktg_pattern *pattern = flatten(*state, mesh, &options, &report);
        seam_edges[k] = report.seam_edges;
        assert_int_equal(report.panels_beyond, 0);
        ktg_flatten_report_free(&report);
        ktg_pattern_free(&pattern);
    }
    assert_int_equal(seam_edges[0], 0);
    assert_true(seam_edges[1] > 0);
    ktg_mesh_free(&mesh);
}

/* ---- memory ------------------------------------------------------------------------------- */

static void every_failing_allocation_is_survived(void **state) {
    ktg_mesh *mesh = in_two_groups(*state, dome, 3);
    ktg_status status = KTG_MEMORY;
    for (uint64_t nth = 1; status == KTG_MEMORY; nth += 3) {
        ktg_pattern *pattern;
        ktg_flatten_report report;
        ktg_context_fail_allocation(*state, nth);
        status = ktg_flatten(*state, mesh, "thing", NULL, &pattern, &report);
        ktg_flatten_report_free(&report);
        ktg_pattern_free(&pattern);
        assert_true(nth < 20000);
    }
    end_short_memory(*state, status);
    assert_int_equal(status, KTG_OK);
    ktg_mesh_free(&mesh);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, make_context, drop_context)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(groups_become_panels),
        TEST(a_marked_edge_is_a_slit),
        TEST(a_marked_edge_that_parts_nothing_is_no_seam),
        TEST(a_slit_whose_sides_pass_each_other_is_found),
        TEST(creases_and_jumps_of_texture_are_seams_where_wanted),
        TEST(both_sides_of_a_seam_become_equally_long),
        TEST(seams_that_fit_leave_panels_alone),
        TEST(grain_turns_a_panel),
        TEST(a_fabric_bears_what_it_says),
        TEST(chosen_seams_suit_the_fabric),
        TEST(every_failing_allocation_is_survived),
    };
    return cmocka_run_group_tests_name("flatten/surface", tests, NULL, NULL);
}
