/* render/build_eye.c - from where a step is seen best. */
#include "render/build_guide.h"

#include "core/memory.h"

#include <stdio.h>

#define DOTS       180.0 /* of the model in a trial */
#define MANY_FACES 20000 /* then fewer eyes are tried */

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

/* How long, in dots, the seams are where the view shows them. */
static double seen_length(const ktg_build_guide *g, const ktg_step *step, const ktg_view *view) {
    const ktg_pattern *p = g->drawing->pattern;
    double sum = 0;
    for (uint32_t i = 0; i < step->numbered; i++) {
        const ktg_pattern_seam *seam = &p->seams[step->seams[i]];
        double seam_sum = 0;
        for (uint32_t e = 0; e < seam->edge_count; e++) {
            const ktg_pattern_edge *edge = &p->edges[seam->edges[e]];
            ktg_vec2 a = ktg_view_dot(view, p->vertices[edge->vertices[0]]);
            ktg_vec2 way = ktg_sub2(ktg_view_dot(view, p->vertices[edge->vertices[1]]), a);
            double length = ktg_length2(way);
            int count = (int)fmin(64, ceil(length / 2)), hits = 0;
            for (int k = 0; k < count; k++)
                hits += ktg_view_shows(view, ktg_madd2(a, (k + 0.5) / count, way),
                                       edge->sides[0].face, edge->sides[1].face);
            seam_sum += count > 0 ? length * hits / count : 0;
        }
        sum += seam_sum + 12 * (seam_sum > 4); /* each number that can be read counts, too */
    }
    return sum;
}

ktg_status ktg_guide_choose_eye(const ktg_build_guide *guide, uint32_t step,
                                ktg_named_eye *chosen) {
    const ktg_drawing *drawing = guide->drawing;
    size_t count = drawing->pattern->face_count > MANY_FACES ? 8 : sizeof stands / sizeof *stands;
    double best = -1;
    for (size_t i = 0; i < count; i++) {
        ktg_eye eye =
            ktg_eye_at(drawing->options.up, stands[i].eighth * KTG_PI / 4, stands[i].rise);
        ktg_area seen;
        ktg_view view;
        if (!ktg_view_extent(drawing->pattern, guide->shown, &eye, &seen))
            return KTG_OK;
        double extent = fmax(seen.x1 - seen.x0, seen.y1 - seen.y0);
        if (!(extent > 0))
            continue;
        KTG_TRY(ktg_view_look(drawing->context, drawing->pattern, guide->shown, &eye, seen,
                              DOTS / extent, &view));
        double length = stands[i].liking * seen_length(guide, &guide->steps[step], &view);
        ktg_view_drop(&view);
        if (length <= best)
            continue;
        best = length;
        chosen->eye = eye;
        name_eye(&stands[i], chosen->name);
    }
    return KTG_OK;
}
