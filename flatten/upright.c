/* flatten/upright.c - which way a flat panel is turned: as the model stands, or by its grain. */
#include "core/vec.h"
#include "flatten/kernel.h"

#include <math.h>

/* Where the model's `direction` points on the flat panel: sum A J direction / sum A, the vector
 * whose turn to +y leaves sum A |R J direction - y|^2 least. */
static ktg_vec2 image_of_direction(const ktg_panel *panel, const ktg_vec2 *flat,
                                   ktg_vec3 direction) {
    ktg_vec2 sum = {0, 0};
    double total = 0;
    for (uint32_t f = 0; f < panel->face_count; f++) {
        ktg_face_map map = ktg_face_map_of(panel, f, flat);
        sum = ktg_madd2(sum, map.area, ktg_face_map_direction(&map, direction));
        total += map.area;
    }
    return ktg_mul2(sum, 1 / total);
}

/* The direction of the flat panel that is to point up: the model's upright axis; of a panel that
 * lies (or a dome, whose sides cancel) away from one who looks down from above; of one that lies in
 * that direction too, sideways. */
ktg_vec2 ktg_panel_upward(const ktg_panel *panel, const ktg_vec2 *flat, unsigned up) {
    static const ktg_vec3 directions[3][3] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                              {{0, 1, 0}, {0, 0, -1}, {1, 0, 0}},
                                              {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}};
    for (size_t k = 0; k < 3; k++) {
        ktg_vec2 image = image_of_direction(panel, flat, directions[up % 3][k]);
        if (ktg_length2(image) > 1e-3)
            return ktg_unit2(image);
    }
    return (ktg_vec2){0, 1};
}

void ktg_panel_set_upright(const ktg_panel *panel, ktg_vec2 *flat, unsigned axis, double grain) {
    ktg_vec2 upright = ktg_panel_upward(panel, flat, axis), low = {INFINITY, INFINITY};
    ktg_vec2 up = {cos(grain) * upright.x - sin(grain) * upright.y,
                   sin(grain) * upright.x + cos(grain) * upright.y};
    for (uint32_t v = 0; v < panel->vertex_count; v++) {
        flat[v] = (ktg_vec2){ktg_cross2(flat[v], up), ktg_dot2(flat[v], up)};
        low = (ktg_vec2){fmin(low.x, flat[v].x), fmin(low.y, flat[v].y)};
    }
    for (uint32_t v = 0; v < panel->vertex_count; v++)
        flat[v] = ktg_sub2(flat[v], low);
}
