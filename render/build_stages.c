/* render/build_stages.c - in which step a face gets its place: when the first of its seams is
 * glued. What lies flat gets it as a whole; what has no seams goes with the nearest that has some.
 */
#include "render/build_guide.h"

#include "core/memory.h"
#include "core/sets.h"

/* The earlier of two steps, where 0 is none. */
static uint32_t earlier(uint32_t a, uint32_t b) {
    return a == 0 || (b > 0 && b < a) ? b : a;
}

static void take_seams(ktg_build_guide *g) {
    const ktg_pattern *pattern = g->drawing->pattern;
    for (size_t h = 0; h < 3 * (size_t)pattern->face_count; h++)
        if (g->seam_of[h] < pattern->seam_count)
            g->stage[h / 3] = earlier(g->stage[h / 3], ktg_guide_step_of(g, g->seam_of[h]));
}

/* parent: face_count, scratch. */
static void join_flat(ktg_build_guide *g, uint32_t *parent) {
    const ktg_pattern *pattern = g->drawing->pattern;
    for (uint32_t f = 0; f < pattern->face_count; f++)
        parent[f] = f;
    for (size_t e = 0; e < pattern->edge_count; e++) {
        const ktg_pattern_side *sides = pattern->edges[e].sides;
        if (g->sides[3 * (size_t)sides[0].face + sides[0].corner] == KTG_SIDE_FLAT &&
            pattern->edges[e].side_count == 2)
            ktg_set_join(parent, sides[0].face, sides[1].face);
    }
    for (uint32_t f = 0; f < pattern->face_count; f++) {
        uint32_t *first = &g->stage[ktg_set_of(parent, f)];
        *first = earlier(*first, g->stage[f]);
    }
    for (uint32_t f = 0; f < pattern->face_count; f++)
        g->stage[f] = g->stage[ktg_set_of(parent, f)];
}

/* beside: 3 face_count, becomes the face beyond a fold. */
static void find_neighbours(const ktg_pattern *pattern, uint32_t *beside) {
    for (size_t h = 0; h < 3 * (size_t)pattern->face_count; h++)
        beside[h] = KTG_NONE;
    for (size_t e = 0; e < pattern->edge_count; e++) {
        const ktg_pattern_edge *edge = &pattern->edges[e];
        for (int k = 0; k < 2 && edge->side_count == 2 && edge->kind != KTG_EDGE_CUT; k++)
            beside[3 * (size_t)edge->sides[k].face + edge->sides[k].corner] =
                edge->sides[1 - k].face;
    }
}

/* queue: face_count, scratch. */
static void spread(ktg_build_guide *g, const uint32_t *beside, uint32_t *queue) {
    uint32_t count = 0;
    for (uint32_t f = 0; f < g->drawing->pattern->face_count; f++)
        if (g->stage[f] > 0)
            queue[count++] = f;
    for (uint32_t i = 0; i < count; i++)
        for (size_t k = 0; k < 3; k++) {
            uint32_t face = beside[3 * (size_t)queue[i] + k];
            if (face == KTG_NONE || g->stage[face] > 0)
                continue;
            g->stage[face] = g->stage[queue[i]];
            queue[count++] = face;
        }
}

ktg_status ktg_guide_find_stages(ktg_build_guide *g) {
    const ktg_pattern *pattern = g->drawing->pattern;
    ktg_context *context = g->drawing->context;
    uint32_t *beside = ktg_new(context, 3 * (size_t)pattern->face_count, uint32_t);
    uint32_t *faces = ktg_new(context, pattern->face_count, uint32_t);
    ktg_status status = beside && faces ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        take_seams(g);
        join_flat(g, faces);
        find_neighbours(pattern, beside);
        spread(g, beside, faces);
    }
    ktg_free(beside);
    ktg_free(faces);
    return status;
}
