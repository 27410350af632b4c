/* mesh/simplify_colours.c - colours of vertices follow the collapses. */
#include "core/memory.h"
#include "core/vec.h"
#include "mesh/simplify.h"

ktg_status ktg_simplify_take_colours(ktg_simplify *s, const ktg_mesh *mesh) {
    size_t count = 3 * (size_t)mesh->vertex_count;
    if (!mesh->vertex_colours)
        return KTG_OK;
    s->colours = ktg_new(s->context, count, float);
    for (size_t i = 0; s->colours && i < count; i++)
        s->colours[i] = mesh->vertex_colours[i];
    return s->colours ? KTG_OK : KTG_MEMORY;
}

/* How far along the edge from `from` to `to` a position lies. */
static double fraction(ktg_vec3 from, ktg_vec3 to, ktg_vec3 position) {
    ktg_vec3 edge = ktg_sub3(to, from);
    double t = ktg_dot3(ktg_sub3(position, from), edge) / ktg_dot3(edge, edge);
    return t > 0 ? fmin(t, 1) : 0;
}

void ktg_simplify_blend_colours(ktg_simplify *s, const ktg_candidate *c, ktg_vec3 position) {
    if (!s->colours)
        return;
    float t = (float)fraction(s->positions[c->from], s->positions[c->to], position);
    const float *from = s->colours + 3 * (size_t)c->from;
    float *to = s->colours + 3 * (size_t)c->to;
    for (int k = 0; k < 3; k++)
        to[k] = (1 - t) * from[k] + t * to[k];
}

void ktg_simplify_give_colour(const ktg_simplify *s, uint32_t vertex, ktg_mesh *mesh, uint32_t at) {
    for (size_t k = 0; s->colours && k < 3; k++)
        mesh->vertex_colours[3 * (size_t)at + k] =
            (uint8_t)lroundf(s->colours[3 * (size_t)vertex + k]);
}
