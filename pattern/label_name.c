/* pattern/label_name.c - the name of a piece, where there is most room for it. */
#include "pattern/label_box.h"

#include <stdio.h>
#include <string.h>

/* Digits of a name are this high at most, in mm. */
#define PAPER_NAME_MM 3.6
#define CLOTH_NAME_MM 8.0
#define SHRINK        0.9

/* At most this many faces are looked at. */
#define MOST_FACES 400

/* "body" or, of several pieces, "body 2 of 3"; cut to fit between characters. */
static void name_text(const ktg_pattern *pattern, uint32_t p, char text[32]) {
    const ktg_pattern_piece *piece = &pattern->pieces[p];
    const char *name = NULL;
    unsigned count = 0, place = 0;
    for (uint32_t i = 0; i < pattern->piece_count; i++) {
        if (pattern->pieces[i].component != piece->component)
            continue;
        count++;
        place += i <= p;
    }
    if (pattern->mode == KTG_CLOTH)
        name = piece->name;
    if ((!name || !*name) && piece->component < pattern->component_count)
        name = pattern->components[piece->component].name;
    char rest[32] = "";
    if (count > 1 && (pattern->mode == KTG_PAPER || !piece->name || !*piece->name))
        snprintf(rest, sizeof rest, " %u of %u", place, count);
    size_t length = name ? strlen(name) : 0, room = 31 - strlen(rest);
    if (length > room)
        length = room;
    while (length > 0 && name && ((unsigned char)name[length] & 0xc0) == 0x80)
        length--;
    snprintf(text, 32, "%.*s%s", (int)length, name ? name : "",
             length ? rest : rest + (*rest == ' '));
}

/* True when a box on `face` lies across no border and no grain line, and of paper across no fold
 * around the flat region. */
static bool lies_clear(ktg_label_sheet *sheet, uint32_t p, uint32_t face,
                       const ktg_label_box *box) {
    const ktg_topology *t = sheet->topology;
    const ktg_pattern_piece *piece = &sheet->pattern->pieces[p];
    if (ktg_label_on_border(sheet, p, box))
        return false;
    for (size_t i = 0; i < piece->line_count; i++)
        if (piece->lines[i].kind == KTG_LINE_GRAIN &&
            ktg_label_box_cut(box, piece->lines[i].points[0], piece->lines[i].points[1]))
            return false;
    if (t->pattern->mode == KTG_CLOTH)
        return true;
    uint32_t region = t->region_of[face];
    bool alone = t->region_size[region] == 1;
    for (size_t i = 0; i < (alone ? 3 : 3 * piece->face_count); i++) {
        uint32_t h = 3 * (alone ? face : piece->faces[i / 3]) + (uint32_t)(i % 3);
        if (t->region_of[h / 3] == region && ktg_edge_at(t, h)->kind != KTG_EDGE_FLAT &&
            ktg_label_box_cut(box, ktg_start_of(t, h), ktg_end_of(t, h)))
            return false;
    }
    return true;
}

static bool covers_label(const ktg_pattern_piece *piece, const ktg_label_box *box) {
    for (size_t i = 0; i < piece->label_count; i++) {
        const ktg_pattern_label *label = &piece->labels[i];
        ktg_label_box other = {
            label->at,
            {cos(label->rotation), sin(label->rotation)},
            {label->height_mm * ktg_label_width(label->text) / 2, label->height_mm / 2}};
        if (ktg_label_boxes_meet(&other, box))
            return true;
    }
    return false;
}

static ktg_vec2 incentre(const ktg_topology *t, uint32_t face) {
    ktg_vec2 sum = {0, 0};
    double weight = 0;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t opposite = 3 * face + (k + 1) % 3;
        double length = ktg_length2(ktg_sub2(ktg_end_of(t, opposite), ktg_start_of(t, opposite)));
        sum = ktg_madd2(sum, length, ktg_corner_at(t, 3 * face + k));
        weight += length;
    }
    return weight > 0 ? ktg_mul2(sum, 1 / weight) : ktg_corner_at(t, 3 * face);
}

/* A candidate: the text in the middle of a face, or of a side it shares with its flat region, along
 * one of its sides (cloth: level). */
static ktg_label_box candidate(const ktg_topology *t, uint32_t face, uint32_t k) {
    uint32_t side = 3 * face + k % 3;
    ktg_vec2 a = ktg_start_of(t, side), b = ktg_end_of(t, side);
    ktg_vec2 along = ktg_unit2(ktg_sub2(b, a));
    if (along.x < 0 || (along.x == 0 && along.y < 0))
        along = ktg_mul2(along, -1);
    if (t->pattern->mode == KTG_CLOTH)
        along = (ktg_vec2){1, 0};
    bool in_middle_of_side = k >= 3 && ktg_edge_at(t, side)->kind == KTG_EDGE_FLAT;
    ktg_vec2 at = in_middle_of_side ? ktg_mul2(ktg_add2(a, b), 0.5) : incentre(t, face);
    if (in_middle_of_side && t->pattern->mode == KTG_PAPER)
        along = ktg_unit2(ktg_sub2(ktg_end_of(t, ktg_next_corner(side)), b));
    if (along.x < 0 || (along.x == 0 && along.y < 0))
        along = ktg_mul2(along, -1);
    return (ktg_label_box){at, along, {0, 0}};
}

static bool fits(ktg_label_sheet *sheet, uint32_t p, uint32_t face, double wide, double mm,
                 ktg_label_box *box) {
    box->half = (ktg_vec2){wide * mm / 2, mm / 2};
    return lies_clear(sheet, p, face, box) && !covers_label(&sheet->pattern->pieces[p], box);
}

/* The largest height, more than `least`, at which the text fits the candidate's place; 0: none. */
static double fitting_height(ktg_label_sheet *sheet, uint32_t p, uint32_t face, double wide,
                             double most, double least, ktg_label_box *box) {
    if (!fits(sheet, p, face, wide, least, box))
        return 0;
    for (double mm = most; mm > least; mm *= SHRINK)
        if (fits(sheet, p, face, wide, mm, box))
            return mm;
    return 0;
}

static double area_of(const ktg_topology *t, uint32_t face) {
    ktg_vec2 a = ktg_corner_at(t, 3 * face);
    return ktg_cross2(ktg_sub2(ktg_corner_at(t, 3 * face + 1), a),
                      ktg_sub2(ktg_corner_at(t, 3 * face + 2), a));
}

/* The best place found so far. */
typedef struct name_place {
    ktg_label_box box;
    uint32_t face;
    double height; /* 0: it does not fit anywhere yet */
    double away;   /* squared distance to the piece's middle */
} name_place;

static ktg_vec2 middle_of(const ktg_pattern_piece *piece) {
    ktg_box box = ktg_box_of(piece->vertices, piece->vertex_count);
    return ktg_mul2(ktg_add2(box.low, box.high), 0.5);
}

/* Keeps the candidate where it is higher, or as high and nearer to the middle. */
static void consider(ktg_label_sheet *sheet, uint32_t p, uint32_t face, uint32_t k, double wide,
                     double most, ktg_vec2 middle, name_place *best) {
    ktg_label_box box = candidate(sheet->topology, face, k);
    ktg_vec2 v = ktg_sub2(box.at, middle);
    double away = ktg_dot2(v, v), least = fmax(best->height, 0.999 * KTG_LABEL_LEAST_MM);
    if (best->height >= most && away >= best->away)
        return;
    double mm = fitting_height(sheet, p, face, wide, most, least * (1 - 1e-9), &box);
    if (mm > best->height * (1 + 1e-9) || (mm >= most && away < best->away))
        *best = (name_place){box, face, mm, away};
}

/* Where nothing fits: the least height, in the largest face. */
static name_place in_largest_face(const ktg_topology *t, const ktg_pattern_piece *piece,
                                  double wide) {
    uint32_t largest = piece->faces[0];
    for (size_t i = 1; i < piece->face_count; i++)
        if (area_of(t, piece->faces[i]) > area_of(t, largest))
            largest = piece->faces[i];
    name_place place = {candidate(t, largest, 0), largest, KTG_LABEL_LEAST_MM, 0};
    place.box.half = (ktg_vec2){wide * KTG_LABEL_LEAST_MM / 2, KTG_LABEL_LEAST_MM / 2};
    return place;
}

ktg_status ktg_label_name(ktg_context *context, ktg_label_sheet *sheet, uint32_t p) {
    const ktg_pattern *pattern = sheet->pattern;
    const ktg_pattern_piece *piece = &pattern->pieces[p];
    bool cloth = pattern->mode == KTG_CLOTH;
    char text[32];
    name_text(pattern, p, text);
    if (!*text || (!cloth && pattern->piece_count < 2) || piece->face_count == 0)
        return KTG_OK;
    double wide = ktg_label_width(text), most = cloth ? CLOTH_NAME_MM : PAPER_NAME_MM;
    ktg_vec2 middle = middle_of(piece);
    name_place best = {.face = KTG_NONE, .away = INFINITY};
    size_t step = piece->face_count / MOST_FACES + 1;
    for (size_t i = 0; i < piece->face_count; i += step)
        for (uint32_t k = 0; k < (cloth ? 1 : 6); k++)
            consider(sheet, p, piece->faces[i], k, wide, most, middle, &best);
    if (best.face == KTG_NONE)
        best = in_largest_face(sheet->topology, piece, wide);
    return ktg_label_write(context, sheet, p, best.face, KTG_NONE, text, &best.box);
}
