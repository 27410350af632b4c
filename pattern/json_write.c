/* pattern/json_write.c - writing a pattern as JSON (docs/pattern-json.md).
 *
 * The text is put together here, item by item, so that a pattern of any size needs one buffer and
 * every number has the shorter of two exact forms; jansson writes the strings. */
#include "core/memory.h"
#include "core/vec.h"
#include "pattern/json_words.h"
#include "pattern/pattern.h"

#include <jansson.h>
#include <locale.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BUFFER_SIZE 65536
#define MOST_NUMBER 64 /* bytes of one formatted number */

/* The first failure stays in `status`; after it nothing more is written. */
typedef struct writer {
    ktg_context *context;
    ktg_output *output;
    ktg_status status;
    size_t length;
    char text[BUFFER_SIZE];
} writer;

static void flush(writer *w) {
    if (w->status == KTG_OK)
        w->status = ktg_output_write(w->context, w->output, w->text, w->length);
    w->length = 0;
}

static void put_bytes(writer *w, const char *text, size_t length) {
    while (length > 0) {
        if (w->length == BUFFER_SIZE)
            flush(w);
        size_t part = BUFFER_SIZE - w->length < length ? BUFFER_SIZE - w->length : length;
        memcpy(w->text + w->length, text, part);
        w->length += part;
        text += part;
        length -= part;
    }
}

static void put(writer *w, const char *text) {
    put_bytes(w, text, strlen(text));
}

/* Between items: the separator, except before the first. */
static void between(writer *w, size_t index, const char *separator) {
    if (index > 0)
        put(w, separator);
}

static void count(writer *w, size_t value) {
    char text[MOST_NUMBER];
    put_bytes(w, text, (size_t)snprintf(text, sizeof text, "%zu", value));
}

/* Fifteen digits where they read back to the same double, else seventeen, which always do. */
static void number(writer *w, double value) {
    char text[MOST_NUMBER];
    if (!isfinite(value)) {
        if (w->status == KTG_OK)
            w->status = ktg_fail(w->context, KTG_ARGUMENT,
                                 "the pattern holds a number that is not finite; it has no JSON "
                                 "form");
        return;
    }
    if (value == 0) {
        put(w, signbit(value) ? "-0.0" : "0");
        return;
    }
    int length = snprintf(text, sizeof text, "%.15g", value);
    if (strtod(text, NULL) != value)
        length = snprintf(text, sizeof text, "%.17g", value);
    put_bytes(w, text, (size_t)length);
}

/* An angle in degrees: of the doubles around it one that reads back to the same radians, a short
 * one (60, not 59.99999999999999) if there is one, so that a pattern read and written again does
 * not drift. */
static void degrees(writer *w, double radians) {
    char text[MOST_NUMBER];
    double near = ktg_json_degrees(radians), best = near;
    snprintf(text, sizeof text, "%.15g", near);
    double tries[4] = {strtod(text, NULL), near, nextafter(near, -INFINITY),
                       nextafter(near, INFINITY)};
    for (int i = 3; i >= 0; i--)
        if (ktg_json_radians(tries[i]) == radians)
            best = tries[i];
    number(w, best);
}

static void point(writer *w, ktg_vec2 p) {
    put(w, "[");
    number(w, p.x);
    put(w, ",");
    number(w, p.y);
    put(w, "]");
}

static void points(writer *w, const ktg_vec2 *list, size_t list_count) {
    put(w, "[");
    for (size_t i = 0; i < list_count; i++) {
        between(w, i, ",");
        point(w, list[i]);
    }
    put(w, "]");
}

/* Three indices as [a,b,c]. */
static void triple(writer *w, const uint32_t *values) {
    for (int k = 0; k < 3; k++) {
        put(w, k ? "," : "[");
        count(w, values[k]);
    }
    put(w, "]");
}

/* A JSON string; bytes that are no UTF-8 (old file names) become question marks. NULL: null. */
static void text_value(writer *w, const char *text) {
    if (!text) {
        put(w, "null");
        return;
    }
    json_t *value = json_string(text);
    char *plain = value ? NULL : ktg_copy_text(w->context, text, SIZE_MAX);
    for (char *c = plain; c && *c; c++)
        if ((unsigned char)*c >= 0x80)
            *c = '?';
    if (plain)
        value = json_string(plain);
    char *written = value ? json_dumps(value, JSON_ENCODE_ANY) : NULL;
    if (written)
        put(w, written);
    else if (w->status == KTG_OK)
        w->status = ktg_fail(w->context, KTG_MEMORY, "out of memory (a name of the pattern)");
    free(written); /* jansson's own */
    json_decref(value);
    ktg_free(plain);
}

static void write_head(writer *w, const ktg_pattern *p) {
    put(w, "{\"format\":\"katagami-pattern\",\n\"version\":1,\n\"units\":\"mm\",\n\"mode\":\"");
    put(w, ktg_json_modes[p->mode]);
    put(w, "\",\n\"model\":{\"file\":");
    text_value(w, p->model_file);
    put(w, ",\"faces\":");
    count(w, p->model_faces);
    put(w, ",\"mm_per_unit\":");
    number(w, p->mm_per_unit);
    put(w, p->simplified ? ",\"simplified\":true" : ",\"simplified\":false");
    for (size_t i = 0; i < p->omitted_count; i++) {
        put(w, i ? "," : ",\"omitted\":[");
        text_value(w, p->omitted[i]);
    }
    put(w, p->omitted_count ? "]},\n" : "},\n");
}

static void write_mesh(writer *w, const ktg_pattern *p) {
    put(w, "\"mesh\":{\"vertices\":[");
    for (size_t i = 0; i < p->vertex_count; i++) {
        between(w, i, ",");
        put(w, "[");
        number(w, p->vertices[i].x);
        put(w, ",");
        number(w, p->vertices[i].y);
        put(w, ",");
        number(w, p->vertices[i].z);
        put(w, "]");
    }
    put(w, "],\n\"faces\":[");
    for (size_t i = 0; i < p->face_count; i++) {
        between(w, i, ",");
        triple(w, p->faces + 3 * i);
    }
    put(w, "]");
    if (p->face_strain)
        put(w, ",\n\"face_strain\":[");
    for (size_t i = 0; p->face_strain && i < p->face_count; i++) {
        between(w, i, ",");
        number(w, p->face_strain[i]);
    }
    put(w, p->face_strain ? "]},\n" : "},\n");
}

/* One pass over the pieces: which belong to which component. `next` chains the pieces of one. */
static void write_components(writer *w, const ktg_pattern *p, const uint32_t *first,
                             const uint32_t *next) {
    put(w, "\"components\":[");
    for (size_t i = 0; i < p->component_count; i++) {
        between(w, i, ",\n");
        put(w, "{\"id\":");
        count(w, i + 1);
        put(w, ",\"name\":");
        text_value(w, p->components[i].name);
        put(w, ",\"pieces\":[");
        for (uint32_t piece = first[i]; piece != KTG_NONE; piece = next[piece]) {
            between(w, piece != first[i], ",");
            count(w, (size_t)piece + 1);
        }
        put(w, "]}");
    }
    put(w, "],\n");
}

static void write_tabs(writer *w, const ktg_pattern_piece *piece) {
    put(w, ",\n \"tabs\":[");
    for (size_t i = 0; i < piece->tab_count; i++) {
        const ktg_pattern_tab *tab = &piece->tabs[i];
        between(w, i, ",");
        put(w, "{\"edge\":");
        count(w, (size_t)tab->edge + 1);
        put(w, ",\"size\":\"");
        put(w, ktg_json_tab_sizes[tab->size]);
        put(w, "\",\"polygon\":");
        points(w, tab->corners, tab->corner_count);
        put(w, "}");
    }
    put(w, "],\n \"lines\":[");
    for (size_t i = 0; i < piece->line_count; i++) {
        between(w, i, ",");
        put(w, "{\"kind\":\"");
        put(w, ktg_json_line_kinds[piece->lines[i].kind]);
        put(w, "\",\"points\":");
        points(w, piece->lines[i].points, piece->lines[i].point_count);
        put(w, "}");
    }
    put(w, "]");
}

static void write_labels(writer *w, const ktg_pattern_piece *piece) {
    put(w, ",\n \"labels\":[");
    for (size_t i = 0; i < piece->label_count; i++) {
        const ktg_pattern_label *label = &piece->labels[i];
        between(w, i, ",");
        put(w, "{\"text\":");
        text_value(w, label->text);
        put(w, ",\"x\":");
        number(w, label->at.x);
        put(w, ",\"y\":");
        number(w, label->at.y);
        put(w, ",\"rotation_deg\":");
        degrees(w, label->rotation);
        put(w, ",\"height_mm\":");
        number(w, label->height_mm);
        put(w, ",\"edge\":");
        if (label->edge == KTG_NONE)
            put(w, "null");
        else
            count(w, (size_t)label->edge + 1);
        if (label->leader) {
            put(w, ",\"leader\":");
            point(w, label->foot);
        }
        put(w, "}");
    }
    put(w, "]");
}

static void write_piece(writer *w, const ktg_pattern_piece *piece, size_t id) {
    put(w, "{\"id\":");
    count(w, id);
    put(w, ",\"name\":");
    text_value(w, piece->name);
    put(w, ",\n \"vertices\":");
    points(w, piece->vertices, piece->vertex_count);
    put(w, ",\n \"faces\":[");
    for (size_t i = 0; i < piece->face_count; i++) {
        between(w, i, ",");
        put(w, "{\"face\":");
        count(w, piece->faces[i]);
        put(w, ",\"corners\":");
        triple(w, piece->corners + 3 * i);
        put(w, "}");
    }
    put(w, "],\n \"outline\":");
    points(w, piece->outline, piece->outline ? piece->outline_count : 0);
    write_tabs(w, piece);
    write_labels(w, piece);
    put(w, ",\n \"cut\":{\"count\":");
    count(w, piece->cut_count);
    put(w, ",\"mirrored\":");
    count(w, piece->cut_mirrored);
    if (piece->cut_count == 0) {
        put(w, ",\"twin_of\":");
        count(w, (size_t)piece->twin_of + 1);
    }
    put(w, piece->on_fold ? ",\"on_fold\":true}}" : "}}");
}

static void write_pieces(writer *w, const ktg_pattern *p) {
    put(w, "\"pieces\":[");
    for (size_t i = 0; i < p->piece_count; i++) {
        between(w, i, ",\n");
        write_piece(w, &p->pieces[i], i + 1);
    }
    put(w, "],\n");
}

static void write_edge(writer *w, const ktg_pattern_edge *edge, size_t id) {
    put(w, "{\"id\":");
    count(w, id);
    put(w, ",\"vertices\":[");
    count(w, edge->vertices[0]);
    put(w, ",");
    count(w, edge->vertices[1]);
    put(w, "],\"kind\":\"");
    put(w, ktg_json_edge_kinds[edge->kind]);
    put(w, "\",\"angle_deg\":");
    degrees(w, edge->angle);
    put(w, ",\"sides\":[");
    for (uint32_t s = 0; s < edge->side_count; s++) {
        put(w, s ? ",{\"piece\":" : "{\"piece\":");
        count(w, (size_t)edge->sides[s].piece + 1);
        put(w, ",\"face\":");
        count(w, edge->sides[s].face);
        put(w, ",\"corner\":");
        count(w, edge->sides[s].corner);
        put(w, "}");
    }
    put(w, "],\"tab_on\":");
    put(w, edge->tab_on < 0 ? "null" : edge->tab_on == 0 ? "0" : "1");
    put(w, edge->forced ? ",\"forced\":true}" : "}");
}

static void write_edges(writer *w, const ktg_pattern *p) {
    put(w, "\"edges\":[");
    for (size_t i = 0; i < p->edge_count; i++) {
        between(w, i, ",\n");
        write_edge(w, &p->edges[i], i + 1);
    }
    put(w, "],\n");
}

static void write_notches(writer *w, const ktg_pattern_seam *seam) {
    put(w, ",\"notches\":[");
    for (size_t i = 0; i < seam->notch_count; i++) {
        put(w, i ? ",{\"at\":" : "{\"at\":");
        number(w, seam->notches[i].at);
        put(w, ",\"marks\":");
        count(w, seam->notches[i].marks);
        put(w, "}");
    }
    put(w, "]");
}

static void write_seam(writer *w, const ktg_pattern_seam *seam, size_t id) {
    put(w, "{\"id\":");
    count(w, id);
    put(w, ",\"sides\":[");
    for (int s = 0; s < 2; s++) {
        put(w, s ? ",{\"piece\":" : "{\"piece\":");
        count(w, (size_t)seam->pieces[s] + 1);
        put(w, ",\"edges\":[");
        for (uint32_t i = 0; i < seam->edge_count; i++) {
            between(w, i, ",");
            count(w, (size_t)seam->edges[i] + 1);
        }
        put(w, "],\"length_mm\":");
        number(w, seam->lengths_mm[s]);
        put(w, "}");
    }
    put(w, "],\"first_side\":[");
    for (uint32_t i = 0; i < seam->edge_count; i++) {
        between(w, i, ",");
        put(w, seam->first_side[i] ? "1" : "0");
    }
    put(w, seam->obvious ? "],\"obvious\":true" : "]");
    put(w, seam->dart ? ",\"dart\":true" : "");
    if (seam->number != id) {
        put(w, ",\"number\":");
        count(w, seam->number);
    }
    if (seam->section > 0) {
        put(w, ",\"section\":");
        count(w, seam->section);
    }
    put(w, seam->closing ? ",\"closing\":true" : "");
    if (seam->notch_count > 0)
        write_notches(w, seam);
    put(w, "}");
}

static void write_seams(writer *w, const ktg_pattern *p) {
    put(w, "\"seams\":[");
    for (size_t i = 0; i < p->seam_count; i++) {
        between(w, i, ",\n");
        write_seam(w, &p->seams[i], i + 1);
    }
    put(w, "],\n");
}

/* Where a tile is in its poster, all counted from 1. */
static void write_tile(writer *w, const ktg_pattern_sheet *sheet) {
    put(w, ",\"tile\":{\"poster\":");
    count(w, sheet->poster);
    put(w, ",\"row\":");
    count(w, (size_t)sheet->row + 1);
    put(w, ",\"column\":");
    count(w, (size_t)sheet->column + 1);
    put(w, "}");
}

static void write_sheet(writer *w, const ktg_pattern_sheet *sheet, size_t id) {
    put(w, "{\"id\":");
    count(w, id);
    put(w, ",\"kind\":\"");
    put(w, ktg_json_sheet_kinds[sheet->kind]);
    put(w, "\",\"width\":");
    number(w, sheet->width_mm);
    put(w, ",\"height\":");
    number(w, sheet->height_mm);
    for (int k = 0; k < 4; k++) {
        put(w, k ? "," : ",\"printable\":[");
        number(w, sheet->printable[k]);
    }
    put(w, "]");
    if (sheet->poster > 0)
        write_tile(w, sheet);
    put(w, ",\"placements\":[");
    for (size_t i = 0; i < sheet->placement_count; i++) {
        const ktg_pattern_placement *placement = &sheet->placements[i];
        put(w, i ? ",{\"piece\":" : "{\"piece\":");
        count(w, (size_t)placement->piece + 1);
        put(w, ",\"x\":");
        number(w, placement->x);
        put(w, ",\"y\":");
        number(w, placement->y);
        put(w, ",\"rotation_deg\":");
        degrees(w, placement->rotation);
        put(w, "}");
    }
    put(w, "]}");
}

static void write_sheets(writer *w, const ktg_pattern *p) {
    put(w, "\"sheets\":[");
    for (size_t i = 0; i < p->sheet_count; i++) {
        between(w, i, ",\n");
        write_sheet(w, &p->sheets[i], i + 1);
    }
    put(w, "]}\n");
}

/* first[c] and next[piece] chain the pieces of each component in their order. */
static ktg_status chain_pieces(ktg_context *context, const ktg_pattern *p, uint32_t **first,
                               uint32_t **next) {
    *first = ktg_new(context, p->component_count, uint32_t);
    *next = ktg_new(context, p->piece_count, uint32_t);
    if (!*first || !*next)
        return KTG_MEMORY;
    memset(*first, 0xff, p->component_count * sizeof **first);
    for (size_t i = p->piece_count; i-- > 0;) {
        uint32_t component = p->pieces[i].component;
        if (component >= p->component_count)
            return ktg_fail(context, KTG_ARGUMENT,
                            "piece %zu is of component %u, but there are %zu; it has no JSON form",
                            i + 1, component + 1, p->component_count);
        (*next)[i] = (*first)[component];
        (*first)[component] = (uint32_t)i;
    }
    return KTG_OK;
}

/* Numbers are printed and read back with a point whatever the caller's locale is. */
static void write_all(writer *w, const ktg_pattern *p, const uint32_t *first,
                      const uint32_t *next) {
    locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (plain == (locale_t)0) {
        w->status = ktg_fail(w->context, KTG_MEMORY, "out of memory (locale)");
        return;
    }
    locale_t before = uselocale(plain);
    write_head(w, p);
    write_mesh(w, p);
    write_components(w, p, first, next);
    write_pieces(w, p);
    write_edges(w, p);
    write_seams(w, p);
    write_sheets(w, p);
    flush(w);
    uselocale(before);
    freelocale(plain);
}

ktg_status ktg_pattern_write_json(ktg_context *context, const ktg_pattern *pattern,
                                  ktg_output *output) {
    uint32_t *first = NULL, *next = NULL;
    writer *w = ktg_new(context, 1, writer);
    ktg_status status = w ? chain_pieces(context, pattern, &first, &next) : KTG_MEMORY;
    if (status == KTG_OK) {
        w->context = context;
        w->output = output;
        write_all(w, pattern, first, next);
        status = w->status;
    }
    ktg_free(first);
    ktg_free(next);
    ktg_free(w);
    return status;
}
