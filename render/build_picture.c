/* render/build_picture.c - the pictures of the guide: the finished model, and each step. */
#include "render/build_guide.h"

#include "core/memory.h"
#include "render/text.h"

#define NUMBER_MM  1.75
#define SEAM_MM    0.55
#define START_MM   0.75
#define NOTCH_MM   0.3
#define FRAME      1.5  /* a step's picture is so much wider than its seams, ... */
#define LEAST_SHOW 0.45 /* ... and shows at least so much of the body */
#define INSET      0.8  /* one that shows less has a small picture of the whole beside it */
#define INSET_MM   13.0
#define GAP_DOTS   6.0 /* seams are drawn on across gaps so short */

/* ---- looks -------------------------------------------------------------------------------- */

typedef struct step_look {
    const ktg_build_guide *guide;
    uint32_t step; /* from 1 */
} step_look;

static uint32_t step_colour(const void *user, const ktg_seen_dot *dot) {
    const step_look *look = user;
    uint32_t stage = look->guide->stage[dot->face];
    return ktg_drawing_colour(look->guide->drawing, stage == look->step  ? KTG_GUIDE_NOW
                                                    : stage < look->step ? KTG_GUIDE_BEFORE
                                                                         : KTG_GUIDE_OPEN);
}

/* Folds are pale; seams glued before are dark, those still open are pale, those of the step are
 * drawn afterwards. */
static ktg_line_look step_line(const void *user, uint32_t face, uint32_t side) {
    const step_look *look = user;
    size_t h = 3 * (size_t)face + side;
    const ktg_pattern *pattern = look->guide->drawing->pattern;
    switch ((ktg_side_kind)look->guide->sides[h]) {
    case KTG_SIDE_FLAT:
        return (ktg_line_look){0, 0};
    case KTG_SIDE_FOLD:
        return (ktg_line_look){0.03, 0.68};
    case KTG_SIDE_BORDER:
        return (ktg_line_look){0.2, 0.3};
    case KTG_SIDE_SEAM:
        break;
    }
    uint32_t seam = look->guide->seam_of[h];
    uint32_t section = seam < pattern->seam_count ? pattern->seams[seam].section : 0;
    return section < look->step ? (ktg_line_look){0.12, 0.35} : (ktg_line_look){0.1, 0.55};
}

/* ---- seams over the picture --------------------------------------------------------------- */

/* The longest part of a seam that is seen. */
typedef struct run {
    double length;
    ktg_vec2 middle; /* on the page */
} run;

typedef struct tracing {
    const ktg_picture *picture;
    cairo_t *cairo; /* NULL: nothing is drawn */
    ktg_vec2 from;  /* dots: where the part began */
    bool is_open;
    run *longest;
} tracing;

static void end_run(tracing *t, ktg_vec2 to) {
    double length = ktg_length2(ktg_sub2(to, t->from)) * t->picture->mm;
    ktg_vec2 a = ktg_picture_point(t->picture, t->from), b = ktg_picture_point(t->picture, to);
    t->is_open = false;
    if (t->cairo && length > 0.1) {
        cairo_move_to(t->cairo, a.x, a.y);
        cairo_line_to(t->cairo, b.x, b.y);
    }
    if (length > t->longest->length)
        *t->longest = (run){length, ktg_mul2(ktg_add2(a, b), 0.5)};
}

/* The parts of an edge that are seen. */
static void trace_edge(tracing *t, const ktg_pattern_edge *edge) {
    const ktg_view *view = &t->picture->view;
    const ktg_vec3 *vertices = view->pattern->vertices;
    ktg_vec2 a = ktg_view_dot(view, vertices[edge->vertices[0]]);
    ktg_vec2 way = ktg_sub2(ktg_view_dot(view, vertices[edge->vertices[1]]), a);
    uint32_t beyond = edge->side_count == 2 ? edge->sides[1].face : KTG_NONE;
    int count = (int)fmin(4096, ceil(ktg_length2(way))), gap = 0;
    ktg_vec2 last = a;
    for (int k = 0; k <= count && count > 0; k++) {
        ktg_vec2 at = ktg_madd2(a, (double)k / count, way);
        if (ktg_view_shows(view, at, edge->sides[0].face, beyond)) {
            if (!t->is_open)
                t->from = at;
            t->is_open = true;
            last = at;
            gap = 0;
        } else if (t->is_open && ++gap > GAP_DOTS)
            end_run(t, last);
    }
    if (t->is_open)
        end_run(t, last);
}

static run trace_seam(const ktg_picture *picture, cairo_t *cairo, const ktg_pattern_seam *seam) {
    run longest = {0, {0, 0}};
    tracing t = {picture, cairo, {0, 0}, false, &longest};
    for (uint32_t k = 0; k < seam->edge_count; k++)
        trace_edge(&t, &picture->view.pattern->edges[seam->edges[k]]);
    return longest;
}

/* A dot where the gluing of a seam begins, if that is seen. */
static void draw_start(const ktg_build_guide *g, const ktg_picture *picture, cairo_t *cairo,
                       uint32_t seam) {
    const ktg_pattern *pattern = g->drawing->pattern;
    const ktg_pattern_seam *s = &pattern->seams[seam];
    uint32_t vertex = g->starts[seam];
    if (vertex == KTG_NONE)
        return;
    ktg_vec2 dot = ktg_view_dot(&picture->view, pattern->vertices[vertex]);
    ktg_vec2 at = ktg_picture_point(picture, dot);
    for (uint32_t k = 0; k < s->edge_count; k++) {
        const ktg_pattern_edge *edge = &pattern->edges[s->edges[k]];
        if ((edge->vertices[0] != vertex && edge->vertices[1] != vertex) ||
            !ktg_view_shows(&picture->view, dot, edge->sides[0].face, edge->sides[1].face))
            continue;
        cairo_arc(cairo, at.x, at.y, START_MM, 0, 2 * KTG_PI);
        cairo_fill(cairo);
        return;
    }
}

static void stroke_seam(const ktg_build_guide *g, const ktg_picture *picture, cairo_t *cairo,
                        uint32_t seam, run *longest) {
    const ktg_pattern_seam *s = &g->drawing->pattern->seams[seam];
    *longest = trace_seam(picture, cairo, s);
    if (g->drawing->options.colour)
        cairo_set_source_rgb(cairo, 0.75, 0.1, 0.05);
    else
        cairo_set_source_rgb(cairo, 0, 0, 0);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_dash(cairo, NULL, 0, 0);
    cairo_set_line_width(cairo, s->obvious ? NOTCH_MM : SEAM_MM);
    cairo_stroke(cairo);
    draw_start(g, picture, cairo, seam);
}

static bool is_within(ktg_area area, ktg_vec2 p) {
    return p.x >= area.x0 && p.x <= area.x1 && p.y >= area.y0 && p.y <= area.y1;
}

/* The number of a seam as a callout; false where none is seen. */
static bool call_seam(const ktg_build_guide *g, uint32_t seam, const run *longest, ktg_area within,
                      ktg_callout *callout) {
    if (g->low[seam] == 0 || !(longest->length > 0.25) || !is_within(within, longest->middle))
        return false;
    *callout = (ktg_callout){.at = longest->middle};
    ktg_words_range(g->low[seam], g->high[seam], callout->text);
    return true;
}

/* ---- a step ------------------------------------------------------------------------------- */

/* The box of what the eye sees that the picture shows: the step's seams with what is around, all of
 * the body where that is not much more. */
static ktg_area frame_of(const ktg_build_guide *g, const ktg_step *step, const ktg_eye *eye,
                         ktg_area seen) {
    const ktg_pattern *p = g->drawing->pattern;
    ktg_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < step->seam_count; i++) {
        const ktg_pattern_seam *seam = &p->seams[step->seams[i]];
        for (uint32_t e = 0; e < 2 * seam->edge_count; e++) {
            ktg_vec2 a =
                ktg_eye_sees(eye, p->vertices[p->edges[seam->edges[e / 2]].vertices[e % 2]]);
            low = (ktg_vec2){fmin(low.x, a.x), fmin(low.y, a.y)};
            high = (ktg_vec2){fmax(high.x, a.x), fmax(high.y, a.y)};
        }
    }
    double whole = fmax(seen.x1 - seen.x0, seen.y1 - seen.y0);
    double half = fmax(FRAME * fmax(high.x - low.x, high.y - low.y), LEAST_SHOW * whole) / 2;
    ktg_vec2 middle = ktg_mul2(ktg_add2(low, high), 0.5);
    return (ktg_area){fmax(seen.x0, middle.x - half), fmax(seen.y0, middle.y - half),
                      fmin(seen.x1, middle.x + half), fmin(seen.y1, middle.y + half)};
}

/* A small picture of the whole body in the upper right corner; *taken is where. */
static ktg_status draw_inset(const ktg_build_guide *g, const step_look *look, const ktg_eye *eye,
                             ktg_area seen, cairo_t *cairo, ktg_area area, ktg_area *taken) {
    ktg_look plain = {look, step_colour, NULL, 0.1};
    double size = fmin(INSET_MM, (area.x1 - area.x0) / 3);
    ktg_picture picture;
    *taken = (ktg_area){area.x1 - size, area.y0, area.x1, area.y0 + size};
    cairo_set_source_rgb(cairo, 1, 1, 1);
    cairo_rectangle(cairo, taken->x0, taken->y0, size, size);
    cairo_fill(cairo);
    ktg_status status = ktg_picture_draw(g->drawing->context, g->drawing->pattern, g->shown, eye,
                                         seen, &plain, cairo, *taken, &picture);
    ktg_view_drop(&picture.view);
    return status;
}

static ktg_status draw_seams(ktg_build_guide *g, const ktg_step *step, const ktg_picture *picture,
                             cairo_t *cairo, ktg_area area, const ktg_area *taken) {
    ktg_context *context = g->drawing->context;
    ktg_callout *callouts = ktg_new(context, step->seam_count, ktg_callout);
    uint32_t *seams = ktg_new(context, step->seam_count, uint32_t);
    ktg_status status = callouts && seams ? KTG_OK : KTG_MEMORY;
    size_t count = 0;
    for (uint32_t i = step->seam_count; status == KTG_OK && i-- > 0;) { /* notches below */
        uint32_t seam = step->seams[i];
        run longest;
        stroke_seam(g, picture, cairo, seam, &longest);
        if (i < step->numbered && !g->is_told[seam] &&
            call_seam(g, seam, &longest, area, &callouts[count]))
            seams[count++] = seam;
    }
    ktg_callouts_place(cairo, callouts, count, NUMBER_MM, area, taken, taken ? 1 : 0);
    ktg_callouts_draw(cairo, callouts, count, NUMBER_MM, KTG_FACE_BOLD);
    for (size_t i = 0; i < count; i++)
        g->is_told[seams[i]] = callouts[i].is_placed;
    ktg_free(callouts);
    ktg_free(seams);
    return status;
}

ktg_status ktg_guide_draw_step(ktg_build_guide *guide, uint32_t step, int eye, cairo_t *cairo,
                               ktg_area area) {
    const ktg_pattern *pattern = guide->drawing->pattern;
    const ktg_eye *from = &guide->steps[step].eyes[eye].eye;
    step_look user = {guide, step + 1};
    ktg_look look = {&user, step_colour, step_line, 0.18};
    ktg_area seen, taken;
    ktg_picture picture;
    ktg_guide_show_pieces(guide, step);
    if (!ktg_view_extent(pattern, guide->shown, from, &seen))
        return KTG_OK;
    ktg_area frame = frame_of(guide, &guide->steps[step], from, seen);
    double shown = fmax(frame.x1 - frame.x0, frame.y1 - frame.y0);
    bool inset = shown < INSET * fmax(seen.x1 - seen.x0, seen.y1 - seen.y0);
    ktg_status status = ktg_picture_draw(guide->drawing->context, pattern, guide->shown, from,
                                         frame, &look, cairo, area, &picture);
    if (status == KTG_OK && inset)
        status = draw_inset(guide, &user, from, seen, cairo, area, &taken);
    if (status == KTG_OK && picture.view.faces)
        status =
            draw_seams(guide, &guide->steps[step], &picture, cairo, area, inset ? &taken : NULL);
    ktg_view_drop(&picture.view);
    return status;
}

/* ---- the finished model ------------------------------------------------------------------- */

static ktg_status write_numbers(const ktg_build_guide *g, const ktg_picture *picture,
                                cairo_t *cairo, ktg_area area) {
    const ktg_pattern *pattern = g->drawing->pattern;
    ktg_callout *callouts = ktg_new(g->drawing->context, pattern->seam_count, ktg_callout);
    size_t count = 0;
    if (!callouts)
        return KTG_MEMORY;
    for (uint32_t s = 0; s < pattern->seam_count; s++) {
        run longest = trace_seam(picture, NULL, &pattern->seams[s]);
        if (longest.length > 1.5 && call_seam(g, s, &longest, area, &callouts[count]))
            count++;
    }
    ktg_callouts_place(cairo, callouts, count, NUMBER_MM, area, NULL, 0);
    ktg_callouts_draw(cairo, callouts, count, NUMBER_MM, KTG_FACE_PLAIN);
    ktg_free(callouts);
    return KTG_OK;
}

ktg_status ktg_guide_draw_model(const ktg_build_guide *guide, cairo_t *cairo, ktg_area area,
                                bool from_behind) {
    ktg_picture picture;
    ktg_status status = ktg_solid_picture(guide->drawing, cairo, area, from_behind, &picture);
    if (status == KTG_OK && picture.view.faces && guide->drawing->pattern->piece_count == 1)
        status = write_numbers(guide, &picture, cairo, area);
    ktg_view_drop(&picture.view);
    return status;
}
