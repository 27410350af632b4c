/* layout/nest_poles.c - inscribed circles, largest first, that do not overlap each other. */
#include "layout/nest_state.h"

#include "core/memory.h"

/* Points along the longer side of the box at which a circle's centre is looked for. */
#define LATTICE 40

#define FEW_POLES       12
#define MUCH_COVERAGE   0.9  /* of the area: enough for few poles */
#define ENOUGH_COVERAGE 0.8  /* enough for more */
#define LEAST_RADIUS    0.06 /* of the first pole's */

typedef struct site {
    ktg_vec2 at;
    double room; /* to the sides and to the poles so far; negative outside */
} site;

static double distance_to_side(ktg_vec2 p, ktg_vec2 a, ktg_vec2 b) {
    ktg_vec2 d = ktg_sub2(b, a), v = ktg_sub2(p, a);
    double n = ktg_dot2(d, d), t = n > 0 ? ktg_dot2(v, d) / n : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return ktg_length2(ktg_madd2(v, -t, d));
}

/* Distance to the boundary, negative outside. */
static double depth_in(const nest_shape *shape, ktg_vec2 p) {
    bool inside = false;
    double least = INFINITY;
    for (uint32_t i = 0; i < shape->corner_count; i++) {
        ktg_vec2 a = shape->corners[i], b = shape->corners[i + 1];
        least = fmin(least, distance_to_side(p, a, b));
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside ? least : -least;
}

static double room_at(const nest_shape *shape, const nest_poles *poles, ktg_vec2 p) {
    double room = depth_in(shape, p);
    for (uint32_t k = 0; k < poles->count; k++) {
        ktg_vec2 d = {p.x - (double)poles->x[k], p.y - (double)poles->y[k]};
        room = fmin(room, ktg_length2(d) - (double)poles->radius[k]);
    }
    return room;
}

/* Climbs to where there is most room near the site. */
static void climb(const nest_shape *shape, const nest_poles *poles, double step, site *best) {
    static const ktg_vec2 ways[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    for (int k = 0; k < 12; step /= 2, k++)
        for (int way = 0; way < 4; way++) {
            ktg_vec2 p = ktg_madd2(best->at, step, ways[way]);
            double room = room_at(shape, poles, p);
            if (room > best->room)
                *best = (site){p, room};
        }
}

static uint32_t make_sites(const nest_shape *shape, ktg_vec2 half, double step, site *sites) {
    uint32_t count = 0;
    for (double y = step / 2 - half.y; y < half.y && count < LATTICE * LATTICE; y += step)
        for (double x = step / 2 - half.x; x < half.x && count < LATTICE * LATTICE; x += step) {
            double room = depth_in(shape, (ktg_vec2){x, y});
            if (room > 0)
                sites[count++] = (site){{x, y}, room};
        }
    return count;
}

static void add_pole(nest_poles *poles, const site *at, site *sites, uint32_t count) {
    uint32_t k = poles->count++;
    poles->x[k] = (float)at->at.x;
    poles->y[k] = (float)at->at.y;
    poles->radius[k] = (float)at->room;
    for (uint32_t i = 0; i < count; i++)
        sites[i].room = fmin(sites[i].room, ktg_length2(ktg_sub2(sites[i].at, at->at)) - at->room);
}

static bool is_enough(const nest_poles *poles, double covered, double area) {
    return poles->count == NEST_MOST_POLES ||
           (poles->count >= FEW_POLES && covered >= ENOUGH_COVERAGE * area) ||
           covered >= MUCH_COVERAGE * area;
}

static void fill(const nest_shape *shape, double step, site *sites, uint32_t count,
                 nest_poles *poles) {
    double covered = 0;
    while (count > 0 && !is_enough(poles, covered, shape->area)) {
        site best = sites[0];
        for (uint32_t i = 1; i < count; i++)
            if (sites[i].room > best.room)
                best = sites[i];
        climb(shape, poles, step / 2, &best);
        if (poles->count > 0 && best.room < LEAST_RADIUS * (double)poles->radius[0])
            return;
        covered += KTG_PI * best.room * best.room;
        add_pole(poles, &best, sites, count);
    }
}

/* A shape as thin as a needle has no site inside: small poles along its sides stand for it. */
static void stand_in(const nest_shape *shape, nest_poles *poles) {
    for (uint32_t i = 0; i < shape->corner_count && poles->count < FEW_POLES; i++) {
        ktg_vec2 middle = ktg_mul2(ktg_add2(shape->corners[i], shape->corners[i + 1]), 0.5);
        poles->x[poles->count] = (float)middle.x;
        poles->y[poles->count] = (float)middle.y;
        poles->radius[poles->count++] = (float)(1e-3 * shape->diameter);
    }
}

static void pad(nest_poles *poles) {
    poles->padded = (poles->count + 3) / 4 * 4;
    for (uint32_t k = poles->count; k < poles->padded; k++) {
        poles->x[k] = poles->y[k] = 1e9f;
        poles->radius[k] = 0;
    }
}

ktg_status ktg_nest_poles_find(ktg_context *context, const nest_shape *shape, nest_poles *poles) {
    *poles = (nest_poles){ktg_new(context, NEST_MOST_POLES, float),
                          ktg_new(context, NEST_MOST_POLES, float),
                          ktg_new(context, NEST_MOST_POLES, float), 0, 0};
    site *sites = ktg_new(context, LATTICE * LATTICE, site);
    if (!poles->x || !poles->y || !poles->radius || !sites) {
        ktg_free(sites);
        return KTG_MEMORY;
    }
    ktg_vec2 half = {0, 0};
    for (uint32_t i = 0; i < shape->corner_count; i++)
        half = (ktg_vec2){fmax(half.x, fabs(shape->corners[i].x)),
                          fmax(half.y, fabs(shape->corners[i].y))};
    double step = 2 * fmax(half.x, half.y) / LATTICE;
    if (step > 0)
        fill(shape, step, sites, make_sites(shape, half, step, sites), poles);
    if (poles->count == 0)
        stand_in(shape, poles);
    pad(poles);
    ktg_free(sites);
    return KTG_OK;
}
