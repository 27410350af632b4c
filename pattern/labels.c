/* pattern/labels.c - numbers that say which edges meet.
 *
 * A number stands on its edge: on the tab with the fold below it, and just inside the mating edge
 * with the cut below it. Glued together, both stand the same way round. */
#include "pattern/finish.h"

#include "core/memory.h"
#include "pattern/cloth_labels.h"

#include <stdio.h>
#include <string.h>

/* How far a number keeps from its edge, and from the sides of its tab or face, in mm. */
#define FROM_EDGE_MM 0.4
#define ASIDE_MM     0.2

/* On an edge without a tab, between the number and the edge, the mark of the butt joint stands. */
#define FROM_JOINT_MM 1.4

/* A number is tried smaller by this factor until it fits. */
#define SHRINK 0.92

/* Where a number may stand: on the base from (0, 0) along x, between two sides, below the top. */
typedef struct stand {
    ktg_vec2 origin, along;
    double left, right, left_cot, right_cot, height;
    uint32_t piece, face; /* face: KTG_NONE on a tab */
    double from_edge;     /* how far the number keeps from its edge */
} stand;

static double left_at(const stand *s, double y) {
    return s->left + s->left_cot * y;
}

static double right_at(const stand *s, double y) {
    return s->right - s->right_cot * y;
}

/* The free interval for a number of this height; false when it is too narrow or too low. */
static bool free_interval(const stand *s, double mm, double width, double *low, double *high) {
    double bottom = s->from_edge, top = bottom + mm;
    *low = fmax(left_at(s, bottom), left_at(s, top)) + ASIDE_MM + width / 2;
    *high = fmin(right_at(s, bottom), right_at(s, top)) - ASIDE_MM - width / 2;
    return top + ASIDE_MM <= s->height && *low <= *high;
}

static ktg_label_box box_at(const stand *s, double x, double y, double mm, double width) {
    ktg_vec2 at = ktg_madd2(ktg_madd2(s->origin, x, s->along), y, ktg_perp2(s->along));
    return (ktg_label_box){at, s->along, {width / 2, mm / 2}};
}

/* The largest box of the text, up to `most` mm high, that fits and covers no other number; false
 * when there is none of the least height. */
static bool find_box(const ktg_label_sheet *sheet, const stand *s, const char *text, double most,
                     ktg_label_box *box) {
    double wide = ktg_label_width(text);
    for (double mm = most;; mm = fmax(KTG_LABEL_LEAST_MM, mm * SHRINK)) {
        double low, high;
        if (free_interval(s, mm, wide * mm, &low, &high)) {
            double places[3] = {(low + high) / 2, low, high};
            for (int k = 0; k < 3; k++) {
                *box = box_at(s, places[k], s->from_edge + mm / 2, mm, wide * mm);
                if (s->face == KTG_NONE || !ktg_label_face_taken(sheet, s->face, box))
                    return true;
            }
        }
        if (mm <= KTG_LABEL_LEAST_MM)
            return false;
    }
}

static stand stand_on_tab(const ktg_topology *t, uint32_t h, const ktg_pattern_tab *tab) {
    ktg_vec2 start = ktg_end_of(t, h), along = ktg_unit2(ktg_sub2(ktg_start_of(t, h), start));
    double x[KTG_TAB_CORNERS], height = 0;
    uint32_t last = tab->corner_count - 1, top = last - 1;
    for (uint32_t i = 0; i <= last; i++) {
        ktg_vec2 v = ktg_sub2(tab->corners[i], start);
        x[i] = ktg_dot2(v, along);
        height = fmax(height, ktg_cross2(along, v));
    }
    return (stand){start,
                   along,
                   x[last],
                   x[0],
                   (x[top] - x[last]) / height,
                   (x[0] - x[1]) / height,
                   height,
                   t->piece_of[h / 3],
                   KTG_NONE,
                   FROM_EDGE_MM};
}

static stand stand_in_face(const ktg_topology *t, uint32_t h) {
    ktg_vec2 a = ktg_start_of(t, h), b = ktg_end_of(t, h);
    ktg_vec2 apex = ktg_corner_at(t, ktg_next_corner(ktg_next_corner(h)));
    ktg_vec2 along = ktg_unit2(ktg_sub2(b, a)), v = ktg_sub2(apex, a);
    double x = ktg_dot2(v, along), y = ktg_cross2(along, v);
    double length = ktg_length2(ktg_sub2(b, a));
    if (!(y > 0))
        y = 1e-9 * length;
    return (stand){a,     along,       0, length, x / y, (length - x) / y, y, t->piece_of[h / 3],
                   h / 3, FROM_EDGE_MM};
}

/* ---- one number --------------------------------------------------------------------------- */

/* Where the number of an edge stands on one of its sides: on the tab, or in the face. */
static stand stand_of(const ktg_label_sheet *sheet, uint32_t edge, uint32_t side,
                      const ktg_pattern_tab *const *tabs) {
    const ktg_pattern_edge *e = &sheet->pattern->edges[edge];
    uint32_t h = ktg_side_halfedge(&e->sides[side]);
    if (e->tab_on == (int)side && tabs[edge])
        return stand_on_tab(sheet->topology, h, tabs[edge]);
    stand s = stand_in_face(sheet->topology, h);
    if (e->tab_on < 0 && sheet->options->tab_height_mm > 0 &&
        s.right - s.left >= sheet->options->tab_edge_mm)
        s.from_edge = FROM_JOINT_MM;
    return s;
}

/* Remembers a number without room, to be written when all others have theirs. */
static ktg_status put_off(ktg_context *context, ktg_label_sheet *sheet, uint32_t edge, uint32_t h,
                          const char *text) {
    const ktg_topology *t = sheet->topology;
    ktg_vec2 a = ktg_start_of(t, h), b = ktg_end_of(t, h);
    KTG_TRY(ktg_reserve(context, &sheet->wants, &sheet->want_capacity, sheet->want_count + 1));
    ktg_label_want *want = &sheet->wants[sheet->want_count++];
    *want = (ktg_label_want){t->piece_of[h / 3], edge, ktg_mul2(ktg_add2(a, b), 0.5),
                             ktg_unit2(ktg_sub2(b, a)), ""};
    snprintf(want->text, sizeof want->text, "%s", text);
    return KTG_OK;
}

static ktg_status write_on_side(ktg_context *context, ktg_label_sheet *sheet, uint32_t edge,
                                uint32_t side, const char *text,
                                const ktg_pattern_tab *const *tabs) {
    uint32_t h = ktg_side_halfedge(&sheet->pattern->edges[edge].sides[side]);
    stand s = stand_of(sheet, edge, side, tabs);
    double most = fmax(sheet->options->number_mm, KTG_LABEL_LEAST_MM);
    ktg_label_box box;
    if (!find_box(sheet, &s, text, most, &box)) {
        if (s.face == KTG_NONE) /* no room on the tab: beside it; or above a joint's mark */
            s = stand_in_face(sheet->topology, h);
        s.from_edge = FROM_EDGE_MM;
        if (!find_box(sheet, &s, text, most, &box))
            return put_off(context, sheet, edge, h, text);
    }
    return ktg_label_write(context, sheet, s.piece, s.face, edge, text, &box);
}

/* True for numbers that read as another one upside down. */
static bool misleads(const char *digits) {
    static const char upside_down[] = "01xxxx9x86";
    char turned[16];
    size_t length = strlen(digits);
    for (size_t i = 0; i < length; i++) {
        turned[length - 1 - i] = upside_down[digits[i] - '0'];
        if (turned[length - 1 - i] == 'x')
            return false;
    }
    turned[length] = '\0';
    return turned[0] != '0' && strcmp(turned, digits) != 0;
}

void ktg_number_text(uint32_t number, char text[16]) {
    snprintf(text, 12, "%u", number);
    if (misleads(text))
        strcat(text, ".");
}

static ktg_status write_number(ktg_context *context, ktg_label_sheet *sheet, uint32_t edge,
                               uint32_t number, const ktg_pattern_tab *const *tabs) {
    char text[16];
    ktg_number_text(number, text);
    KTG_TRY(write_on_side(context, sheet, edge, 0, text, tabs));
    return write_on_side(context, sheet, edge, 1, text, tabs);
}

/* How well an edge of a seam can bear its number: the height that fits on both sides, then the
 * edge's length. */
static double fitness_of(const ktg_label_sheet *sheet, uint32_t edge, const char *text,
                         const ktg_pattern_tab *const *tabs) {
    double least = sheet->options->number_mm, length = 0;
    for (uint32_t side = 0; side < 2; side++) {
        stand s = stand_of(sheet, edge, side, tabs);
        ktg_label_box box;
        uint32_t h = ktg_side_halfedge(&sheet->pattern->edges[edge].sides[side]);
        length =
            ktg_length2(ktg_sub2(ktg_end_of(sheet->topology, h), ktg_start_of(sheet->topology, h)));
        bool fits =
            find_box(sheet, &s, text, fmax(sheet->options->number_mm, KTG_LABEL_LEAST_MM), &box);
        least = fmin(least, fits ? 2 * box.half.y : 0);
    }
    return 1e4 * least + length;
}

static ktg_status number_seams(ktg_context *context, ktg_label_sheet *sheet,
                               const ktg_pattern_tab *const *tabs) {
    for (uint32_t s = 0; s < sheet->pattern->seam_count; s++) {
        const ktg_pattern_seam *seam = &sheet->pattern->seams[s];
        if (seam->obvious)
            break; /* and so are all that follow */
        char text[16];
        ktg_number_text(seam->number, text);
        uint32_t best = 0;
        double best_fitness = -1;
        for (uint32_t k = 0; k < seam->edge_count; k++) {
            double fitness = fitness_of(sheet, seam->edges[k], text, tabs);
            if (fitness > best_fitness * (1 + 1e-9)) {
                best_fitness = fitness;
                best = k;
            }
        }
        KTG_TRY(write_number(context, sheet, seam->edges[best], seam->number, tabs));
    }
    return KTG_OK;
}

static ktg_status number_edges(ktg_context *context, ktg_label_sheet *sheet,
                               const ktg_pattern_tab *const *tabs) {
    uint32_t number = 0;
    for (size_t s = 0; s < sheet->pattern->seam_count; s++)
        for (uint32_t k = 0; k < sheet->pattern->seams[s].edge_count; k++)
            KTG_TRY(
                write_number(context, sheet, sheet->pattern->seams[s].edges[k], ++number, tabs));
    return KTG_OK;
}

static ktg_status write_numbers(ktg_context *context, ktg_label_sheet *sheet) {
    if (sheet->options->numbers == KTG_NUMBER_NONE)
        return KTG_OK;
    const ktg_pattern *pattern = sheet->pattern;
    const ktg_pattern_tab **tabs = ktg_new(context, pattern->edge_count, const ktg_pattern_tab *);
    if (!tabs)
        return KTG_MEMORY;
    for (size_t p = 0; p < pattern->piece_count; p++)
        for (size_t i = 0; i < pattern->pieces[p].tab_count; i++)
            tabs[pattern->pieces[p].tabs[i].edge] = &pattern->pieces[p].tabs[i];
    ktg_status status = sheet->options->numbers == KTG_NUMBER_EDGE
                            ? number_edges(context, sheet, tabs)
                            : number_seams(context, sheet, tabs);
    for (size_t i = 0; status == KTG_OK && i < sheet->want_count; i++)
        status = ktg_label_lead(context, sheet, &sheet->wants[i]);
    ktg_free(tabs);
    return status;
}

static ktg_status write_paper(ktg_context *context, ktg_label_sheet *sheet) {
    KTG_TRY(write_numbers(context, sheet));
    for (uint32_t p = 0; p < sheet->pattern->piece_count; p++)
        KTG_TRY(ktg_label_name(context, sheet, p));
    return KTG_OK;
}

ktg_status ktg_labels_write(ktg_context *context, const ktg_topology *topology,
                            const ktg_finish_options *options, ktg_pattern *pattern) {
    ktg_label_sheet sheet = {.topology = topology, .options = options, .pattern = pattern};
    for (size_t p = 0; p < pattern->piece_count; p++) {
        ktg_free(pattern->pieces[p].labels);
        pattern->pieces[p].labels = NULL;
        pattern->pieces[p].label_count = 0;
    }
    ktg_status status = ktg_label_sheet_open(context, &sheet);
    if (status == KTG_OK)
        status = pattern->mode == KTG_CLOTH ? ktg_cloth_labels_write(context, &sheet)
                                            : write_paper(context, &sheet);
    ktg_label_sheet_drop(&sheet);
    return status;
}
