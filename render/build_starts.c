/* render/build_starts.c - at which end the gluing of a seam begins: where all other seams that meet
 * it are glued before, so that it closes like a zip. */
#include "render/build_guide.h"

#include "core/memory.h"

/* When a seam is glued: notches without numbers in passing, before the others. */
static uint32_t rank_of(const ktg_pattern *pattern, size_t seam) {
    return pattern->seams[seam].obvious ? 0 : (uint32_t)seam + 1;
}

static uint32_t end_of(const ktg_pattern *pattern, size_t seam, uint32_t end) {
    const ktg_pattern_seam *s = &pattern->seams[seam];
    uint32_t k = end ? s->edge_count - 1 : 0;
    return pattern->edges[s->edges[k]].vertices[s->first_side[k] ^ end];
}

/* latest: vertex_count, becomes the last seam that is glued there, as a rank; no seam is last on a
 * border, which stays open. */
static void find_latest(const ktg_pattern *pattern, uint32_t *latest) {
    for (size_t s = 0; s < pattern->seam_count; s++)
        for (uint32_t end = 0; end < 2 && pattern->seams[s].edge_count > 0; end++) {
            uint32_t *at = &latest[end_of(pattern, s, end)], rank = rank_of(pattern, s);
            *at = rank > *at ? rank : *at;
        }
    for (size_t e = 0; e < pattern->edge_count; e++)
        for (uint32_t k = 0; k < 2 && pattern->edges[e].side_count == 1; k++)
            latest[pattern->edges[e].vertices[k]] = KTG_NONE;
}

ktg_status ktg_guide_find_starts(ktg_build_guide *g) {
    const ktg_pattern *pattern = g->drawing->pattern;
    uint32_t *latest = ktg_new(g->drawing->context, pattern->vertex_count, uint32_t);
    if (!latest)
        return KTG_MEMORY;
    find_latest(pattern, latest);
    for (size_t s = 0; s < pattern->seam_count; s++) {
        uint32_t rank = rank_of(pattern, s), count = 0;
        g->starts[s] = KTG_NONE;
        for (uint32_t end = 0; end < 2 && rank > 0 && pattern->seams[s].edge_count > 0; end++)
            if (latest[end_of(pattern, s, end)] == rank) {
                g->starts[s] = end_of(pattern, s, end);
                count++;
            }
        if (count != 1)
            g->starts[s] = KTG_NONE;
    }
    ktg_free(latest);
    return KTG_OK;
}
