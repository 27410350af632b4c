/* tests/mesh/test_simplify_uv.c - texture coordinates follow a simplification, and seams stay. */
#include "shapes.h"
#include "tests/short_memory.h"

typedef ktg_vec2 (*uv_map)(ktg_vec3 position, ktg_vec3 centre);

static ktg_vec3 centre_of(const ktg_mesh *mesh, uint32_t f) {
    ktg_vec3 sum = {0, 0, 0};
    for (uint32_t k = 0; k < 3; k++)
        sum = ktg_add3(sum, mesh->positions[mesh->faces[3 * f + k]]);
    return ktg_mul3(sum, 1.0 / 3);
}

/* Gives each corner a coordinate of its own, by its position and its face's centre; none where the
 * map says NaN. */
static void set_uvs(ktg_mesh *mesh, uv_map map) {
    mesh->uv_count = 3 * mesh->face_count;
    mesh->uvs = calloc(mesh->uv_count, sizeof *mesh->uvs);
    mesh->face_uv = calloc(mesh->uv_count, sizeof *mesh->face_uv);
    for (uint32_t h = 0; h < mesh->uv_count; h++) {
        mesh->uvs[h] = map(mesh->positions[mesh->faces[h]], centre_of(mesh, h / 3));
        mesh->face_uv[h] = isnan(mesh->uvs[h].x) ? KTG_NONE : h;
    }
}

static bool has_uv(const ktg_mesh *mesh, uint32_t f) {
    return mesh->face_uv[3 * f] != KTG_NONE;
}

static ktg_vec2 uv_of(const ktg_mesh *mesh, uint32_t h) {
    assert_true(mesh->face_uv[h] < mesh->uv_count);
    return mesh->uvs[mesh->face_uv[h]];
}

static double uv_area(const ktg_mesh *mesh, uint32_t f) {
    ktg_vec2 a = uv_of(mesh, 3 * f), b = uv_of(mesh, 3 * f + 1), c = uv_of(mesh, 3 * f + 2);
    return ktg_cross2(ktg_sub2(b, a), ktg_sub2(c, a)) / 2;
}

/* Simplifies; what must hold of any texture afterwards. */
static ktg_simplify_report simplify(void **state, ktg_mesh *mesh, uint32_t target) {
    ktg_simplify_report report;
    uint32_t none = 0, before = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++)
        before += !has_uv(mesh, f);
    OK(ktg_mesh_simplify(context_of(state), mesh, target, &report));
    assert_oriented_manifold(state, mesh);
    assert_non_null(mesh->face_uv);
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        none += !has_uv(mesh, f);
        for (uint32_t k = 0; k < 3; k++) {
            assert_int_equal(mesh->face_uv[3 * f + k] == KTG_NONE, !has_uv(mesh, f));
            if (has_uv(mesh, f))
                (void)uv_of(mesh, 3 * f + k);
        }
    }
    assert_in_range(report.faces_without_uv, none > before ? none - before : 0, none);
    return report;
}

/* ---- plates --------------------------------------------------------------------------------- */

static ktg_mesh *plate(void **state, uint32_t n) {
    builder *b = build();
    add_plate(b, n);
    return finish(state, b);
}

/* Two charts that part at x = 8, the right one mirrored. */
static ktg_vec2 two_charts(ktg_vec3 p, ktg_vec3 centre) {
    return centre.x < 8 ? (ktg_vec2){p.x, p.y} : (ktg_vec2){100 - p.x, p.y};
}

static void charts_of_a_plate_stay_exact(void **state) {
    ktg_mesh *mesh = plate(state, 16);
    set_uvs(mesh, two_charts);
    assert_int_equal(simplify(state, mesh, 8).faces_without_uv, 0);
    assert_in_range(mesh->face_count, 4, 8);
    double area[2] = {0, 0};
    for (uint32_t h = 0; h < 3 * mesh->face_count; h++) {
        ktg_vec2 uv = uv_of(mesh, h);
        ktg_vec3 p = mesh->positions[mesh->faces[h]];
        bool left = uv.x < 50;
        assert_float_equal(uv.x, left ? p.x : 100 - p.x, 1e-9);
        assert_float_equal(uv.y, p.y, 1e-9);
        area[!left] += uv_area(mesh, h / 3) / 3;
    }
    assert_float_equal(area[0], 128, 1e-9);
    assert_float_equal(area[1], -128, 1e-9);
    assert_in_range(mesh->uv_count, 8, 12); /* corners of a vertex share what they can */
    ktg_mesh_free(&mesh);
}

static ktg_vec2 one_chart(ktg_vec3 p, ktg_vec3 centre) {
    (void)centre;
    return (ktg_vec2){p.x, p.y};
}

/* On rough ground, where a line that no texture depends on would give way a little. */
static void lines_between_materials_stay_in_one_chart_too(void **state) {
    ktg_mesh *mesh = plate(state, 16);
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        mesh->positions[v].z = 0.4 * (7 * v % 5);
    set_uvs(mesh, one_chart);
    mesh->face_material = calloc(mesh->face_count, sizeof *mesh->face_material);
    for (uint32_t f = 0; f < mesh->face_count; f++)
        mesh->face_material[f] = centre_of(mesh, f).y < 4;
    assert_int_equal(simplify(state, mesh, 100).faces_without_uv, 0);
    assert_in_range(mesh->face_count, 80, 100);
    double area = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++)
        area += mesh->face_material[f] ? uv_area(mesh, f) : 0;
    assert_float_equal(area, 64, 1e-9);
    ktg_mesh_free(&mesh);
}

/* A texture of a few colours: all of a chart is one point. */
static ktg_vec2 palette(ktg_vec3 p, ktg_vec3 centre) {
    (void)p;
    return (ktg_vec2){centre.x < 6 ? 0.25 : 0.75, centre.y < 6 ? 0.25 : 0.75};
}

static void charts_may_be_points(void **state) {
    ktg_mesh *mesh = plate(state, 16);
    set_uvs(mesh, palette);
    assert_int_equal(simplify(state, mesh, 24).faces_without_uv, 0);
    assert_in_range(mesh->face_count, 8, 24);
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        ktg_vec2 wanted = palette((ktg_vec3){0, 0, 0}, centre_of(mesh, f)), uv = uv_of(mesh, 3 * f);
        assert_true(uv.x == wanted.x && uv.y == wanted.y);
    }
    ktg_mesh_free(&mesh);
}

static ktg_vec2 half(ktg_vec3 p, ktg_vec3 centre) {
    return centre.x < 8 ? (ktg_vec2){p.x, p.y} : (ktg_vec2){NAN, NAN};
}

static void faces_without_texture_stay_apart(void **state) {
    ktg_mesh *mesh = plate(state, 16);
    set_uvs(mesh, half);
    assert_int_equal(simplify(state, mesh, 8).faces_without_uv, 0);
    for (uint32_t f = 0; f < mesh->face_count; f++)
        assert_int_equal(has_uv(mesh, f), centre_of(mesh, f).x < 8);
    ktg_mesh_free(&mesh);
}

/* One chart with a slit from the border at (8, 0) to its end at (8, 8). */
static ktg_vec2 slit(ktg_vec3 p, ktg_vec3 centre) {
    return (ktg_vec2){p.x + (centre.x > 8 && p.y < 8 ? 8 - p.y : 0), p.y};
}

static void a_slit_keeps_its_length(void **state) {
    ktg_mesh *mesh = plate(state, 16);
    ktg_adjacency *a;
    set_uvs(mesh, slit);
    assert_int_equal(simplify(state, mesh, 12).faces_without_uv, 0);
    OK(ktg_adjacency_new(context_of(state), mesh, &a));
    double length = 0;
    for (uint32_t h = 0; h < a->halfedge_count; h++) {
        uint32_t t = a->twin[h], next = h % 3 == 2 ? h - 2 : h + 1;
        if (t == KTG_NONE)
            continue;
        uint32_t back = t % 3 == 2 ? t - 2 : t + 1;
        if (mesh->face_uv[h] == mesh->face_uv[back] && mesh->face_uv[next] == mesh->face_uv[t])
            continue;
        ktg_vec3 p = mesh->positions[mesh->faces[h]], q = mesh->positions[mesh->faces[next]];
        assert_true(p.x == 8 && q.x == 8);
        length += fabs(p.y - q.y) / 2;
    }
    assert_true(length == 8);
    ktg_adjacency_free(&a);
    ktg_mesh_free(&mesh);
}

/* Both halves show the same, one of them mirrored; no coordinate jumps. */
static ktg_vec2 mirrored(ktg_vec3 p, ktg_vec3 centre) {
    (void)centre;
    return (ktg_vec2){fabs(p.x - 8), p.y};
}

static void the_line_between_mirrored_halves_stays(void **state) {
    ktg_mesh *mesh = plate(state, 16);
    set_uvs(mesh, mirrored);
    assert_int_equal(simplify(state, mesh, 8).faces_without_uv, 0);
    assert_in_range(mesh->face_count, 4, 8);
    for (uint32_t h = 0; h < 3 * mesh->face_count; h++) {
        ktg_vec3 p = mesh->positions[mesh->faces[h]];
        assert_true((centre_of(mesh, h / 3).x - 8) * (p.x - 8) >= 0);
        assert_float_equal(uv_of(mesh, h).x, fabs(p.x - 8), 1e-9);
    }
    ktg_mesh_free(&mesh);
}

/* Two small charts in a large one, at (4, 4) and (12, 4). */
static ktg_vec2 specks(ktg_vec3 p, ktg_vec3 centre) {
    bool speck = centre.y > 4 && centre.y < 5 && fabs(fabs(centre.x - 8.5) - 4) < 0.5;
    return (ktg_vec2){p.x + (speck ? 100 + centre.x : 0), p.y};
}

static void charts_too_small_to_cut_out_are_given_up(void **state) {
    ktg_mesh *mesh = plate(state, 16);
    set_uvs(mesh, specks);
    ktg_simplify_report report = simplify(state, mesh, 32);
    assert_true(report.target_reached);
    assert_in_range(report.faces_without_uv, 1, 16);
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        ktg_vec3 n = {0, 0, 0};
        for (uint32_t k = 0; k < 3; k++)
            n = ktg_add3(n, ktg_cross3(mesh->positions[mesh->faces[3 * f + k]],
                                       mesh->positions[mesh->faces[3 * f + (k + 1) % 3]]));
        assert_true(n.z / 2 > 1); /* none as small as half a speck */
        for (uint32_t k = 0; k < 3 && has_uv(mesh, f); k++) {
            ktg_vec3 p = mesh->positions[mesh->faces[3 * f + k]];
            assert_float_equal(uv_of(mesh, 3 * f + k).x, p.x, 1e-9);
            assert_float_equal(uv_of(mesh, 3 * f + k).y, p.y, 1e-9);
        }
    }
    ktg_mesh_free(&mesh);
}

/* ---- round things --------------------------------------------------------------------------- */

/* A sphere as a cube blown up: six sides of n x n quadrangles. */
static ktg_mesh *ball(void **state, uint32_t n) {
    builder *b = build();
    for (uint32_t side = 0; side < 6; side++) {
        uint32_t first = b->vertex_count, w = n + 1;
        for (uint32_t i = 0; i <= n; i++)
            for (uint32_t j = 0; j <= n; j++) {
                double u = tan(KTG_PI / 4 * (2.0 * j / n - 1)),
                       v = tan(KTG_PI / 4 * (2.0 * i / n - 1));
                double c[3] = {side < 3 ? 1 : -1, side < 3 ? u : v, side < 3 ? v : u};
                double l = sqrt(1 + u * u + v * v), *p = c;
                double q[3];
                for (uint32_t k = 0; k < 3; k++)
                    q[(k + side) % 3] = round(p[k] / l * 1e9) / 1e9;
                add_point(b, q[0], q[1], q[2]);
            }
        for (uint32_t i = 0; i < n; i++)
            for (uint32_t j = 0; j < n; j++)
                add_quad(b, first + w * i + j, first + w * i + j + 1, first + w * (i + 1) + j + 1,
                         first + w * (i + 1) + j);
    }
    weld_builder(b);
    ktg_mesh *mesh = finish(state, b);
    OK(ktg_mesh_repair(context_of(state), mesh, NULL));
    return mesh;
}

static uint32_t side_of(ktg_vec3 p) {
    double c[3] = {p.x, p.y, p.z};
    uint32_t axis = 0;
    for (uint32_t k = 1; k < 3; k++)
        if (fabs(c[k]) > fabs(c[axis]))
            axis = k;
    return c[axis] > 0 ? axis : axis + 3;
}

/* The angles on the side of a cube that faces the centre; a chart is a unit square. */
static ktg_vec2 uv_on_side(ktg_vec3 p, uint32_t side) {
    double c[3] = {p.x, p.y, p.z};
    double x = c[side % 3], y = c[(side + 1) % 3], z = c[(side + 2) % 3];
    double u = atan(y / x) * 2 / KTG_PI, v = atan(z / x) * 2 / KTG_PI;
    return (ktg_vec2){2 * (side % 3) + 0.5 + (side < 3 ? u : -u), 2 * (side / 3) + 0.5 + v};
}

static ktg_vec2 six_charts(ktg_vec3 p, ktg_vec3 centre) {
    return uv_on_side(p, side_of(centre));
}

static uint32_t chart_at(ktg_vec2 uv) {
    return (uint32_t)floor(uv.x / 2) + 3 * (uint32_t)floor(uv.y / 2);
}

/* The largest distance between what a face shows at its corners, edges and centre and what the
 * sphere shows there, in parts of a chart. */
static double worst_slip(const ktg_mesh *mesh) {
    double worst = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        uint32_t chart = chart_at(ktg_mul2(
            ktg_add2(uv_of(mesh, 3 * f), ktg_add2(uv_of(mesh, 3 * f + 1), uv_of(mesh, 3 * f + 2))),
            1.0 / 3));
        for (uint32_t i = 0; i < 28; i++) {
            double w[3] = {(i % 7) / 6.0, (i / 7) / 6.0, 0};
            ktg_vec3 p = {0, 0, 0};
            ktg_vec2 uv = {0, 0};
            w[2] = 1 - w[0] - w[1];
            for (uint32_t k = 0; k < 3 && w[2] >= -1e-9; k++) {
                p = ktg_madd3(p, w[k], mesh->positions[mesh->faces[3 * f + k]]);
                uv = ktg_madd2(uv, w[k], uv_of(mesh, 3 * f + k));
            }
            if (w[2] >= -1e-9)
                worst = fmax(worst, ktg_length2(ktg_sub2(uv, uv_on_side(p, chart))));
        }
    }
    return worst;
}

static void six_charts_of_a_ball_stay_in_place(void **state) {
    ktg_mesh *mesh = ball(state, 30), *before = NULL;
    set_uvs(mesh, six_charts);
    OK(ktg_mesh_copy(context_of(state), mesh, &before));
    ktg_simplify_report report = simplify(state, mesh, 300);
    assert_true(report.target_reached);
    assert_int_equal(report.faces_without_uv, 0);
    double area[6] = {0}, distance;
    bool turned = uv_area(before, 0) < 0;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        uint32_t chart = chart_at(uv_of(mesh, 3 * f));
        for (uint32_t k = 1; k < 3; k++)
            assert_int_equal(chart_at(uv_of(mesh, 3 * f + k)), chart);
        assert_true(uv_area(mesh, f) != 0 && (uv_area(mesh, f) < 0) == turned);
        area[chart] += fabs(uv_area(mesh, f));
    }
    for (int i = 0; i < 6; i++)
        assert_true(fabs(area[i] - 1) < 0.02);
    assert_true(worst_slip(mesh) < 0.05);
    OK(ktg_mesh_hausdorff(context_of(state), before, mesh, 0, &distance));
    assert_true(distance < 0.05);
    ktg_mesh_free(&mesh);
    ktg_mesh_free(&before);
}

/* Longitude and latitude; each face at a pole sees another point of the texture there. */
static ktg_vec2 globe(ktg_vec3 p, ktg_vec3 centre) {
    double turn = atan2(centre.y, centre.x), own = atan2(p.y, p.x);
    if (hypot(p.x, p.y) < 1e-9)
        own = turn;
    while (own < turn - KTG_PI)
        own += 2 * KTG_PI;
    while (own > turn + KTG_PI)
        own -= 2 * KTG_PI;
    return (ktg_vec2){own / KTG_PI, asin(p.z) * 2 / KTG_PI};
}

static void the_poles_of_a_globe_do_not_hold_up_the_rest(void **state) {
    builder *b = build();
    add_sphere(b, 0, 0, 0, 1, 0, 40, 80);
    ktg_mesh *mesh = finish(state, b);
    ktg_mesh *before, *plain;
    OK(ktg_mesh_copy(context_of(state), mesh, &before));
    OK(ktg_mesh_copy(context_of(state), mesh, &plain));
    OK(ktg_mesh_simplify(context_of(state), plain, 200, NULL));
    set_uvs(mesh, globe);
    ktg_simplify_report report = simplify(state, mesh, 200);
    assert_true(report.target_reached);
    assert_int_equal(report.faces_without_uv, 0);
    double area = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        assert_true(uv_area(mesh, f) > 0);
        area += uv_area(mesh, f);
    }
    assert_true(area > 3.5 && area < 4.01); /* of 2 x 2, without what the poles' faces leave out */
    double painted_far, plain_far;
    OK(ktg_mesh_hausdorff(context_of(state), mesh, before, 0.02, &painted_far));
    OK(ktg_mesh_hausdorff(context_of(state), plain, before, 0.02, &plain_far));
    assert_true(painted_far < 1.5 * plain_far);
    ktg_mesh_free(&mesh);
    ktg_mesh_free(&before);
    ktg_mesh_free(&plain);
}

/* ---- more seams than faces ------------------------------------------------------------------ */

/* Every few faces have a chart of their own. */
static ktg_vec2 scattered(ktg_vec3 p, ktg_vec3 centre) {
    double u = floor(8 * (centre.x + 2)), v = floor(8 * (centre.y + 2)),
           w = floor(8 * (centre.z + 2));
    return (ktg_vec2){p.x + 10 * u, p.y + p.z + 10 * v + 1000 * w};
}

static void the_target_outweighs_thousands_of_charts(void **state) {
    ktg_mesh *mesh = ball(state, 30);
    set_uvs(mesh, scattered);
    ktg_simplify_report report = simplify(state, mesh, 200);
    uint32_t none = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++)
        none += !has_uv(mesh, f);
    assert_true(report.target_reached);
    assert_int_equal(report.faces_without_uv, none);
    assert_in_range(none, 150, 200);
    ktg_mesh_free(&mesh);
}

static void seams_are_given_up_where_nothing_else_is_left(void **state) {
    ktg_mesh *mesh = plate(state, 16);
    set_uvs(mesh, slit);
    ktg_simplify_report report = simplify(state, mesh, 2); /* seams alone want more */
    assert_true(report.target_reached);
    assert_int_equal(mesh->face_count, 2);
    ktg_mesh_free(&mesh);
}

/* ---- the house rules ------------------------------------------------------------------------ */

static void the_same_at_every_power_of_two(void **state) {
    ktg_mesh *mesh[2];
    for (int i = 0; i < 2; i++) {
        mesh[i] = ball(state, 12);
        set_uvs(mesh[i], six_charts);
        for (uint32_t v = 0; v < mesh[i]->vertex_count; v++)
            mesh[i]->positions[v] = ktg_ldexp3(mesh[i]->positions[v], i * 200);
        (void)simplify(state, mesh[i], 100);
    }
    assert_int_equal(mesh[0]->face_count, mesh[1]->face_count);
    assert_int_equal(mesh[0]->uv_count, mesh[1]->uv_count);
    assert_memory_equal(mesh[0]->uvs, mesh[1]->uvs, mesh[0]->uv_count * sizeof *mesh[0]->uvs);
    assert_memory_equal(mesh[0]->face_uv, mesh[1]->face_uv, 12 * mesh[0]->face_count);
    ktg_mesh_free(&mesh[0]);
    ktg_mesh_free(&mesh[1]);
}

static void memory_may_run_out(void **state) {
    ktg_mesh *mesh = plate(state, 6);
    set_uvs(mesh, one_chart);
    mesh->vertex_colours = calloc(mesh->vertex_count, 3);
    ktg_status status = KTG_MEMORY;
    for (uint64_t nth = 1; status == KTG_MEMORY; nth++) {
        assert_int_equal(mesh->face_count, 72);
        assert_int_equal(mesh->uv_count, 216);
        ktg_context_fail_allocation(context_of(state), nth);
        status = ktg_mesh_simplify(context_of(state), mesh, 10, NULL);
    }
    end_short_memory(context_of(state), status);
    assert_int_equal(status, KTG_OK);
    assert_true(mesh->face_count <= 10 && mesh->uv_count < 216);
    ktg_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(charts_of_a_plate_stay_exact),
        cmocka_unit_test(lines_between_materials_stay_in_one_chart_too),
        cmocka_unit_test(charts_may_be_points),
        cmocka_unit_test(faces_without_texture_stay_apart),
        cmocka_unit_test(a_slit_keeps_its_length),
        cmocka_unit_test(the_line_between_mirrored_halves_stays),
        cmocka_unit_test(charts_too_small_to_cut_out_are_given_up),
        cmocka_unit_test(six_charts_of_a_ball_stay_in_place),
        cmocka_unit_test(the_poles_of_a_globe_do_not_hold_up_the_rest),
        cmocka_unit_test(the_target_outweighs_thousands_of_charts),
        cmocka_unit_test(seams_are_given_up_where_nothing_else_is_left),
        cmocka_unit_test(the_same_at_every_power_of_two),
        cmocka_unit_test(memory_may_run_out),
    };
    return cmocka_run_group_tests_name("mesh simplify texture", tests, start, stop);
}
