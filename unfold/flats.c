/* unfold/flats.c - flat regions laid out. */
#include "unfold/flats.h"
#include "core/memory.h"
#include "unfold/crease.h"
#include "unfold/lay.h"

#include <string.h>

typedef struct layer {
    const ktg_dual *dual;
    ktg_flats *flats;
    uint32_t *queue; /* face_count */
    ktg_vec2 *turn;  /* face_count */
} layer;

void ktg_flats_free(ktg_flats *flats) {
    ktg_free(flats->region);
    ktg_free(flats->first);
    ktg_free(flats->sides);
    ktg_free(flats->corners);
    *flats = (ktg_flats){0};
}

/* The half-edge across an edge that no search cuts and where the surface is flat; else KTG_NONE. */
static uint32_t flat_across(const ktg_dual *dual, uint32_t h) {
    uint32_t e = dual->halfedge_edge[h];
    if (e == KTG_NONE || !dual->edges[e].rigid ||
        fabs(ktg_dual_angle(dual, &dual->edges[e])) >= KTG_FLAT_FOLD)
        return KTG_NONE;
    return dual->edges[e].halfedge[dual->edges[e].halfedge[0] == h];
}

static void lay_against(layer *l, uint32_t other, uint32_t own) {
    uint32_t after_own = own % 3 == 2 ? own - 2 : own + 1;
    uint32_t after = other % 3 == 2 ? other - 2 : other + 1, face = own / 3;
    ktg_vec2 *corners = l->flats->corners;
    const ktg_vec2 *flat = l->dual->flat;
    l->turn[face] = ktg_lay_turn(l->dual, l->turn[other / 3], other, own);
    ktg_motion2 m =
        ktg_lay_motion(l->turn[face], flat[own], flat[after_own], corners[after], corners[other]);
    for (uint32_t c = 3 * face; c < 3 * face + 3; c++)
        corners[c] = ktg_move2(m, flat[c]);
}

/* The region around `seed`, and its sides from `count` on; returns how many sides there are then.
 */
static uint32_t gather(layer *l, uint32_t seed, uint32_t count) {
    ktg_flats *f = l->flats;
    uint32_t length = 1;
    l->queue[0] = seed;
    l->turn[seed] = (ktg_vec2){1, 0};
    memcpy(f->corners + 3 * (size_t)seed, l->dual->flat + 3 * (size_t)seed, 3 * sizeof(ktg_vec2));
    f->region[seed] = f->region_count;
    for (uint32_t i = 0; i < length; i++)
        for (uint32_t h = 3 * l->queue[i], end = h + 3; h < end; h++) {
            uint32_t other = flat_across(l->dual, h);
            if (other == KTG_NONE) {
                f->sides[count++] = h;
            } else if (f->region[other / 3] == KTG_NONE) {
                f->region[other / 3] = f->region_count;
                lay_against(l, h, other);
                l->queue[length++] = other / 3;
            }
        }
    return count;
}

static ktg_status lay_regions(ktg_context *context, layer *l) {
    ktg_flats *f = l->flats;
    uint32_t n = l->dual->face_count, count = 0;
    f->region = ktg_new(context, n, uint32_t);
    f->first = ktg_new(context, n + 1, uint32_t);
    f->sides = ktg_new(context, 3 * (size_t)n, uint32_t);
    f->corners = ktg_new(context, 3 * (size_t)n, ktg_vec2);
    if (!f->region || !f->first || !f->sides || !f->corners)
        return KTG_MEMORY;
    memset(f->region, 0xff, n * sizeof *f->region);
    for (uint32_t seed = 0; seed < n; seed++) {
        if (f->region[seed] != KTG_NONE)
            continue;
        count = gather(l, seed, count);
        f->first[++f->region_count] = count;
    }
    return KTG_OK;
}

ktg_status ktg_flats_new(ktg_context *context, const ktg_dual *dual, ktg_flats *flats) {
    *flats = (ktg_flats){0};
    layer l = {dual, flats, ktg_new(context, dual->face_count, uint32_t),
               ktg_new(context, dual->face_count, ktg_vec2)};
    ktg_status status = l.queue && l.turn ? lay_regions(context, &l) : KTG_MEMORY;
    ktg_free(l.queue);
    ktg_free(l.turn);
    return status;
}
