/* render/dxf_astm.c - a cloth pattern as DXF for garment CAD, after ASTM D6673-10: one style in one
 * file, a block for each piece, numbers for layers.
 *
 * Some readers (Gerber's) know nothing but what that standard speaks of: there is no header, there
 * are no tables, and every block is a piece. Text is seven bits wide. */
#include "render/dxf.h"

#include "core/memory.h"
#include "render/poster.h"
#include "render/text.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#define BOUNDARY   "1" /* and what is told about style and piece */
#define TURN       "2"
#define CURVE      "3"
#define NOTCH      "4"
#define MIRROR     "6"
#define GRAIN      "7"
#define INTERNAL   "8"
#define SEW        "14"
#define ANNOTATION "15"

#define TURN_ANGLE  (15 * KTG_PI / 180) /* what turns more is a corner, not a curve */
#define TELL_MM     3.0                 /* height of what is told */
#define LINE_FEED   1.6                 /* from line to line, of that */
#define SHEET_GAP   50.0                /* sheets lie side by side */
#define NAME_LENGTH 24                  /* of the 31 that a block's name may have */

/* ---- names -------------------------------------------------------------------------------- */

/* A block's name: capitals, digits and dashes, with the piece's number so that it is unique. */
static void name_block(const ktg_drawing *drawing, uint32_t piece, char name[KTG_NAME_SIZE]) {
    const char *from = drawing->pattern->pieces[piece].name;
    size_t used = 0;
    for (; from && *from && used < NAME_LENGTH; from++)
        if ((unsigned char)*from < 0x80)
            name[used++] =
                isalnum((unsigned char)*from) || *from == '-' ? (char)toupper(*from) : '_';
    snprintf(name + used, KTG_NAME_SIZE - used, "%s%u", used > 0 ? "_" : "PIECE_", piece + 1);
}

/* What a piece is called; its number tells it from others of that name. */
static void name_piece(const ktg_drawing *drawing, uint32_t piece, char name[KTG_NAME_SIZE]) {
    const ktg_pattern *pattern = drawing->pattern;
    const char *own = pattern->pieces[piece].name;
    char clean[KTG_NAME_SIZE - 16];
    bool unique = own && *own;
    for (size_t p = 0; unique && p < pattern->piece_count; p++) {
        const char *other = pattern->pieces[p].name;
        unique = p == piece || !other || strcmp(other, own) != 0;
    }
    ktg_text_clean(own && *own ? own : "piece", SIZE_MAX, clean, sizeof clean);
    if (unique)
        snprintf(name, KTG_NAME_SIZE, "%s", clean);
    else
        snprintf(name, KTG_NAME_SIZE, "%s %u", clean, piece + 1);
}

static void tell_cuts(const ktg_pattern_piece *piece, char text[KTG_NAME_SIZE]) {
    if (piece->on_fold)
        snprintf(text, KTG_NAME_SIZE, "Annotation: cut %u on fold",
                 piece->cut_count + piece->cut_mirrored);
    else if (piece->cut_mirrored > 0)
        snprintf(text, KTG_NAME_SIZE, "Annotation: cut %u and %u mirrored", piece->cut_count,
                 piece->cut_mirrored);
    else
        snprintf(text, KTG_NAME_SIZE, "Annotation: cut %u", piece->cut_count);
}

/* ---- points ------------------------------------------------------------------------------- */

static ktg_status put_point(const ktg_dxf *dxf, const char *layer, ktg_vec2 at) {
    KTG_TRY(ktg_dxf_entity(dxf, "POINT", layer));
    return ktg_dxf_point(dxf, 0, at);
}

static bool turns(ktg_vec2 before, ktg_vec2 at, ktg_vec2 after) {
    ktg_vec2 in = ktg_sub2(at, before), out = ktg_sub2(after, at);
    return fabs(atan2(ktg_cross2(in, out), ktg_dot2(in, out))) > TURN_ANGLE;
}

/* A closed line, and its corners: turn points where it bends, curve points elsewhere. */
static ktg_status put_closed(const ktg_dxf *dxf, const char *layer, const ktg_vec2 *points,
                             size_t count) {
    KTG_TRY(ktg_dxf_way(dxf, layer, NULL, points, count, true));
    for (size_t i = 0; i < count; i++) {
        bool corner = turns(points[(i + count - 1) % count], points[i], points[(i + 1) % count]);
        KTG_TRY(put_point(dxf, corner ? TURN : CURVE, points[i]));
    }
    return KTG_OK;
}

/* An open one: its ends are turn points. */
static ktg_status put_open(const ktg_dxf *dxf, const char *layer, const ktg_vec2 *points,
                           size_t count) {
    KTG_TRY(ktg_dxf_way(dxf, layer, NULL, points, count, false));
    for (size_t i = 0; i < count; i++) {
        bool corner = i == 0 || i + 1 == count || turns(points[i - 1], points[i], points[i + 1]);
        KTG_TRY(put_point(dxf, corner ? TURN : CURVE, points[i]));
    }
    return KTG_OK;
}

/* ---- lines -------------------------------------------------------------------------------- */

static double distance_to_outline(const ktg_pattern_piece *piece, ktg_vec2 p) {
    double least = INFINITY;
    for (size_t i = 0; i < piece->outline_count; i++) {
        ktg_vec2 a = piece->outline[i], b = piece->outline[(i + 1) % piece->outline_count];
        ktg_vec2 way = ktg_sub2(b, a);
        double square = ktg_dot2(way, way);
        double t = square > 0 ? ktg_dot2(way, ktg_sub2(p, a)) / square : 0;
        t = fmin(fmax(t, 0), 1);
        least = fmin(least, ktg_length2(ktg_sub2(p, ktg_madd2(a, t, way))));
    }
    return least;
}

/* A slit notch: a point on the boundary with the way it goes and its depth (as z). */
static ktg_status put_notch(const ktg_dxf *dxf, const ktg_pattern_piece *piece,
                            const ktg_pattern_line *line) {
    ktg_vec2 foot = line->points[0], tip = line->points[line->point_count - 1];
    if (distance_to_outline(piece, tip) < distance_to_outline(piece, foot)) {
        ktg_vec2 other = foot;
        foot = tip;
        tip = other;
    }
    ktg_vec2 way = ktg_sub2(tip, foot);
    KTG_TRY(put_point(dxf, NOTCH, foot));
    KTG_TRY(ktg_dxf_real(dxf, 30, ktg_length2(way)));
    return ktg_dxf_real(dxf, 50, atan2(way.y, way.x) * 180 / KTG_PI);
}

static ktg_status put_line(const ktg_dxf *dxf, const ktg_pattern_piece *piece,
                           const ktg_pattern_line *line) {
    const ktg_vec2 *points = line->points;
    size_t count = line->point_count;
    if (count < 2)
        return KTG_OK;
    bool closed =
        count > 3 && points[0].x == points[count - 1].x && points[0].y == points[count - 1].y;
    const ktg_vec2 ends[] = {points[0], points[count - 1]};
    switch (line->kind) {
    case KTG_LINE_NOTCH:
        return put_notch(dxf, piece, line);
    case KTG_LINE_GRAIN:
        return ktg_dxf_way(dxf, GRAIN, NULL, ends, 2, false);
    case KTG_LINE_FOLD:
        return ktg_dxf_way(dxf, MIRROR, NULL, ends, 2, false);
    case KTG_LINE_SEW:
        return closed ? put_closed(dxf, SEW, points, count - 1) : put_open(dxf, SEW, points, count);
    default:
        return closed ? put_closed(dxf, INTERNAL, points, count - 1)
                      : put_open(dxf, INTERNAL, points, count);
    }
}

/* ---- pieces ------------------------------------------------------------------------------- */

/* What is told about a piece, line by line from the middle of its box. */
static ktg_status tell_piece(const ktg_dxf *dxf, const ktg_drawing *drawing, uint32_t index) {
    const ktg_pattern_piece *piece = &drawing->pattern->pieces[index];
    char lines[4][KTG_NAME_SIZE + 16], name[KTG_NAME_SIZE];
    ktg_vec2 low = piece->outline[0], high = low;
    for (size_t i = 0; i < piece->outline_count; i++) {
        ktg_vec2 p = piece->outline[i];
        low = (ktg_vec2){fmin(low.x, p.x), fmin(low.y, p.y)};
        high = (ktg_vec2){fmax(high.x, p.x), fmax(high.y, p.y)};
    }
    name_piece(drawing, index, name);
    snprintf(lines[0], sizeof *lines, "Piece Name: %s", name);
    snprintf(lines[1], sizeof *lines, "Size: ONE");
    snprintf(lines[2], sizeof *lines, "Quantity: %u,%u", piece->cut_count, piece->cut_mirrored);
    tell_cuts(piece, lines[3]);
    ktg_vec2 at = ktg_mul2(ktg_add2(low, high), 0.5);
    for (int k = 0; k < 4; k++, at.y -= LINE_FEED * TELL_MM)
        KTG_TRY(ktg_dxf_line(dxf, BOUNDARY, at, TELL_MM, lines[k]));
    return KTG_OK;
}

static ktg_status put_labels(const ktg_dxf *dxf, const ktg_pattern_piece *piece) {
    char text[128];
    for (size_t i = 0; i < piece->label_count; i++) {
        const ktg_pattern_label *label = &piece->labels[i];
        ktg_text_clean(label->text, sizeof label->text, text, sizeof text);
        double width = label->height_mm * 0.85 * (double)strlen(text);
        if (*text && label->height_mm > 0)
            KTG_TRY(ktg_dxf_label(dxf, ANNOTATION, label->at, width, label->height_mm,
                                  label->rotation, text));
    }
    return KTG_OK;
}

/* The twin of another piece is cut with it, and has no block. */
static bool has_block(const ktg_drawing *drawing, uint32_t piece) {
    const ktg_pattern_piece *p = &drawing->pattern->pieces[piece];
    return p->outline_count > 0 && p->cut_count > 0;
}

static ktg_status put_block(const ktg_dxf *dxf, const ktg_drawing *drawing, uint32_t index) {
    const ktg_pattern_piece *piece = &drawing->pattern->pieces[index];
    char name[KTG_NAME_SIZE];
    name_block(drawing, index, name);
    KTG_TRY(ktg_dxf_entity(dxf, "BLOCK", "0"));
    KTG_TRY(ktg_dxf_word(dxf, 2, name));
    KTG_TRY(ktg_dxf_integer(dxf, 70, 64));
    KTG_TRY(ktg_dxf_point(dxf, 0, (ktg_vec2){0, 0}));
    KTG_TRY(tell_piece(dxf, drawing, index));
    KTG_TRY(put_closed(dxf, BOUNDARY, piece->outline, piece->outline_count));
    for (size_t i = 0; i < piece->line_count; i++)
        KTG_TRY(put_line(dxf, piece, &piece->lines[i]));
    KTG_TRY(put_labels(dxf, piece));
    return ktg_dxf_entity(dxf, "ENDBLK", "0");
}

/* ---- the file ----------------------------------------------------------------------------- */

static ktg_status put_blocks(const ktg_dxf *dxf, const ktg_drawing *drawing) {
    KTG_TRY(ktg_dxf_section(dxf, "BLOCKS"));
    for (uint32_t p = 0; p < drawing->pattern->piece_count; p++)
        if (has_block(drawing, p))
            KTG_TRY(put_block(dxf, drawing, p));
    return ktg_dxf_word(dxf, 0, "ENDSEC");
}

static ktg_status put_insert(const ktg_dxf *dxf, const ktg_drawing *drawing,
                             const ktg_pattern_placement *at, double right) {
    char name[KTG_NAME_SIZE];
    name_block(drawing, at->piece, name);
    KTG_TRY(ktg_dxf_entity(dxf, "INSERT", BOUNDARY));
    KTG_TRY(ktg_dxf_word(dxf, 2, name));
    KTG_TRY(ktg_dxf_point(dxf, 0, (ktg_vec2){at->x + right, at->y}));
    return ktg_dxf_real(dxf, 50, remainder(at->rotation, 2 * KTG_PI) * 180 / KTG_PI);
}

/* Where the pieces lie on their sheets, side by side; of a poster's tiles only the first counts. */
static ktg_status put_inserts(const ktg_dxf *dxf, const ktg_drawing *drawing) {
    const ktg_pattern *pattern = drawing->pattern;
    double right = 0;
    for (size_t s = 0; s < pattern->sheet_count; s++) {
        const ktg_pattern_sheet *sheet = &pattern->sheets[s];
        if (s > 0 && ktg_is_tile(sheet) && sheet->poster == pattern->sheets[s - 1].poster)
            continue;
        for (size_t i = 0; i < sheet->placement_count; i++)
            if (has_block(drawing, sheet->placements[i].piece))
                KTG_TRY(put_insert(dxf, drawing, &sheet->placements[i], right));
        right += sheet->width_mm + SHEET_GAP;
    }
    return KTG_OK;
}

static ktg_status tell_style(const ktg_dxf *dxf, const ktg_drawing *drawing) {
    char lines[6][KTG_TITLE_SIZE + 16];
    snprintf(lines[0], sizeof *lines, "Style Name: %s", drawing->title);
    snprintf(lines[1], sizeof *lines, "Author: Katagami");
    snprintf(lines[2], sizeof *lines, "Product: Katagami");
    snprintf(lines[3], sizeof *lines, "Version: %s", ktg_version());
    snprintf(lines[4], sizeof *lines, "Sample Size: ONE");
    snprintf(lines[5], sizeof *lines, "Units: METRIC");
    for (int k = 0; k < 6; k++)
        KTG_TRY(ktg_dxf_line(dxf, BOUNDARY, (ktg_vec2){0, -LINE_FEED * TELL_MM * (k + 1)}, TELL_MM,
                             lines[k]));
    return KTG_OK;
}

static ktg_status put_file(const ktg_dxf *dxf, const ktg_drawing *drawing) {
    KTG_TRY(ktg_check_cancel(dxf->context));
    KTG_TRY(ktg_dxf_section(dxf, "HEADER"));
    KTG_TRY(ktg_dxf_word(dxf, 0, "ENDSEC"));
    KTG_TRY(put_blocks(dxf, drawing));
    KTG_TRY(ktg_dxf_section(dxf, "ENTITIES"));
    KTG_TRY(tell_style(dxf, drawing));
    KTG_TRY(put_inserts(dxf, drawing));
    KTG_TRY(ktg_dxf_word(dxf, 0, "ENDSEC"));
    return ktg_dxf_word(dxf, 0, "EOF");
}

ktg_status ktg_render_astm(ktg_context *context, const ktg_pattern *pattern,
                           const ktg_render_options *options, ktg_output *output) {
    ktg_drawing *drawing;
    ktg_status status = ktg_drawing_new(context, pattern, options, &drawing);
    if (status != KTG_OK)
        return status;
    ktg_dxf dxf = {context, output, true};
    status = put_file(&dxf, drawing);
    ktg_drawing_free(&drawing);
    return status;
}
