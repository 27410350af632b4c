/* render/build_steps.c - the steps of the building: which seams, which faces, what they touch. */
#include "render/build_guide.h"

#include "core/memory.h"
#include "core/sets.h"

#include <stdlib.h>

#define MOST_PICTURES 60

/* ---- sides of faces ----------------------------------------------------------------------- */

static ktg_side_kind kind_of(const ktg_drawing *drawing, const ktg_pattern_edge *edge) {
    if (edge->kind == KTG_EDGE_BORDER)
        return KTG_SIDE_BORDER;
    if (edge->kind == KTG_EDGE_CUT)
        return KTG_SIDE_SEAM;
    return fabs(edge->angle) >= drawing->options.flat_below ? KTG_SIDE_FOLD : KTG_SIDE_FLAT;
}

static void fill_sides(ktg_build_guide *g) {
    const ktg_pattern *pattern = g->drawing->pattern;
    for (size_t p = 0; p < pattern->piece_count; p++)
        for (size_t f = 0; f < pattern->pieces[p].face_count; f++)
            g->piece_of[pattern->pieces[p].faces[f]] = (uint32_t)p;
    for (size_t e = 0; e < pattern->edge_count; e++) {
        const ktg_pattern_edge *edge = &pattern->edges[e];
        for (uint32_t k = 0; k < edge->side_count; k++) {
            size_t h = 3 * (size_t)edge->sides[k].face + edge->sides[k].corner;
            g->sides[h] = (uint8_t)kind_of(g->drawing, edge);
            g->seam_of[h] = edge->kind == KTG_EDGE_CUT ? edge->seam : KTG_NONE;
        }
    }
}

/* ---- numbers ------------------------------------------------------------------------------ */

/* The numbers that a seam's edges bear on the sheets. */
static void read_numbers(ktg_build_guide *g) {
    const ktg_pattern *pattern = g->drawing->pattern;
    for (size_t p = 0; p < pattern->piece_count; p++)
        for (size_t i = 0; i < pattern->pieces[p].label_count; i++) {
            const ktg_pattern_label *label = &pattern->pieces[p].labels[i];
            if (label->edge >= pattern->edge_count)
                continue;
            uint32_t seam = pattern->edges[label->edge].seam;
            uint32_t number = (uint32_t)strtoul(label->text, NULL, 10);
            if (seam >= pattern->seam_count || number == 0)
                continue;
            if (g->low[seam] == 0 || number < g->low[seam])
                g->low[seam] = number;
            if (number > g->high[seam])
                g->high[seam] = number;
        }
}

/* ---- steps -------------------------------------------------------------------------------- */

static uint32_t count_steps(const ktg_pattern *pattern) {
    uint32_t count = 0;
    for (size_t s = 0; s < pattern->seam_count; s++)
        if (pattern->seams[s].section > count && pattern->seams[s].section <= pattern->seam_count)
            count = pattern->seams[s].section;
    return count;
}

uint32_t ktg_guide_step_of(const ktg_build_guide *g, size_t seam) {
    uint32_t section = g->drawing->pattern->seams[seam].section;
    return section <= g->step_count ? section : 0;
}

static void take_number(ktg_step *step, uint32_t low, uint32_t high) {
    if (low > 0 && (step->low == 0 || low < step->low))
        step->low = low;
    if (high > step->high)
        step->high = high;
}

static void fill_steps(ktg_build_guide *g) {
    const ktg_pattern *pattern = g->drawing->pattern;
    uint32_t *next = g->seams_in;
    for (size_t s = 0; s < pattern->seam_count; s++)
        if (ktg_guide_step_of(g, s) > 0)
            g->steps[ktg_guide_step_of(g, s) - 1].seam_count++;
    for (uint32_t k = 0; k < g->step_count; k++) {
        g->steps[k].seams = next;
        next += g->steps[k].seam_count;
        g->steps[k].seam_count = 0;
    }
    for (uint32_t s = 0; s < pattern->seam_count; s++) { /* seams without numbers come last */
        if (ktg_guide_step_of(g, s) == 0)
            continue;
        ktg_step *step = &g->steps[ktg_guide_step_of(g, s) - 1];
        step->seams[step->seam_count++] = s;
        step->numbered += !pattern->seams[s].obvious;
        step->closing += pattern->seams[s].closing;
        step->part = g->part_of[pattern->seams[s].pieces[0]];
        take_number(step, g->low[s], g->high[s]);
    }
}

static void find_parts(ktg_build_guide *g) {
    const ktg_pattern *pattern = g->drawing->pattern;
    for (uint32_t p = 0; p < pattern->piece_count; p++)
        g->part_of[p] = p;
    for (size_t s = 0; s < pattern->seam_count; s++) {
        const ktg_pattern_seam *seam = &pattern->seams[s];
        ktg_set_join(g->part_of, seam->pieces[0], seam->pieces[1]);
        for (int k = 0; k < 2; k++) {
            uint32_t *first = &g->first_step[seam->pieces[k]], step = ktg_guide_step_of(g, s);
            if (step > 0 && (*first == 0 || step < *first))
                *first = step;
        }
    }
    for (uint32_t p = 0; p < pattern->piece_count; p++)
        g->part_of[p] = ktg_set_of(g->part_of, p);
}

/* ---- what a step goes on from ------------------------------------------------------------- */

/* Bodies of steps, by the vertices they touch. */
static void touch_vertex(ktg_build_guide *g, uint32_t step, uint32_t vertex, uint32_t *touched,
                         uint32_t *body) {
    ktg_step *s = &g->steps[step];
    if (touched[vertex] == KTG_NONE) {
        touched[vertex] = step;
        return;
    }
    uint32_t earlier = touched[vertex];
    while (body[earlier] != earlier)
        earlier = body[earlier] = body[body[earlier]];
    touched[vertex] = step;
    if (earlier == step)
        return;
    body[earlier] = step; /* the last step of a body stands for it */
    if (s->follows[0] == 0)
        s->follows[0] = earlier + 1;
    else if (s->follows[1] == 0)
        s->follows[1] = earlier + 1;
}

static ktg_status find_followed(ktg_build_guide *g) {
    const ktg_pattern *pattern = g->drawing->pattern;
    ktg_context *context = g->drawing->context;
    uint32_t *touched = ktg_new(context, pattern->vertex_count, uint32_t);
    uint32_t *body = ktg_new(context, g->step_count, uint32_t);
    ktg_status status = touched && body ? KTG_OK : KTG_MEMORY;
    for (size_t v = 0; status == KTG_OK && v < pattern->vertex_count; v++)
        touched[v] = KTG_NONE;
    for (uint32_t k = 0; status == KTG_OK && k < g->step_count; k++) {
        body[k] = k;
        for (uint32_t i = 0; i < g->steps[k].seam_count; i++) {
            const ktg_pattern_seam *seam = &pattern->seams[g->steps[k].seams[i]];
            for (uint32_t e = 0; e < 2 * seam->edge_count; e++)
                touch_vertex(g, k, pattern->edges[seam->edges[e / 2]].vertices[e % 2], touched,
                             body);
        }
        g->steps[k].is_begin = g->steps[k].follows[0] == 0;
    }
    ktg_free(touched);
    ktg_free(body);
    return status;
}

/* ---- the whole ---------------------------------------------------------------------------- */

/* The fewest seams a step must have for a picture, so that there are not too many. */
static void limit_pictures(ktg_build_guide *g) {
    for (g->picture_least = 0;; g->picture_least++) {
        uint32_t count = 0;
        for (uint32_t k = 0; k < g->step_count; k++)
            count += g->steps[k].seam_count >= g->picture_least;
        if (count <= MOST_PICTURES)
            return;
    }
}

static ktg_status make_room(ktg_build_guide *g) {
    const ktg_pattern *p = g->drawing->pattern;
    ktg_context *context = g->drawing->context;
    g->steps = ktg_new(context, g->step_count, ktg_step);
    g->seams_in = ktg_new(context, p->seam_count, uint32_t);
    g->low = ktg_new(context, p->seam_count, uint32_t);
    g->high = ktg_new(context, p->seam_count, uint32_t);
    g->piece_of = ktg_new(context, p->face_count, uint32_t);
    g->part_of = ktg_new(context, p->piece_count, uint32_t);
    g->first_step = ktg_new(context, p->piece_count, uint32_t);
    g->stage = ktg_new(context, p->face_count, uint32_t);
    g->sides = ktg_new(context, 3 * (size_t)p->face_count, uint8_t);
    g->seam_of = ktg_new(context, 3 * (size_t)p->face_count, uint32_t);
    g->shown = ktg_new(context, p->face_count, bool);
    g->is_told = ktg_new(context, p->seam_count, bool);
    g->starts = ktg_new(context, p->seam_count, uint32_t);
    if (!g->steps || !g->seams_in || !g->low || !g->high || !g->piece_of || !g->part_of ||
        !g->first_step || !g->stage || !g->sides || !g->seam_of || !g->shown || !g->starts ||
        !g->is_told)
        return KTG_MEMORY;
    for (size_t f = 0; f < p->face_count; f++)
        g->piece_of[f] = KTG_NONE;
    for (size_t h = 0; h < 3 * (size_t)p->face_count; h++)
        g->seam_of[h] = KTG_NONE;
    return KTG_OK;
}

ktg_status ktg_guide_find_steps(ktg_build_guide *g) {
    g->step_count = count_steps(g->drawing->pattern);
    KTG_TRY(make_room(g));
    fill_sides(g);
    read_numbers(g);
    find_parts(g);
    fill_steps(g);
    limit_pictures(g);
    KTG_TRY(find_followed(g));
    KTG_TRY(ktg_guide_find_starts(g));
    return ktg_guide_find_stages(g);
}

void ktg_build_guide_free(ktg_build_guide **guide) {
    ktg_build_guide *g = *guide;
    if (!g)
        return;
    ktg_free(g->steps);
    ktg_free(g->seams_in);
    ktg_free(g->low);
    ktg_free(g->high);
    ktg_free(g->piece_of);
    ktg_free(g->part_of);
    ktg_free(g->first_step);
    ktg_free(g->stage);
    ktg_free(g->sides);
    ktg_free(g->seam_of);
    ktg_free(g->shown);
    ktg_free(g->is_told);
    ktg_free(g->starts);
    ktg_free(g);
    *guide = NULL;
}
