/* Cutting polygons into triangles, through files that hold one. */
#include "core/random.h"
#include "core/vec.h"
#include "read_help.h"

/* Reads one polygon with these corners, as vertices 0 .. count - 1. */
static ktg_mesh *read_polygon(fixture *f, const ktg_vec3 *corners, size_t count) {
    char *text = malloc(100 * count + 100), *at = text;
    for (size_t i = 0; i < count; i++)
        at += sprintf(at, "v %.17g %.17g %.17g\n", corners[i].x, corners[i].y, corners[i].z);
    at += sprintf(at, "f");
    for (size_t i = 0; i < count; i++)
        at += sprintf(at, " %zu", i + 1);
    ktg_mesh *mesh = read_text(f, "a.obj", text);
    free(text);
    return mesh;
}

static ktg_vec3 face_area(const ktg_mesh *mesh, uint32_t f) {
    const ktg_vec3 *p = mesh->positions;
    const uint32_t *c = mesh->faces + 3 * f;
    return ktg_mul3(ktg_cross3(ktg_sub3(p[c[1]], p[c[0]]), ktg_sub3(p[c[2]], p[c[0]])), 0.5);
}

/* Every edge of the outline appears once, the right way round; the other edges in pairs; no face is
 * turned over, so (the areas adding up) none overlaps another. */
static void assert_cut_well(const ktg_mesh *mesh, uint32_t count) {
    assert_int_equal(mesh->face_count, count - 2);
    char *seen = calloc(count, 1);
    uint32_t inner = 0;
    ktg_vec3 whole = {0, 0, 0};
    double sum = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        ktg_vec3 area = face_area(mesh, f);
        whole = ktg_add3(whole, area);
        sum += ktg_length3(area);
        assert_true(mesh->face_polygon == NULL || mesh->face_polygon[f] == 0);
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t from = mesh->faces[3 * f + k], to = mesh->faces[3 * f + (k + 1) % 3];
            if (to == (from + 1) % count)
                seen[from]++;
            else
                inner++;
        }
    }
    for (uint32_t i = 0; i < count; i++)
        assert_int_equal(seen[i], 1);
    assert_int_equal(inner, 2 * (count - 3));
    assert_true(fabs(sum - ktg_length3(whole)) <= 1e-9 * sum);
    free(seen);
}

static void check_polygon(fixture *f, const ktg_vec3 *corners, size_t count) {
    ktg_mesh *mesh = read_polygon(f, corners, count);
    assert_cut_well(mesh, (uint32_t)count);
    ktg_mesh_free(&mesh);
}

/* The vertex pair of a quadrangle's diagonal: 0 for 0-2, 1 for 1-3. */
static int diagonal(fixture *f, const ktg_vec3 corners[4]) {
    ktg_mesh *mesh = read_polygon(f, corners, 4);
    assert_int_equal(mesh->face_count, 2);
    assert_non_null(mesh->face_polygon);
    int uses[4] = {0};
    for (int i = 0; i < 6; i++)
        uses[mesh->faces[i]]++;
    int cut = uses[1] == 2;
    assert_true(uses[cut] == 2 && uses[cut + 2] == 2);
    assert_cut_well(mesh, 4);
    ktg_mesh_free(&mesh);
    return cut;
}

static void a_quadrangle_is_cut_along_its_better_diagonal(void **state) {
    fixture *f = *state;
    const struct {
        ktg_vec3 p[4];
        int cut;
    } cases[] = {
        {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 0},         /* a square: the file's order */
        {{{0, 0, 0}, {0.3, 0, 0}, {0.3, 0.1, 0}, {0, 0.1, 0}}, 0}, /* a rectangle: the same */
        {{{0, 0, 0}, {4, 0, 0}, {5, 1, 0}, {1, 1, 0}}, 1},         /* leaning: the shorter one */
        {{{0, 0, 0}, {3, -1, 0}, {6, 0, 0}, {3, 1, 0}}, 1},        /* a kite */
        {{{0, 0, 0}, {4, -1, 0}, {1, 0, 0}, {4, 1, 0}}, 0},        /* concave at 2 */
        {{{4, 1, 0}, {0, 0, 0}, {4, -1, 0}, {1, 0, 0}}, 1},        /* concave at 3 */
        {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 2, 0}}, 1},         /* straight at 1 */
        {{{1, 2, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 0},         /* straight at 2 */
        {{{0, 0, 0}, {0, 4, -1}, {0, 1, 0}, {0, 4, 1}}, 0},        /* concave in another plane */
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int exponent = -300; exponent <= 200; exponent += 100) {
            ktg_vec3 scaled[4];
            for (int k = 0; k < 4; k++)
                scaled[k] = ktg_mul3(cases[i].p[k], ldexp(1, exponent));
            if (diagonal(f, scaled) != cases[i].cut)
                fail_msg("case %zu, scale 2^%d", i, exponent);
        }
}

static void a_crossed_quadrangle_keeps_its_corners(void **state) {
    const ktg_vec3 bow[4] = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
    ktg_mesh *mesh = read_polygon(*state, bow, 4);
    assert_int_equal(mesh->face_count, 2);
    ktg_mesh_free(&mesh);
}

static void repeated_corners_are_dropped(void **state) {
    ktg_mesh *mesh =
        read_text(*state, "a.obj",
                  "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                  "f 1/1 1/2 2/2 2/2 3/3 4/4 1/1\nf 1 2 3 1\n");
    assert_int_equal(mesh->face_count, 3);
    assert_corners(mesh, 0, 0, 1, 2);
    assert_corners(mesh, 1, 0, 2, 3);
    assert_corners(mesh, 2, 0, 1, 2);
    assert_int_equal(mesh->face_polygon[0], mesh->face_polygon[1]);
    assert_int_not_equal(mesh->face_polygon[1], mesh->face_polygon[2]);
    for (int i = 0; i < 6; i++)
        assert_int_equal(mesh->face_uv[i], mesh->faces[i]);
    ktg_mesh_free(&mesh);
}

static void attributes_follow_all_triangles_of_a_polygon(void **state) {
    ktg_mesh *mesh = read_text(*state, "a.obj",
                               "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 3 0\nv 0 1 0\no a\nf 1 2 3\ng b\n"
                               "usemtl c\nf 1 2 3 4 5\nf 1 2 5\n");
    assert_int_equal(mesh->face_count, 5);
    const uint32_t polygon[] = {0, 1, 1, 1, 2}, group[] = {KTG_NONE, 0, 0, 0, 0}, object[5] = {0};
    assert_memory_equal(mesh->face_polygon, polygon, sizeof polygon);
    assert_memory_equal(mesh->face_group, group, sizeof group);
    assert_memory_equal(mesh->face_material, group, sizeof group);
    assert_memory_equal(mesh->face_object, object, sizeof object);
    ktg_mesh_free(&mesh);
}

/* A star around the origin, with random radii, in a tilted plane. */
static void concave_polygons_are_covered_exactly(void **state) {
    ktg_random random;
    ktg_random_seed(&random, 3);
    ktg_vec3 corners[200];
    for (size_t round = 0; round < 60; round++) {
        size_t count = 5 + ktg_random_below(&random, round < 40 ? 8 : 195);
        ktg_vec3 n =
            ktg_unit3((ktg_vec3){ktg_random_unit(&random) - 0.5, ktg_random_unit(&random) - 0.5,
                                 ktg_random_unit(&random)});
        ktg_vec3 u = ktg_unit3(ktg_cross3(n, (ktg_vec3){0.3, -0.2, 0.9})), v = ktg_cross3(n, u);
        for (size_t i = 0; i < count; i++) {
            double angle = 2 * KTG_PI * (double)i / (double)count;
            double radius = 0.1 + ktg_random_unit(&random);
            corners[i] = ktg_madd3(ktg_madd3(ktg_mul3(n, 7), radius * cos(angle), u),
                                   radius * sin(angle), v);
        }
        check_polygon(*state, corners, count);
    }
}

static void straight_corners_and_notches_are_cut_well(void **state) {
    const ktg_vec3 cross[] = {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {3, 1, 0}, {3, 2, 0}, {2, 2, 0},
                              {2, 3, 0}, {1, 3, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}, {1, 1, 0}};
    const ktg_vec3 straight[] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0},
                                 {3, 0, 1}, {2, 0, 1}, {1, 0, 1}, {0, 0, 1}};
    check_polygon(*state, cross, 12);
    check_polygon(*state, straight, 8);
}

/* A square with a square hole, reached over a bridge that the outline walks both ways; once with
 * the same vertices at its ends and once with others in the same places. */
static void a_hole_with_a_bridge_stays_open(void **state) {
    const char *faces[] = {"f 1 2 3 4 1 5 8 7 6 5\n", "f 1 2 3 4 9 5 8 7 6 10\n"};
    for (int i = 0; i < 2; i++) {
        char text[256] = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 3 1 0\nv 3 3 0\nv 1 3 0\n"
                         "v 0 0 0\nv 1 1 0\n";
        ktg_mesh *mesh = read_text(*state, "a.obj", strcat(text, faces[i]));
        assert_int_equal(mesh->face_count, 8);
        double sum = 0;
        for (uint32_t f = 0; f < 8; f++) {
            ktg_vec3 area = face_area(mesh, f);
            assert_true(area.z > 0);
            sum += area.z;
        }
        assert_true(fabs(sum - 12) < 1e-12);
        ktg_mesh_free(&mesh);
    }
}

static void outlines_that_cross_or_touch_themselves_become_fans(void **state) {
    const ktg_vec3 pentagram[] = {{0, 3, 0}, {2, -3, 0}, {-3, 1, 0}, {3, 1, 0}, {-2, -3, 0}};
    const ktg_vec3 touching[] = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}};
    const ktg_vec3 doubled[] = {{0, 0, 0}, {4, 0, 0}, {2, 2, 0}, {4, 4, 0}, {0, 4, 0}, {2, 2, 0}};
    const ktg_vec3 line[] = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}};
    const struct {
        const ktg_vec3 *p;
        uint32_t count;
    } cases[] = {{pentagram, 5}, {touching, 5}, {doubled, 6}, {line, 5}};
    for (size_t i = 0; i < 4; i++) {
        ktg_mesh *mesh = read_polygon(*state, cases[i].p, cases[i].count);
        assert_int_equal(mesh->face_count, cases[i].count - 2);
        for (uint32_t f = 0; f < mesh->face_count; f++)
            assert_corners(mesh, f, 0, f + 1, f + 2);
        ktg_mesh_free(&mesh);
    }
}

/* A zigzag whose long teeth lie so aslant that every edge crosses many triangles of the corners. */
static void a_slanted_comb_does_not_take_forever(void **state) {
    enum { TEETH = 20000 };
    ktg_vec3 *corners = malloc((TEETH + 2) * sizeof *corners);
    for (int i = 0; i < TEETH; i++) {
        bool right = (i % 4 == 1) || (i % 4 == 2);
        corners[i] = (ktg_vec3){right ? 1000 : 0, i / 2 + (right ? TEETH / 4 : 0), 0};
    }
    corners[TEETH] = (ktg_vec3){-10, TEETH, 0};
    corners[TEETH + 1] = (ktg_vec3){-10, -10, 0};
    ktg_mesh *mesh = read_polygon(*state, corners, TEETH + 2);
    assert_cut_well(mesh, TEETH + 2);
    ktg_mesh_free(&mesh);
    free(corners);
}

/* An outline that comes back to the same corner again and again, like petals round a centre. */
static void many_petals_do_not_take_forever(void **state) {
    enum { PETALS = 50000 };
    char *text = malloc(150 * PETALS), *at = text;
    at += sprintf(at, "v 0 0 0\n");
    for (int i = 0; i < 2 * PETALS; i++) {
        double angle = KTG_PI * i / PETALS;
        at += sprintf(at, "v %.17g %.17g 0\n", cos(angle), sin(angle));
    }
    at += sprintf(at, "f");
    for (int i = 0; i < PETALS; i++)
        at += sprintf(at, " 1 %d %d", 2 * i + 2, 2 * i + 3);
    assert_true(at < text + 150 * PETALS);
    ktg_mesh *mesh = read_text(*state, "a.obj", text);
    assert_int_equal(mesh->face_count, 3 * PETALS - 2);
    ktg_mesh_free(&mesh);
    free(text);
}

/* No corner of a triangulated convex polygon lies inside another triangle's circle. */
static void a_polygon_is_cut_by_delaunay(void **state) {
    const ktg_vec3 corners[] = {{0, 0, 0},  {10, -1, 0}, {20, 0, 0},
                                {20, 2, 0}, {11, 3, 0},  {0, 2, 0}};
    ktg_mesh *mesh = read_polygon(*state, corners, 6);
    assert_cut_well(mesh, 6);
    for (uint32_t f = 0; f < mesh->face_count; f++)
        for (uint32_t i = 0; i < 6; i++) {
            double m[3][3];
            for (int k = 0; k < 3; k++) {
                ktg_vec3 d = ktg_sub3(corners[mesh->faces[3 * f + (uint32_t)k]], corners[i]);
                m[k][0] = d.x;
                m[k][1] = d.y;
                m[k][2] = d.x * d.x + d.y * d.y;
            }
            double in = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                        m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                        m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
            assert_true(in <= 1e-6);
        }
    ktg_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        READ_TEST(a_quadrangle_is_cut_along_its_better_diagonal),
        READ_TEST(a_crossed_quadrangle_keeps_its_corners),
        READ_TEST(repeated_corners_are_dropped),
        READ_TEST(attributes_follow_all_triangles_of_a_polygon),
        READ_TEST(concave_polygons_are_covered_exactly),
        READ_TEST(straight_corners_and_notches_are_cut_well),
        READ_TEST(a_hole_with_a_bridge_stays_open),
        READ_TEST(outlines_that_cross_or_touch_themselves_become_fans),
        READ_TEST(a_slanted_comb_does_not_take_forever),
        READ_TEST(many_petals_do_not_take_forever),
        READ_TEST(a_polygon_is_cut_by_delaunay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
