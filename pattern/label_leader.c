/* pattern/label_leader.c - numbers that have no room on their edge: they stand near by, and a line
 * leads to the edge. */
#include "pattern/label_box.h"

/* How far from the edge, and how far aside, in steps. */
#define STEP_MM  0.8
#define STEPS    22
#define ASIDES   10
#define EDGE_MM  0.3 /* a leader ends so far inside the edge */
#define CLEAR_MM 0.25
/* Among more labels than these no place is looked for: nobody builds such a net by its numbers. */
#define MOST_LABELS 800

/* The number's box with its foot `away` from the edge and its middle `aside` of the edge's, along
 * the edge or upright to it. */
static ktg_label_box box_at(const ktg_label_want *want, double aside, double away, bool upright) {
    ktg_vec2 half = {KTG_LABEL_LEAST_MM * ktg_label_width(want->text) / 2, KTG_LABEL_LEAST_MM / 2};
    ktg_vec2 up = ktg_perp2(want->along);
    ktg_vec2 at = ktg_madd2(ktg_madd2(want->middle, aside, want->along),
                            away + (upright ? half.x : half.y), up);
    return (ktg_label_box){at, upright ? up : want->along, half};
}

/* Where the leader meets the number: the point of its box next to the edge's middle. */
static ktg_vec2 near_end(const ktg_label_box *box, ktg_vec2 from) {
    ktg_vec2 v = ktg_sub2(from, box->at), up = ktg_perp2(box->along);
    double x = fmax(-box->half.x, fmin(box->half.x, ktg_dot2(v, box->along)));
    double y = fmax(-box->half.y, fmin(box->half.y, ktg_dot2(v, up)));
    return ktg_madd2(ktg_madd2(box->at, x, box->along), y, up);
}

static ktg_label_box strip_between(ktg_vec2 a, ktg_vec2 b) {
    ktg_vec2 d = ktg_sub2(b, a);
    double length = ktg_length2(d);
    ktg_vec2 along = length > 0 ? ktg_mul2(d, 1 / length) : (ktg_vec2){1, 0};
    return (ktg_label_box){ktg_mul2(ktg_add2(a, b), 0.5), along, {length / 2, 0.05}};
}

static bool is_free(ktg_label_sheet *sheet, uint32_t piece, const ktg_label_box *box) {
    return !ktg_label_on_border(sheet, piece, box) && !ktg_label_piece_taken(sheet, piece, box);
}

/* Keeps the box when it is nearer than the best so far, in a free place with a way that is free, or
 * with `crossing` at least within the piece. */
static void consider(ktg_label_sheet *sheet, const ktg_label_want *want, ktg_vec2 foot,
                     bool crossing, const ktg_label_box *box, double *best, ktg_label_box *found) {
    ktg_vec2 end = near_end(box, foot);
    double away = ktg_length2(ktg_sub2(end, foot));
    ktg_label_box wide = *box, way = strip_between(foot, end);
    wide.half = ktg_add2(wide.half, (ktg_vec2){CLEAR_MM, CLEAR_MM});
    if (away >= *best || !is_free(sheet, want->piece, &wide) ||
        (crossing ? ktg_label_on_border(sheet, want->piece, &way)
                  : !is_free(sheet, want->piece, &way)))
        return;
    *best = away;
    *found = *box;
}

/* The nearest place; false when there is none. */
static bool find_place(ktg_label_sheet *sheet, const ktg_label_want *want, ktg_vec2 foot,
                       bool crossing, ktg_label_box *found) {
    double best = INFINITY;
    for (int k = 0; k < STEPS && k * STEP_MM < best; k++)
        for (int i = 0; i < 2 * (2 * ASIDES + 1); i++) {
            int aside = (i / 2 + 1) / 2 * (i / 2 % 2 ? -1 : 1);
            ktg_label_box box = box_at(want, aside * STEP_MM, EDGE_MM + k * STEP_MM, i % 2);
            consider(sheet, want, foot, crossing, &box, &best, found);
        }
    return isfinite(best);
}

ktg_status ktg_label_lead(ktg_context *context, ktg_label_sheet *sheet,
                          const ktg_label_want *want) {
    ktg_vec2 foot = ktg_madd2(want->middle, EDGE_MM, ktg_perp2(want->along));
    ktg_label_box box;
    bool found =
        sheet->label_count + sheet->want_count <= MOST_LABELS &&
        (find_place(sheet, want, foot, false, &box) || find_place(sheet, want, foot, true, &box));
    if (!found)
        box = box_at(want, 0, EDGE_MM, false); /* over whatever is there */
    KTG_TRY(ktg_label_write(context, sheet, want->piece, KTG_NONE, want->edge, want->text, &box));
    ktg_pattern_piece *piece = &sheet->pattern->pieces[want->piece];
    ktg_pattern_label *label = &piece->labels[piece->label_count - 1];
    label->leader = found && ktg_length2(ktg_sub2(near_end(&box, foot), foot)) > STEP_MM;
    label->foot = foot;
    return KTG_OK;
}
