/* pattern/cloth_labels.c - what is written on a piece of cloth: numbers along its seams, and what
 * it is called, how often it is cut and which allowances it has. */
#include "pattern/cloth_labels.h"

#include "core/memory.h"
#include "core/text.h"

#include <stdio.h>
#include <string.h>

/* Heights of a digit, in mm: of seams, of the piece's name, and what they may shrink to. */
#define SEAM_MM       5.0
#define NAME_MM       8.0
#define LEAST_SEAM_MM 2.2
#define SHRINK        0.85

/* Between a number and its seam. */
#define FROM_SEAM_MM 2.0

/* Free around a name, by its height. */
#define AROUND_NAME 0.25

/* Lines of text below each other, by their heights. */
#define LEADING 1.5

/* The most bytes of a label and its end. */
#define TEXT_SIZE sizeof((ktg_pattern_label){0}.text)

/* A name is tried at this many places from side to side and from top to bottom. */
enum { places = 25 };

/* ---- where there is room ------------------------------------------------------------------ */

/* Whether a ray from p to the right passes between a and b. */
static bool passes(ktg_vec2 p, ktg_vec2 a, ktg_vec2 b) {
    return (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
}

static bool is_within_outline(const ktg_pattern_piece *piece, ktg_vec2 at) {
    bool within = false;
    for (size_t i = 0; i < piece->outline_count; i++)
        if (passes(at, piece->outline[i], piece->outline[(i + 1) % piece->outline_count]))
            within = !within;
    return within;
}

/* Within the sewing line and, of half a piece, within its outline. */
static bool is_inside(const ktg_label_sheet *sheet, uint32_t p, ktg_vec2 at) {
    const ktg_topology *t = sheet->topology;
    const ktg_pattern_piece *piece = &sheet->pattern->pieces[p];
    bool inside = false;
    for (uint32_t k = t->border_first[p]; k < t->border_first[p + 1]; k++)
        if (passes(at, ktg_start_of(t, t->border[k]), ktg_end_of(t, t->border[k])))
            inside = !inside;
    return inside && (!piece->on_fold || is_within_outline(piece, at));
}

static bool on_line(const ktg_pattern_piece *piece, const ktg_label_box *box) {
    for (size_t i = 0; i < piece->line_count; i++) {
        const ktg_pattern_line *line = &piece->lines[i];
        if (line->kind == KTG_LINE_SEW)
            continue; /* it is the border */
        for (size_t k = 1; k < line->point_count; k++)
            if (ktg_label_box_cut(box, line->points[k - 1], line->points[k]))
                return true;
    }
    return false;
}

static bool is_free(ktg_label_sheet *sheet, uint32_t p, const ktg_label_box *box) {
    const ktg_pattern_piece *piece = &sheet->pattern->pieces[p];
    return is_inside(sheet, p, box->at) && !ktg_label_on_border(sheet, p, box) &&
           !on_line(piece, box) && !ktg_label_piece_taken(sheet, p, box);
}

/* ---- numbers of seams --------------------------------------------------------------------- */

/* The box of a text inside the piece, level with the seam `along_mm` from its start, and the edge
 * it stands at. */
static ktg_label_box box_at_seam(const ktg_label_sheet *sheet, const ktg_pattern_seam *seam,
                                 uint32_t side, double along_mm, double mm, double wide,
                                 uint32_t *edge) {
    const ktg_topology *t = sheet->topology;
    uint32_t k = 0, h;
    double length;
    for (;; k++) {
        h = ktg_seam_halfedge(sheet->pattern, seam, k, side);
        length = ktg_length2(ktg_sub2(ktg_end_of(t, h), ktg_start_of(t, h)));
        if (along_mm <= length || k + 1 == seam->edge_count)
            break;
        along_mm -= length;
    }
    ktg_vec2 along = ktg_along(t, h), in = ktg_perp2(along);
    double from_start = side == 0 ? along_mm : length - along_mm;
    ktg_vec2 at = ktg_madd2(ktg_start_of(t, h), from_start, along);
    *edge = seam->edges[k];
    bool upright = along.x > 0 || (along.x == 0 && along.y > 0);
    return (ktg_label_box){ktg_madd2(at, FROM_SEAM_MM + mm / 2, in),
                           upright ? along : ktg_mul2(along, -1),
                           {wide * mm / 2, mm / 2}};
}

/* Near the middle of the seam, and smaller, until there is room. */
static ktg_status number_side(ktg_context *context, ktg_label_sheet *sheet,
                              const ktg_pattern_seam *seam, uint32_t side, const char *text) {
    static const double where[] = {0.5, 0.45, 0.55, 0.35, 0.65, 0.3, 0.7, 0.2, 0.8};
    double wide = ktg_label_width(text), mm = SEAM_MM;
    ktg_label_box box;
    uint32_t edge, p = seam->pieces[side];
    for (; mm >= LEAST_SEAM_MM; mm *= SHRINK)
        for (size_t k = 0; k < sizeof where / sizeof *where; k++) {
            box =
                box_at_seam(sheet, seam, side, where[k] * seam->lengths_mm[side], mm, wide, &edge);
            if (is_free(sheet, p, &box))
                return ktg_label_write(context, sheet, p, KTG_NONE, edge, text, &box);
        }
    box = box_at_seam(sheet, seam, side, 0.5 * seam->lengths_mm[side], LEAST_SEAM_MM, wide, &edge);
    if (!is_inside(sheet, p, box.at))
        return KTG_OK; /* the other half of a piece on the fold */
    return ktg_label_write(context, sheet, p, KTG_NONE, edge, text, &box);
}

static ktg_status number_seams(ktg_context *context, ktg_label_sheet *sheet) {
    for (size_t s = 0; s < sheet->pattern->seam_count; s++) {
        const ktg_pattern_seam *seam = &sheet->pattern->seams[s];
        char text[16];
        if (seam->dart)
            continue;
        ktg_number_text(seam->number, text);
        for (uint32_t side = 0; side < 2; side++)
            KTG_TRY(number_side(context, sheet, seam, side, text));
    }
    return KTG_OK;
}

/* ---- names -------------------------------------------------------------------------------- */

enum { most_lines = 4 };

/* Lines of text below each other; heights by that of the first. */
typedef struct block {
    char text[most_lines][TEXT_SIZE];
    double height[most_lines];
    uint32_t count;
} block;

static char *add_line(block *b, double height) {
    b->height[b->count] = height;
    return b->text[b->count++];
}

/* The name, cut to fit between characters. */
static void write_name(const ktg_pattern_piece *piece, uint32_t p, char text[TEXT_SIZE]) {
    if (!piece->name || !*piece->name) {
        snprintf(text, TEXT_SIZE, "piece %u", p + 1);
        return;
    }
    size_t length = strlen(piece->name);
    if (length >= TEXT_SIZE)
        length = TEXT_SIZE - 1;
    while (length > 0 && ((unsigned char)piece->name[length] & 0xc0) == 0x80)
        length--;
    memcpy(text, piece->name, length);
    text[length] = '\0';
}

/* "cut 1", "cut 2", "cut 2, 1 mirrored", "cut 1 on the fold": of a symmetric piece a mirror image
 * is the same. */
static void write_cut(const ktg_pattern_piece *piece, char text[TEXT_SIZE]) {
    unsigned count = piece->cut_count + piece->cut_mirrored;
    if (piece->on_fold)
        snprintf(text, TEXT_SIZE, "cut %u on the fold", count);
    else if (piece->cut_mirrored > 0)
        snprintf(text, TEXT_SIZE, "cut %u, %u mirrored", count, piece->cut_mirrored);
    else
        snprintf(text, TEXT_SIZE, "cut %u", count);
}

static bool has_hem(const ktg_topology *t, uint32_t p) {
    for (uint32_t k = t->border_first[p]; k < t->border_first[p + 1]; k++)
        if (ktg_edge_at(t, t->border[k])->kind == KTG_EDGE_BORDER)
            return true;
    return false;
}

/* Pieces that are printed: how many there are, and how many up to the one that is named. */
typedef struct tally {
    unsigned number, count;
} tally;

static unsigned count_printed(const ktg_pattern *pattern) {
    unsigned count = 0;
    for (uint32_t p = 0; p < pattern->piece_count; p++)
        count += pattern->pieces[p].cut_count > 0;
    return count;
}

static block block_of(const ktg_label_sheet *sheet, uint32_t p, tally printed) {
    const ktg_finish_options *options = sheet->options;
    block b = {.count = 0};
    write_name(&sheet->pattern->pieces[p], p, add_line(&b, 1));
    write_cut(&sheet->pattern->pieces[p], add_line(&b, 0.7));
    if (sheet->pattern->piece_count > 1)
        snprintf(add_line(&b, 0.5), TEXT_SIZE, "piece %u of %u", printed.number, printed.count);
    char *allowances = add_line(&b, 0.4);
    int length = ktg_format(allowances, TEXT_SIZE, "with %.4g mm", options->allowance_mm);
    if (has_hem(sheet->topology, p) && length > 0 && (size_t)length < TEXT_SIZE)
        ktg_format(allowances + length, TEXT_SIZE - (size_t)length, ", hem %.4g mm",
                   options->hem_mm);
    return b;
}

static ktg_vec2 size_of(const block *b) {
    ktg_vec2 size = {0, 0};
    for (uint32_t k = 0; k < b->count; k++) {
        size.x = fmax(size.x, b->height[k] * ktg_label_width(b->text[k]));
        size.y += b->height[k] * (k + 1 < b->count ? LEADING : 1);
    }
    return size;
}

/* The place nearest to the middle where the block is free, and so much around it, if any. */
static bool find_place(ktg_label_sheet *sheet, uint32_t p, ktg_vec2 size, double around_mm,
                       ktg_label_box *found) {
    const ktg_pattern_piece *piece = &sheet->pattern->pieces[p];
    ktg_box around = ktg_box_of(piece->outline, piece->outline_count);
    ktg_vec2 middle = ktg_mul2(ktg_add2(around.low, around.high), 0.5),
             room = {around.high.x - around.low.x, around.high.y - around.low.y};
    double nearest = INFINITY;
    for (int k = 0; k < places * places; k++) {
        ktg_vec2 away = {((k % places + 0.5) / places - 0.5) * room.x,
                         ((k / places + 0.5) / places - 0.5) * room.y};
        ktg_label_box box = {ktg_add2(middle, away), {1, 0}, ktg_mul2(size, 0.5)}, wide = box;
        wide.half = ktg_add2(box.half, (ktg_vec2){around_mm, around_mm});
        double distance = ktg_dot2(away, away);
        if (distance < nearest * (1 - 1e-9) && is_free(sheet, p, &wide)) {
            nearest = distance;
            *found = box;
        }
    }
    return isfinite(nearest);
}

static ktg_status write_block(ktg_context *context, ktg_label_sheet *sheet, uint32_t p,
                              const block *b, const ktg_label_box *box, double mm) {
    double y = box->at.y + box->half.y;
    for (uint32_t k = 0; k < b->count; k++) {
        double height = mm * b->height[k];
        ktg_label_box line = {{box->at.x, y - height / 2},
                              {1, 0},
                              {height * ktg_label_width(b->text[k]) / 2, height / 2}};
        KTG_TRY(ktg_label_write(context, sheet, p, KTG_NONE, KTG_NONE, b->text[k], &line));
        y -= height * LEADING;
    }
    return KTG_OK;
}

/* The middle of the widest face that is drawn: in the cloth, however far the cut is from it. */
static ktg_vec2 middle_face(const ktg_pattern_piece *piece) {
    ktg_vec2 best = piece->outline[0];
    double largest = 0;
    for (size_t f = 0; f < piece->face_count; f++) {
        const uint32_t *corners = piece->corners + 3 * f;
        ktg_vec2 a = piece->vertices[corners[0]], b = piece->vertices[corners[1]],
                 c = piece->vertices[corners[2]];
        ktg_vec2 middle = ktg_mul2(ktg_add2(ktg_add2(a, b), c), 1.0 / 3);
        double area = ktg_cross2(ktg_sub2(b, a), ktg_sub2(c, a));
        if (area > largest && (!piece->on_fold || is_within_outline(piece, middle))) {
            largest = area;
            best = middle;
        }
    }
    return best;
}

/* Smaller and, when it would be too small, with fewer lines, until there is room: a piece of cloth
 * is never without its name. */
static ktg_status name_piece(ktg_context *context, ktg_label_sheet *sheet, uint32_t p,
                             tally printed) {
    block b = block_of(sheet, p, printed);
    ktg_label_box box = {0};
    for (; b.count > 0; b.count--)
        for (double mm = NAME_MM; mm * b.height[b.count - 1] >= KTG_LABEL_LEAST_MM; mm *= SHRINK)
            if (find_place(sheet, p, ktg_mul2(size_of(&b), mm), AROUND_NAME * mm, &box))
                return write_block(context, sheet, p, &b, &box, mm);
    b.count = 1;
    box = (ktg_label_box){middle_face(&sheet->pattern->pieces[p]),
                          {1, 0},
                          ktg_mul2(size_of(&b), KTG_LABEL_LEAST_MM / 2)};
    return write_block(context, sheet, p, &b, &box, KTG_LABEL_LEAST_MM);
}

/* "place on fold" along the fold of half a piece, inside it. */
static ktg_status name_fold(ktg_context *context, ktg_label_sheet *sheet, uint32_t p) {
    const ktg_pattern_piece *piece = &sheet->pattern->pieces[p];
    static const char text[] = "place on fold";
    for (size_t i = 0; i < piece->line_count; i++) {
        if (piece->lines[i].kind != KTG_LINE_FOLD)
            continue;
        ktg_vec2 a = piece->lines[i].points[0], b = piece->lines[i].points[1];
        double mm = fmin(SEAM_MM, ktg_length2(ktg_sub2(b, a)) / (2 * ktg_label_width(text)));
        ktg_vec2 along = ktg_unit2(ktg_sub2(b, a));
        ktg_vec2 at =
            ktg_madd2(ktg_mul2(ktg_add2(a, b), 0.5), -(FROM_SEAM_MM + mm / 2), ktg_perp2(along));
        ktg_label_box box = {at, along, {mm * ktg_label_width(text) / 2, mm / 2}};
        return ktg_label_write(context, sheet, p, KTG_NONE, KTG_NONE, text, &box);
    }
    return KTG_OK;
}

ktg_status ktg_cloth_labels_write(ktg_context *context, ktg_label_sheet *sheet) {
    const ktg_pattern *pattern = sheet->pattern;
    tally printed = {0, count_printed(pattern)};
    if (sheet->options->numbers != KTG_NUMBER_NONE)
        KTG_TRY(number_seams(context, sheet));
    for (uint32_t p = 0; p < pattern->piece_count; p++) {
        printed.number += pattern->pieces[p].cut_count > 0;
        KTG_TRY(ktg_check_cancel(context));
        KTG_TRY(name_fold(context, sheet, p));
        KTG_TRY(name_piece(context, sheet, p, printed));
    }
    return KTG_OK;
}
