/* pattern/tab_low.c - the last resort: a low, pointed tab, looked for among all of them. */
#include "pattern/tab_room.h"

/* Cutting back obstacle by obstacle may end with nothing although a triangle of the least height
 * would pass between all of them: its corners are tried on this many places along the edge. */
#define PLACES 12

typedef struct low_search {
    const ktg_tab_wish *wish;
    ktg_tab_wall *walls;
    uint32_t count;
    double low, step; /* place k is at low + k step */
} low_search;

static double place(const low_search *s, int k) {
    return s->low + k * s->step;
}

static ktg_trapezoid triangle(double left, double right, double apex, double height) {
    return (ktg_trapezoid){left, right, (apex - left) / height, (right - apex) / height, height};
}

/* The wall that was in the way is asked first the next time. */
static bool passes(low_search *s, const ktg_trapezoid *t) {
    for (uint32_t i = 0; i < s->count; i++) {
        if (ktg_trapezoid_is_clear(t, s->walls[i].ends, 2, s->walls[i].clearance))
            continue;
        ktg_tab_wall wall = s->walls[i];
        s->walls[i] = s->walls[0];
        s->walls[0] = wall;
        return false;
    }
    return true;
}

/* The longest base for a point at place `apex`; false when no base is long enough. */
static bool search_base(low_search *s, int apex, double height, ktg_trapezoid *best) {
    double middle = s->wish->length / 2, x = place(s, apex);
    /* Half of the edge holds its middle: every base holds this one. */
    ktg_trapezoid least = triangle(fmin(x, middle), fmax(x, middle), x, height);
    if (!passes(s, &least))
        return false;
    for (int length = PLACES; 2 * length >= PLACES; length--)
        for (int left = 0; left + length <= PLACES; left++) {
            *best = triangle(place(s, left), place(s, left + length), x, height);
            if (left <= apex && apex <= left + length && ktg_trapezoid_is_tab(best, s->wish) &&
                ktg_trapezoid_is_gluable(best) && passes(s, best))
                return true;
        }
    return false;
}

bool ktg_trapezoid_search(ktg_trapezoid *room, const ktg_tab_wish *wish, double inset,
                          ktg_tab_wall *walls, uint32_t count) {
    low_search s = {wish, walls, count, inset, (wish->length - 2 * inset) / PLACES};
    double best_value = 0;
    for (int apex = 0; apex <= PLACES; apex++) {
        ktg_trapezoid found;
        if (!search_base(&s, apex, wish->least, &found))
            continue;
        double x = place(&s, apex);
        for (int k = 6; k > 0; k--) { /* as high as it goes */
            double height = wish->least + (wish->height - wish->least) * k / 6;
            ktg_trapezoid higher = triangle(found.left, found.right, x, height);
            if (!passes(&s, &higher))
                continue;
            found = higher;
            break;
        }
        double value = ktg_trapezoid_value(&found, wish);
        if (value > best_value * (1 + 1e-9)) {
            best_value = value;
            *room = found;
        }
    }
    return best_value > 0;
}
