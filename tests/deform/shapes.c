#include "shapes.h"
#include "core/memory.h"
#include "core/vec.h"

#include <stdlib.h>
#include <string.h>

int rig_setup(void **state) {
    rig *r = calloc(1, sizeof *r);
    *state = r;
    return !r || ktg_context_new(&r->context) != KTG_OK;
}

int rig_teardown(void **state) {
    rig *r = *state;
    for (size_t h = 0; h < r->edit.hold_count; h++)
        free(r->holds[h].vertices);
    for (size_t l = 0; l < r->edit.link_count; l++) {
        free(r->links[l].from);
        free(r->links[l].to);
    }
    ktg_mesh_free(&r->mesh);
    ktg_free(r->points);
    ktg_free(r->faces);
    free(r->after);
    ktg_context_free(&r->context);
    free(r);
    return 0;
}

/* ---- surfaces ---- */

uint32_t rig_point(rig *r, double x, double y, double z) {
    assert_int_equal(
        ktg_reserve(r->context, &r->points, &r->point_capacity, (size_t)r->point_count + 1),
        KTG_OK);
    r->points[r->point_count] = (ktg_vec3){x, y, z};
    return r->point_count++;
}

void rig_face(rig *r, uint32_t a, uint32_t b, uint32_t c) {
    size_t at = 3 * (size_t)r->face_count++;
    assert_int_equal(ktg_reserve(r->context, &r->faces, &r->face_capacity, at + 3), KTG_OK);
    r->faces[at] = a;
    r->faces[at + 1] = b;
    r->faces[at + 2] = c;
}

uint32_t rig_plate(rig *r, uint32_t across, uint32_t along, ktg_vec3 o, ktg_vec3 u, ktg_vec3 v) {
    uint32_t first = r->point_count, width = across + 1;
    for (uint32_t j = 0; j <= along; j++)
        for (uint32_t i = 0; i <= across; i++) {
            double s = (double)i / across, t = (double)j / along;
            rig_point(r, o.x + s * u.x + t * v.x, o.y + s * u.y + t * v.y, o.z + s * u.z + t * v.z);
        }
    for (uint32_t j = 0; j < along; j++)
        for (uint32_t i = 0; i < across; i++) {
            uint32_t a = first + j * width + i;
            rig_face(r, a, a + 1, a + width + 1);
            rig_face(r, a, a + width + 1, a + width);
        }
    return first;
}

static void close_rings(rig *r, uint32_t first, uint32_t sides, uint32_t rings) {
    for (uint32_t j = 0; j < rings; j++)
        for (uint32_t i = 0; i < sides; i++) {
            uint32_t a = first + j * sides + i, b = first + j * sides + (i + 1) % sides;
            rig_face(r, a, b, b + sides);
            rig_face(r, a, b + sides, a + sides);
        }
}

uint32_t rig_tube(rig *r, uint32_t sides, uint32_t rings, double x0, double x1, double r0,
                  double r1) {
    uint32_t first = r->point_count;
    for (uint32_t j = 0; j <= rings; j++)
        for (uint32_t i = 0; i < sides; i++) {
            double t = (double)j / rings, radius = r0 + t * (r1 - r0);
            double turn = 2 * KTG_PI * i / sides;
            rig_point(r, x0 + t * (x1 - x0), radius * cos(turn), radius * sin(turn));
        }
    close_rings(r, first, sides, rings);
    return first;
}

uint32_t rig_square_with_hole(rig *r, uint32_t sides, uint32_t rings, double radius) {
    uint32_t first = r->point_count;
    for (uint32_t j = 0; j <= rings; j++)
        for (uint32_t i = 0; i < sides; i++) {
            double turn = 2 * KTG_PI * i / sides, c = cos(turn), s = sin(turn);
            double square = 1 / ktg_max(fabs(c), fabs(s)), t = (double)j / rings;
            double away = radius + t * (square - radius);
            rig_point(r, away * c, away * s, 0);
        }
    close_rings(r, first, sides, rings);
    return first;
}

void rig_mesh(rig *r) {
    ktg_mesh_free(&r->mesh);
    assert_int_equal(ktg_mesh_new(r->context, (const double *)r->points, r->point_count, r->faces,
                                  r->face_count, &r->mesh),
                     KTG_OK);
    r->edit.holds = r->holds;
    r->edit.links = r->links;
}

/* ---- edits ---- */

static bool inside(ktg_vec3 p, ktg_vec3 low, ktg_vec3 high) {
    return p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x && p.y <= high.y &&
           p.z <= high.z;
}

static ktg_hold *new_hold(rig *r, ktg_hold_kind kind, const char *name) {
    assert_true(r->edit.hold_count < MOST_HOLDS);
    ktg_hold *hold = &r->holds[r->edit.hold_count++];
    *hold = (ktg_hold){.kind = kind, .name = (char *)(uintptr_t)name};
    hold->vertices = calloc(r->point_count, sizeof *hold->vertices);
    assert_non_null(hold->vertices);
    return hold;
}

ktg_hold *rig_hold(rig *r, ktg_hold_kind kind, const char *name, ktg_vec3 low, ktg_vec3 high) {
    ktg_hold *hold = new_hold(r, kind, name);
    for (uint32_t v = 0; v < r->point_count; v++)
        if (inside(r->points[v], low, high))
            hold->vertices[hold->vertex_count++] = v;
    return hold;
}

ktg_hold *rig_hold_run(rig *r, ktg_hold_kind kind, const char *name, uint32_t first,
                       uint32_t count) {
    ktg_hold *hold = new_hold(r, kind, name);
    for (uint32_t v = first; v < first + count; v++)
        hold->vertices[hold->vertex_count++] = v;
    return hold;
}

static uint32_t *run(uint32_t first, uint32_t count) {
    uint32_t *vertices = calloc(count, sizeof *vertices);
    assert_non_null(vertices);
    for (uint32_t i = 0; i < count; i++)
        vertices[i] = first + i;
    return vertices;
}

ktg_edit_link *rig_link(rig *r, ktg_link_kind kind, uint32_t from, uint32_t from_count, uint32_t to,
                        uint32_t to_count, double most) {
    assert_true(r->edit.link_count < MOST_LINKS);
    ktg_edit_link *link = &r->links[r->edit.link_count++];
    *link = (ktg_edit_link){.kind = kind, .from_count = from_count, .to_count = to_count};
    link->from = run(from, from_count);
    link->to = run(to, to_count);
    link->most = most;
    return link;
}

ktg_deform_motion bend(double x0, double x1, double angle) {
    double radius = (x1 - x0) / angle;
    return (ktg_deform_motion){
        .axis = {0, -1, 0},
        .angle = angle,
        .centre = {x1, 0, 0},
        .move = {x0 + radius * sin(angle) - x1, 0, radius * (1 - cos(angle))}};
}

ktg_status rig_try(rig *r) {
    ktg_deform *deform = NULL;
    free(r->after);
    r->after = calloc(r->point_count, sizeof *r->after);
    ktg_status status = ktg_deform_new(r->context, r->mesh, &r->edit, &deform);
    if (status == KTG_OK)
        status = ktg_deform_update(r->context, deform, NULL, r->after);
    if (status == KTG_OK)
        status = ktg_deform_measure(r->context, deform, r->after, &r->report);
    ktg_deform_free(&deform);
    return status;
}

void rig_deform(rig *r) {
    if (rig_try(r) != KTG_OK)
        fail_msg("%s", ktg_context_message(r->context));
}

/* ---- measuring ---- */

double gap(const ktg_vec3 *p, uint32_t a, uint32_t b) {
    return ktg_length3(ktg_sub3(p[b], p[a]));
}

ktg_vec3 direction(const ktg_vec3 *p, uint32_t a, uint32_t b) {
    return ktg_unit3(ktg_sub3(p[b], p[a]));
}

ktg_vec3 normal_of(const ktg_vec3 *p, uint32_t a, uint32_t b, uint32_t c) {
    return ktg_unit3(ktg_cross3(ktg_sub3(p[b], p[a]), ktg_sub3(p[c], p[a])));
}

double degrees_between(ktg_vec3 a, ktg_vec3 b) {
    return atan2(ktg_length3(ktg_cross3(a, b)), ktg_dot3(a, b)) * 180 / KTG_PI;
}
