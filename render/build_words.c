/* render/build_words.c - what the guide says. */
#include "render/build_guide.h"

#include <stdio.h>
#include <string.h>

#define EN_DASH "\xe2\x80\x93"
#define SQUARED "\xc2\xb2"
#define ASIDE   0.33 /* of half the body: what is nearer to its middle has no side */

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

bool ktg_guide_has_bodies(const ktg_build_guide *g) {
    for (uint32_t p = 0; p < g->drawing->pattern->piece_count; p++)
        if (g->part_of[p] != 0)
            return true;
    return false;
}

void ktg_words_title(const ktg_build_guide *guide, uint32_t step, char text[KTG_WORDS_SIZE]) {
    const ktg_step *s = &guide->steps[step];
    char range[32];
    ktg_words_range(s->low, s->high, range);
    bool last = s->closing > 0 && guide->step_count > 1 && !ktg_guide_has_bodies(guide);
    snprintf(text, KTG_WORDS_SIZE, "%u. %s%s%s", step + 1,
             !*range             ? "Seams without numbers"
             : s->low == s->high ? "Seam "
                                 : "Seams ",
             range, last ? ", the last" : "");
}

void ktg_words_missing(const ktg_build_guide *guide, uint32_t step, char text[KTG_WORDS_SIZE]) {
    const ktg_step *s = &guide->steps[step];
    *text = 0;
    for (uint32_t i = 0; i < s->numbered; i++) {
        char range[32];
        if (guide->is_told[s->seams[i]] || guide->low[s->seams[i]] == 0)
            continue;
        ktg_words_range(guide->low[s->seams[i]], guide->high[s->seams[i]], range);
        add(text, *text ? ", " : "");
        add(text, range);
    }
}

/* Where a step's seams lie between the ends of their body along an axis, -1 to 1. */
static double place_along(const ktg_build_guide *g, const ktg_step *s, ktg_vec3 axis) {
    const ktg_pattern *p = g->drawing->pattern;
    double low = INFINITY, high = -INFINITY, sum = 0, number = 0;
    for (size_t h = 0; h < 3 * (size_t)p->face_count; h++) {
        uint32_t piece = g->piece_of[h / 3];
        if (piece == KTG_NONE || g->part_of[piece] != s->part)
            continue;
        double at = ktg_dot3(p->vertices[p->faces[h]], axis);
        low = fmin(low, at);
        high = fmax(high, at);
    }
    for (uint32_t i = 0; i < s->seam_count; i++) {
        const ktg_pattern_seam *seam = &p->seams[s->seams[i]];
        for (uint32_t e = 0; e < 2 * seam->edge_count; e++, number++)
            sum += ktg_dot3(p->vertices[p->edges[seam->edges[e / 2]].vertices[e % 2]], axis);
    }
    return high > low && number > 0 ? (2 * sum / number - low - high) / (high - low) : 0;
}

/* "at the top, on the left", as one sees it from the front. */
static void add_place(const ktg_build_guide *g, const ktg_step *s, char *text) {
    static const char *const words[3][2] = {{"at the bottom", "at the top"},
                                            {"at the back", "at the front"},
                                            {"on the left", "on the right"}};
    ktg_eye front = ktg_eye_at(g->drawing->options.up, 0, 0);
    ktg_vec3 axes[3] = {front.above, front.toward, front.right};
    int count = 0;
    for (int k = 0; k < 3; k++) {
        double at = place_along(g, s, axes[k]);
        if (fabs(at) <= ASIDE)
            continue;
        add(text, count++ > 0 ? ", " : "");
        add(text, words[k][at > 0]);
    }
    if (count == 0)
        add(text, "in the middle");
}

/* "piece 3" where all pieces belong to one part of the model, else its name. */
static void add_piece(const ktg_build_guide *g, uint32_t piece, bool brief, char *text) {
    char name[KTG_NAME_SIZE];
    if (g->drawing->pattern->component_count == 1)
        snprintf(name, sizeof name, "%s%u", brief ? "" : "piece ", piece + 1);
    else
        ktg_drawing_piece_name(g->drawing, piece, name);
    add(text, name);
}

static bool has_piece(const ktg_pattern_seam *seam, uint32_t piece) {
    return seam->pieces[0] == piece || seam->pieces[1] == piece;
}

/* The end of the run of seams from `from` on that close one piece, or join one to others; which
 * one comes out. */
static uint32_t end_of_run(const ktg_build_guide *g, const ktg_step *s, uint32_t from,
                           uint32_t *piece) {
    const ktg_pattern_seam *seams = g->drawing->pattern->seams;
    const ktg_pattern_seam *first = &seams[s->seams[from]];
    bool joint = first->pieces[0] != first->pieces[1];
    uint32_t best = from;
    for (int k = 0; k < 2; k++) {
        uint32_t end = from + 1;
        while (end < s->numbered && has_piece(&seams[s->seams[end]], first->pieces[k]) &&
               (seams[s->seams[end]].pieces[0] != seams[s->seams[end]].pieces[1]) == joint)
            end++;
        if (end > best) {
            best = end;
            *piece = first->pieces[k];
        }
    }
    return best;
}

/* The pieces that the seams of a run join to `piece`, each once: "2, 5 and 7". */
static void add_partners(const ktg_build_guide *g, const ktg_step *s, uint32_t from, uint32_t to,
                         uint32_t piece, char *text) {
    const ktg_pattern_seam *seams = g->drawing->pattern->seams;
    uint32_t count = 0;
    for (uint32_t i = from; i < to; i++) {
        const ktg_pattern_seam *seam = &seams[s->seams[i]];
        uint32_t other = seam->pieces[seam->pieces[0] == piece];
        bool known = false;
        for (uint32_t k = from; k < i; k++)
            known = known || has_piece(&seams[s->seams[k]], other);
        if (known)
            continue;
        add(text, count++ > 0 ? ", " : "");
        add_piece(g, other, true, text);
    }
}

/* Which pieces are closed and which are joined: "Close piece 2. 7-9: join it to 1, 5." */
static void add_pieces(const ktg_build_guide *g, const ktg_step *s, char *text) {
    const ktg_pattern_seam *seams = g->drawing->pattern->seams;
    for (uint32_t i = 0, end; i < s->numbered; i = end) {
        uint32_t piece = 0, low = g->low[s->seams[i]];
        char range[32];
        end = end_of_run(g, s, i, &piece);
        bool joint = seams[s->seams[i]].pieces[0] != seams[s->seams[i]].pieces[1];
        ktg_words_range(low, g->high[s->seams[end - 1]], range);
        if (end - i < s->numbered && *range) {
            add(text, range);
            add(text, ": ");
        }
        if (end - i < s->numbered && *range)
            add(text, joint ? "join " : "close ");
        else
            add(text, joint ? "Join " : "Close ");
        add_piece(g, piece, false, text);
        if (joint) {
            add(text, " to ");
            add_partners(g, s, i, end, piece, text);
        }
        add(text, ". ");
    }
}

/* True when no other step belongs to the step's body. */
static bool is_alone(const ktg_build_guide *g, uint32_t step) {
    return (step == 0 || g->steps[step - 1].part != g->steps[step].part) &&
           (step + 1 == g->step_count || g->steps[step + 1].part != g->steps[step].part);
}

static void add_begin(const ktg_build_guide *g, uint32_t step, char *text) {
    const ktg_step *s = &g->steps[step];
    char words[96];
    if (is_alone(g, step))
        return;
    if (s->is_begin)
        add(text, step == 0                            ? "Begin here, "
                  : g->steps[step - 1].part != s->part ? "Begin the next body, "
                                                       : "Begin anew, ");
    else if (s->follows[1] > 0) {
        bool order = s->follows[0] < s->follows[1];
        snprintf(words, sizeof words, "Bring together what steps %u and %u have closed, ",
                 s->follows[order ? 0 : 1], s->follows[order ? 1 : 0]);
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
    snprintf(words, sizeof words, "%s %u notch%s without a number. ",
             s->numbered > 0 ? "And" : "Close", notches, notches == 1 ? "" : "es");
    add(text, words);
}

/* The seams that close a body are the last ones with numbers. */
static void add_closing(const ktg_build_guide *g, const ktg_step *s, char *text) {
    char range[32] = "", words[192];
    bool one = s->closing == 1;
    if (s->closing == 0 || s->closing > s->numbered)
        return;
    ktg_words_range(g->low[s->seams[s->numbered - s->closing]], s->high, range);
    snprintf(words, sizeof words, "%s%s close%s %s",
             *range ? ""
             : one  ? "The last seam"
                    : "The last seams",
             range, one ? "s" : "", ktg_guide_has_bodies(g) ? "it." : "the model: ");
    add(text, words);
    if (ktg_guide_has_bodies(g)) /* the head of the page says the rest once for all */
        return;
    snprintf(words, sizeof words,
             "put glue on all %s tabs at once, then press the paper down on them.",
             one ? "its" : "their");
    add(text, words);
}

void ktg_words_step(const ktg_build_guide *guide, uint32_t step, char text[KTG_WORDS_SIZE]) {
    const ktg_step *s = &guide->steps[step];
    *text = 0;
    add_begin(guide, step, text);
    if (guide->drawing->pattern->piece_count > 1)
        add_pieces(guide, s, text);
    add_notches(s, text);
    add_closing(guide, s, text);
}
