/* pattern/json_pieces.c - reading the pieces of a pattern from JSON. */
#include "core/memory.h"
#include "pattern/json_read.h"
#include "pattern/json_words.h"

#include <string.h>

#define LABEL_HEIGHT_MM 2.4 /* where a file of another program does not say */

static ktg_status read_points(const ktg_json *list, ktg_vec2 **points, size_t *count) {
    *count = ktg_json_length(list);
    double *numbers = NULL;
    ktg_status status = ktg_json_rows(list, 2, &numbers);
    *points = (ktg_vec2 *)numbers; /* a ktg_vec2 is two doubles */
    return status;
}

static ktg_status read_faces(const ktg_json *object, const ktg_pattern *p,
                             ktg_pattern_piece *piece) {
    ktg_json list;
    KTG_TRY(ktg_json_get(object, "faces", KTG_JSON_ARRAY, &list));
    piece->face_count = ktg_json_length(&list);
    KTG_JSON_TAKE(object, piece->faces, piece->face_count, uint32_t);
    KTG_JSON_TAKE(object, piece->corners, 3 * piece->face_count, uint32_t);
    for (size_t i = 0; i < piece->face_count; i++) {
        ktg_json face, corners;
        KTG_TRY(ktg_json_item(&list, i, KTG_JSON_OBJECT, &face));
        KTG_TRY(ktg_json_count(&face, "face", p->face_count, &piece->faces[i]));
        KTG_TRY(ktg_json_get(&face, "corners", KTG_JSON_ARRAY, &corners));
        KTG_TRY(ktg_json_indices(&corners, 3, piece->vertex_count, piece->corners + 3 * i));
    }
    return KTG_OK;
}

static ktg_status read_tab(const ktg_json *object, const ktg_json_reader *r, ktg_pattern_tab *tab) {
    ktg_json polygon, at;
    int word = KTG_TAB_FULL;
    KTG_TRY(ktg_json_read_id(object, "edge", &r->edge_ids, &tab->edge));
    KTG_TRY(ktg_json_get_optional(object, "size", KTG_JSON_STRING, &at));
    if (at.value)
        KTG_TRY(ktg_json_word(object, "size", ktg_json_tab_sizes, &word));
    tab->size = (ktg_tab_size)word;
    KTG_TRY(ktg_json_get(object, "polygon", KTG_JSON_ARRAY, &polygon));
    size_t length = ktg_json_length(&polygon);
    if (length < 3 || length > KTG_TAB_CORNERS)
        return ktg_json_refuse(&polygon, "must have 3 to %d points, but it has %zu",
                               KTG_TAB_CORNERS, length);
    tab->corner_count = (uint32_t)length;
    for (size_t i = 0; i < length; i++) {
        double numbers[2];
        KTG_TRY(ktg_json_item(&polygon, i, KTG_JSON_ARRAY, &at));
        KTG_TRY(ktg_json_numbers(&at, 2, numbers));
        tab->corners[i] = (ktg_vec2){numbers[0], numbers[1]};
    }
    return KTG_OK;
}

static ktg_status read_tabs(const ktg_json *object, const ktg_json_reader *r,
                            ktg_pattern_piece *piece) {
    ktg_json list, item;
    KTG_TRY(ktg_json_get(object, "tabs", KTG_JSON_ARRAY, &list));
    piece->tab_count = ktg_json_length(&list);
    KTG_JSON_TAKE(object, piece->tabs, piece->tab_count, ktg_pattern_tab);
    for (size_t i = 0; i < piece->tab_count; i++) {
        KTG_TRY(ktg_json_item(&list, i, KTG_JSON_OBJECT, &item));
        KTG_TRY(read_tab(&item, r, &piece->tabs[i]));
    }
    return KTG_OK;
}

static ktg_status read_lines(const ktg_json *object, ktg_pattern_piece *piece) {
    ktg_json list, item, points;
    int word;
    KTG_TRY(ktg_json_get(object, "lines", KTG_JSON_ARRAY, &list));
    size_t length = ktg_json_length(&list);
    KTG_JSON_TAKE(object, piece->lines, length, ktg_pattern_line);
    piece->line_count = length;
    for (size_t i = 0; i < length; i++) {
        ktg_pattern_line *line = &piece->lines[i];
        KTG_TRY(ktg_json_item(&list, i, KTG_JSON_OBJECT, &item));
        KTG_TRY(ktg_json_word(&item, "kind", ktg_json_line_kinds, &word));
        line->kind = (ktg_line_kind)word;
        KTG_TRY(ktg_json_get(&item, "points", KTG_JSON_ARRAY, &points));
        KTG_TRY(read_points(&points, &line->points, &line->point_count));
    }
    return KTG_OK;
}

/* A number that may be left out. */
static ktg_status read_optional(const ktg_json *object, const char *key, double otherwise,
                                double *number) {
    ktg_json at;
    *number = otherwise;
    KTG_TRY(ktg_json_get_optional(object, key, KTG_JSON_NUMBER, &at));
    return at.value ? ktg_json_number(object, key, number) : KTG_OK;
}

static ktg_status read_label(const ktg_json *object, const ktg_json_reader *r,
                             ktg_pattern_label *label) {
    ktg_json at;
    KTG_TRY(ktg_json_get(object, "text", KTG_JSON_STRING, &at));
    size_t length = json_string_length(at.value);
    if (length >= sizeof label->text)
        return ktg_json_refuse(&at, "has %zu bytes, but a label has %zu at most", length,
                               sizeof label->text - 1);
    memcpy(label->text, json_string_value(at.value), length);
    KTG_TRY(ktg_json_number(object, "x", &label->at.x));
    KTG_TRY(ktg_json_number(object, "y", &label->at.y));
    KTG_TRY(read_optional(object, "rotation_deg", 0, &label->rotation));
    label->rotation = ktg_json_radians(label->rotation);
    KTG_TRY(read_optional(object, "height_mm", LABEL_HEIGHT_MM, &label->height_mm));
    KTG_TRY(ktg_json_get_optional(object, "leader", KTG_JSON_ARRAY, &at));
    label->leader = at.value != NULL;
    if (label->leader)
        KTG_TRY(ktg_json_numbers(&at, 2, &label->foot.x));
    label->edge = KTG_NONE;
    KTG_TRY(ktg_json_get_optional(object, "edge", KTG_JSON_INTEGER, &at));
    return at.value ? ktg_json_ids_find(&r->edge_ids, &at, &label->edge) : KTG_OK;
}

static ktg_status read_labels(const ktg_json *object, const ktg_json_reader *r,
                              ktg_pattern_piece *piece) {
    ktg_json list, item;
    KTG_TRY(ktg_json_get(object, "labels", KTG_JSON_ARRAY, &list));
    piece->label_count = ktg_json_length(&list);
    KTG_JSON_TAKE(object, piece->labels, piece->label_count, ktg_pattern_label);
    for (size_t i = 0; i < piece->label_count; i++) {
        KTG_TRY(ktg_json_item(&list, i, KTG_JSON_OBJECT, &item));
        KTG_TRY(read_label(&item, r, &piece->labels[i]));
    }
    return KTG_OK;
}

static ktg_status read_cut(const ktg_json *object, const ktg_json_reader *r,
                           ktg_pattern_piece *piece) {
    ktg_json at;
    KTG_TRY(ktg_json_count(object, "count", KTG_JSON_MOST_COUNT, &piece->cut_count));
    KTG_TRY(ktg_json_count(object, "mirrored", KTG_JSON_MOST_COUNT, &piece->cut_mirrored));
    KTG_TRY(ktg_json_get_optional(object, "on_fold", KTG_JSON_BOOLEAN, &at));
    piece->on_fold = at.value && json_is_true(at.value);
    return piece->cut_count > 0
               ? KTG_OK
               : ktg_json_read_id(object, "twin_of", &r->piece_ids, &piece->twin_of);
}

static ktg_status read_piece(const ktg_json *object, const ktg_json_reader *r,
                             ktg_pattern_piece *piece) {
    ktg_json at;
    piece->component = KTG_NONE;
    KTG_TRY(ktg_json_text(object, "name", &piece->name));
    KTG_TRY(ktg_json_get(object, "vertices", KTG_JSON_ARRAY, &at));
    KTG_TRY(read_points(&at, &piece->vertices, &piece->vertex_count));
    KTG_TRY(read_faces(object, r->pattern, piece));
    KTG_TRY(ktg_json_get(object, "outline", KTG_JSON_ARRAY, &at));
    if (ktg_json_length(&at) > 0)
        KTG_TRY(read_points(&at, &piece->outline, &piece->outline_count));
    KTG_TRY(read_tabs(object, r, piece));
    KTG_TRY(read_lines(object, piece));
    KTG_TRY(read_labels(object, r, piece));
    KTG_TRY(ktg_json_get(object, "cut", KTG_JSON_OBJECT, &at));
    return read_cut(&at, r, piece);
}

ktg_status ktg_json_read_pieces(ktg_json_reader *r) {
    ktg_pattern *p = r->pattern;
    KTG_JSON_TAKE(&r->root, p->pieces, r->piece_ids.count, ktg_pattern_piece);
    p->piece_count = r->piece_ids.count;
    for (size_t i = 0; i < p->piece_count; i++) {
        ktg_json item;
        KTG_TRY(ktg_json_item(&r->pieces, i, KTG_JSON_OBJECT, &item));
        KTG_TRY(read_piece(&item, r, &p->pieces[i]));
    }
    return KTG_OK;
}
