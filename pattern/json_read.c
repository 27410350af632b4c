/* pattern/json_read.c - reading a pattern from JSON (docs/pattern-json.md), every key and every
 * index checked. */
#include "pattern/json_read.h"
#include "core/file.h"
#include "core/memory.h"
#include "pattern/json_words.h"
#include "pattern/pattern.h"

#include <string.h>

/* A pattern of a million faces has about 300 MB. */
#define MOST_BYTES ((size_t)1 << 29)

ktg_status ktg_json_read_id(const ktg_json *object, const char *key, const ktg_json_ids *ids,
                            uint32_t *index) {
    ktg_json at;
    KTG_TRY(ktg_json_get(object, key, KTG_JSON_INTEGER, &at));
    return ktg_json_ids_find(ids, &at, index);
}

/* ---- head and mesh ------------------------------------------------------------------------ */

static ktg_status read_omitted(const ktg_json *model, ktg_pattern *p) {
    ktg_json list, item;
    KTG_TRY(ktg_json_get_optional(model, "omitted", KTG_JSON_ARRAY, &list));
    if (!list.value)
        return KTG_OK;
    KTG_JSON_TAKE(&list, p->omitted, ktg_json_length(&list), char *);
    p->omitted_count = ktg_json_length(&list);
    for (size_t i = 0; i < p->omitted_count; i++) {
        KTG_TRY(ktg_json_item(&list, i, KTG_JSON_STRING, &item));
        p->omitted[i] = ktg_copy_text(model->context, json_string_value(item.value), SIZE_MAX);
        if (!p->omitted[i])
            return KTG_MEMORY;
    }
    return KTG_OK;
}

static ktg_status read_head(const ktg_json *root, ktg_pattern *p) {
    static const char *const formats[] = {"katagami-pattern", NULL};
    static const char *const units[] = {"mm", NULL};
    int word;
    uint32_t version;
    ktg_json model, at;
    KTG_TRY(ktg_json_word(root, "format", formats, &word));
    KTG_TRY(ktg_json_get(root, "version", KTG_JSON_INTEGER, &at));
    KTG_TRY(ktg_json_below(&at, KTG_JSON_MOST_COUNT, &version));
    if (version != 1)
        return ktg_json_refuse(&at, "is %u, but only version 1 can be read", version);
    KTG_TRY(ktg_json_word(root, "units", units, &word));
    KTG_TRY(ktg_json_word(root, "mode", ktg_json_modes, &word));
    p->mode = (ktg_pattern_mode)word;
    KTG_TRY(ktg_json_get(root, "model", KTG_JSON_OBJECT, &model));
    KTG_TRY(ktg_json_text(&model, "file", &p->model_file));
    KTG_TRY(ktg_json_count(&model, "faces", KTG_JSON_MOST_COUNT, &p->model_faces));
    KTG_TRY(ktg_json_number(&model, "mm_per_unit", &p->mm_per_unit));
    KTG_TRY(ktg_json_get(&model, "mm_per_unit", KTG_JSON_NUMBER, &at));
    if (p->mm_per_unit < 0)
        return ktg_json_refuse(&at, "must not be negative");
    KTG_TRY(ktg_json_get(&model, "simplified", KTG_JSON_BOOLEAN, &at));
    p->simplified = json_is_true(at.value);
    return read_omitted(&model, p);
}

static ktg_status read_strain(const ktg_json *mesh, ktg_pattern *p) {
    ktg_json at;
    KTG_TRY(ktg_json_get_optional(mesh, "face_strain", KTG_JSON_ARRAY, &at));
    if (!at.value)
        return KTG_OK;
    KTG_JSON_TAKE(mesh, p->face_strain, p->face_count, double);
    return ktg_json_numbers(&at, p->face_count, p->face_strain);
}

static ktg_status read_mesh(const ktg_json *root, ktg_pattern *p) {
    ktg_json mesh, at, row;
    double *numbers = NULL;
    KTG_TRY(ktg_json_get(root, "mesh", KTG_JSON_OBJECT, &mesh));
    KTG_TRY(ktg_json_get(&mesh, "vertices", KTG_JSON_ARRAY, &at));
    p->vertex_count = (uint32_t)ktg_json_length(&at);
    ktg_status status = ktg_json_rows(&at, 3, &numbers);
    p->vertices = (ktg_vec3 *)numbers; /* a ktg_vec3 is three doubles */
    KTG_TRY(status);
    KTG_TRY(ktg_json_get(&mesh, "faces", KTG_JSON_ARRAY, &at));
    p->face_count = (uint32_t)ktg_json_length(&at);
    KTG_JSON_TAKE(&mesh, p->faces, 3 * (size_t)p->face_count, uint32_t);
    for (size_t i = 0; i < p->face_count; i++) {
        KTG_TRY(ktg_json_item(&at, i, KTG_JSON_ARRAY, &row));
        KTG_TRY(ktg_json_indices(&row, 3, p->vertex_count, p->faces + 3 * i));
    }
    return read_strain(&mesh, p);
}

/* ---- components --------------------------------------------------------------------------- */

static ktg_status read_component(const ktg_json *object, const ktg_json_reader *r,
                                 uint32_t component) {
    ktg_json list, item;
    uint32_t piece;
    KTG_TRY(ktg_json_text(object, "name", &r->pattern->components[component].name));
    KTG_TRY(ktg_json_get(object, "pieces", KTG_JSON_ARRAY, &list));
    for (size_t i = 0; i < ktg_json_length(&list); i++) {
        KTG_TRY(ktg_json_item(&list, i, KTG_JSON_INTEGER, &item));
        KTG_TRY(ktg_json_ids_find(&r->piece_ids, &item, &piece));
        if (r->pattern->pieces[piece].component != KTG_NONE)
            return ktg_json_refuse(&item, "names a piece that component number %u has already",
                                   r->pattern->pieces[piece].component + 1);
        r->pattern->pieces[piece].component = component;
    }
    return KTG_OK;
}

static ktg_status read_components(const ktg_json_reader *r) {
    ktg_pattern *p = r->pattern;
    ktg_json list, item;
    ktg_json_ids ids = {0};
    KTG_TRY(ktg_json_get(&r->root, "components", KTG_JSON_ARRAY, &list));
    ktg_status status = ktg_json_ids_read(&list, &ids);
    ktg_json_ids_free(&ids);
    KTG_TRY(status);
    KTG_JSON_TAKE(&list, p->components, ktg_json_length(&list), ktg_pattern_component);
    p->component_count = ktg_json_length(&list);
    for (size_t i = 0; i < p->component_count; i++) {
        KTG_TRY(ktg_json_item(&list, i, KTG_JSON_OBJECT, &item));
        KTG_TRY(read_component(&item, r, (uint32_t)i));
    }
    for (size_t i = 0; i < p->piece_count; i++)
        if (p->pieces[i].component == KTG_NONE) {
            KTG_TRY(ktg_json_item(&r->pieces, i, KTG_JSON_OBJECT, &item));
            return ktg_json_refuse(&item, "is listed under no component");
        }
    return KTG_OK;
}

/* ---- edges -------------------------------------------------------------------------------- */

static ktg_status read_sides(const ktg_json *object, const ktg_json_reader *r,
                             ktg_pattern_edge *edge) {
    ktg_json list, item;
    KTG_TRY(ktg_json_get(object, "sides", KTG_JSON_ARRAY, &list));
    size_t length = ktg_json_length(&list);
    if (length < 1 || length > 2)
        return ktg_json_refuse(&list, "must have 1 or 2 items, but it has %zu", length);
    edge->side_count = (uint32_t)length;
    for (size_t s = 0; s < length; s++) {
        KTG_TRY(ktg_json_item(&list, s, KTG_JSON_OBJECT, &item));
        KTG_TRY(ktg_json_read_id(&item, "piece", &r->piece_ids, &edge->sides[s].piece));
        KTG_TRY(ktg_json_count(&item, "face", r->pattern->face_count, &edge->sides[s].face));
        KTG_TRY(ktg_json_count(&item, "corner", 3, &edge->sides[s].corner));
    }
    return KTG_OK;
}

static ktg_status read_edge(const ktg_json *object, const ktg_json_reader *r,
                            ktg_pattern_edge *edge) {
    ktg_json at;
    int word;
    uint32_t tab = 0;
    edge->seam = KTG_NONE;
    KTG_TRY(ktg_json_get(object, "vertices", KTG_JSON_ARRAY, &at));
    KTG_TRY(ktg_json_indices(&at, 2, r->pattern->vertex_count, edge->vertices));
    KTG_TRY(ktg_json_word(object, "kind", ktg_json_edge_kinds, &word));
    edge->kind = (ktg_edge_kind)word;
    KTG_TRY(ktg_json_number(object, "angle_deg", &edge->angle));
    edge->angle = ktg_json_radians(edge->angle);
    KTG_TRY(read_sides(object, r, edge));
    KTG_TRY(ktg_json_get(object, "tab_on", KTG_JSON_INTEGER_OR_NULL, &at));
    if (!json_is_null(at.value))
        KTG_TRY(ktg_json_below(&at, edge->side_count, &tab));
    edge->tab_on = json_is_null(at.value) ? -1 : (int)tab;
    KTG_TRY(ktg_json_get_optional(object, "forced", KTG_JSON_BOOLEAN, &at));
    edge->forced = at.value && json_is_true(at.value);
    return KTG_OK;
}

static ktg_status read_edges(const ktg_json_reader *r) {
    ktg_pattern *p = r->pattern;
    KTG_JSON_TAKE(&r->root, p->edges, r->edge_ids.count, ktg_pattern_edge);
    p->edge_count = r->edge_ids.count;
    for (size_t i = 0; i < p->edge_count; i++) {
        ktg_json item;
        KTG_TRY(ktg_json_item(&r->edges, i, KTG_JSON_OBJECT, &item));
        KTG_TRY(read_edge(&item, r, &p->edges[i]));
    }
    return KTG_OK;
}

/* ---- sheets ------------------------------------------------------------------------------- */

/* The most posters, rows and columns; more would be no poster. */
#define MOST_TILES 100000

/* Counted from 1, as people do. */
static ktg_status read_tile(const ktg_json *object, ktg_pattern_sheet *sheet) {
    ktg_json tile;
    KTG_TRY(ktg_json_get_optional(object, "tile", KTG_JSON_OBJECT, &tile));
    if (!tile.value)
        return KTG_OK;
    KTG_TRY(ktg_json_count(&tile, "poster", MOST_TILES, &sheet->poster));
    KTG_TRY(ktg_json_count(&tile, "row", MOST_TILES, &sheet->row));
    KTG_TRY(ktg_json_count(&tile, "column", MOST_TILES, &sheet->column));
    if (sheet->poster < 1 || sheet->row < 1 || sheet->column < 1)
        return ktg_json_refuse(&tile, "counts from 1");
    sheet->row--;
    sheet->column--;
    return KTG_OK;
}

static ktg_status read_sheet(const ktg_json *object, const ktg_json_reader *r,
                             ktg_pattern_sheet *sheet) {
    ktg_json list, item;
    int word;
    KTG_TRY(ktg_json_word(object, "kind", ktg_json_sheet_kinds, &word));
    sheet->kind = (ktg_sheet_kind)word;
    KTG_TRY(ktg_json_number(object, "width", &sheet->width_mm));
    KTG_TRY(ktg_json_number(object, "height", &sheet->height_mm));
    KTG_TRY(ktg_json_get(object, "printable", KTG_JSON_ARRAY, &list));
    KTG_TRY(ktg_json_numbers(&list, 4, sheet->printable));
    KTG_TRY(read_tile(object, sheet));
    KTG_TRY(ktg_json_get(object, "placements", KTG_JSON_ARRAY, &list));
    KTG_JSON_TAKE(&list, sheet->placements, ktg_json_length(&list), ktg_pattern_placement);
    sheet->placement_count = ktg_json_length(&list);
    for (size_t i = 0; i < sheet->placement_count; i++) {
        ktg_pattern_placement *placement = &sheet->placements[i];
        KTG_TRY(ktg_json_item(&list, i, KTG_JSON_OBJECT, &item));
        KTG_TRY(ktg_json_read_id(&item, "piece", &r->piece_ids, &placement->piece));
        KTG_TRY(ktg_json_number(&item, "x", &placement->x));
        KTG_TRY(ktg_json_number(&item, "y", &placement->y));
        KTG_TRY(ktg_json_number(&item, "rotation_deg", &placement->rotation));
        placement->rotation = ktg_json_radians(placement->rotation);
    }
    return KTG_OK;
}

static ktg_status read_sheets(const ktg_json_reader *r) {
    ktg_pattern *p = r->pattern;
    ktg_json list, item;
    ktg_json_ids ids = {0};
    KTG_TRY(ktg_json_get(&r->root, "sheets", KTG_JSON_ARRAY, &list));
    ktg_status status = ktg_json_ids_read(&list, &ids);
    ktg_json_ids_free(&ids);
    KTG_TRY(status);
    KTG_JSON_TAKE(&list, p->sheets, ktg_json_length(&list), ktg_pattern_sheet);
    p->sheet_count = ktg_json_length(&list);
    for (size_t i = 0; i < p->sheet_count; i++) {
        KTG_TRY(ktg_json_item(&list, i, KTG_JSON_OBJECT, &item));
        KTG_TRY(read_sheet(&item, r, &p->sheets[i]));
    }
    return KTG_OK;
}

/* ---- the whole file ----------------------------------------------------------------------- */

static ktg_status read_pattern(ktg_json_reader *r) {
    if (!json_is_object(r->root.value))
        return ktg_json_refuse(&r->root, "is no Katagami pattern (an object is expected)");
    KTG_TRY(read_head(&r->root, r->pattern));
    KTG_TRY(read_mesh(&r->root, r->pattern));
    KTG_TRY(ktg_json_get(&r->root, "pieces", KTG_JSON_ARRAY, &r->pieces));
    KTG_TRY(ktg_json_ids_read(&r->pieces, &r->piece_ids));
    KTG_TRY(ktg_json_get(&r->root, "edges", KTG_JSON_ARRAY, &r->edges));
    KTG_TRY(ktg_json_ids_read(&r->edges, &r->edge_ids));
    KTG_TRY(ktg_json_read_pieces(r));
    KTG_TRY(read_components(r));
    KTG_TRY(read_edges(r));
    KTG_TRY(ktg_json_read_seams(r));
    return read_sheets(r);
}

/* jansson quotes the file in its messages; what cannot be shown becomes a question mark. */
static ktg_status parse(ktg_context *context, const char *path, const char *bytes, size_t size,
                        json_t **root) {
    json_error_t error;
    *root = json_loadb(bytes, size, JSON_REJECT_DUPLICATES, &error);
    if (*root)
        return KTG_OK;
    bool no_place = error.line < 0; /* it did not come as far as the first character */
    if (no_place || json_error_code(&error) == json_error_out_of_memory)
        return ktg_fail(context, KTG_MEMORY, "%s: out of memory", path);
    for (char *c = error.text; *c; c++)
        if (*c < ' ' || *c > '~')
            *c = '?';
    return ktg_fail(context, KTG_FORMAT, "%s:%d: is no JSON: %s", path, error.line, error.text);
}

ktg_status ktg_pattern_read_json(ktg_context *context, const char *path, ktg_pattern **pattern) {
    char *bytes = NULL;
    size_t size = 0;
    json_t *root = NULL;
    ktg_json_reader r = {0};
    *pattern = NULL;
    ktg_status status = ktg_file_read(context, path, MOST_BYTES, &bytes, &size);
    if (status == KTG_OK)
        status = parse(context, path, bytes, size, &root);
    ktg_free(bytes);
    if (status == KTG_OK) {
        r.root = (ktg_json){.context = context, .path = path, .value = root};
        r.pattern = ktg_new(context, 1, ktg_pattern);
        status = r.pattern ? read_pattern(&r) : KTG_MEMORY;
    }
    ktg_json_ids_free(&r.piece_ids);
    ktg_json_ids_free(&r.edge_ids);
    json_decref(root);
    if (status == KTG_OK)
        *pattern = r.pattern;
    else
        ktg_pattern_free(&r.pattern);
    return status;
}
