/* layout/nest_shape.c - a shape made ready for the search. */
#include "layout/nest_state.h"

#include "core/memory.h"
#include "pattern/hull.h"
#include "pattern/pattern.h"

static ktg_vec2 middle_of(const ktg_vec2 *points, size_t count) {
    ktg_vec2 low = points[0], high = points[0];
    for (size_t i = 1; i < count; i++) {
        low = (ktg_vec2){fmin(low.x, points[i].x), fmin(low.y, points[i].y)};
        high = (ktg_vec2){fmax(high.x, points[i].x), fmax(high.y, points[i].y)};
    }
    return ktg_mul2(ktg_add2(low, high), 0.5);
}

static void measure(nest_shape *shape) {
    ktg_vec2 high = {0, 0};
    double twice = 0;
    for (uint32_t i = 0; i < shape->corner_count; i++) {
        high = (ktg_vec2){fmax(high.x, shape->corners[i].x), fmax(high.y, shape->corners[i].y)};
        twice += ktg_cross2(shape->corners[i], shape->corners[i + 1]);
    }
    shape->area = fabs(twice) / 2;
    shape->diameter = 2 * ktg_length2(high);
    shape->size = sqrt(4 * high.x * high.y);
    if (!(shape->size > 0.01 * shape->diameter))
        shape->size = 0.01 * shape->diameter;
}

/* The cover, closed, without corners that come twice in a row. */
static void copy_cover(const ktg_nest_shape *from, nest_shape *shape) {
    uint32_t n = 0;
    for (size_t i = 0; i < from->cover_count; i++) {
        ktg_vec2 p = ktg_sub2(from->cover[i], shape->middle);
        if (n == 0 || p.x != shape->corners[n - 1].x || p.y != shape->corners[n - 1].y)
            shape->corners[n++] = p;
    }
    while (n > 1 && shape->corners[0].x == shape->corners[n - 1].x &&
           shape->corners[0].y == shape->corners[n - 1].y)
        n--;
    shape->corners[n] = shape->corners[0];
    shape->corner_count = n;
}

static ktg_status copy_hull(ktg_context *context, const ktg_nest_shape *from, nest_shape *shape) {
    size_t count;
    KTG_TRY(ktg_hull(context, from->outline, from->outline_count, &shape->hull, &count));
    for (size_t i = 0; i < count; i++)
        shape->hull[i] = ktg_sub2(shape->hull[i], shape->middle);
    shape->hull_count = (uint32_t)count;
    if (from->turn_count > 0)
        return KTG_OK;
    ktg_vec2 low, size;
    return ktg_smallest_box(context, from->outline, from->outline_count, &shape->box_turn, &low,
                            &size);
}

ktg_status ktg_nest_shape_make(ktg_context *context, const ktg_nest_shape *from,
                               nest_shape *shape) {
    *shape = (nest_shape){.turns = from->turns, .turn_count = (uint32_t)from->turn_count};
    shape->middle = middle_of(from->cover, from->cover_count);
    shape->corners = ktg_new(context, from->cover_count + 1, ktg_vec2);
    if (!shape->corners)
        return KTG_MEMORY;
    copy_cover(from, shape);
    measure(shape);
    KTG_TRY(copy_hull(context, from, shape));
    return ktg_nest_poles_find(context, shape, &shape->poles);
}

void ktg_nest_shape_drop(nest_shape *shape) {
    ktg_free(shape->corners);
    ktg_free(shape->hull);
    ktg_free(shape->poles.x);
    ktg_free(shape->poles.y);
    ktg_free(shape->poles.radius);
}

/* Cosine and sine, exact for quarter turns. */
static void turn_by(double angle, double *c, double *s) {
    double quarters = angle / (KTG_PI / 2), whole = nearbyint(quarters);
    if (fabs(quarters - whole) > 1e-12) {
        *c = cos(angle);
        *s = sin(angle);
        return;
    }
    static const int cosines[] = {1, 0, -1, 0};
    int k = (int)fmod(whole, 4);
    k = k < 0 ? k + 4 : k;
    *c = cosines[k];
    *s = cosines[(k + 3) % 4];
}

static void turned_box(const ktg_vec2 *points, uint32_t count, double c, double s, ktg_vec2 *low,
                       ktg_vec2 *high) {
    ktg_vec2 l = {INFINITY, INFINITY}, h = {-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < count; i++) {
        double x = c * points[i].x - s * points[i].y, y = s * points[i].x + c * points[i].y;
        l.x = x < l.x ? x : l.x;
        l.y = y < l.y ? y : l.y;
        h.x = x > h.x ? x : h.x;
        h.y = y > h.y ? y : h.y;
    }
    *low = l;
    *high = h;
}

nest_turn ktg_nest_turn_by(const nest_shape *shape, double angle) {
    nest_turn turn = {.angle = angle};
    turn_by(angle, &turn.c, &turn.s);
    turned_box(shape->hull, shape->hull_count, turn.c, turn.s, &turn.low, &turn.high);
    return turn;
}

void ktg_nest_turn_cover(const nest_shape *shape, nest_turn *turn) {
    turned_box(shape->corners, shape->corner_count, turn->c, turn->s, &turn->cover_low,
               &turn->cover_high);
}
