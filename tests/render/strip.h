/* A pattern made by hand for the tests of rendering: pieces of three squares in a row, a mountain
 * and a valley fold between them, a glue tab at the right end. */
#ifndef KTG_TESTS_RENDER_STRIP_H
#define KTG_TESTS_RENDER_STRIP_H

#include "core/file.h"
#include "core/memory.h"
#include "core/vec.h"
#include "render/render.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define SIDE_MM 40.0

static void add_label(ktg_pattern_piece *piece, const char *text, double x, double y,
                      double rotation, uint32_t edge) {
    ktg_pattern_label *label = &piece->labels[piece->label_count++];
    snprintf(label->text, sizeof label->text, "%s", text);
    label->at = (ktg_vec2){x, y};
    label->rotation = rotation;
    label->height_mm = 2.4;
    label->edge = edge;
}

static void fill_strip(ktg_context *context, ktg_pattern *pattern, uint32_t index) {
    static const ktg_vec2 outline[] = {{0, 0},    {80, 0},   {120, 0}, {125, 5},
                                       {125, 35}, {120, 40}, {0, 40}};
    static const ktg_vec2 tab[] = {{120, 0}, {125, 5}, {125, 35}, {120, 40}};
    ktg_pattern_piece *piece = &pattern->pieces[index];
    piece->name = ktg_copy_text(context, "strip", 5);
    piece->cut_count = 1;
    piece->vertex_count = 8;
    piece->vertices = ktg_new(context, 8, ktg_vec2);
    for (int i = 0; i < 8; i++) {
        piece->vertices[i] = (ktg_vec2){SIDE_MM * (i / 2), SIDE_MM * (i % 2)};
        pattern->vertices[8 * index + (uint32_t)i] =
            (ktg_vec3){piece->vertices[i].x, piece->vertices[i].y, 10 * (i / 4)};
    }
    piece->face_count = 6;
    piece->faces = ktg_new(context, 6, uint32_t);
    piece->corners = ktg_new(context, 18, uint32_t);
    for (uint32_t s = 0; s < 3; s++) {
        uint32_t corners[] = {2 * s, 2 * s + 2, 2 * s + 3, 2 * s, 2 * s + 3, 2 * s + 1};
        for (uint32_t k = 0; k < 6; k++) {
            piece->corners[6 * s + k] = corners[k];
            pattern->faces[18 * index + 6 * s + k] = 8 * index + corners[k];
        }
        piece->faces[2 * s] = 6 * index + 2 * s;
        piece->faces[2 * s + 1] = 6 * index + 2 * s + 1;
    }
    piece->outline_count = 7;
    piece->outline = ktg_copy_array(context, outline, 7, sizeof *outline);
    piece->tab_count = 1;
    piece->tabs = ktg_new(context, 1, ktg_pattern_tab);
    piece->tabs[0].edge = 3 * index + 2;
    piece->tabs[0].corner_count = 4;
    memcpy(piece->tabs[0].corners, tab, sizeof tab);
    piece->labels = ktg_new(context, 4, ktg_pattern_label);
    add_label(piece, "127", 122.5, 20, -KTG_PI / 2, 3 * index + 2);
    add_label(piece, "66.", 3, 20, KTG_PI, 3 * index + 2);
    add_label(piece, "W\xc3\xbcrfel", 60, 10, 0, KTG_NONE);
}

/* Edges 3i and 3i + 1 are the folds of piece i, 3i + 2 is the seam of its ends. */
static void fill_edges(ktg_pattern *pattern, uint32_t index) {
    static const uint32_t sides[3][4] = {{0, 1, 3, 2}, {2, 1, 5, 2}, {4, 1, 1, 2}};
    static const double angles[] = {1.2, -0.8, 0.9};
    for (uint32_t k = 0; k < 3; k++) {
        ktg_pattern_edge *edge = &pattern->edges[3 * index + k];
        edge->vertices[0] = 8 * index + 2 * k + 2;
        edge->vertices[1] = 8 * index + 2 * k + 3;
        edge->kind = k == 0 ? KTG_EDGE_MOUNTAIN : k == 1 ? KTG_EDGE_VALLEY : KTG_EDGE_CUT;
        edge->angle = angles[k];
        edge->side_count = 2;
        edge->sides[0] = (ktg_pattern_side){index, 6 * index + sides[k][0], sides[k][1]};
        edge->sides[1] = (ktg_pattern_side){index, 6 * index + sides[k][2], sides[k][3]};
        edge->tab_on = k == 2 ? 0 : -1;
        edge->seam = KTG_NONE;
    }
}

/* `count` strips, the i-th on sheet i with its lower left corner at (x, y). */
static ktg_pattern *make_strips(ktg_context *context, uint32_t count, double width, double height,
                                double margin, double x, double y) {
    ktg_pattern *pattern = ktg_new(context, 1, ktg_pattern);
    pattern->model_file = ktg_copy_text(context, "strip.obj", 9);
    pattern->mm_per_unit = 12.5;
    pattern->vertex_count = 8 * count;
    pattern->vertices = ktg_new(context, 8 * count, ktg_vec3);
    pattern->face_count = 6 * count;
    pattern->faces = ktg_new(context, 18 * (size_t)count, uint32_t);
    pattern->edge_count = 3 * count;
    pattern->edges = ktg_new(context, 3 * (size_t)count, ktg_pattern_edge);
    pattern->piece_count = count;
    pattern->pieces = ktg_new(context, count, ktg_pattern_piece);
    pattern->sheet_count = count;
    pattern->sheets = ktg_new(context, count, ktg_pattern_sheet);
    for (uint32_t i = 0; i < count; i++) {
        fill_strip(context, pattern, i);
        fill_edges(pattern, i);
        pattern->sheets[i] = (ktg_pattern_sheet){
            KTG_SHEET, width, height, {margin, margin, width - margin, height - margin}, 1, NULL};
        pattern->sheets[i].placements = ktg_new(context, 1, ktg_pattern_placement);
        pattern->sheets[i].placements[0] = (ktg_pattern_placement){i, x, y, 0};
    }
    return pattern;
}

/* Renders into memory: "pdf", "astm" or "contact", or "svg", "dxf" or "png" of one sheet. Free
 * *bytes with ktg_free. */
static ktg_status render_bytes(ktg_context *context, const ktg_pattern *pattern, const char *kind,
                               size_t sheet, const ktg_render_options *options, char **bytes,
                               size_t *size) {
    char path[] = "/tmp/ktg-render-XXXXXX";
    ktg_output *output = NULL;
    *bytes = NULL;
    *size = 0;
    close(mkstemp(path));
    ktg_status status = ktg_output_open(context, path, &output);
    if (status == KTG_OK)
        status =
            strcmp(kind, "pdf") == 0       ? ktg_render_pdf(context, pattern, options, output)
            : strcmp(kind, "contact") == 0 ? ktg_render_contact(context, pattern, options, output)
            : strcmp(kind, "svg") == 0  ? ktg_render_svg(context, pattern, sheet, options, output)
            : strcmp(kind, "dxf") == 0  ? ktg_render_dxf(context, pattern, sheet, options, output)
            : strcmp(kind, "astm") == 0 ? ktg_render_astm(context, pattern, options, output)
                                        : ktg_render_png(context, pattern, sheet, options, output);
    if (status == KTG_OK)
        status = ktg_output_commit(context, &output);
    ktg_output_discard(&output);
    if (status == KTG_OK)
        status = ktg_file_read(context, path, SIZE_MAX / 4, bytes, size);
    unlink(path);
    return status;
}

#endif
