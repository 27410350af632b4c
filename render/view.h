/* render/view.h - the model as one eye sees it: which face is nearest at each dot (render only).
 *
 * A z-buffer (Catmull 1974), seen from far away, at any resolution: hidden faces are removed dot by
 * dot, so that nothing shows through, however faces lie. What a dot's colour is, is said by a
 * function of the face and of where on it the dot lies. Lines are found in the picture: where two
 * neighbouring dots show two faces, there the edge between those is seen. */
#ifndef KTG_RENDER_VIEW_H
#define KTG_RENDER_VIEW_H

#include "render/draw.h"

/* Unit vectors of the model: what is right and up in the picture, and where the eye is. */
typedef struct ktg_eye {
    ktg_vec3 right, above, toward;
} ktg_eye;

/* An eye that is `turn` to the right of the model's front and `rise` above its middle, radians;
 * `up`: which axis is height. The front looks along z where y is up, against y where z is. */
ktg_eye ktg_eye_at(unsigned up, double turn, double rise);

/* Where a point of the model is seen: to the right and down, in the model's unit. */
static inline ktg_vec2 ktg_eye_sees(const ktg_eye *eye, ktg_vec3 point) {
    return (ktg_vec2){ktg_dot3(point, eye->right), -ktg_dot3(point, eye->above)};
}

typedef struct ktg_view {
    const ktg_pattern *pattern;
    ktg_eye eye;
    ktg_vec2 corner; /* what is seen at the upper left corner of the picture */
    double scale;    /* dots for a unit of the model */
    int width, height;
    uint32_t *faces; /* width * height, row after row: the face seen, or KTG_NONE */
    float *depths;   /* width * height: towards the eye, in dots */
} ktg_view;

/* What the eye sees of the faces (all, or those that `shown`, face_count, says) as a box. False
 * when that is nothing. */
bool ktg_view_extent(const ktg_pattern *pattern, const bool *shown, const ktg_eye *eye,
                     ktg_area *seen);

/* Looks at `seen` with that many dots for a unit; at least one dot each way. Free with
 * ktg_view_drop. KTG_LIMIT above 2^26 dots. */
KTG_NODISCARD ktg_status ktg_view_look(ktg_context *context, const ktg_pattern *pattern,
                                       const bool *shown, const ktg_eye *eye, ktg_area seen,
                                       double scale, ktg_view *view);
void ktg_view_drop(ktg_view *view);

/* A point of the model in the picture, in dots. */
static inline ktg_vec2 ktg_view_dot(const ktg_view *view, ktg_vec3 point) {
    return ktg_mul2(ktg_sub2(ktg_eye_sees(&view->eye, point), view->corner), view->scale);
}

/* Whether one of the faces at a surface edge is seen where the point of that edge is, or right
 * beside it; b may be KTG_NONE. */
bool ktg_view_shows(const ktg_view *view, ktg_vec2 dot, uint32_t a, uint32_t b);

/* ---- view_picture.c ----------------------------------------------------------------------- */

/* How the edge between two faces is drawn. */
typedef struct ktg_line_look {
    double width_mm; /* 0: not at all */
    double grey;     /* 0: black */
} ktg_line_look;

/* Where on the surface a dot of the picture lies: the weights of the face's corners, which add up
 * to 1, and how they change from dot to dot. */
typedef struct ktg_seen_dot {
    uint32_t face;
    double weights[3], right[3], down[3];
    bool is_inside; /* the back of the face is seen */
} ktg_seen_dot;

/* The look of a picture; functions are handed `user`. */
typedef struct ktg_look {
    const void *user;
    /* 0xRRGGBB before light and shade. NULL: white. */
    uint32_t (*colour)(const void *user, const ktg_seen_dot *dot);
    /* `side` of `face` is an edge of the surface. NULL: no lines but outlines. */
    ktg_line_look (*line)(const void *user, uint32_t face, uint32_t side);
    double outline_mm;
} ktg_look;

/* The picture of the view as an image of its own, transparent where nothing is; each of its dots is
 * the mean of oversample x oversample dots of the view, and dots_per_mm of the view's dots are a
 * millimetre of paper. */
KTG_NODISCARD ktg_status ktg_view_picture(ktg_context *context, const ktg_view *view,
                                          const ktg_look *look, int oversample, double dots_per_mm,
                                          cairo_surface_t **picture);

/* A picture on a page. */
typedef struct ktg_picture {
    ktg_view view;
    ktg_vec2 corner; /* of the page: its upper left corner */
    double mm;       /* of paper for a dot of the view */
} ktg_picture;

/* Where a dot of the view, which may lie between dots, is on the page. */
static inline ktg_vec2 ktg_picture_point(const ktg_picture *picture, ktg_vec2 dot) {
    return ktg_madd2(picture->corner, picture->mm, dot);
}

/* Draws what of the model (the faces shown) is within `frame`, a box of what the eye sees, into an
 * area of the page: as large as fits there, in its middle; at about 200 dots an inch, in an image
 * at that image's own. Nothing is drawn, and the view has no faces, where all is in one point. Free
 * picture->view with ktg_view_drop, also after a failure. */
KTG_NODISCARD ktg_status ktg_picture_draw(ktg_context *context, const ktg_pattern *pattern,
                                          const bool *shown, const ktg_eye *eye, ktg_area frame,
                                          const ktg_look *look, cairo_t *cairo, ktg_area area,
                                          ktg_picture *picture);

/* ---- solid.c ------------------------------------------------------------------------------ */

/* ktg_solid_draw that hands out the picture, for more to be written on it. Free picture->view with
 * ktg_view_drop, also after a failure. */
KTG_NODISCARD ktg_status ktg_solid_picture(const ktg_drawing *drawing, cairo_t *cairo,
                                           ktg_area area, bool from_behind, ktg_picture *picture);

#endif
