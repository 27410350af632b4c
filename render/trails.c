/* render/trails.c - loose segments become long paths, so that a machine need not lift its tool. */
#include "render/weld.h"

#include "core/memory.h"
#include "core/vec.h"

/* Segments at each point. */
typedef struct web {
    const ktg_weld *weld;
    const ktg_segment *segments;
    size_t *first;      /* points + 1: into `ends` */
    uint32_t *ends;     /* 2 per segment */
    bool *used;         /* of each segment */
    ktg_vec2 *trail;    /* the path being made */
    size_t trail_count; /* at most segments + 1 */
} web;

static uint32_t other_end(const web *w, uint32_t segment, uint32_t point) {
    const ktg_segment *s = &w->segments[segment];
    return s->a == point ? s->b : s->a;
}

static ktg_status build(web *w, size_t count) {
    ktg_context *context = w->weld->context;
    w->first = ktg_new(context, w->weld->count + 2, size_t);
    w->ends = ktg_new(context, 2 * count, uint32_t);
    w->used = ktg_new(context, count, bool);
    w->trail = ktg_new(context, count + 1, ktg_vec2);
    if (!w->first || !w->ends || !w->used || !w->trail)
        return KTG_MEMORY;
    for (size_t i = 0; i < count; i++) {
        w->first[w->segments[i].a + 2]++;
        w->first[w->segments[i].b + 2]++;
    }
    for (size_t p = 0; p < w->weld->count; p++)
        w->first[p + 2] += w->first[p + 1];
    for (size_t i = 0; i < count; i++) {
        w->ends[w->first[w->segments[i].a + 1]++] = (uint32_t)i;
        w->ends[w->first[w->segments[i].b + 1]++] = (uint32_t)i;
    }
    return KTG_OK;
}

/* The unused segment at `point` that turns least from `way`; KTG_NONE where there is none. */
static uint32_t straightest(const web *w, uint32_t point, ktg_vec2 way) {
    uint32_t best = KTG_NONE;
    double most = -INFINITY;
    for (size_t k = w->first[point]; k < w->first[point + 1]; k++) {
        uint32_t segment = w->ends[k];
        if (w->used[segment])
            continue;
        ktg_vec2 to = w->weld->points[other_end(w, segment, point)];
        double along = ktg_dot2(way, ktg_unit2(ktg_sub2(to, w->weld->points[point])));
        if (along > most) {
            most = along;
            best = segment;
        }
    }
    return best;
}

/* Walks from `start` until no segment is left; the way back to the start closes the path. */
static ktg_status walk(web *w, uint32_t start, ktg_trail_draw *draw, void *user) {
    uint32_t point = start, segment;
    ktg_vec2 way = {0, 0};
    w->trail_count = 0;
    w->trail[w->trail_count++] = w->weld->points[start];
    while ((segment = straightest(w, point, way)) != KTG_NONE) {
        w->used[segment] = true;
        uint32_t next = other_end(w, segment, point);
        way = ktg_unit2(ktg_sub2(w->weld->points[next], w->weld->points[point]));
        point = next;
        w->trail[w->trail_count++] = w->weld->points[point];
    }
    bool closed = point == start && w->trail_count > 3;
    return w->trail_count < 2 ? KTG_OK
                              : draw(user, w->trail, w->trail_count - (closed ? 1 : 0), closed);
}

static size_t unused_at(const web *w, uint32_t point) {
    size_t count = 0;
    for (size_t k = w->first[point]; k < w->first[point + 1]; k++)
        count += !w->used[w->ends[k]];
    return count;
}

/* Where an odd number of segments meet, a path must begin or end. */
static ktg_status walk_all(web *w, ktg_trail_draw *draw, void *user) {
    for (uint32_t p = 0; p < w->weld->count; p++)
        if (unused_at(w, p) % 2 == 1)
            KTG_TRY(walk(w, p, draw, user));
    for (uint32_t p = 0; p < w->weld->count; p++)
        while (unused_at(w, p) > 0)
            KTG_TRY(walk(w, p, draw, user));
    return KTG_OK;
}

ktg_status ktg_trails_join(const ktg_weld *weld, const ktg_segment *segments, size_t count,
                           ktg_trail_draw *draw, void *user) {
    web w = {.weld = weld, .segments = segments};
    ktg_status status = build(&w, count);
    if (status == KTG_OK)
        status = walk_all(&w, draw, user);
    ktg_free(w.first);
    ktg_free(w.ends);
    ktg_free(w.used);
    ktg_free(w.trail);
    return status;
}
