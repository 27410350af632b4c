/* paint/colour.c - the colour of a dot on a face. */
#include "paint/look.h"

#include "core/memory.h"
#include "mesh/closest.h"

#include <math.h>

/* Where a face looks away from the model's by more than a right angle it is asked again from
 * outside, so that a thin part is not given the colours of its other side. */
#define FROM_OUTSIDE 2.0
/* So many half dots from a corner of 30 degrees a point is away from both its edges. */
#define SHARP_CORNER 4.0
#define MOST_ROUNDS  16

/* ---- along a face -------------------------------------------------------------------------- */

/* Weights of a point of the face; what lies beyond an edge comes onto it. */
static void bring_in(double weights[3]) {
    double sum = 0;
    for (size_t k = 0; k < 3; k++) {
        weights[k] = ktg_max(0, weights[k]);
        sum += weights[k];
    }
    for (size_t k = 0; k < 3; k++)
        weights[k] = sum > 0 ? weights[k] / sum : 1.0 / 3;
}

static ktg_vec2 mix2(const ktg_vec2 p[3], const double w[3]) {
    return (ktg_vec2){w[0] * p[0].x + w[1] * p[1].x + w[2] * p[2].x,
                      w[0] * p[0].y + w[1] * p[1].y + w[2] * p[2].y};
}

static ktg_vec3 mix3(const ktg_vec3 p[3], const double w[3]) {
    return ktg_add3(ktg_add3(ktg_mul3(p[0], w[0]), ktg_mul3(p[1], w[1])), ktg_mul3(p[2], w[2]));
}

/* Twice the area of the face in its image, and the radius of the circle in it. */
static double room_of(const ktg_look *look, double *radius) {
    const ktg_vec2 *p = look->dots;
    double twice = ktg_cross2(ktg_sub2(p[1], p[0]), ktg_sub2(p[2], p[0])), around = 0;
    for (size_t k = 0; k < 3; k++)
        around += ktg_length2(ktg_sub2(p[(k + 1) % 3], p[k]));
    *radius = around > 0 ? fabs(twice) / around : 0;
    return twice;
}

/* Edges to keep away from, as bits: those beyond which the image shows something else; near a
 * corner where there is such an edge, also one of a neighbour, all. */
static unsigned edges_near(const ktg_look *look, ktg_vec2 at, double half) {
    for (size_t k = 0; k < 3; k++)
        if (look->borders & 8u << k &&
            ktg_length2(ktg_sub2(at, look->dots[k])) < SHARP_CORNER * half)
            return 7;
    return look->borders & 7u;
}

/* Between two dots of an image a bit of both is seen. So what is nearer than half a dot (of a
 * level's) to such an edge moves inwards, as far as the triangle has room: to one edge after the
 * other, until it is away from all. */
static ktg_vec2 keep_inside(const ktg_look *look, ktg_vec2 at, double half) {
    double radius, twice = room_of(look, &radius);
    const ktg_vec2 *p = look->dots;
    half = ktg_min(half, radius);
    unsigned edges = half > 0 ? edges_near(look, at, half) : 0;
    for (int round = 0; round < MOST_ROUNDS && edges; round++) {
        bool moved = false;
        for (size_t k = 0; k < 3; k++) {
            ktg_vec2 along = ktg_unit2(ktg_sub2(p[(k + 1) % 3], p[k]));
            ktg_vec2 in = ktg_mul2(ktg_perp2(along), twice < 0 ? -1 : 1);
            double from = ktg_dot2(ktg_sub2(at, p[k]), in);
            if (!(edges & 1u << k) || from >= half - 1e-6)
                continue;
            at = ktg_madd2(at, half - from, in);
            moved = true;
        }
        if (!moved)
            break;
    }
    return at;
}

/* The level whose dots are about `dots` of level 0 wide. */
static uint32_t level_for(const ktg_image *image, double dots) {
    double level = dots > 1 ? floor(log2(dots) + 0.5) : 0;
    return level < image->level_count - 1 ? (uint32_t)level : image->level_count - 1;
}

static void image_colour(const ktg_paint *paint, const ktg_look *look, const double weights[3],
                         uint32_t level, double rgb[3]) {
    const ktg_source *source = &paint->sources[look->source];
    double half = source->crisp ? 1e-3 : 0.5 * (double)((uint32_t)1 << level);
    ktg_vec2 at = keep_inside(look, mix2(look->dots, weights), half);
    ktg_image_colour(source->image, level, at, source->wrap, source->crisp, rgb);
}

/* One place of a face whose colours it has itself. */
static void own_colour(const ktg_paint *paint, const ktg_look *look, const double weights[3],
                       uint32_t level, double rgb[3]) {
    if (look->kind == KTG_LOOK_IMAGE) {
        image_colour(paint, look, weights, level, rgb);
        return;
    }
    for (size_t c = 0; c < 3; c++)
        rgb[c] = look->kind == KTG_LOOK_PLAIN
                     ? look->rgb[0][c]
                     : weights[0] * look->rgb[0][c] + weights[1] * look->rgb[1][c] +
                           weights[2] * look->rgb[2][c];
}

/* The mean of four places within the dot. */
static void mean_colour(const ktg_paint *paint, const ktg_look *look, const ktg_paint_dot *dot,
                        double rgb[3]) {
    uint32_t level = 0;
    if (look->kind == KTG_LOOK_IMAGE) {
        double right = ktg_length2(mix2(look->dots, dot->right));
        double down = ktg_length2(mix2(look->dots, dot->down));
        const ktg_source *source = &paint->sources[look->source];
        level = source->crisp ? 0 : level_for(source->image, ktg_max(right, down) / 2);
    }
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (size_t i = 0; i < 4; i++) {
        double weights[3], part[3];
        for (size_t k = 0; k < 3; k++)
            weights[k] = dot->weights[k] + (i & 1 ? 0.25 : -0.25) * dot->right[k] +
                         (i & 2 ? 0.25 : -0.25) * dot->down[k];
        bring_in(weights);
        own_colour(paint, look, weights, level, part);
        for (size_t c = 0; c < 3; c++)
            rgb[c] += part[c] / 4;
    }
}

/* ---- the closest point of the model -------------------------------------------------------- */

static void corners_of(const ktg_mesh *mesh, uint32_t face, ktg_vec3 corners[3]) {
    for (size_t k = 0; k < 3; k++)
        corners[k] = mesh->positions[mesh->faces[3 * (size_t)face + k]];
}

static ktg_vec3 normal_of(const ktg_vec3 corners[3]) {
    return ktg_cross3(ktg_sub3(corners[1], corners[0]), ktg_sub3(corners[2], corners[0]));
}

/* The weights of a point of a triangle. */
static void weigh(const ktg_vec3 corners[3], ktg_vec3 point, double weights[3]) {
    ktg_vec3 normal = normal_of(corners);
    double square = ktg_dot3(normal, normal);
    for (size_t k = 0; k < 3; k++) {
        ktg_vec3 a = ktg_sub3(corners[(k + 1) % 3], point),
                 b = ktg_sub3(corners[(k + 2) % 3], point);
        weights[k] = square > 0 ? ktg_dot3(ktg_cross3(a, b), normal) / square : 1.0 / 3;
    }
    bring_in(weights);
}

static bool looks_away(const ktg_paint *paint, uint32_t face, ktg_vec3 normal) {
    ktg_vec3 corners[3];
    corners_of(paint->model, face, corners);
    return ktg_dot3(normal_of(corners), normal) < 0;
}

/* The model's point that is closest to `at`, of those that look the same way where that is easily
 * had. */
static ktg_status find_closest(ktg_context *context, const ktg_paint *paint, ktg_vec3 at,
                               ktg_vec3 normal, ktg_vec3 *point, uint32_t *face) {
    KTG_TRY(ktg_closest_point(context, paint->closest, at, point, face));
    double away = ktg_length3(ktg_sub3(*point, at));
    if (!looks_away(paint, *face, normal) || !(away > 0))
        return KTG_OK;
    ktg_vec3 other;
    uint32_t other_face = KTG_NONE;
    KTG_TRY(ktg_closest_point(context, paint->closest,
                              ktg_madd3(at, FROM_OUTSIDE * away, ktg_unit3(normal)), &other,
                              &other_face));
    if (!looks_away(paint, other_face, normal)) {
        *point = other;
        *face = other_face;
    }
    return KTG_OK;
}

/* How many dots of its image lie along a unit of length on a face. */
static double density(const ktg_look *look, const ktg_vec3 corners[3]) {
    double area = ktg_length3(normal_of(corners));
    double dots = fabs(
        ktg_cross2(ktg_sub2(look->dots[1], look->dots[0]), ktg_sub2(look->dots[2], look->dots[0])));
    return area > 0 ? sqrt(dots / area) : 0;
}

static ktg_status closest_colour(ktg_context *context, const ktg_paint *paint, ktg_paint_dot *dot,
                                 double rgb[3]) {
    const ktg_vec3 *own = paint->corners + 3 * (size_t)dot->face;
    double weights[3] = {dot->weights[0], dot->weights[1], dot->weights[2]};
    ktg_vec3 point, corners[3];
    uint32_t face = dot->near, level = 0;
    bring_in(weights);
    KTG_TRY(find_closest(context, paint, mix3(own, weights), normal_of(own), &point, &face));
    dot->near = face;
    corners_of(paint->model, face, corners);
    weigh(corners, point, weights);
    const ktg_look *look = &paint->model_looks[face];
    if (look->kind == KTG_LOOK_IMAGE && !paint->sources[look->source].crisp)
        level = level_for(paint->sources[look->source].image,
                          density(look, corners) * ktg_length3(mix3(own, dot->right)));
    own_colour(paint, look, weights, level, rgb);
    return KTG_OK;
}

/* ---- the dot ------------------------------------------------------------------------------- */

ktg_status ktg_paint_colour(ktg_context *context, const ktg_paint *paint, ktg_paint_dot *dot,
                            uint8_t rgb[3]) {
    double mean[3];
    if (dot->face >= paint->face_count)
        return ktg_fail(context, KTG_ARGUMENT, "face %u has no look: there are %u", dot->face,
                        paint->face_count);
    const ktg_look *look = &paint->looks[dot->face];
    if (look->kind == KTG_LOOK_CLOSEST)
        KTG_TRY(closest_colour(context, paint, dot, mean));
    else if (look->kind == KTG_LOOK_PLAIN)
        own_colour(paint, look, dot->weights, 0, mean);
    else
        mean_colour(paint, look, dot, mean);
    for (size_t c = 0; c < 3; c++)
        rgb[c] = (uint8_t)(mean[c] + 0.5);
    return KTG_OK;
}
