/* verify/check.h - what the checks share (verify only): the pattern under proof, the surface's
 * adjacency as computed anew, and the list of problems.
 *
 * Half-edge h = 3 f + k runs from corner k of surface face f to the next one, and has the face on
 * its left. */
#ifndef KTG_VERIFY_CHECK_H
#define KTG_VERIFY_CHECK_H

#include "core/vec.h"
#include "verify/verify.h"

#define KTG_VERIFY_LISTED 5     /* problems that go into the message */
#define KTG_VERIFY_TEXT   2048  /* bytes of that message */
#define KTG_VERIFY_LENGTH 1e-9  /* relative, of lengths and areas */
#define KTG_VERIFY_SHORT  1e-3  /* of the reach: shorter edges count as that long, ... */
#define KTG_VERIFY_SEWN   1e-5  /* ... and the two sides of cloth from this on */
#define KTG_VERIFY_REFOLD 1e-6  /* of the diagonal */
#define KTG_VERIFY_FLAT   1e-3  /* radians: folds that turn by less are called flat */
#define KTG_VERIFY_ANGLE  1e-6  /* radians, of an angle that is told */
#define KTG_VERIFY_TOUCH  1e-6  /* mm: points that should be the same, or inside */
#define KTG_VERIFY_DEPTH  1e-3  /* mm: deeper is an overlap */
#define KTG_VERIFY_EASE   0.005 /* cloth: of the two sides of a seam */
#define KTG_VERIFY_MARKS  6.0   /* mm: between the marks of a notch (docs/pattern-json.md) */

typedef struct ktg_check {
    ktg_context *context;
    const ktg_pattern *pattern;
    ktg_verify_report *report;

    char text[KTG_VERIFY_TEXT]; /* the first problems, one sentence each */
    size_t text_length;

    bool finished;   /* the pattern has seams and outlines, not only faces and edges */
    double diagonal; /* of the surface's bounding box */
    double mm;       /* millimetres in the pattern's unit; not 1 only where no scale is set */
    double reach3;   /* largest coordinate of the surface, at least the diagonal */

    uint32_t *twin;           /* 3 face_count: the half-edge on the other side, or KTG_NONE */
    uint32_t *face_component; /* face_count: connected parts of the surface ... */
    uint32_t component_count; /* ... and how many there are */
    double *width;            /* face_count: the smallest height of the triangle in 3D */

    uint32_t *face_piece; /* face_count: where each face lies ... */
    uint32_t *face_slot;  /* ... and its place in that piece's list */
    double *reach2;       /* piece_count: largest coordinate in 2D, at least the diagonal */
    uint8_t *fold;        /* 3 face_count: both sides in one piece, sharing both its vertices */
    uint32_t *edge_at;    /* 3 face_count: the pattern's edge, or KTG_NONE */
} ktg_check;

/* Counts a problem and puts the first ones into the message. */
void ktg_check_problem(ktg_check *check, const char *format, ...) KTG_PRINTF(2, 3);

/* ---- small geometry ----------------------------------------------------------------------- */

static inline uint32_t ktg_check_next(uint32_t h) {
    return h % 3 == 2 ? h - 2 : h + 1;
}
/* Surface vertex where half-edge h starts. */
static inline uint32_t ktg_check_start(const ktg_check *check, uint32_t h) {
    return check->pattern->faces[h];
}
static inline const ktg_pattern_piece *ktg_check_piece(const ktg_check *check, uint32_t face) {
    return &check->pattern->pieces[check->face_piece[face]];
}
/* The piece's vertex at the start of half-edge h. */
static inline uint32_t ktg_check_corner(const ktg_check *check, uint32_t h) {
    return ktg_check_piece(check, h / 3)->corners[3 * (size_t)check->face_slot[h / 3] + h % 3];
}
/* Where half-edge h starts and ends, flat and in space. */
static inline ktg_vec2 ktg_check_start2(const ktg_check *check, uint32_t h) {
    return ktg_check_piece(check, h / 3)->vertices[ktg_check_corner(check, h)];
}
static inline ktg_vec2 ktg_check_end2(const ktg_check *check, uint32_t h) {
    return ktg_check_start2(check, ktg_check_next(h));
}
static inline ktg_vec3 ktg_check_start3(const ktg_check *check, uint32_t h) {
    return check->pattern->vertices[check->pattern->faces[h]];
}
static inline ktg_vec3 ktg_check_end3(const ktg_check *check, uint32_t h) {
    return ktg_check_start3(check, ktg_check_next(h));
}
static inline uint32_t ktg_check_halfedge(const ktg_pattern_side *side) {
    return 3 * side->face + side->corner;
}
static inline double ktg_check_distance2(ktg_vec2 a, ktg_vec2 b) {
    return ktg_length2(ktg_sub2(a, b));
}
static inline double ktg_check_distance3(ktg_vec3 a, ktg_vec3 b) {
    return ktg_length3(ktg_sub3(a, b));
}

/* Unit normal of a face of the surface, from its two shorter edges. */
ktg_vec3 ktg_check_normal(const ktg_check *check, uint32_t face);
/* Twice the signed area of a polygon. */
double ktg_check_area2(const ktg_vec2 *points, size_t count);
/* The half-edge of the piece's border that follows border half-edge h. */
uint32_t ktg_check_next_border(const ktg_check *check, uint32_t h);

/* ---- overlap ------------------------------------------------------------------------------ */

/* Convex polygons; two with the same group are not compared when `groups` is given. */
typedef struct ktg_check_shapes {
    size_t count, count_capacity;
    size_t point_count, point_capacity;
    struct ktg_check_shape *shapes;
    ktg_vec2 *points;
    bool by_group;
} ktg_check_shapes;

typedef struct ktg_check_shape {
    size_t first;   /* of its points */
    uint32_t count; /* of its points */
    uint32_t group;
    uint32_t number; /* face, or edge of a tab */
    bool tab;
} ktg_check_shape;

/* Adds a polygon (its points are copied). */
KTG_NODISCARD ktg_status ktg_check_add_shape(ktg_context *context, ktg_check_shapes *shapes,
                                             const ktg_vec2 *points, uint32_t count, uint32_t group,
                                             uint32_t number, bool tab);
void ktg_check_clear_shapes(ktg_check_shapes *shapes);
void ktg_check_free_shapes(ktg_check_shapes *shapes);

typedef void ktg_check_overlap_found(ktg_check *check, const ktg_check_shape *a,
                                     const ktg_check_shape *b, double depth, void *user);

/* Calls `found` for each pair that overlaps deeper than KTG_VERIFY_DEPTH, in the order of the
 * shapes, up to 10,000 of them; keeps the deepest in the report. */
KTG_NODISCARD ktg_status ktg_check_overlaps(ktg_check *check, const ktg_check_shapes *shapes,
                                            ktg_check_overlap_found *found, void *user);

/* ---- the checks, in their order ----------------------------------------------------------- */

KTG_NODISCARD ktg_status ktg_check_form(ktg_check *check);
KTG_NODISCARD ktg_status ktg_check_surface(ktg_check *check);
KTG_NODISCARD ktg_status ktg_check_faces(ktg_check *check);
KTG_NODISCARD ktg_status ktg_check_components(ktg_check *check);
KTG_NODISCARD ktg_status ktg_check_edges(ktg_check *check);
void ktg_check_lengths(ktg_check *check);
KTG_NODISCARD ktg_status ktg_check_refold(ktg_check *check);
KTG_NODISCARD ktg_status ktg_check_pieces_apart(ktg_check *check);
KTG_NODISCARD ktg_status ktg_check_tabs(ktg_check *check);
KTG_NODISCARD ktg_status ktg_check_outlines(ktg_check *check);
KTG_NODISCARD ktg_status ktg_check_seams(ktg_check *check);
KTG_NODISCARD ktg_status ktg_check_cloth(ktg_check *check);

/* How far p is on the drawn side of the fold of half a piece; infinite for a whole one. */
double ktg_check_on_drawn_side(const ktg_pattern_piece *piece, ktg_vec2 p);
/* What is drawn of the piece's face at that place of its list: 3 corners, or of half a piece 0
 * to 4.
 */
uint32_t ktg_check_drawn_face(const ktg_pattern_piece *piece, size_t place, ktg_vec2 points[4]);
void ktg_check_labels(ktg_check *check);
KTG_NODISCARD ktg_status ktg_check_sheets(ktg_check *check);
/* tiled[p]: on how many tiles piece p lies. */
KTG_NODISCARD ktg_status ktg_check_tiles(ktg_check *check, const uint32_t *tiled);
KTG_NODISCARD ktg_status ktg_check_model(ktg_check *check, const ktg_mesh *model);

#endif
