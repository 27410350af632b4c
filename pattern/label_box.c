/* pattern/label_box.c - the room a text takes, and the labels written so far. */
#include "pattern/label_box.h"

#include <stdio.h>

#define LETTER_WIDTH 0.85
#define DOT_WIDTH    0.45
#define WIDE_WIDTH   1.45 /* of Chinese, Japanese and Korean letters: from U+3000 on */

static ktg_status build_grids(ktg_context *context, ktg_label_sheet *sheet) {
    const ktg_topology *t = sheet->topology;
    for (uint32_t k = 0; k < t->border_count; k++) {
        ktg_vec2 ends[2] = {ktg_start_of(t, t->border[k]), ktg_end_of(t, t->border[k])};
        sheet->boxes[k] = ktg_box_of(ends, 2);
    }
    for (size_t p = 0; p < sheet->pattern->piece_count; p++)
        KTG_TRY(ktg_grid_build(context, sheet->boxes + t->border_first[p],
                               t->border_first[p + 1] - t->border_first[p], &sheet->grids[p]));
    return KTG_OK;
}

ktg_status ktg_label_sheet_open(ktg_context *context, ktg_label_sheet *sheet) {
    const ktg_pattern *pattern = sheet->pattern;
    sheet->capacities = ktg_new(context, pattern->piece_count, size_t);
    sheet->grids = ktg_new(context, pattern->piece_count, ktg_grid);
    sheet->boxes = ktg_new(context, sheet->topology->border_count, ktg_box);
    sheet->face_labels = ktg_new(context, pattern->face_count, uint32_t);
    if (!sheet->capacities || !sheet->grids || !sheet->boxes || !sheet->face_labels)
        return KTG_MEMORY;
    for (uint32_t f = 0; f < pattern->face_count; f++)
        sheet->face_labels[f] = KTG_NONE;
    return build_grids(context, sheet);
}

void ktg_label_sheet_drop(ktg_label_sheet *sheet) {
    for (size_t p = 0; sheet->grids && p < sheet->pattern->piece_count; p++)
        ktg_grid_drop(&sheet->grids[p]);
    ktg_free(sheet->grids);
    ktg_free(sheet->capacities);
    ktg_free(sheet->boxes);
    ktg_free(sheet->face_labels);
    ktg_free(sheet->next_label);
    ktg_free(sheet->places);
    ktg_free(sheet->wants);
}

double ktg_label_width(const char *text) {
    double width = 0;
    for (const char *c = text; *c; c++)
        if (((unsigned char)*c & 0xc0) != 0x80) /* not inside a UTF-8 character */
            width += *c == '.' ? DOT_WIDTH : (unsigned char)*c >= 0xe3 ? WIDE_WIDTH : LETTER_WIDTH;
    return width;
}

/* How far the box reaches from its centre along a unit vector. */
static double reach(const ktg_label_box *box, ktg_vec2 d) {
    return box->half.x * fabs(ktg_dot2(d, box->along)) +
           box->half.y * fabs(ktg_cross2(box->along, d));
}

bool ktg_label_boxes_meet(const ktg_label_box *a, const ktg_label_box *b) {
    ktg_vec2 axes[4] = {a->along, ktg_perp2(a->along), b->along, ktg_perp2(b->along)};
    ktg_vec2 between = ktg_sub2(b->at, a->at);
    for (int k = 0; k < 4; k++)
        if (fabs(ktg_dot2(between, axes[k])) >= reach(a, axes[k]) + reach(b, axes[k]))
            return false;
    return true;
}

static ktg_vec2 to_box(const ktg_label_box *box, ktg_vec2 p) {
    ktg_vec2 v = ktg_sub2(p, box->at);
    return (ktg_vec2){ktg_dot2(v, box->along), ktg_cross2(box->along, v)};
}

bool ktg_label_box_cut(const ktg_label_box *box, ktg_vec2 a, ktg_vec2 b) {
    ktg_vec2 p = to_box(box, a), q = to_box(box, b), d = ktg_sub2(q, p);
    if (fmax(p.x, q.x) <= -box->half.x || fmin(p.x, q.x) >= box->half.x ||
        fmax(p.y, q.y) <= -box->half.y || fmin(p.y, q.y) >= box->half.y)
        return false;
    double away = fabs(ktg_cross2(d, p));
    return away < box->half.x * fabs(d.y) + box->half.y * fabs(d.x);
}

bool ktg_label_face_taken(const ktg_label_sheet *sheet, uint32_t face, const ktg_label_box *box) {
    for (uint32_t k = sheet->face_labels[face]; k != KTG_NONE; k = sheet->next_label[k])
        if (ktg_label_boxes_meet(&sheet->places[k], box))
            return true;
    return false;
}

/* The label's own box, or that of its leader. */
static ktg_label_box box_of(const ktg_pattern_label *label, bool leader) {
    ktg_vec2 v = ktg_sub2(label->foot, label->at);
    double length = ktg_length2(v);
    if (leader && length > 0)
        return (ktg_label_box){
            ktg_madd2(label->at, 0.5, v), ktg_mul2(v, 1 / length), {length / 2, 0.05}};
    return (ktg_label_box){
        label->at,
        {cos(label->rotation), sin(label->rotation)},
        {label->height_mm * ktg_label_width(label->text) / 2, label->height_mm / 2}};
}

/* True when the label is so far away that its shape does not matter. */
static bool is_far(const ktg_pattern_label *label, const ktg_label_box *box) {
    ktg_vec2 v = ktg_sub2(label->at, box->at);
    double letters =
        label->edge == KTG_NONE ? sizeof label->text : sizeof((ktg_label_want){0}.text);
    double reach = box->half.x + box->half.y + label->height_mm * letters;
    if (label->leader)
        reach += fabs(label->foot.x - label->at.x) + fabs(label->foot.y - label->at.y);
    return fabs(v.x) > reach || fabs(v.y) > reach;
}

bool ktg_label_piece_taken(const ktg_label_sheet *sheet, uint32_t p, const ktg_label_box *box) {
    const ktg_pattern_piece *piece = &sheet->pattern->pieces[p];
    for (size_t i = 0; i < piece->label_count; i++)
        for (int leader = 0; leader <= piece->labels[i].leader && !is_far(&piece->labels[i], box);
             leader++) {
            ktg_label_box other = box_of(&piece->labels[i], leader);
            if (ktg_label_boxes_meet(&other, box))
                return true;
        }
    return false;
}

bool ktg_label_on_border(ktg_label_sheet *sheet, uint32_t piece, const ktg_label_box *box) {
    const ktg_topology *t = sheet->topology;
    ktg_vec2 reaches = {reach(box, (ktg_vec2){1, 0}), reach(box, (ktg_vec2){0, 1})};
    ktg_box around = {ktg_sub2(box->at, reaches), ktg_add2(box->at, reaches)};
    uint32_t found = ktg_grid_query(&sheet->grids[piece], around);
    for (uint32_t k = 0; k < found; k++) {
        uint32_t h = t->border[t->border_first[piece] + sheet->grids[piece].found[k]];
        if (ktg_label_box_cut(box, ktg_start_of(t, h), ktg_end_of(t, h)))
            return true;
    }
    return false;
}

ktg_status ktg_label_write(ktg_context *context, ktg_label_sheet *sheet, uint32_t piece,
                           uint32_t face, uint32_t edge, const char *text,
                           const ktg_label_box *box) {
    ktg_pattern_piece *p = &sheet->pattern->pieces[piece];
    uint32_t number = sheet->label_count;
    KTG_TRY(ktg_reserve(context, &p->labels, &sheet->capacities[piece], p->label_count + 1));
    KTG_TRY(ktg_reserve(context, &sheet->places, &sheet->place_capacity, (size_t)number + 1));
    KTG_TRY(ktg_reserve(context, &sheet->next_label, &sheet->next_capacity, (size_t)number + 1));
    ktg_pattern_label *label = &p->labels[p->label_count++];
    *label =
        (ktg_pattern_label){"", box->at, atan2(box->along.y, box->along.x), 2 * box->half.y, edge};
    snprintf(label->text, sizeof label->text, "%s", text);
    sheet->places[number] = *box;
    sheet->label_count++;
    if (face != KTG_NONE) {
        sheet->next_label[number] = sheet->face_labels[face];
        sheet->face_labels[face] = number;
    }
    return KTG_OK;
}
