/* layout/nest_body.c - shapes as they lie. */
#include "layout/nest_state.h"

#include "core/memory.h"

ktg_status ktg_nest_body_make(ktg_context *context, const nest_shape *shape, uint32_t most_corners,
                              nest_body *body) {
    *body = (nest_body){.shape = shape};
    body->corners = ktg_new(context, (size_t)most_corners + 1, ktg_vec2);
    return body->corners ? KTG_OK : KTG_MEMORY;
}

void ktg_nest_body_drop(nest_body *body) {
    ktg_free(body->corners);
}

void ktg_nest_body_put(nest_body *body, const nest_pose *pose) {
    const nest_poles *poles = &body->shape->poles;
    float c = (float)pose->turn.c, s = (float)pose->turn.s;
    float x = (float)pose->at.x, y = (float)pose->at.y;
    body->pose = *pose;
    for (uint32_t k = 0; k < poles->padded; k++) {
        body->pole_x[k] = c * poles->x[k] - s * poles->y[k] + x;
        body->pole_y[k] = s * poles->x[k] + c * poles->y[k] + y;
    }
}

void ktg_nest_body_put_corners(nest_body *body) {
    const nest_shape *shape = body->shape;
    double c = body->pose.turn.c, s = body->pose.turn.s;
    ktg_vec2 at = body->pose.at;
    for (uint32_t i = 0; i <= shape->corner_count; i++) {
        ktg_vec2 p = shape->corners[i];
        body->corners[i] = (ktg_vec2){c * p.x - s * p.y + at.x, s * p.x + c * p.y + at.y};
    }
}
