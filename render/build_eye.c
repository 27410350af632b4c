/* render/build_eye.c - from where a step is seen best. */
#include "render/build_guide.h"

#include "core/memory.h"

#include <stdio.h>

#define DOTS        140.0 /* of the model in a trial */
#define MANY_FACES  20000 /* then fewer eyes are tried */
#define MOST_DOUBLE 24    /* with more steps than that each has one picture */
#define READABLE    3.0   /* dots of a seam beside which its number can be read */

/* Where eyes stand: turns in eighths to the right of the front; the first ones are preferred. */
typedef struct stand {
    int eighth;
    double rise, liking;
} stand;

#define LEVEL 0.35
#define HIGH  1.05
#define LOW   (-0.6)

static const stand stands[] = {
    {1, LEVEL, 1},   {0, LEVEL, 0.9},  {7, LEVEL, 0.92}, {2, LEVEL, 0.85}, {6, LEVEL, 0.85},
    {5, LEVEL, 0.9}, {3, LEVEL, 0.88}, {4, LEVEL, 0.85}, {1, HIGH, 0.85},  {5, HIGH, 0.8},
    {1, LOW, 0.85},  {7, LOW, 0.82},   {5, LOW, 0.82},   {3, LOW, 0.82},   {0, LOW, 0.75},
    {4, LOW, 0.75},  {0, HIGH, 0.75},  {4, HIGH, 0.75}};

static void name_eye(const stand *s, char name[64]) {
    static const char *const sides[] = {"the front",     "the front right", "the right",
                                        "behind, right", "behind",          "behind, left",
                                        "the left",      "the front left"};
    snprintf(name, 64, "from %s%s", sides[s->eighth],
             s->rise >= HIGH ? ", high above"
             : s->rise < 0   ? ", below"
                             : "");
}

/* How long, in dots, a seam is where the view shows it. */
static double seen_length(const ktg_pattern *p, const ktg_pattern_seam *seam,
                          const ktg_view *view) {
    double sum = 0;
    for (uint32_t e = 0; e < seam->edge_count; e++) {
        const ktg_pattern_edge *edge = &p->edges[seam->edges[e]];
        ktg_vec2 a = ktg_view_dot(view, p->vertices[edge->vertices[0]]);
        ktg_vec2 way = ktg_sub2(ktg_view_dot(view, p->vertices[edge->vertices[1]]), a);
        double length = ktg_length2(way);
        int count = (int)fmin(64, ceil(length / 2)), hits = 0;
        for (int k = 0; k < count; k++)
            hits += ktg_view_shows(view, ktg_madd2(a, (k + 0.5) / count, way), edge->sides[0].face,
                                   edge->sides[1].face);
        sum += count > 0 ? length * hits / count : 0;
    }
    return sum;
}

/* lengths: for each seam of the step with a number, how much of it the eye sees; 0 where there is
 * nothing to see. */
static ktg_status try_eye(const ktg_build_guide *g, const ktg_step *step, const ktg_eye *eye,
                          double *lengths) {
    const ktg_pattern *pattern = g->drawing->pattern;
    ktg_area seen;
    ktg_view view;
    for (uint32_t i = 0; i < step->numbered; i++)
        lengths[i] = 0;
    if (!ktg_view_extent(pattern, g->shown, eye, &seen))
        return KTG_OK;
    double extent = fmax(seen.x1 - seen.x0, seen.y1 - seen.y0);
    if (!(extent > 0))
        return KTG_OK;
    KTG_TRY(ktg_view_look(g->drawing->context, pattern, g->shown, eye, seen, DOTS / extent, &view));
    for (uint32_t i = 0; i < step->numbered; i++)
        lengths[i] = seen_length(pattern, &pattern->seams[step->seams[i]], &view);
    ktg_view_drop(&view);
    return KTG_OK;
}

/* What an eye is worth that sees so much of the seams; `but` has what is seen already, or is NULL.
 * Each number that can be read counts, too. */
static double worth(const double *lengths, const double *but, uint32_t count) {
    double sum = 0;
    for (uint32_t i = 0; i < count; i++)
        if (!but || but[i] <= READABLE)
            sum += lengths[i] + (lengths[i] > READABLE ? 3 * READABLE : 0);
    return sum;
}

/* Adds the best eye of those tried; `but` as above. */
static void take_best(ktg_build_guide *g, ktg_step *step, const double *lengths, size_t eyes,
                      const double *but, const double **taken) {
    double best = but ? 3 * READABLE : -1;
    for (size_t i = 0; i < eyes; i++) {
        const double *own = lengths + i * step->numbered;
        double value = stands[i].liking * worth(own, but, step->numbered);
        if (value <= best)
            continue;
        ktg_named_eye *eye = &step->eyes[but ? 1 : 0];
        best = value;
        eye->eye =
            ktg_eye_at(g->drawing->options.up, stands[i].eighth * KTG_PI / 4, stands[i].rise);
        name_eye(&stands[i], eye->name);
        step->eye_count = but ? 2 : 1;
        *taken = own;
    }
}

static ktg_status choose_for(ktg_build_guide *g, uint32_t k, double *lengths) {
    ktg_step *step = &g->steps[k];
    size_t eyes = g->drawing->pattern->face_count > MANY_FACES ? 8 : sizeof stands / sizeof *stands;
    const double *first = NULL, *second = NULL;
    ktg_guide_show_pieces(g, k);
    for (size_t i = 0; i < eyes; i++) {
        ktg_eye eye =
            ktg_eye_at(g->drawing->options.up, stands[i].eighth * KTG_PI / 4, stands[i].rise);
        KTG_TRY(try_eye(g, step, &eye, lengths + i * step->numbered));
    }
    take_best(g, step, lengths, eyes, NULL, &first);
    if (g->step_count <= MOST_DOUBLE)
        take_best(g, step, lengths, eyes, first, &second);
    return KTG_OK;
}

ktg_status ktg_guide_choose_eyes(ktg_build_guide *guide) {
    ktg_context *context = guide->drawing->context;
    double *lengths = ktg_new(
        context, guide->drawing->pattern->seam_count * (sizeof stands / sizeof *stands), double);
    ktg_status status = lengths ? KTG_OK : KTG_MEMORY;
    for (uint32_t k = 0; status == KTG_OK && k < guide->step_count; k++) {
        if (guide->steps[k].seam_count < guide->picture_least)
            continue;
        status = ktg_check_cancel(context);
        if (status == KTG_OK)
            status = choose_for(guide, k, lengths);
    }
    ktg_free(lengths);
    return status;
}

void ktg_guide_show_pieces(ktg_build_guide *guide, uint32_t step) {
    for (uint32_t f = 0; f < guide->drawing->pattern->face_count; f++) {
        uint32_t piece = guide->piece_of[f];
        guide->shown[f] = piece != KTG_NONE && guide->part_of[piece] == guide->steps[step].part &&
                          guide->first_step[piece] > 0 && guide->first_step[piece] <= step + 1;
    }
}
