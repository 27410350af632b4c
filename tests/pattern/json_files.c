/* tests/pattern/json_files.c - a pattern in which everything appears that the JSON form knows, and
 * its files. */
#include "json_files.h"

#include "core/file.h"
#include "core/memory.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <unistd.h>

int setup(void **state) {
    fixture *f = calloc(1, sizeof *f);
    strcpy(f->folder, "/tmp/ktg-json-XXXXXX");
    *state = f;
    if (ktg_context_new(&f->context) != KTG_OK || !mkdtemp(f->folder))
        return -1;
    snprintf(f->path, sizeof f->path, "%s/a.json", f->folder);
    snprintf(f->other, sizeof f->other, "%s/b.json", f->folder);
    return 0;
}

int teardown(void **state) {
    fixture *f = *state;
    unlink(f->path);
    unlink(f->other);
    rmdir(f->folder);
    ktg_context_free(&f->context);
    free(f);
    return 0;
}

ktg_pattern *make_pattern(ktg_context *context) {
    ktg_pattern *p = ktg_new(context, 1, ktg_pattern);
    p->mode = KTG_PAPER;
    p->model_file = ktg_copy_text(context, "K\xc3\xa4rl \"x\"\n.obj", SIZE_MAX);
    p->model_faces = 622;
    p->mm_per_unit = 0.1;
    p->simplified = true;
    const char *const omitted[] = {"floor", "K\xc3\xa4se \"y\""};
    assert_int_equal(ktg_pattern_set_omitted(context, p, omitted, 2), KTG_OK);
    p->vertex_count = 4;
    p->face_count = 2;
    ktg_vec3 positions[4] = {
        {0, -0.0, DBL_MIN}, {1.0 / 3, 0, 1e300}, {-5e-324, 1e-17, 2}, {1, 1, 1}};
    uint32_t faces[6] = {0, 1, 2, 2, 1, 3};
    double strain[2] = {0.25, 1e-9};
    p->vertices = ktg_copy_array(context, positions, 4, sizeof *positions);
    p->faces = ktg_copy_array(context, faces, 6, sizeof *faces);
    p->face_strain = ktg_copy_array(context, strain, 2, sizeof *strain);
    p->component_count = 2;
    p->components = ktg_new(context, 2, ktg_pattern_component);
    p->components[0].name = ktg_copy_text(context, "body", SIZE_MAX);
    p->piece_count = 2;
    p->pieces = ktg_new(context, 2, ktg_pattern_piece);
    for (uint32_t i = 0; i < 2; i++) {
        ktg_pattern_piece *piece = &p->pieces[i];
        ktg_vec2 corners[3] = {{0.1, 0.2}, {acos(-1) * 1e5, 1e22}, {3, 123456789012345678.0}};
        uint32_t order[3] = {1, 2, 0};
        piece->component = 1 - i;
        piece->vertex_count = 3;
        piece->vertices = ktg_copy_array(context, corners, 3, sizeof *corners);
        piece->face_count = 1;
        piece->faces = ktg_copy_array(context, &i, 1, sizeof i);
        piece->corners = ktg_copy_array(context, order, 3, sizeof *order);
        piece->cut_count = 2 * i;
        piece->cut_mirrored = i;
        piece->twin_of = 1 - i;
        piece->on_fold = i == 1;
    }
    ktg_pattern_piece *piece = &p->pieces[1];
    piece->name = ktg_copy_text(context, "left", SIZE_MAX);
    piece->outline_count = 3;
    piece->outline = ktg_copy_array(context, piece->vertices, 3, sizeof(ktg_vec2));
    piece->tab_count = 1;
    piece->tabs = ktg_new(context, 1, ktg_pattern_tab);
    piece->tabs[0] = (ktg_pattern_tab){2, 4, {{1, 2}, {3, 4}, {5, 6}, {7, 8.5}}, KTG_TAB_REDUCED};
    piece->line_count = 1;
    piece->lines = ktg_new(context, 1, ktg_pattern_line);
    piece->lines[0].kind = KTG_LINE_NOTCH;
    piece->lines[0].point_count = 2;
    piece->lines[0].points = ktg_copy_array(context, piece->vertices, 2, sizeof(ktg_vec2));
    piece->label_count = 2;
    piece->labels = ktg_new(context, 2, ktg_pattern_label);
    piece->labels[0] = (ktg_pattern_label){"12.", {1, 2}, 0.7, 2.4, 2, true, {3, 4}};
    piece->labels[1] = (ktg_pattern_label){"left", {1, 2}, -acos(-1), 3, KTG_NONE};
    p->edge_count = 5;
    p->edges = ktg_new(context, 5, ktg_pattern_edge);
    static const uint32_t ends[5][4] = {
        {0, 1, 0, 0}, {2, 0, 0, 2}, {1, 2, 0, 1}, {1, 3, 1, 1}, {3, 2, 1, 2}};
    for (uint32_t i = 0; i < 5; i++)
        p->edges[i] = (ktg_pattern_edge){{ends[i][0], ends[i][1]},
                                         KTG_EDGE_BORDER,
                                         0,
                                         1,
                                         {{ends[i][2], ends[i][2], ends[i][3]}},
                                         -1,
                                         KTG_NONE};
    p->edges[2].kind = KTG_EDGE_CUT;
    p->edges[2].angle = acos(-1) / 4;
    p->edges[2].side_count = 2;
    p->edges[2].sides[1] = (ktg_pattern_side){1, 1, 0};
    p->edges[2].tab_on = 1;
    p->edges[2].forced = true;
    p->edges[2].seam = 0;
    p->seam_count = 1;
    p->seams = ktg_new(context, 1, ktg_pattern_seam);
    p->seams[0].edge_count = 1;
    p->seams[0].edges = ktg_copy_array(context, &(uint32_t){2}, 1, sizeof(uint32_t));
    p->seams[0].first_side = ktg_copy_array(context, &(uint8_t){1}, 1, 1);
    p->seams[0].pieces[0] = 1;
    p->seams[0].obvious = true;
    p->seams[0].dart = true;
    p->seams[0].number = 7;
    p->seams[0].section = 3;
    p->seams[0].closing = true;
    ktg_pattern_notch notches[2] = {{1.0 / 3, 1}, {0.7, 3}};
    p->seams[0].notch_count = 2;
    p->seams[0].notches = ktg_copy_array(context, notches, 2, sizeof *notches);
    p->seams[0].lengths_mm[0] = 1.0 / 7;
    p->seams[0].lengths_mm[1] = 1.0 / 7;
    p->sheet_count = 1;
    p->sheets = ktg_new(context, 1, ktg_pattern_sheet);
    p->sheets[0] = (ktg_pattern_sheet){KTG_TILE, 210, 297, {10, 10, 200, 287}, 1, NULL, 2, 0, 3};
    ktg_pattern_placement placement = {1, 12.5, 40.1, acos(-1) / 2};
    p->sheets[0].placements = ktg_copy_array(context, &placement, 1, sizeof placement);
    return p;
}

ktg_status write_to(fixture *f, const ktg_pattern *pattern, const char *path) {
    ktg_output *output = NULL;
    ktg_status status = ktg_output_open(f->context, path, &output);
    if (status != KTG_OK)
        return status;
    status = ktg_pattern_write_json(f->context, pattern, output);
    if (status == KTG_OK)
        return ktg_output_commit(f->context, &output);
    ktg_output_discard(&output);
    return status;
}

void write_bytes(const char *path, const char *bytes, size_t size) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

char *slurp(fixture *f, const char *path) {
    char *bytes = NULL;
    size_t size;
    assert_int_equal(ktg_file_read(f->context, path, 1 << 24, &bytes, &size), KTG_OK);
    return bytes;
}

void assert_same_file(fixture *f) {
    char *a = slurp(f, f->path), *b = slurp(f, f->other);
    assert_string_equal(a, b);
    ktg_free(a);
    ktg_free(b);
}
