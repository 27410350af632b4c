/* The pattern's JSON form: everything a file can get wrong. */
#include "json_files.h"

#include "core/memory.h"

#include <jansson.h>
#include <stdio.h>
#include <unistd.h>

static void assert_refused(fixture *f, ktg_status expected, const char *says) {
    ktg_pattern *pattern = NULL;
    ktg_status status = ktg_pattern_read_json(f->context, f->path, &pattern);
    const char *message = ktg_context_message(f->context);
    if (status != expected || !strstr(message, says) || !strstr(message, f->path))
        fail_msg("status %s, message \"%s\" instead of \"%s\"", ktg_status_name(status), message,
                 says);
    assert_null(pattern);
}

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

int main(void) {
    const struct CMUnitTest tests[] = {
        CASE(every_key_is_needed_and_has_its_kind), CASE(every_index_is_in_range),
        CASE(every_word_and_length_is_checked),     CASE(an_edge_in_two_seams_is_refused),
        CASE(hostile_files_end_with_a_sentence),    CASE(no_truncated_file_is_accepted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
