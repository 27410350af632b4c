/* render/callouts.c - short texts at points of a picture, none over another. */
#include "render/callouts.h"

#define GAP_MM   0.35 /* between two texts */
#define RINGS    7
#define RING_MM  1.7
#define TURNS    16
#define LINE_MM  0.12
#define POINT_MM 0.35

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

/* From the text to its point, unless that is under the text. */
static void draw_leader(cairo_t *cairo, const ktg_callout *c) {
    ktg_vec2 middle = {(c->box.x0 + c->box.x1) / 2, (c->box.y0 + c->box.y1) / 2};
    if (c->at.x > c->box.x0 && c->at.x < c->box.x1 && c->at.y > c->box.y0 && c->at.y < c->box.y1)
        return;
    cairo_set_source_rgb(cairo, 0.1, 0.1, 0.1);
    cairo_set_dash(cairo, NULL, 0, 0);
    cairo_set_line_width(cairo, LINE_MM);
    cairo_move_to(cairo, middle.x, middle.y);
    cairo_line_to(cairo, c->at.x, c->at.y);
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
