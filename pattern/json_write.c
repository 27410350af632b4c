/* pattern/json_write.c - writing a pattern as JSON (docs/pattern-json.md). */
#include "core/memory.h"
#include "core/vec.h"
#include "pattern/json_put.h"
#include "pattern/json_words.h"
#include "pattern/pattern.h"

#include <locale.h>
#include <string.h>

static void write_head(ktg_json_writer *w, const ktg_pattern *p) {
    ktg_json_put(
        w, "{\"format\":\"katagami-pattern\",\n\"version\":1,\n\"units\":\"mm\",\n\"mode\":\"");
    ktg_json_put(w, ktg_json_modes[p->mode]);
    ktg_json_put(w, "\",\n\"model\":{\"file\":");
    ktg_json_put_text(w, p->model_file);
    ktg_json_put(w, ",\"faces\":");
    ktg_json_put_count(w, p->model_faces);
    ktg_json_put(w, ",\"mm_per_unit\":");
    ktg_json_put_number(w, p->mm_per_unit);
    ktg_json_put(w, p->simplified ? ",\"simplified\":true" : ",\"simplified\":false");
    for (size_t i = 0; i < p->omitted_count; i++) {
        ktg_json_put(w, i ? "," : ",\"omitted\":[");
        ktg_json_put_text(w, p->omitted[i]);
    }
    ktg_json_put(w, p->omitted_count ? "]},\n" : "},\n");
}

static void write_mesh(ktg_json_writer *w, const ktg_pattern *p) {
    ktg_json_put(w, "\"mesh\":{\"vertices\":[");
    for (size_t i = 0; i < p->vertex_count; i++) {
        ktg_json_between(w, i, ",");
        ktg_json_put(w, "[");
        ktg_json_put_number(w, p->vertices[i].x);
        ktg_json_put(w, ",");
        ktg_json_put_number(w, p->vertices[i].y);
        ktg_json_put(w, ",");
        ktg_json_put_number(w, p->vertices[i].z);
        ktg_json_put(w, "]");
    }
    ktg_json_put(w, "],\n\"faces\":[");
    for (size_t i = 0; i < p->face_count; i++) {
        ktg_json_between(w, i, ",");
        ktg_json_put_triple(w, p->faces + 3 * i);
    }
    ktg_json_put(w, "]");
    if (p->face_strain)
        ktg_json_put(w, ",\n\"face_strain\":[");
    for (size_t i = 0; p->face_strain && i < p->face_count; i++) {
        ktg_json_between(w, i, ",");
        ktg_json_put_number(w, p->face_strain[i]);
    }
    ktg_json_put(w, p->face_strain ? "]},\n" : "},\n");
}

/* One pass over the pieces: which belong to which component. `next` chains the pieces of one. */
static void write_components(ktg_json_writer *w, const ktg_pattern *p, const uint32_t *first,
                             const uint32_t *next) {
    ktg_json_put(w, "\"components\":[");
    for (size_t i = 0; i < p->component_count; i++) {
        ktg_json_between(w, i, ",\n");
        ktg_json_put(w, "{\"id\":");
        ktg_json_put_count(w, i + 1);
        ktg_json_put(w, ",\"name\":");
        ktg_json_put_text(w, p->components[i].name);
        ktg_json_put(w, ",\"pieces\":[");
        for (uint32_t piece = first[i]; piece != KTG_NONE; piece = next[piece]) {
            ktg_json_between(w, piece != first[i], ",");
            ktg_json_put_count(w, (size_t)piece + 1);
        }
        ktg_json_put(w, "]}");
    }
    ktg_json_put(w, "],\n");
}

static void write_tabs(ktg_json_writer *w, const ktg_pattern_piece *piece) {
    ktg_json_put(w, ",\n \"tabs\":[");
    for (size_t i = 0; i < piece->tab_count; i++) {
        const ktg_pattern_tab *tab = &piece->tabs[i];
        ktg_json_between(w, i, ",");
        ktg_json_put(w, "{\"edge\":");
        ktg_json_put_count(w, (size_t)tab->edge + 1);
        ktg_json_put(w, ",\"size\":\"");
        ktg_json_put(w, ktg_json_tab_sizes[tab->size]);
        ktg_json_put(w, "\",\"polygon\":");
        ktg_json_put_points(w, tab->corners, tab->corner_count);
        ktg_json_put(w, "}");
    }
    ktg_json_put(w, "],\n \"lines\":[");
    for (size_t i = 0; i < piece->line_count; i++) {
        ktg_json_between(w, i, ",");
        ktg_json_put(w, "{\"kind\":\"");
        ktg_json_put(w, ktg_json_line_kinds[piece->lines[i].kind]);
        ktg_json_put(w, "\",\"points\":");
        ktg_json_put_points(w, piece->lines[i].points, piece->lines[i].point_count);
        ktg_json_put(w, "}");
    }
    ktg_json_put(w, "]");
}

static void write_labels(ktg_json_writer *w, const ktg_pattern_piece *piece) {
    ktg_json_put(w, ",\n \"labels\":[");
    for (size_t i = 0; i < piece->label_count; i++) {
        const ktg_pattern_label *label = &piece->labels[i];
        ktg_json_between(w, i, ",");
        ktg_json_put(w, "{\"text\":");
        ktg_json_put_text(w, label->text);
        ktg_json_put(w, ",\"x\":");
        ktg_json_put_number(w, label->at.x);
        ktg_json_put(w, ",\"y\":");
        ktg_json_put_number(w, label->at.y);
        ktg_json_put(w, ",\"rotation_deg\":");
        ktg_json_put_degrees(w, label->rotation);
        ktg_json_put(w, ",\"height_mm\":");
        ktg_json_put_number(w, label->height_mm);
        ktg_json_put(w, ",\"edge\":");
        if (label->edge == KTG_NONE)
            ktg_json_put(w, "null");
        else
            ktg_json_put_count(w, (size_t)label->edge + 1);
        if (label->leader) {
            ktg_json_put(w, ",\"leader\":");
            ktg_json_put_point(w, label->foot);
        }
        ktg_json_put(w, "}");
    }
    ktg_json_put(w, "]");
}

static void write_piece(ktg_json_writer *w, const ktg_pattern_piece *piece, size_t id) {
    ktg_json_put(w, "{\"id\":");
    ktg_json_put_count(w, id);
    ktg_json_put(w, ",\"name\":");
    ktg_json_put_text(w, piece->name);
    ktg_json_put(w, ",\n \"vertices\":");
    ktg_json_put_points(w, piece->vertices, piece->vertex_count);
    ktg_json_put(w, ",\n \"faces\":[");
    for (size_t i = 0; i < piece->face_count; i++) {
        ktg_json_between(w, i, ",");
        ktg_json_put(w, "{\"face\":");
        ktg_json_put_count(w, piece->faces[i]);
        ktg_json_put(w, ",\"corners\":");
        ktg_json_put_triple(w, piece->corners + 3 * i);
        ktg_json_put(w, "}");
    }
    ktg_json_put(w, "],\n \"outline\":");
    ktg_json_put_points(w, piece->outline, piece->outline ? piece->outline_count : 0);
    write_tabs(w, piece);
    write_labels(w, piece);
    ktg_json_put(w, ",\n \"cut\":{\"count\":");
    ktg_json_put_count(w, piece->cut_count);
    ktg_json_put(w, ",\"mirrored\":");
    ktg_json_put_count(w, piece->cut_mirrored);
    if (piece->cut_count == 0) {
        ktg_json_put(w, ",\"twin_of\":");
        ktg_json_put_count(w, (size_t)piece->twin_of + 1);
    }
    ktg_json_put(w, piece->on_fold ? ",\"on_fold\":true}}" : "}}");
}

static void write_pieces(ktg_json_writer *w, const ktg_pattern *p) {
    ktg_json_put(w, "\"pieces\":[");
    for (size_t i = 0; i < p->piece_count; i++) {
        ktg_json_between(w, i, ",\n");
        write_piece(w, &p->pieces[i], i + 1);
    }
    ktg_json_put(w, "],\n");
}

static void write_edge(ktg_json_writer *w, const ktg_pattern_edge *edge, size_t id) {
    ktg_json_put(w, "{\"id\":");
    ktg_json_put_count(w, id);
    ktg_json_put(w, ",\"vertices\":[");
    ktg_json_put_count(w, edge->vertices[0]);
    ktg_json_put(w, ",");
    ktg_json_put_count(w, edge->vertices[1]);
    ktg_json_put(w, "],\"kind\":\"");
    ktg_json_put(w, ktg_json_edge_kinds[edge->kind]);
    ktg_json_put(w, "\",\"angle_deg\":");
    ktg_json_put_degrees(w, edge->angle);
    ktg_json_put(w, ",\"sides\":[");
    for (uint32_t s = 0; s < edge->side_count; s++) {
        ktg_json_put(w, s ? ",{\"piece\":" : "{\"piece\":");
        ktg_json_put_count(w, (size_t)edge->sides[s].piece + 1);
        ktg_json_put(w, ",\"face\":");
        ktg_json_put_count(w, edge->sides[s].face);
        ktg_json_put(w, ",\"corner\":");
        ktg_json_put_count(w, edge->sides[s].corner);
        ktg_json_put(w, "}");
    }
    ktg_json_put(w, "],\"tab_on\":");
    ktg_json_put(w, edge->tab_on < 0 ? "null" : edge->tab_on == 0 ? "0" : "1");
    ktg_json_put(w, edge->forced ? ",\"forced\":true}" : "}");
}

static void write_edges(ktg_json_writer *w, const ktg_pattern *p) {
    ktg_json_put(w, "\"edges\":[");
    for (size_t i = 0; i < p->edge_count; i++) {
        ktg_json_between(w, i, ",\n");
        write_edge(w, &p->edges[i], i + 1);
    }
    ktg_json_put(w, "],\n");
}

static void write_notches(ktg_json_writer *w, const ktg_pattern_seam *seam) {
    ktg_json_put(w, ",\"notches\":[");
    for (size_t i = 0; i < seam->notch_count; i++) {
        ktg_json_put(w, i ? ",{\"at\":" : "{\"at\":");
        ktg_json_put_number(w, seam->notches[i].at);
        ktg_json_put(w, ",\"marks\":");
        ktg_json_put_count(w, seam->notches[i].marks);
        ktg_json_put(w, "}");
    }
    ktg_json_put(w, "]");
}

static void write_seam(ktg_json_writer *w, const ktg_pattern_seam *seam, size_t id) {
    ktg_json_put(w, "{\"id\":");
    ktg_json_put_count(w, id);
    ktg_json_put(w, ",\"sides\":[");
    for (int s = 0; s < 2; s++) {
        ktg_json_put(w, s ? ",{\"piece\":" : "{\"piece\":");
        ktg_json_put_count(w, (size_t)seam->pieces[s] + 1);
        ktg_json_put(w, ",\"edges\":[");
        for (uint32_t i = 0; i < seam->edge_count; i++) {
            ktg_json_between(w, i, ",");
            ktg_json_put_count(w, (size_t)seam->edges[i] + 1);
        }
        ktg_json_put(w, "],\"length_mm\":");
        ktg_json_put_number(w, seam->lengths_mm[s]);
        ktg_json_put(w, "}");
    }
    ktg_json_put(w, "],\"first_side\":[");
    for (uint32_t i = 0; i < seam->edge_count; i++) {
        ktg_json_between(w, i, ",");
        ktg_json_put(w, seam->first_side[i] ? "1" : "0");
    }
    ktg_json_put(w, seam->obvious ? "],\"obvious\":true" : "]");
    ktg_json_put(w, seam->dart ? ",\"dart\":true" : "");
    if (seam->number != id) {
        ktg_json_put(w, ",\"number\":");
        ktg_json_put_count(w, seam->number);
    }
    if (seam->section > 0) {
        ktg_json_put(w, ",\"section\":");
        ktg_json_put_count(w, seam->section);
    }
    ktg_json_put(w, seam->closing ? ",\"closing\":true" : "");
    if (seam->notch_count > 0)
        write_notches(w, seam);
    ktg_json_put(w, "}");
}

static void write_seams(ktg_json_writer *w, const ktg_pattern *p) {
    ktg_json_put(w, "\"seams\":[");
    for (size_t i = 0; i < p->seam_count; i++) {
        ktg_json_between(w, i, ",\n");
        write_seam(w, &p->seams[i], i + 1);
    }
    ktg_json_put(w, "],\n");
}

/* Where a tile is in its poster, all counted from 1. */
static void write_tile(ktg_json_writer *w, const ktg_pattern_sheet *sheet) {
    ktg_json_put(w, ",\"tile\":{\"poster\":");
    ktg_json_put_count(w, sheet->poster);
    ktg_json_put(w, ",\"row\":");
    ktg_json_put_count(w, (size_t)sheet->row + 1);
    ktg_json_put(w, ",\"column\":");
    ktg_json_put_count(w, (size_t)sheet->column + 1);
    ktg_json_put(w, "}");
}

static void write_sheet(ktg_json_writer *w, const ktg_pattern_sheet *sheet, size_t id) {
    ktg_json_put(w, "{\"id\":");
    ktg_json_put_count(w, id);
    ktg_json_put(w, ",\"kind\":\"");
    ktg_json_put(w, ktg_json_sheet_kinds[sheet->kind]);
    ktg_json_put(w, "\",\"width\":");
    ktg_json_put_number(w, sheet->width_mm);
    ktg_json_put(w, ",\"height\":");
    ktg_json_put_number(w, sheet->height_mm);
    for (int k = 0; k < 4; k++) {
        ktg_json_put(w, k ? "," : ",\"printable\":[");
        ktg_json_put_number(w, sheet->printable[k]);
    }
    ktg_json_put(w, "]");
    if (sheet->poster > 0)
        write_tile(w, sheet);
    ktg_json_put(w, ",\"placements\":[");
    for (size_t i = 0; i < sheet->placement_count; i++) {
        const ktg_pattern_placement *placement = &sheet->placements[i];
        ktg_json_put(w, i ? ",{\"piece\":" : "{\"piece\":");
        ktg_json_put_count(w, (size_t)placement->piece + 1);
        ktg_json_put(w, ",\"x\":");
        ktg_json_put_number(w, placement->x);
        ktg_json_put(w, ",\"y\":");
        ktg_json_put_number(w, placement->y);
        ktg_json_put(w, ",\"rotation_deg\":");
        ktg_json_put_degrees(w, placement->rotation);
        ktg_json_put(w, "}");
    }
    ktg_json_put(w, "]}");
}

static void write_sheets(ktg_json_writer *w, const ktg_pattern *p) {
    ktg_json_put(w, "\"sheets\":[");
    for (size_t i = 0; i < p->sheet_count; i++) {
        ktg_json_between(w, i, ",\n");
        write_sheet(w, &p->sheets[i], i + 1);
    }
    ktg_json_put(w, "]}\n");
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
static void write_all(ktg_json_writer *w, const ktg_pattern *p, const uint32_t *first,
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
    ktg_json_flush(w);
    uselocale(before);
    freelocale(plain);
}

ktg_status ktg_pattern_write_json(ktg_context *context, const ktg_pattern *pattern,
                                  ktg_output *output) {
    uint32_t *first = NULL, *next = NULL;
    ktg_json_writer *w = ktg_new(context, 1, ktg_json_writer);
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
