/* render/callouts.c - short texts at points of a picture, or beside it, none over another. */
#include "render/callouts.h"

#include "core/memory.h"

#include <stdlib.h>

#define GAP_MM      0.35 /* between two texts */
#define RINGS       7
#define RING_MM     1.7
#define TURNS       16
#define LINE_MM     0.12
#define HALO_MM     0.4 /* of white around that line */
#define POINT_MM    0.35
#define MOST_AWAY   4 /* texts go beside the picture with one of so many away from its point, ... */
#define MOST_HIDDEN 10   /* ... or one part of so many of the picture hidden */
#define ASIDE_MM    3.0  /* from the picture to the texts beside it */
#define ROUNDING_MM 0.05 /* dots of a picture do not end where its area does */
#define LINES       2.1  /* from text to text beside it, in digits */

static bool meets(ktg_area a, ktg_area b) {
    return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

static ktg_area box_at(ktg_vec2 middle, double width, double digit_mm) {
    double x = width / 2 + GAP_MM, y = digit_mm / 2 + GAP_MM;
    return (ktg_area){middle.x - x, middle.y - y, middle.x + x, middle.y + y};
}

static bool is_free(const ktg_callout *callouts, size_t count, size_t own, ktg_area box,
                    ktg_area within, const ktg_area *taken, size_t taken_count) {
    if (box.x0 < within.x0 || box.y0 < within.y0 || box.x1 > within.x1 || box.y1 > within.y1)
        return false;
    for (size_t i = 0; i < taken_count; i++)
        if (meets(box, taken[i]))
            return false;
    for (size_t i = 0; i < count; i++) {
        ktg_vec2 p = callouts[i].at;
        ktg_area point = {p.x - POINT_MM, p.y - POINT_MM, p.x + POINT_MM, p.y + POINT_MM};
        if (callouts[i].is_placed && meets(box, callouts[i].box))
            return false;
        if (i != own && meets(box, point))
            return false;
    }
    return true;
}

/* The nearest place: at the point itself, then in rings around it. */
static bool place(cairo_t *cairo, ktg_callout *callouts, size_t count, size_t own, double digit_mm,
                  ktg_area within, const ktg_area *taken, size_t taken_count) {
    ktg_callout *c = &callouts[own];
    double width = ktg_text_width(cairo, c->text);
    for (int ring = 0; ring <= RINGS; ring++)
        for (int turn = 0; turn < (ring ? TURNS : 1); turn++) {
            double angle = 2 * KTG_PI * turn / TURNS + 0.4;
            ktg_vec2 away = {cos(angle) * (ring * RING_MM + (ring ? width / 2 : 0)),
                             sin(angle) * ring * RING_MM};
            c->box = box_at(ktg_add2(c->at, away), width, digit_mm);
            if (is_free(callouts, count, own, c->box, within, taken, taken_count))
                return true;
        }
    return false;
}

void ktg_callouts_place(cairo_t *cairo, ktg_callout *callouts, size_t count, double digit_mm,
                        ktg_area within, const ktg_area *taken, size_t taken_count) {
    ktg_text_set(cairo, KTG_FACE_PLAIN, digit_mm);
    for (size_t i = 0; i < count; i++)
        callouts[i].is_placed =
            place(cairo, callouts, count, i, digit_mm, within, taken, taken_count);
}

/* ---- beside the picture ------------------------------------------------------------------- */

static bool is_at_its_point(const ktg_callout *c) {
    return c->is_placed && c->at.x > c->box.x0 && c->at.x < c->box.x1 && c->at.y > c->box.y0 &&
           c->at.y < c->box.y1;
}

static double area_of(ktg_area a) {
    return (a.x1 - a.x0) * (a.y1 - a.y0);
}

double ktg_callouts_area(double width, double digit_mm) {
    return area_of(box_at((ktg_vec2){0, 0}, width, digit_mm));
}

bool ktg_callouts_hide(double texts_mm2, double picture_mm2) {
    return texts_mm2 * MOST_HIDDEN > picture_mm2;
}

/* Whether many are not at their points, or they hide much of the picture. */
static bool are_crowded(const ktg_callout *callouts, size_t count, ktg_area picture) {
    size_t away = 0;
    double hidden = 0;
    for (size_t i = 0; i < count; i++) {
        away += !is_at_its_point(&callouts[i]);
        hidden += area_of(callouts[i].box);
    }
    return away * MOST_AWAY > count || ktg_callouts_hide(hidden, area_of(picture));
}

static int compare_doubles(double a, double b) {
    return (a > b) - (a < b);
}

static int from_left(const void *a, const void *b) {
    const ktg_callout *const *p = a, *const *q = b;
    int order = compare_doubles((*p)->at.x, (*q)->at.x);
    return order ? order : (*p > *q) - (*p < *q);
}

static int from_top(const void *a, const void *b) {
    const ktg_callout *const *p = a, *const *q = b;
    int order = compare_doubles((*p)->at.y, (*q)->at.y);
    return order ? order : (*p > *q) - (*p < *q);
}

/* heights: as near to the wished ones, which rise, as can be with `step` between them and all from
 * `low` to `high` (isotonic regression by pooling neighbours). weights: scratch. */
static void spread(double *heights, size_t *weights, size_t count, double step, double low,
                   double high) {
    size_t pools = 0;
    for (size_t i = 0; i < count; i++) {
        double mean = heights[i] - (double)i * step;
        size_t weight = 1;
        for (; pools > 0 && heights[pools - 1] >= mean; pools--) {
            size_t both = weight + weights[pools - 1];
            mean += (heights[pools - 1] - mean) * (double)weights[pools - 1] / (double)both;
            weight = both;
        }
        heights[pools] = mean;
        weights[pools++] = weight;
    }
    high -= (double)(count - 1) * step;
    for (size_t i = count; i-- > 0; weights[pools - 1]--) {
        while (weights[pools - 1] == 0)
            pools--;
        heights[i] = fmax(low, fmin(high, heights[pools - 1])) + (double)i * step;
    }
}

static ktg_vec2 leader_start(const ktg_callout *c) {
    const ktg_area *box = &c->box;
    bool beside = c->at.x < box->x0 || c->at.x > box->x1;
    double y = beside ? (box->y0 + box->y1) / 2 : c->at.y < box->y0 ? box->y0 : box->y1;
    return (ktg_vec2){fmax(box->x0, fmin(box->x1, c->at.x)), y};
}

static double side_of(ktg_vec2 a, ktg_vec2 b, ktg_vec2 p) {
    return ktg_cross2(ktg_sub2(b, a), ktg_sub2(p, a));
}

static bool do_cross(const ktg_callout *a, const ktg_callout *b) {
    ktg_vec2 p = leader_start(a), q = leader_start(b);
    return side_of(p, a->at, q) * side_of(p, a->at, b->at) < 0 &&
           side_of(q, b->at, p) * side_of(q, b->at, a->at) < 0;
}

static void change_heights(ktg_callout *a, ktg_callout *b) {
    double y0 = a->box.y0, y1 = a->box.y1;
    a->box.y0 = b->box.y0;
    a->box.y1 = b->box.y1;
    b->box.y0 = y0;
    b->box.y1 = y1;
}

/* Two leaders that cross change their texts' heights; each change makes them shorter. */
static void uncross(ktg_callout **row, size_t count) {
    for (size_t pass = 0, changes = 1; pass < count && changes > 0; pass++) {
        changes = 0;
        for (size_t i = 0; i < count; i++)
            for (size_t k = 0; k < i; k++)
                if (do_cross(row[i], row[k])) {
                    change_heights(row[i], row[k]);
                    changes++;
                }
    }
}

/* A column of texts that end, or begin, at `x`. heights, weights: scratch. */
static void put_column(cairo_t *cairo, ktg_callout **row, size_t count, double digit_mm, double x,
                       bool ends, ktg_area within, double *heights, size_t *weights) {
    double half = digit_mm / 2 + GAP_MM;
    qsort(row, count, sizeof *row, from_top);
    for (size_t i = 0; i < count; i++)
        heights[i] = row[i]->at.y;
    spread(heights, weights, count, LINES * digit_mm, within.y0 + half, within.y1 - half);
    for (size_t i = 0; i < count; i++) {
        double width = ktg_text_width(cairo, row[i]->text);
        ktg_vec2 middle = {x + (ends ? -1 : 1) * (width / 2 + GAP_MM), heights[i]};
        row[i]->box = box_at(middle, width, digit_mm);
        row[i]->is_placed = true;
    }
    uncross(row, count);
}

ktg_vec2 ktg_callouts_room(size_t count, double widest, double digit_mm) {
    return (ktg_vec2){widest + ASIDE_MM + 2 * GAP_MM, (double)((count + 1) / 2) * LINES * digit_mm};
}

/* Whether the texts, and so many lines, fit beside the picture. */
static bool has_room_beside(cairo_t *cairo, const ktg_callout *callouts, size_t count,
                            double digit_mm, ktg_area within, ktg_area picture) {
    double widest = 0;
    for (size_t i = 0; i < count; i++)
        widest = fmax(widest, ktg_text_width(cairo, callouts[i].text));
    ktg_vec2 room = ktg_callouts_room(count, widest, digit_mm);
    return room.x <= fmin(picture.x0 - within.x0, within.x1 - picture.x1) + ROUNDING_MM &&
           room.y <= within.y1 - within.y0;
}

ktg_status ktg_callouts_spread(ktg_context *context, cairo_t *cairo, ktg_callout *callouts,
                               size_t count, double digit_mm, ktg_area within, ktg_area picture) {
    ktg_text_set(cairo, KTG_FACE_PLAIN, digit_mm);
    if (!are_crowded(callouts, count, picture) ||
        !has_room_beside(cairo, callouts, count, digit_mm, within, picture))
        return KTG_OK;
    ktg_callout **row = ktg_new(context, count, ktg_callout *);
    double *heights = ktg_new(context, count, double);
    size_t *weights = ktg_new(context, count, size_t), left = (count + 1) / 2;
    ktg_status status = row && heights && weights ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        for (size_t i = 0; i < count; i++)
            row[i] = &callouts[i];
        qsort(row, count, sizeof *row, from_left);
        put_column(cairo, row, left, digit_mm, picture.x0 - ASIDE_MM, true, within, heights,
                   weights);
        put_column(cairo, row + left, count - left, digit_mm, picture.x1 + ASIDE_MM, false, within,
                   heights, weights);
    }
    ktg_free(row);
    ktg_free(heights);
    ktg_free(weights);
    return status;
}

/* ---- drawing ------------------------------------------------------------------------------ */

/* From the text to its point, unless that is under the text. */
static void draw_leader(cairo_t *cairo, const ktg_callout *c) {
    ktg_vec2 start = leader_start(c);
    if (is_at_its_point(c))
        return;
    cairo_set_dash(cairo, NULL, 0, 0);
    cairo_move_to(cairo, start.x, start.y);
    cairo_line_to(cairo, c->at.x, c->at.y);
    cairo_set_source_rgba(cairo, 1, 1, 1, 0.7);
    cairo_set_line_width(cairo, HALO_MM);
    cairo_stroke_preserve(cairo);
    cairo_set_source_rgb(cairo, 0.1, 0.1, 0.1);
    cairo_set_line_width(cairo, LINE_MM);
    cairo_stroke(cairo);
    cairo_arc(cairo, c->at.x, c->at.y, POINT_MM, 0, 2 * KTG_PI);
    cairo_fill(cairo);
}

void ktg_callouts_draw(cairo_t *cairo, const ktg_callout *callouts, size_t count, double digit_mm,
                       ktg_face face) {
    for (size_t i = 0; i < count; i++)
        if (callouts[i].is_placed)
            draw_leader(cairo, &callouts[i]);
    ktg_text_set(cairo, face, digit_mm);
    for (size_t i = 0; i < count; i++) {
        const ktg_callout *c = &callouts[i];
        if (!c->is_placed)
            continue;
        double x = (c->box.x0 + c->box.x1 - ktg_text_width(cairo, c->text)) / 2;
        double baseline = (c->box.y0 + c->box.y1 + digit_mm) / 2;
        ktg_text_ground(cairo, x, baseline, c->text, 0.7);
        cairo_set_source_rgb(cairo, 0, 0, 0);
        ktg_text_draw(cairo, x, baseline, c->text);
    }
}
