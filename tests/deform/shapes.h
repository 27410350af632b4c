/* Surfaces and edits to be put together in tests of the deformation. */
#ifndef KTG_TESTS_DEFORM_SHAPES_H
#define KTG_TESTS_DEFORM_SHAPES_H

#include "deform/deform.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#define MOST_HOLDS 24
#define MOST_LINKS 24

/* What a test works on; freed by its teardown. */
typedef struct rig {
    ktg_context *context;
    ktg_vec3 *points;
    uint32_t *faces;
    uint32_t point_count, face_count;
    size_t point_capacity, face_capacity;
    ktg_mesh *mesh;
    ktg_vec3 *after; /* where the vertices of the mesh came to */
    ktg_edit edit;
    ktg_hold holds[MOST_HOLDS];
    ktg_edit_link links[MOST_LINKS];
    ktg_deform_report report;
} rig;

int rig_setup(void **state);
int rig_teardown(void **state);

/* ---- surfaces: each gives the number of its first point ---- */

uint32_t rig_point(rig *r, double x, double y, double z);
void rig_face(rig *r, uint32_t a, uint32_t b, uint32_t c);
/* (across + 1) x (along + 1) points, rows along v: origin + i / across u + j / along v. */
uint32_t rig_plate(rig *r, uint32_t across, uint32_t along, ktg_vec3 origin, ktg_vec3 u,
                   ktg_vec3 v);
/* Rings around the x axis from x0 to x1, radius r0 to r1: `sides` points each. */
uint32_t rig_tube(rig *r, uint32_t sides, uint32_t rings, double x0, double x1, double r0,
                  double r1);
/* The square from -1 to 1 with a round hole in the middle: `rings` + 1 rings of `sides` points, the
 * first one the hole's. */
uint32_t rig_square_with_hole(rig *r, uint32_t sides, uint32_t rings, double radius);
/* The points and faces so far become the mesh. */
void rig_mesh(rig *r);

/* ---- edits ---- */

/* A hold of the points in a box. */
ktg_hold *rig_hold(rig *r, ktg_hold_kind kind, const char *name, ktg_vec3 low, ktg_vec3 high);
/* A hold of `count` points from `first` on. */
ktg_hold *rig_hold_run(rig *r, ktg_hold_kind kind, const char *name, uint32_t first,
                       uint32_t count);
/* A link between points of two runs in two boxes that are the same but for the run. */
ktg_edit_link *rig_link(rig *r, ktg_link_kind kind, uint32_t from, uint32_t from_count, uint32_t to,
                        uint32_t to_count, double most);

/* What takes the end of a strip from x0 to x1 to where a circular arc that leaves x0 straight on
 * ends, after `angle` radians, bent towards z. */
ktg_deform_motion bend(double x0, double x1, double angle);

/* Deforms; the mesh stays as it is, `after` and `report` are new. */
void rig_deform(rig *r);
/* The same without a check: for edits that are to be refused. */
ktg_status rig_try(rig *r);

/* ---- measuring ---- */

double gap(const ktg_vec3 *p, uint32_t a, uint32_t b);
ktg_vec3 direction(const ktg_vec3 *p, uint32_t a, uint32_t b);
ktg_vec3 normal_of(const ktg_vec3 *p, uint32_t a, uint32_t b, uint32_t c);
/* Degrees between two unit vectors. */
double degrees_between(ktg_vec3 a, ktg_vec3 b);

#endif
