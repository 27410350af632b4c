/* The pattern's JSON form: there and back, and everything a file can get wrong. */
#include "core/file.h"
#include "core/memory.h"
#include "pattern/pattern.h"

#include <float.h>
#include <jansson.h>
#include <locale.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

typedef struct fixture {
    ktg_context *context;
    char folder[32], path[64], other[64];
} fixture;

static int setup(void **state) {
    fixture *f = calloc(1, sizeof *f);
    strcpy(f->folder, "/tmp/ktg-json-XXXXXX");
    *state = f;
    if (ktg_context_new(&f->context) != KTG_OK || !mkdtemp(f->folder))
        return -1;
    snprintf(f->path, sizeof f->path, "%s/a.json", f->folder);
    snprintf(f->other, sizeof f->other, "%s/b.json", f->folder);
    return 0;
}

static int teardown(void **state) {
    fixture *f = *state;
    unlink(f->path);
    unlink(f->other);
    rmdir(f->folder);
    ktg_context_free(&f->context);
    free(f);
    return 0;
}

/* Two triangles in two pieces, joined by one seam; everything the form knows appears. */
static ktg_pattern *make_pattern(ktg_context *context) {
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

static ktg_status write_to(fixture *f, const ktg_pattern *pattern, const char *path) {
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

static void write_bytes(const char *path, const char *bytes, size_t size) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static char *slurp(fixture *f, const char *path) {
    char *bytes = NULL;
    size_t size;
    assert_int_equal(ktg_file_read(f->context, path, 1 << 24, &bytes, &size), KTG_OK);
    return bytes;
}

static void assert_same_file(fixture *f) {
    char *a = slurp(f, f->path), *b = slurp(f, f->other);
    assert_string_equal(a, b);
    ktg_free(a);
    ktg_free(b);
}

static void assert_refused(fixture *f, ktg_status expected, const char *says) {
    ktg_pattern *pattern = NULL;
    ktg_status status = ktg_pattern_read_json(f->context, f->path, &pattern);
    const char *message = ktg_context_message(f->context);
    if (status != expected || !strstr(message, says) || !strstr(message, f->path))
        fail_msg("status %s, message \"%s\" instead of \"%s\"", ktg_status_name(status), message,
                 says);
    assert_null(pattern);
}

#define assert_same_array(a, b, count, items)                                                      \
    assert_memory_equal((a)->items, (b)->items, (count) * sizeof *(a)->items)

static void assert_same_piece(const ktg_pattern_piece *a, const ktg_pattern_piece *b) {
    assert_int_equal(a->component, b->component);
    assert_int_equal(a->name == NULL, b->name == NULL);
    if (a->name)
        assert_string_equal(a->name, b->name);
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_same_array(a, b, a->vertex_count, vertices);
    assert_int_equal(a->face_count, b->face_count);
    assert_same_array(a, b, a->face_count, faces);
    assert_same_array(a, b, 3 * a->face_count, corners);
    assert_int_equal(a->outline_count, b->outline_count);
    if (a->outline)
        assert_same_array(a, b, a->outline_count, outline);
    else
        assert_null(b->outline);
    assert_int_equal(a->tab_count, b->tab_count);
    for (size_t i = 0; i < a->tab_count; i++) {
        assert_int_equal(a->tabs[i].edge, b->tabs[i].edge);
        assert_int_equal(a->tabs[i].size, b->tabs[i].size);
        assert_int_equal(a->tabs[i].corner_count, b->tabs[i].corner_count);
        assert_memory_equal(a->tabs[i].corners, b->tabs[i].corners, sizeof a->tabs[i].corners);
    }
    assert_int_equal(a->line_count, b->line_count);
    for (size_t i = 0; i < a->line_count; i++) {
        assert_int_equal(a->lines[i].kind, b->lines[i].kind);
        assert_int_equal(a->lines[i].point_count, b->lines[i].point_count);
        assert_same_array(&a->lines[i], &b->lines[i], a->lines[i].point_count, points);
    }
    assert_int_equal(a->label_count, b->label_count);
    for (size_t i = 0; i < a->label_count; i++) {
        assert_memory_equal(a->labels[i].text, b->labels[i].text, sizeof a->labels[i].text);
        assert_memory_equal(&a->labels[i].at, &b->labels[i].at, sizeof(ktg_vec2));
        assert_true(fabs(a->labels[i].rotation - b->labels[i].rotation) <=
                    1e-15 * fabs(a->labels[i].rotation));
        assert_true(a->labels[i].height_mm == b->labels[i].height_mm);
        assert_int_equal(a->labels[i].edge, b->labels[i].edge);
        assert_int_equal(a->labels[i].leader, b->labels[i].leader);
        assert_memory_equal(&a->labels[i].foot, &b->labels[i].foot, sizeof(ktg_vec2));
    }
    assert_int_equal(a->cut_count, b->cut_count);
    assert_int_equal(a->cut_mirrored, b->cut_mirrored);
    assert_int_equal(a->on_fold, b->on_fold);
    if (a->cut_count == 0)
        assert_int_equal(a->twin_of, b->twin_of);
}

static void assert_same_edge(const ktg_pattern_edge *a, const ktg_pattern_edge *b) {
    assert_memory_equal(a->vertices, b->vertices, sizeof a->vertices);
    assert_int_equal(a->kind, b->kind);
    assert_true(fabs(a->angle - b->angle) <= 1e-15 * fabs(a->angle));
    assert_int_equal(a->side_count, b->side_count);
    assert_memory_equal(a->sides, b->sides, a->side_count * sizeof *a->sides);
    assert_int_equal(a->tab_on, b->tab_on);
    assert_int_equal(a->seam, b->seam);
    assert_int_equal(a->forced, b->forced);
}

static void assert_same_seam(const ktg_pattern_seam *a, const ktg_pattern_seam *b) {
    assert_int_equal(a->edge_count, b->edge_count);
    assert_same_array(a, b, a->edge_count, edges);
    assert_same_array(a, b, a->edge_count, first_side);
    assert_memory_equal(a->pieces, b->pieces, sizeof a->pieces);
    assert_memory_equal(a->lengths_mm, b->lengths_mm, sizeof a->lengths_mm);
    assert_int_equal(a->obvious, b->obvious);
    assert_int_equal(a->dart, b->dart);
    assert_int_equal(a->number, b->number);
    assert_int_equal(a->notch_count, b->notch_count);
    for (size_t i = 0; i < a->notch_count; i++) {
        assert_true(a->notches[i].at == b->notches[i].at);
        assert_int_equal(a->notches[i].marks, b->notches[i].marks);
    }
}

static void assert_same_sheet(const ktg_pattern_sheet *a, const ktg_pattern_sheet *b) {
    assert_int_equal(a->kind, b->kind);
    assert_int_equal(a->poster, b->poster);
    assert_int_equal(a->row, b->row);
    assert_int_equal(a->column, b->column);
    assert_true(a->width_mm == b->width_mm && a->height_mm == b->height_mm);
    assert_memory_equal(a->printable, b->printable, sizeof a->printable);
    assert_int_equal(a->placement_count, b->placement_count);
    for (size_t i = 0; i < a->placement_count; i++) {
        assert_int_equal(a->placements[i].piece, b->placements[i].piece);
        assert_true(a->placements[i].x == b->placements[i].x);
        assert_true(a->placements[i].y == b->placements[i].y);
        assert_true(fabs(a->placements[i].rotation - b->placements[i].rotation) <=
                    1e-15 * fabs(a->placements[i].rotation));
    }
}

static void assert_same_pattern(const ktg_pattern *a, const ktg_pattern *b) {
    assert_int_equal(a->mode, b->mode);
    assert_string_equal(a->model_file, b->model_file);
    assert_int_equal(a->model_faces, b->model_faces);
    assert_true(a->mm_per_unit == b->mm_per_unit);
    assert_int_equal(a->simplified, b->simplified);
    assert_int_equal(a->omitted_count, b->omitted_count);
    for (size_t i = 0; i < a->omitted_count; i++)
        assert_string_equal(a->omitted[i], b->omitted[i]);
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_same_array(a, b, a->vertex_count, vertices);
    assert_int_equal(a->face_count, b->face_count);
    assert_same_array(a, b, 3 * a->face_count, faces);
    assert_same_array(a, b, a->face_count, face_strain);
    assert_int_equal(a->component_count, b->component_count);
    assert_string_equal(a->components[0].name, b->components[0].name);
    assert_null(b->components[1].name);
    assert_int_equal(a->piece_count, b->piece_count);
    for (size_t i = 0; i < a->piece_count; i++)
        assert_same_piece(&a->pieces[i], &b->pieces[i]);
    assert_int_equal(a->edge_count, b->edge_count);
    for (size_t i = 0; i < a->edge_count; i++)
        assert_same_edge(&a->edges[i], &b->edges[i]);
    assert_int_equal(a->seam_count, b->seam_count);
    for (size_t i = 0; i < a->seam_count; i++)
        assert_same_seam(&a->seams[i], &b->seams[i]);
    assert_int_equal(a->sheet_count, b->sheet_count);
    for (size_t i = 0; i < a->sheet_count; i++)
        assert_same_sheet(&a->sheets[i], &b->sheets[i]);
}

static void a_pattern_reads_back_to_the_same_bits(void **state) {
    fixture *f = *state;
    ktg_pattern *pattern = make_pattern(f->context), *back = NULL;
    assert_int_equal(write_to(f, pattern, f->path), KTG_OK);
    assert_int_equal(ktg_pattern_read_json(f->context, f->path, &back), KTG_OK);
    assert_same_pattern(pattern, back);
    assert_int_equal(write_to(f, back, f->other), KTG_OK);
    assert_same_file(f);
    ktg_pattern_free(&pattern);
    ktg_pattern_free(&back);
}

static void every_angle_survives_degrees(void **state) {
    fixture *f = *state;
    ktg_pattern *pattern = make_pattern(f->context), *back = NULL;
    ktg_free(pattern->pieces[1].labels);
    size_t count = pattern->pieces[1].label_count = 20000;
    ktg_pattern_label *labels = pattern->pieces[1].labels =
        ktg_new(f->context, count, ktg_pattern_label);
    for (size_t i = 0; i < count; i++)
        labels[i] = (ktg_pattern_label){"7", {0, 0}, sin((double)i) * pow(10, i % 17 - 14.0), 2, 2};
    assert_int_equal(write_to(f, pattern, f->path), KTG_OK);
    assert_int_equal(ktg_pattern_read_json(f->context, f->path, &back), KTG_OK);
    for (size_t i = 0; i < count; i++)
        assert_true(fabs(labels[i].rotation - back->pieces[1].labels[i].rotation) <=
                    1e-15 * fabs(labels[i].rotation));
    ktg_pattern_free(&pattern);
    assert_int_equal(write_to(f, back, f->path), KTG_OK);
    ktg_pattern_free(&back);
    assert_int_equal(ktg_pattern_read_json(f->context, f->path, &back), KTG_OK);
    assert_int_equal(write_to(f, back, f->other), KTG_OK);
    assert_same_file(f); /* a pattern that was read once does not change any more */
    ktg_pattern_free(&back);
}

static void short_numbers_stay_short(void **state) {
    fixture *f = *state;
    ktg_pattern *pattern = make_pattern(f->context);
    assert_int_equal(write_to(f, pattern, f->path), KTG_OK);
    char *text = slurp(f, f->path);
    assert_non_null(strstr(text, "\"mm_per_unit\":0.1,"));
    assert_non_null(strstr(text, "\"angle_deg\":45,"));
    assert_non_null(strstr(text, "{\"piece\":2,\"x\":12.5,\"y\":40.1,\"rotation_deg\":90}"));
    assert_non_null(strstr(text, "\n\"edges\":["));
    ktg_free(text);
    ktg_pattern_free(&pattern);
}

static void the_locale_changes_nothing(void **state) {
    fixture *f = *state;
    static const char *const names[] = {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "C.UTF-8"};
    ktg_pattern *pattern = make_pattern(f->context), *back = NULL;
    assert_int_equal(write_to(f, pattern, f->path), KTG_OK);
    for (size_t i = 0; i < 4; i++)
        if (setlocale(LC_ALL, names[i]))
            break;
    assert_int_equal(write_to(f, pattern, f->other), KTG_OK);
    assert_int_equal(ktg_pattern_read_json(f->context, f->other, &back), KTG_OK);
    setlocale(LC_ALL, "C");
    assert_same_file(f);
    assert_same_pattern(pattern, back);
    ktg_pattern_free(&pattern);
    ktg_pattern_free(&back);
}

static void a_number_without_a_form_is_not_written(void **state) {
    fixture *f = *state;
    ktg_pattern *pattern = make_pattern(f->context);
    pattern->pieces[0].vertices[1].x = NAN;
    assert_int_equal(write_to(f, pattern, f->path), KTG_ARGUMENT);
    assert_int_not_equal(access(f->path, F_OK), 0);
    pattern->pieces[0].vertices[1].x = 1;
    pattern->pieces[0].component = 2;
    assert_int_equal(write_to(f, pattern, f->path), KTG_ARGUMENT);
    ktg_pattern_free(&pattern);
}

static void a_name_that_is_no_utf8_is_written_with_question_marks(void **state) {
    fixture *f = *state;
    ktg_pattern *pattern = make_pattern(f->context), *back = NULL;
    ktg_free(pattern->model_file);
    pattern->model_file = ktg_copy_text(f->context, "f\xfc.obj", SIZE_MAX);
    assert_int_equal(write_to(f, pattern, f->path), KTG_OK);
    assert_int_equal(ktg_pattern_read_json(f->context, f->path, &back), KTG_OK);
    assert_string_equal(back->model_file, "f?.obj");
    ktg_pattern_free(&pattern);
    ktg_pattern_free(&back);
}

/* ---- damaged files ------------------------------------------------------------------------ */

static json_t *make_json(fixture *f) {
    ktg_pattern *pattern = make_pattern(f->context);
    assert_int_equal(write_to(f, pattern, f->path), KTG_OK);
    ktg_pattern_free(&pattern);
    json_t *root = json_load_file(f->path, JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(root);
    return root;
}

static void save(fixture *f, const json_t *root) {
    assert_int_equal(json_dump_file(root, f->path, JSON_REAL_PRECISION(17)), 0);
}

/* What docs/pattern-json.md lets a file leave out. */
static bool may_miss(const char *way) {
    const char *key = strrchr(way, '.');
    if (strstr(way, ".labels["))
        return !strcmp(key, ".rotation_deg") || !strcmp(key, ".height_mm") ||
               !strcmp(key, ".edge") || !strcmp(key, ".leader");
    return key &&
           (!strcmp(key, ".size") || !strcmp(key, ".omitted") || !strcmp(key, ".tile") ||
            !strcmp(key, ".obvious") || !strcmp(key, ".section") || !strcmp(key, ".closing") ||
            !strcmp(key, ".dart") || !strcmp(key, ".number") || !strcmp(key, ".notches") ||
            !strcmp(key, ".on_fold") || !strcmp(key, ".forced") || !strcmp(key, ".face_strain") ||
            !strcmp(key, ".first_side"));
}

static size_t damage_below(fixture *f, const json_t *root, json_t *value, const char *way);

static size_t damage_items(fixture *f, const json_t *root, json_t *array, const char *way) {
    size_t count = 0;
    for (size_t i = 0; i < json_array_size(array); i++) {
        char deeper[128], says[160];
        snprintf(deeper, sizeof deeper, "%s[%zu]", way, i);
        snprintf(says, sizeof says, "%s: must be", deeper);
        json_t *item = json_incref(json_array_get(array, i));
        assert_int_equal(json_array_set_new(array, i, json_true()), 0);
        save(f, root);
        assert_refused(f, KTG_FORMAT, says);
        assert_int_equal(json_array_set_new(array, i, item), 0);
        count += 1 + damage_below(f, root, item, deeper);
    }
    return count;
}

static size_t damage_key(fixture *f, const json_t *root, json_t *object, const char *key,
                         const char *way) {
    char deeper[128], says[160];
    snprintf(deeper, sizeof deeper, "%s%s%s", way, *way ? "." : "", key);
    json_t *item = json_incref(json_object_get(object, key));
    json_t *wrong = json_is_object(item) ? json_array() : json_object();
    assert_int_equal(json_object_set_new(object, key, wrong), 0);
    save(f, root);
    snprintf(says, sizeof says, "%s: must be", deeper);
    assert_refused(f, KTG_FORMAT, says);
    if (!may_miss(deeper)) {
        assert_int_equal(json_object_del(object, key), 0);
        save(f, root);
        snprintf(says, sizeof says, "%s: is missing", deeper);
        assert_refused(f, KTG_FORMAT, says);
    }
    assert_int_equal(json_object_set_new(object, key, item), 0);
    return 1 + damage_below(f, root, item, deeper);
}

/* Takes each key away and puts a value of another kind there, all the way down. */
static size_t damage_below(fixture *f, const json_t *root, json_t *value, const char *way) {
    char *keys[16];
    size_t count = 0, key_count = 0;
    if (json_is_array(value))
        return damage_items(f, root, value, way);
    for (void *at = json_object_iter(value); at; at = json_object_iter_next(value, at))
        keys[key_count++] = strdup(json_object_iter_key(at));
    for (size_t i = 0; i < key_count; i++) {
        count += damage_key(f, root, value, keys[i], way);
        free(keys[i]);
    }
    return count;
}

static void every_key_is_needed_and_has_its_kind(void **state) {
    fixture *f = *state;
    json_t *root = make_json(f);
    assert_true(damage_below(f, root, root, "") > 200);
    json_decref(root);
}

/* The value `way` leads to: keys and numbers with '/' between them. */
static json_t *follow(json_t *value, const char *way) {
    char copy[96], *rest = NULL;
    snprintf(copy, sizeof copy, "%s", way);
    for (char *step = strtok_r(copy, "/", &rest); step; step = strtok_r(NULL, "/", &rest))
        value = json_is_array(value) ? json_array_get(value, (size_t)atoi(step))
                                     : json_object_get(value, step);
    assert_non_null(value);
    return value;
}

/* Replaces the value at parent/last by the JSON text `instead` and expects the refusal. */
static void refuse_change(fixture *f, const char *parent, const char *last, const char *instead,
                          const char *says) {
    json_t *root = make_json(f), *value = json_loads(instead, JSON_DECODE_ANY, NULL);
    json_t *holder = follow(root, parent);
    assert_non_null(value);
    if (json_is_array(holder))
        assert_int_equal(json_array_set_new(holder, (size_t)atoi(last), value), 0);
    else
        assert_int_equal(json_object_set_new(holder, last, value), 0);
    save(f, root);
    assert_refused(f, KTG_FORMAT, says);
    json_decref(root);
}

static void every_index_is_in_range(void **state) {
    fixture *f = *state;
    static const char *const cases[][4] = {
        {"mesh/faces/1", "2", "4", "mesh.faces[1][2]: is 4, which is not between 0 and 3"},
        {"mesh/faces/1", "0", "-1", "mesh.faces[1][0]: is -1"},
        {"pieces/0/faces/0", "face", "2", "pieces[0].faces[0].face: is 2"},
        {"pieces/1/faces/0/corners", "1", "3", "pieces[1].faces[0].corners[1]: is 3"},
        {"pieces/1/tabs/0", "edge", "6", "pieces[1].tabs[0].edge: is 6, an id that nothing has"},
        {"pieces/1/labels/0", "edge", "0", "pieces[1].labels[0].edge: is 0, an id"},
        {"components/1/pieces", "0", "3", "components[1].pieces[0]: is 3, an id"},
        {"edges/2/vertices", "0", "4", "edges[2].vertices[0]: is 4"},
        {"edges/2/sides/1", "piece", "9", "edges[2].sides[1].piece: is 9, an id"},
        {"edges/2/sides/1", "face", "2", "edges[2].sides[1].face: is 2"},
        {"edges/2/sides/1", "corner", "3", "edges[2].sides[1].corner: is 3"},
        {"edges/2", "tab_on", "2", "edges[2].tab_on: is 2"},
        {"edges/0", "tab_on", "1", "edges[0].tab_on: is 1, which is not between 0 and 0"},
        {"seams/0/sides/0", "piece", "4", "seams[0].sides[0].piece: is 4, an id"},
        {"seams/0/sides/0/edges", "0", "77", "seams[0].sides[0].edges[0]: is 77, an id"},
        {"seams/0/first_side", "0", "2", "seams[0].first_side[0]: is 2"},
        {"sheets/0/placements/0", "piece", "3", "sheets[0].placements[0].piece: is 3, an id"},
        {"model", "faces", "4294967295", "model.faces: is 4294967295"},
        {"pieces/0/cut", "count", "-1", "pieces[0].cut.count: is -1"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        refuse_change(f, cases[i][0], cases[i][1], cases[i][2], cases[i][3]);
}

static void every_word_and_length_is_checked(void **state) {
    fixture *f = *state;
    static const char *const cases[][4] = {
        {"", "format", "\"svg\"", "format: is \"svg\", which is none of katagami-pattern"},
        {"", "version", "2", "version: is 2, but only version 1 can be read"},
        {"", "units", "\"in\"", "units: is \"in\""},
        {"", "mode", "\"wood\"", "mode: is \"wood\", which is none of paper, cloth"},
        {"model", "mm_per_unit", "-1", "model.mm_per_unit: must not be negative"},
        {"mesh/vertices", "1", "[1, 2]", "mesh.vertices[1]: must have 3 items, but it has 2"},
        {"mesh/faces", "0", "[0, 1, 2, 3]", "mesh.faces[0]: must have 3 items, but it has 4"},
        {"mesh", "face_strain", "[1]", "mesh.face_strain: must have 2 items, but it has 1"},
        {"pieces/0/faces/0", "corners", "[0]", "pieces[0].faces[0].corners: must have 3 items"},
        {"pieces/0/vertices", "2", "[1]", "pieces[0].vertices[2]: must have 2 items"},
        {"pieces/1/outline", "0", "[]", "pieces[1].outline[0]: must have 2 items"},
        {"pieces/1/tabs/0", "polygon", "[[0, 0], [1, 0]]", "pieces[1].tabs[0].polygon: must have"},
        {"pieces/1/tabs/0", "size", "\"huge\"", "pieces[1].tabs[0].size: is \"huge\""},
        {"pieces/1/lines/0", "kind", "\"x\"", "pieces[1].lines[0].kind: is \"x\""},
        {"pieces/1/labels/0", "text", "\"01234567890123456789012345678901\"",
         "pieces[1].labels[0].text: has 32 bytes"},
        {"components/1", "pieces", "[]", "pieces[0]: is listed under no component"},
        {"components/0", "pieces", "[2, 1]", "components[1].pieces[0]: names a piece that"},
        {"pieces/1", "id", "1", "pieces[1].id: is 1, which item 0 has already"},
        {"edges/4", "id", "1", "edges[4].id: is 1, which item 0 has already"},
        {"components/1", "id", "1", "components[1].id: is 1"},
        {"edges/1", "kind", "\"ridge\"", "edges[1].kind: is \"ridge\""},
        {"edges/1", "sides", "[]", "edges[1].sides: must have 1 or 2 items, but it has 0"},
        {"seams/0", "sides", "[]", "seams[0].sides: must have 2 items, but it has 0"},
        {"seams/0/sides/0", "edges", "[]", "seams[0].sides[0].edges: must not be empty"},
        {"seams/0/sides/1", "edges", "[2]", "seams[0].sides[1].edges: must be the edges of"},
        {"seams/0/sides/1", "edges", "[3, 3]", "seams[0].sides[1].edges: must have 1 items"},
        {"seams/0", "first_side", "[0, 1]", "seams[0].first_side: must have 1 items"},
        {"sheets/0", "kind", "\"page\"", "sheets[0].kind: is \"page\""},
        {"sheets/0/tile", "row", "0", "sheets[0].tile: counts from 1"},
        {"sheets/0", "printable", "[1, 2, 3]", "sheets[0].printable: must have 4 items"},
        {"model", "mm_per_unit", "\"1\"", "model.mm_per_unit: must be a number, but it is a str"},
        {"edges/2/vertices", "0", "1.0", "edges[2].vertices[0]: must be an integer"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        refuse_change(f, cases[i][0], cases[i][1], cases[i][2], cases[i][3]);
}

static void an_edge_in_two_seams_is_refused(void **state) {
    fixture *f = *state;
    json_t *root = make_json(f), *seam = json_deep_copy(follow(root, "seams/0"));
    assert_int_equal(json_object_set_new(seam, "id", json_integer(2)), 0);
    assert_int_equal(json_array_append_new(follow(root, "seams"), seam), 0);
    save(f, root);
    assert_refused(f, KTG_FORMAT, "seams[1].sides[0].edges[0]: names an edge that seams[0] has");
    json_decref(root);
}

static void hostile_files_end_with_a_sentence(void **state) {
    fixture *f = *state;
    enum { DEEP = 300000 };
    char *deep = malloc(DEEP + 1);
    memset(deep, '[', DEEP);
    write_bytes(f->path, deep, DEEP);
    assert_refused(f, KTG_FORMAT, "maximum parsing depth");
    for (int i = 0; i < DEEP; i++)
        deep[i] = (char)((unsigned)i * 7919u >> 3);
    write_bytes(f->path, deep, DEEP);
    assert_refused(f, KTG_FORMAT, "is no JSON");
    free(deep);
    static const char *const cases[][2] = {
        {"", "is no JSON"},
        {"\x1b[31m", "near '?'"},
        {"[]", "is no Katagami pattern"},
        {"7", "is no JSON"},
        {"{\"format\": \"katagami-pattern\", \"format\": 1}", "duplicate object key"},
        {"{\"format\": \"katagami-pattern\", \"version\": 1e999}", "real number overflow"},
        {"{\"format\": \"katagami-pattern\", \"version\": 99999999999999999999}", "too big"},
        {"{\"format\": \"katagami-pattern\", \"version\": NaN}", "is no JSON"},
        {"{\"format\": \"a\\u0000b\"}", "is no JSON"},
        {"{\"format\": \"\xff\xfe\"}", "unable to decode byte 0xff"},
        {"{} {}", "is no JSON"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_bytes(f->path, cases[i][0], strlen(cases[i][0]));
        assert_refused(f, KTG_FORMAT, cases[i][1]);
    }
    unlink(f->path);
    assert_refused(f, KTG_FILE, "cannot be opened");
}

static void no_truncated_file_is_accepted(void **state) {
    fixture *f = *state;
    json_decref(make_json(f));
    char *text = slurp(f, f->path);
    for (size_t i = 0; i + 2 < strlen(text); i++) { /* the last two are "}\n" */
        write_bytes(f->path, text, i);
        assert_refused(f, KTG_FORMAT, "is no JSON");
    }
    ktg_free(text);
}

/* Multiplies every id of the file, turns the order of pieces and edges round, and drops what may be
 * missing: what another program might write. */
static void files_of_other_programs_are_understood(void **state) {
    fixture *f = *state;
    static const char *const text =
        "{\"mode\":\"paper\",\"units\":\"mm\",\"version\":1,\"format\":\"katagami-pattern\",\"x\":{"
        "},"
        "\"model\":{\"file\":null,\"faces\":2,\"mm_per_unit\":1,\"simplified\":false,\"by\":\"me\"}"
        ","
        "\"mesh\":{\"vertices\":[[0,0,0],[1,0,0],[0,1,0],[1,1,0.5]],\"faces\":[[0,1,2],[2,1,3]],"
        "\"uv\":[1,2,3],\"face_strain\":null},"
        "\"pieces\":[{\"id\":70,\"name\":\"b\",\"vertices\":[[0,1],[1,0],[1,1.1]],"
        "\"faces\":[{\"face\":1,\"corners\":[0,1,2]}],\"outline\":[],"
        "\"tabs\":[{\"edge\":-3,\"polygon\":[[0,1],[0.2,0.5],[1,0]]}],\"lines\":[],"
        "\"labels\":[{\"text\":\"1\",\"x\":1,\"y\":0}],\"cut\":{\"count\":1,\"mirrored\":0}},"
        "{\"id\":-5,\"name\":\"a\",\"vertices\":[[0,0],[1,0],[0,1]],"
        "\"faces\":[{\"face\":0,\"corners\":[0,1,2]}],\"outline\":[],\"tabs\":[],\"lines\":[],"
        "\"labels\":[],\"cut\":{\"count\":1,\"mirrored\":0}}],"
        "\"components\":[{\"id\":0,\"name\":\"all\",\"pieces\":[-5,70]}],"
        "\"edges\":[{\"id\":900,\"vertices\":[0,1],\"kind\":\"border\",\"angle_deg\":0,"
        "\"sides\":[{\"piece\":-5,\"face\":0,\"corner\":0}],\"tab_on\":null},"
        "{\"id\":-3,\"vertices\":[1,2],\"kind\":\"cut\",\"angle_deg\":-10,"
        "\"sides\":[{\"piece\":-5,\"face\":0,\"corner\":1},{\"piece\":70,\"face\":1,\"corner\":0}],"
        "\"tab_on\":1}],"
        "\"seams\":[{\"id\":4,\"sides\":[{\"piece\":70,\"edges\":[-3],\"length_mm\":1.5},"
        "{\"piece\":-5,\"edges\":[-3],\"length_mm\":1.5}]}],"
        "\"sheets\":[]}";
    ktg_pattern *p = NULL;
    write_bytes(f->path, text, strlen(text));
    if (ktg_pattern_read_json(f->context, f->path, &p) != KTG_OK)
        fail_msg("%s", ktg_context_message(f->context));
    assert_int_equal(p->pieces[0].tabs[0].edge, 1);
    assert_int_equal(p->pieces[0].tabs[0].size, KTG_TAB_FULL);
    assert_true(p->pieces[0].labels[0].height_mm > 0);
    assert_int_equal(p->pieces[0].labels[0].edge, KTG_NONE);
    assert_int_equal(p->edges[1].sides[0].piece, 1);
    assert_int_equal(p->edges[1].sides[1].piece, 0);
    assert_int_equal(p->edges[1].tab_on, 1);
    assert_int_equal(p->edges[1].seam, 0);
    assert_int_equal(p->seams[0].pieces[0], 0);
    assert_int_equal(p->seams[0].first_side[0], 1); /* the side in piece 70 */
    assert_null(p->model_file);
    assert_null(p->face_strain);
    assert_null(p->pieces[0].outline);
    assert_int_equal(write_to(f, p, f->path), KTG_OK);
    ktg_pattern_free(&p);
    assert_int_equal(ktg_pattern_read_json(f->context, f->path, &p), KTG_OK);
    assert_int_equal(write_to(f, p, f->other), KTG_OK);
    assert_same_file(f);
    ktg_pattern_free(&p);
}

static void memory_may_fail_anywhere(void **state) {
    fixture *f = *state;
    ktg_pattern *pattern = make_pattern(f->context), *back = NULL;
    assert_int_equal(write_to(f, pattern, f->path), KTG_OK);
    ktg_status status = KTG_MEMORY;
    uint64_t nth = 0;
    while (status == KTG_MEMORY) {
        ktg_context_fail_allocation(f->context, ++nth);
        status = ktg_pattern_read_json(f->context, f->path, &back);
        assert_int_equal(back == NULL, status == KTG_MEMORY);
    }
    assert_int_equal(status, KTG_OK);
    assert_true(nth > 20);
    for (nth = 1, status = KTG_MEMORY; status == KTG_MEMORY; nth++) {
        ktg_context_fail_allocation(f->context, nth);
        status = write_to(f, pattern, f->other);
    }
    assert_int_equal(status, KTG_OK);
    assert_true(nth > 4);
    ktg_context_fail_allocation(f->context, 0);
    ktg_pattern_free(&pattern);
    ktg_pattern_free(&back);
}

#define CASE(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void) {
    const struct CMUnitTest tests[] = {
        CASE(a_pattern_reads_back_to_the_same_bits),
        CASE(every_angle_survives_degrees),
        CASE(short_numbers_stay_short),
        CASE(the_locale_changes_nothing),
        CASE(a_number_without_a_form_is_not_written),
        CASE(a_name_that_is_no_utf8_is_written_with_question_marks),
        CASE(every_key_is_needed_and_has_its_kind),
        CASE(every_index_is_in_range),
        CASE(every_word_and_length_is_checked),
        CASE(an_edge_in_two_seams_is_refused),
        CASE(hostile_files_end_with_a_sentence),
        CASE(no_truncated_file_is_accepted),
        CASE(files_of_other_programs_are_understood),
        CASE(memory_may_fail_anywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
