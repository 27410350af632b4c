/* What a model looks like: materials, images, colours of its own; and on what it was simplified to.
 */
#include "folder.h"
#include "paint/look.h"
#include "tests/short_memory.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

/* A square from (0, 0) to (4, 4) that shows the whole of an image, or another material's colour. */
static const char square[] = "mtllib a.mtl\n"
                             "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 8 0 0\nv 8 4 0\n"
                             "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                             "usemtl skin\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n"
                             "usemtl plain\nf 2 5 6\nf 2 6 3\n";

/* Four dots: red and green above, blue and white below. */
static const uint8_t four[] = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};

typedef struct scene {
    ktg_mesh *mesh;
    ktg_paint *paint;
    ktg_paint_report report;
} scene;

static scene look(folder *f, const char *obj, const ktg_paint_options *options) {
    scene s = {0};
    folder_write_text(f, "a.obj", obj);
    const char *path = folder_file(f, "a.obj");
    assert_int_equal(ktg_mesh_read(f->context, path, KTG_MESH_OBJ, &s.mesh), KTG_OK);
    ktg_status status = ktg_paint_new(f->context, s.mesh, path, options, &s.paint, &s.report);
    if (status != KTG_OK)
        fail_msg("%s", ktg_context_message(f->context));
    if (s.paint)
        assert_int_equal(ktg_paint_lay(f->context, s.paint, s.mesh, 1, &s.report), KTG_OK);
    return s;
}

static void leave(scene *s) {
    ktg_paint_free(&s->paint);
    ktg_mesh_free(&s->mesh);
}

/* The colour at weights of a face's corners, of a dot so small that it is a point. */
static void expect(folder *f, const scene *s, uint32_t face, double a, double b, double c,
                   unsigned colour) {
    ktg_paint_dot dot = {.face = face, .weights = {a, b, c}, .near = KTG_NONE};
    uint8_t rgb[3];
    assert_int_equal(ktg_paint_colour(f->context, s->paint, &dot, rgb), KTG_OK);
    unsigned found = (unsigned)rgb[0] << 16 | (unsigned)rgb[1] << 8 | rgb[2];
    if (found != colour)
        fail_msg("face %u: %06x instead of %06x", face, found, colour);
}

static void an_image_stands_upright(void **state) {
    folder *f = *state;
    folder_write_png(f, "four.png", four, 2, 2);
    folder_write_text(f, "a.mtl", "newmtl skin\nmap_Kd four.png\nnewmtl plain\nKd 0.2 0.4 0.6\n");
    scene s = look(f, square, NULL);
    assert_non_null(s.paint);
    assert_int_equal(s.report.images, 1);
    assert_true(ktg_paint_is_picture(s.paint));
    expect(f, &s, 0, 0.8, 0.1, 0.1, 0x0000ff); /* lower left */
    expect(f, &s, 0, 0.1, 0.8, 0.1, 0xffffff); /* lower right */
    expect(f, &s, 0, 0.1, 0.1, 0.8, 0x00ff00); /* upper right */
    expect(f, &s, 1, 0.1, 0.1, 0.8, 0xff0000); /* upper left */
    expect(f, &s, 2, 0.3, 0.3, 0.4, 0x336699);
    leave(&s);
}

static void a_dot_beyond_an_edge_is_as_at_the_edge(void **state) {
    folder *f = *state;
    folder_write_png(f, "four.png", four, 2, 2);
    folder_write_text(f, "a.mtl", "newmtl skin\nmap_Kd four.png\nnewmtl plain\nKd 0.2 0.4 0.6\n");
    scene s = look(f, square, NULL);
    expect(f, &s, 0, 1.4, -0.2, -0.2, 0x0000ff);
    expect(f, &s, 1, -0.3, 0.1, 1.2, 0xff0000);
    leave(&s);
}

static void a_dot_is_the_mean_of_what_it_covers(void **state) {
    folder *f = *state;
    uint8_t stripes[3 * 64 * 64];
    for (size_t i = 0; i < sizeof stripes; i++)
        stripes[i] = i / 3 % 2 ? 200 : 100;
    folder_write_png(f, "stripes.png", stripes, 64, 64);
    folder_write_text(f, "a.mtl", "newmtl skin\nmap_Kd stripes.png\n");
    scene s = look(f, square, NULL);
    ktg_paint_dot dot = {.face = 0, .weights = {0.4, 0.3, 0.3}, .near = KTG_NONE};
    uint8_t rgb[3];
    dot.right[0] = -0.25; /* 16 dots of the image across */
    dot.right[1] = 0.25;
    dot.down[0] = 0.25;
    dot.down[2] = -0.25;
    assert_int_equal(ktg_paint_colour(f->context, s.paint, &dot, rgb), KTG_OK);
    assert_true(abs(rgb[0] - 150) < 3);
    leave(&s);
}

static void options_of_an_image_move_it(void **state) {
    folder *f = *state;
    folder_write_png(f, "four.png", four, 2, 2);
    folder_write_text(f, "a.mtl",
                      "newmtl skin\nKd 1 1 1\n"
                      "map_Kd -bm 1 -s 0.5 1 1 -o 0.5 0 -clamp on four.png\n");
    scene s = look(f, square, NULL);
    expect(f, &s, 0, 0.8, 0.1, 0.1, 0xffffff); /* the right half only */
    expect(f, &s, 1, 0.1, 0.1, 0.8, 0x00ff00);
    leave(&s);
}

static void names_may_have_blanks_and_several_files(void **state) {
    folder *f = *state;
    char obj[512];
    folder_write_png(f, "my four.png", four, 2, 2);
    folder_write_text(f, "my colours.mtl", "newmtl skin\r\n\tmap_Kd my four.png \r\n");
    folder_write_text(f, "b.mtl", "newmtl plain\nKd 0.2 0.4 0.6");
    snprintf(obj, sizeof obj, "mtllib my colours.mtl b.mtl%s", strchr(square, '\n'));
    scene s = look(f, obj, NULL);
    expect(f, &s, 0, 0.8, 0.1, 0.1, 0x0000ff);
    expect(f, &s, 2, 0.3, 0.3, 0.4, 0x336699);
    assert_string_equal(f->log, "");
    leave(&s);
}

/* The third one finds too little room left. */
static void many_large_images_come_in_smaller(void **state) {
    folder *f = *state;
    enum { SIDE = 8192 };
    uint8_t *grey = malloc((size_t)3 * SIDE * SIDE);
    char mtl[256];
    assert_non_null(grey);
    memset(grey, 0x55, (size_t)3 * SIDE * SIDE);
    folder_write_png(f, "grey.png", grey, SIDE, SIDE);
    free(grey);
    for (int i = 1; i < 3; i++) {
        char name[16];
        snprintf(name, sizeof name, "grey%d.png", i);
        assert_int_equal(link(folder_file(f, "grey.png"), folder_file(f, name)), 0);
    }
    snprintf(mtl, sizeof mtl,
             "newmtl a\nmap_Kd grey.png\nnewmtl b\nmap_Kd grey1.png\nnewmtl c\nmap_Kd ./grey2.png\n"
             "newmtl d\nmap_Kd ./grey.png\n");
    folder_write_text(f, "a.mtl", mtl);
    scene s = look(f,
                   "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                   "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 3/3\n"
                   "usemtl c\nf 1/1 2/2 3/3\nusemtl d\nf 1/1 2/2 3/3\n",
                   NULL);
    assert_int_equal(s.report.images, 3); /* two names of one file are one image */
    assert_int_equal(s.paint->images[1]->levels[0].width, SIDE);
    assert_int_equal(s.paint->images[2]->levels[0].width, 1024);
    for (uint32_t face = 0; face < 4; face++)
        expect(f, &s, face, 0.3, 0.3, 0.4, 0x555555);
    leave(&s);
}

static void a_missing_image_leaves_the_materials_colour(void **state) {
    folder *f = *state;
    folder_write_text(f, "a.mtl", "newmtl skin\nKd 0.2 0.4 0.6\nmap_Kd gone.png\n");
    scene s = look(f, square, NULL);
    assert_int_equal(s.report.images_missing, 1);
    assert_non_null(strstr(f->log, "gone.png is not there"));
    expect(f, &s, 0, 0.8, 0.1, 0.1, 0x336699);
    expect(f, &s, 2, 0.3, 0.3, 0.4, 0xffffff); /* nobody says */
    leave(&s);
}

static void one_colour_all_over_is_no_paint(void **state) {
    folder *f = *state;
    static const ktg_paint_options plain = {.plain = true};
    folder_write_text(f, "a.mtl", "newmtl skin\nKd 0.2 0.4 0.6\nnewmtl plain\nKd 0.2 0.4 0.6\n");
    scene s = look(f, square, NULL);
    assert_null(s.paint);
    assert_int_equal(s.report.colours, 1);
    leave(&s);
    s = look(f, square, &plain);
    expect(f, &s, 0, 0.8, 0.1, 0.1, 0x336699);
    assert_false(ktg_paint_is_picture(s.paint));
    leave(&s);
    s = look(f, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", &plain);
    assert_null(s.paint);
    leave(&s);
}

static void colours_of_vertices_blend(void **state) {
    folder *f = *state;
    scene s = look(f, "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n", NULL);
    assert_non_null(s.paint);
    assert_true(s.report.own_colours);
    expect(f, &s, 0, 1, 0, 0, 0xff0000);
    expect(f, &s, 0, 0, 0.5, 0.5, 0x008080);
    leave(&s);
}

/* A thin plate, white above and black below, and a coarser one that lies nearer to its underside.
 */
static void a_thin_part_keeps_the_colours_of_both_sides(void **state) {
    folder *f = *state;
    scene s = look(f,
                   "v 0 0 0.01 1 1 1\nv 4 0 0.01 1 1 1\nv 0 4 0.01 1 1 1\n"
                   "v 0 0 0 0 0 0\nv 4 0 0 0 0 0\nv 0 4 0 0 0 0\n"
                   "f 1 2 3\nf 4 6 5\n",
                   NULL);
    static const double corners[] = {0, 0, 0.002, 4, 0, 0.002, 0, 4, 0.002};
    static const uint32_t faces[] = {0, 1, 2, 0, 2, 1};
    ktg_mesh *coarse;
    assert_int_equal(ktg_mesh_new(f->context, corners, 3, faces, 2, &coarse), KTG_OK);
    assert_int_equal(ktg_paint_lay(f->context, s.paint, coarse, 1, &s.report), KTG_OK);
    assert_int_equal(s.report.faces_sampled, 2);
    expect(f, &s, 0, 0.3, 0.3, 0.4, 0xffffff);
    expect(f, &s, 1, 0.3, 0.3, 0.4, 0x000000);
    ktg_mesh_free(&coarse);
    leave(&s);
}

/* Just above the model's surface, without materials or coordinates. */
static ktg_mesh *bare_oblong(folder *f) {
    static const double corners[] = {0, 0, 0.1, 8, 0, 0.1, 8, 4, 0.1, 0, 4, 0.1};
    static const uint32_t faces[] = {0, 1, 2, 0, 2, 3};
    ktg_mesh *mesh;
    assert_int_equal(ktg_mesh_new(f->context, corners, 4, faces, 2, &mesh), KTG_OK);
    return mesh;
}

static void a_surface_without_coordinates_is_coloured_by_closest_point(void **state) {
    folder *f = *state;
    folder_write_png(f, "four.png", four, 2, 2);
    folder_write_text(f, "a.mtl", "newmtl skin\nmap_Kd four.png\nnewmtl plain\nKd 0.2 0.4 0.6\n");
    scene s = look(f, square, NULL);
    ktg_mesh *coarse = bare_oblong(f);
    assert_int_equal(ktg_paint_lay(f->context, s.paint, coarse, 1, &s.report), KTG_OK);
    assert_int_equal(ktg_paint_face_count(s.paint), 2);
    expect(f, &s, 0, 0.9, 0.05, 0.05, 0x0000ff);
    expect(f, &s, 1, 0.05, 0.05, 0.9, 0xff0000);
    expect(f, &s, 0, 0.05, 0.9, 0.05, 0x336699);
    coarse->face_material = calloc(2, sizeof *coarse->face_material);
    coarse->face_material[0] = 1; /* of a list that is not the model's */
    assert_int_equal(ktg_paint_lay(f->context, s.paint, coarse, 1, &s.report), KTG_OK);
    assert_int_equal(s.report.faces_sampled, 2);
    expect(f, &s, 0, 0.9, 0.05, 0.05, 0x0000ff);
    ktg_mesh_free(&coarse);
    leave(&s);
}

static void memory_that_runs_out_is_told(void **state) {
    folder *f = *state;
    ktg_status status = KTG_MEMORY;
    ktg_paint *paint = NULL;
    ktg_mesh *mesh, *bare = bare_oblong(f);
    size_t failures = 0;
    folder_write_png(f, "four.png", four, 2, 2);
    folder_write_text(f, "a.mtl", "newmtl skin\nmap_Kd four.png\nnewmtl plain\nKd 0.2 0.4 0.6\n");
    folder_write_text(f, "a.obj", square);
    const char *path = folder_file(f, "a.obj");
    assert_int_equal(ktg_mesh_read(f->context, path, KTG_MESH_OBJ, &mesh), KTG_OK);
    for (uint64_t k = 1; status == KTG_MEMORY; k++, failures++) {
        ktg_context_fail_allocation(f->context, k);
        status = ktg_paint_new(f->context, mesh, path, NULL, &paint, NULL);
        if (status == KTG_OK)
            status = ktg_paint_lay(f->context, paint, mesh, 1, NULL);
        if (status == KTG_OK)
            status = ktg_paint_lay(f->context, paint, bare, 1, NULL);
        end_short_memory(f->context, status);
        assert_true(status == KTG_OK || status == KTG_MEMORY);
        ktg_paint_free(&paint);
    }
    assert_true(failures > 30);
    ktg_mesh_free(&mesh);
    ktg_mesh_free(&bare);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(an_image_stands_upright, folder_begin, folder_end),
        cmocka_unit_test_setup_teardown(a_dot_beyond_an_edge_is_as_at_the_edge, folder_begin,
                                        folder_end),
        cmocka_unit_test_setup_teardown(a_dot_is_the_mean_of_what_it_covers, folder_begin,
                                        folder_end),
        cmocka_unit_test_setup_teardown(options_of_an_image_move_it, folder_begin, folder_end),
        cmocka_unit_test_setup_teardown(names_may_have_blanks_and_several_files, folder_begin,
                                        folder_end),
        cmocka_unit_test_setup_teardown(many_large_images_come_in_smaller, folder_begin,
                                        folder_end),
        cmocka_unit_test_setup_teardown(a_missing_image_leaves_the_materials_colour, folder_begin,
                                        folder_end),
        cmocka_unit_test_setup_teardown(one_colour_all_over_is_no_paint, folder_begin, folder_end),
        cmocka_unit_test_setup_teardown(colours_of_vertices_blend, folder_begin, folder_end),
        cmocka_unit_test_setup_teardown(a_thin_part_keeps_the_colours_of_both_sides, folder_begin,
                                        folder_end),
        cmocka_unit_test_setup_teardown(a_surface_without_coordinates_is_coloured_by_closest_point,
                                        folder_begin, folder_end),
        cmocka_unit_test_setup_teardown(memory_that_runs_out_is_told, folder_begin, folder_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
