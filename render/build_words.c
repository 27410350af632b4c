/* render/build_words.c - what the guide says. */
#include "render/build_guide.h"

#include <stdio.h>
#include <string.h>

#define EN_DASH "\xe2\x80\x93"
#define SQUARED "\xc2\xb2"

/* Appends to a text of KTG_WORDS_SIZE, as much as fits. */
static void add(char *text, const char *words) {
    size_t used = strlen(text);
    snprintf(text + used, KTG_WORDS_SIZE - used, "%s", words);
}

void ktg_words_range(uint32_t low, uint32_t high, char text[32]) {
    if (low == 0)
        *text = 0;
    else if (low == high)
        snprintf(text, 32, "%u", low);
    else
        snprintf(text, 32, "%u" EN_DASH "%u", low, high);
}

/* ---- paper -------------------------------------------------------------------------------- */

/* The largest extent of the model, and how wide its faces are: the root of the mean area between
 * two folds, where a flat region is one face. */
static void measure(const ktg_build_guide *g, double *extent, double *face) {
    const ktg_pattern *p = g->drawing->pattern;
    double area = 0, regions = 0;
    ktg_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t v = 0; v < p->vertex_count; v++) {
        ktg_vec3 a = p->vertices[v];
        low = (ktg_vec3){fmin(low.x, a.x), fmin(low.y, a.y), fmin(low.z, a.z)};
        high = (ktg_vec3){fmax(high.x, a.x), fmax(high.y, a.y), fmax(high.z, a.z)};
    }
    for (size_t h = 0; h < 3 * (size_t)p->face_count; h += 3) {
        const uint32_t *c = &p->faces[h];
        ktg_vec3 a = p->vertices[c[0]];
        area += ktg_length3(
                    ktg_cross3(ktg_sub3(p->vertices[c[1]], a), ktg_sub3(p->vertices[c[2]], a))) /
                2;
        regions += 1;
        for (int k = 0; k < 3; k++)
            regions -= g->sides[h + (size_t)k] == KTG_SIDE_FLAT ? 0.5 : 0;
    }
    *extent = ktg_largest3(ktg_sub3(high, low));
    *face = sqrt(area / fmax(1, regions));
}

/* The larger the model, the stiffer its paper, which has to carry it; small faces want it thinner,
 * for stiff paper does not fold along short lines. */
void ktg_words_paper(const ktg_build_guide *guide, char text[KTG_WORDS_SIZE]) {
    static const int weights[] = {120, 160, 200, 250};
    double extent, face;
    measure(guide, &extent, &face);
    int rank = extent < 100 ? 0 : extent < 250 ? 1 : extent < 500 ? 2 : 3;
    rank -= rank > 0 && face < 8;
    snprintf(text, KTG_WORDS_SIZE,
             "Paper of about %d g/m" SQUARED
             ": the model is %.0f mm large, its faces about %.0f mm.",
             weights[rank], extent, face);
}

/* ---- steps -------------------------------------------------------------------------------- */

void ktg_words_title(const ktg_build_guide *guide, uint32_t step, char text[KTG_WORDS_SIZE]) {
    const ktg_step *s = &guide->steps[step];
    char range[32];
    ktg_words_range(s->low, s->high, range);
    snprintf(text, KTG_WORDS_SIZE, "%u. %s%s%s", step + 1,
             !*range             ? "Notches"
             : s->low == s->high ? "Seam "
                                 : "Seams ",
             range, s->closing > 0 ? ", the last" : "");
    if (s->closing > 0 && guide->step_count == 1)
        snprintf(text, KTG_WORDS_SIZE, "%u. %s %s", step + 1, s->low == s->high ? "Seam" : "Seams",
                 range);
}

/* Where in its body a step's seams lie, as one sees it from the front: "at the top, on the left".
 */
static void add_place(const ktg_build_guide *g, const ktg_step *s, char *text) {
    static const char *const words[3][2] = {
        {"left", "right"}, {"bottom", "top"}, {"back", "front"}};
    const ktg_pattern *p = g->drawing->pattern;
    ktg_eye front = ktg_eye_at(g->drawing->options.up, 0, 0);
    ktg_vec3 axes[3] = {front.right, front.above, front.toward};
    const char *found[3];
    int count = 0;
    for (int axis = 1; axis < 4; axis++) { /* height first */
        double low = INFINITY, high = -INFINITY, sum = 0, number = 0;
        const ktg_vec3 *a = &axes[axis % 3];
        for (size_t h = 0; h < 3 * (size_t)p->face_count; h++) {
            uint32_t piece = g->piece_of[h / 3];
            if (piece == KTG_NONE || g->part_of[piece] != s->part)
                continue;
            double at = ktg_dot3(p->vertices[p->faces[h]], *a);
            low = fmin(low, at);
            high = fmax(high, at);
        }
        for (uint32_t i = 0; i < s->seam_count; i++) {
            const ktg_pattern_seam *seam = &p->seams[s->seams[i]];
            for (uint32_t e = 0; e < 2 * seam->edge_count; e++, number++)
                sum += ktg_dot3(p->vertices[p->edges[seam->edges[e / 2]].vertices[e % 2]], *a);
        }
        double at = high > low && number > 0 ? (2 * sum / number - low - high) / (high - low) : 0;
        if (fabs(at) > 0.33)
            found[count++] = words[axis % 3][at > 0];
    }
    if (count == 0)
        add(text, "in the middle");
    for (int k = 0; k < count; k++) {
        add(text, k == 0 ? "" : ", ");
        add(text, found[k]);
    }
}

static void add_piece(const ktg_build_guide *g, uint32_t piece, char *text) {
    char name[KTG_NAME_SIZE];
    if (g->drawing->pattern->component_count == 1) {
        ktg_drawing_piece_part(g->drawing, piece, name);
        add(text, "piece ");
        add(text, *name ? name : "1 of 1");
    } else {
        ktg_drawing_piece_name(g->drawing, piece, name);
        add(text, name);
    }
}

/* Which piece is closed, and which are joined: "Join piece 2 of 5 to piece 3 of 5." */
static void add_pieces(const ktg_build_guide *g, const ktg_step *s, char *text) {
    const ktg_pattern *p = g->drawing->pattern;
    const uint32_t *before = NULL;
    for (uint32_t i = 0; i < s->numbered; i++) {
        const uint32_t *pieces = p->seams[s->seams[i]].pieces;
        uint32_t low = g->low[s->seams[i]], high = g->high[s->seams[i]];
        char range[32];
        if (before && ((before[0] == pieces[0] && before[1] == pieces[1]) ||
                       (before[0] == pieces[1] && before[1] == pieces[0])))
            continue;
        for (uint32_t k = i + 1; k < s->numbered; k++) { /* the run of these two pieces */
            const uint32_t *other = p->seams[s->seams[k]].pieces;
            if (!((other[0] == pieces[0] && other[1] == pieces[1]) ||
                  (other[0] == pieces[1] && other[1] == pieces[0])))
                break;
            high = g->high[s->seams[k]];
        }
        before = pieces;
        ktg_words_range(low, high, range);
        if (*range && (low != s->low || high != s->high)) {
            add(text, range);
            add(text, ": ");
        }
        bool joint = pieces[0] != pieces[1];
        add(text, joint ? "join " : "close ");
        add_piece(g, pieces[0], text);
        add(text, joint ? " to " : "");
        if (joint)
            add_piece(g, pieces[1], text);
        add(text, ". ");
    }
}

static void add_begin(const ktg_build_guide *g, uint32_t step, char *text) {
    const ktg_step *s = &g->steps[step];
    char words[96];
    if (step == 0)
        add(text, "Begin here, ");
    else if (s->is_begin && g->steps[step - 1].part != s->part)
        add(text, "A new body: begin ");
    else if (s->is_begin)
        add(text, "Begin anew, ");
    else if (s->follows[1] > 0) {
        snprintf(words, sizeof words, "Brings together what steps %u and %u have closed, ",
                 s->follows[0] < s->follows[1] ? s->follows[0] : s->follows[1],
                 s->follows[0] < s->follows[1] ? s->follows[1] : s->follows[0]);
        add(text, words);
    } else {
        snprintf(words, sizeof words, "Go on from step %u, ", s->follows[0]);
        add(text, words);
    }
    add_place(g, s, text);
    add(text, ". ");
}

static void add_notches(const ktg_step *s, char *text) {
    char words[96];
    uint32_t notches = s->seam_count - s->numbered;
    if (notches == 0)
        return;
    snprintf(words, sizeof words, "%u notch%s without a number. ", notches,
             notches == 1 ? "" : "es");
    add(text, words);
}

/* The seams that close a body are the last ones with numbers. */
static void add_closing(const ktg_build_guide *g, const ktg_step *s, char *text) {
    char range[32] = "", words[192];
    if (s->closing == 0 || s->closing > s->numbered)
        return;
    ktg_words_range(g->low[s->seams[s->numbered - s->closing]], s->high, range);
    if (s->closing > 1)
        snprintf(words, sizeof words,
                 "%s close%s the model: glue on all their tabs at once, then press it shut.",
                 *range ? range : "The last seams", *range ? "" : "");
    else
        snprintf(words, sizeof words,
                 "%s closes the model: glue on all its tabs at once, then press it shut.",
                 *range ? range : "The last seam");
    add(text, words);
}

void ktg_words_step(const ktg_build_guide *guide, uint32_t step, char text[KTG_WORDS_SIZE]) {
    const ktg_step *s = &guide->steps[step];
    const ktg_pattern *p = guide->drawing->pattern;
    bool several = false;
    *text = 0;
    for (uint32_t i = 0; i < p->piece_count; i++)
        several = several || (guide->part_of[i] == s->part && i != s->part);
    add_begin(guide, step, text);
    if (several || p->component_count > 1)
        add_pieces(guide, s, text);
    add_notches(s, text);
    add_closing(guide, s, text);
}
