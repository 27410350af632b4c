/* render/solid.c - the finished model with the names of its pieces: where each of them goes. */
#include "render/callouts.h"
#include "render/view.h"

#include "core/memory.h"
#include "render/more_pages.h"

#include <stdio.h>
#include <stdlib.h>

#define MOST_EDGED  20000 /* faces: of more, folds would be all one sees */
#define NAME_MM     1.9
#define MANY_PIECES 10   /* then "2 of 12" is only called 2 */
#define LEAST_MM    1.5  /* pieces of which one sees a smaller square have no name */
#define SEEN_SHARE  0.7  /* of the pieces, from one side */
#define LEAST_SHARE 0.6  /* that is left of a picture's width for names beside it */
#define TURN        0.55 /* radians: the eye is so far to the right of the front ... */
#define RISE        0.4  /* ... and above */

/* What is drawn along a face's side. */
typedef enum side_look { SIDE_PLAIN, SIDE_FOLD, SIDE_CUT, SIDE_PIECE } side_look;

/* Of colours while a picture is painted. */
typedef struct sampling {
    ktg_status status; /* the first failure */
    uint32_t near;     /* where the last dot was */
} sampling;

typedef struct solid {
    const ktg_drawing *drawing;
    uint32_t *piece_of; /* face_count; KTG_NONE */
    uint8_t *looks;     /* 3 face_count: side_look */
    sampling *sampling;
} solid;

/* Of each piece: how many dots are seen, their middle, and the dot nearest to that. */
typedef struct sight {
    uint32_t piece, dots;
    double x, y, away; /* away: squared */
    ktg_vec2 nearest;
} sight;

/* ---- looks -------------------------------------------------------------------------------- */

/* What the model looks like there. */
static uint32_t colour_of_paint(const solid *s, const ktg_seen_dot *seen) {
    ktg_paint_dot dot = {.face = seen->face, .near = s->sampling->near};
    uint8_t rgb[3] = {255, 255, 255};
    if (seen->is_inside || s->sampling->status != KTG_OK)
        return 0xffffff;
    for (int k = 0; k < 3; k++) {
        dot.weights[k] = seen->weights[k];
        dot.right[k] = seen->right[k];
        dot.down[k] = seen->down[k];
    }
    s->sampling->status =
        ktg_paint_colour(s->drawing->context, s->drawing->options.paint, &dot, rgb);
    s->sampling->near = dot.near;
    return (uint32_t)rgb[0] << 16 | (uint32_t)rgb[1] << 8 | rgb[2];
}

static uint32_t colour_of(const void *user, const ktg_seen_dot *dot) {
    const solid *s = user;
    const ktg_drawing *drawing = s->drawing;
    uint32_t piece = s->piece_of[dot->face];
    if (drawing->tints)
        return drawing->tints[dot->face];
    if (drawing->options.paint)
        return ktg_drawing_colour(drawing, colour_of_paint(s, dot));
    return !drawing->piece_tints || piece == KTG_NONE ? 0xffffff : drawing->piece_tints[piece];
}

static ktg_line_look line_of(const void *user, uint32_t face, uint32_t side) {
    static const ktg_line_look looks[] = {{0, 0}, {0.03, 0.6}, {0.15, 0.15}, {0.3, 0}};
    const solid *s = user;
    return looks[s->looks[3 * (size_t)face + side]];
}

static side_look look_of(const ktg_drawing *drawing, const ktg_pattern_edge *edge) {
    if (edge->kind == KTG_EDGE_BORDER)
        return SIDE_CUT;
    if (edge->kind == KTG_EDGE_CUT && edge->side_count == 2)
        return edge->sides[0].piece == edge->sides[1].piece ? SIDE_CUT : SIDE_PIECE;
    return fabs(edge->angle) >= drawing->options.flat_below &&
                   drawing->pattern->face_count <= MOST_EDGED
               ? SIDE_FOLD
               : SIDE_PLAIN;
}

static void fill_tables(solid *s) {
    const ktg_pattern *pattern = s->drawing->pattern;
    for (uint32_t f = 0; f < pattern->face_count; f++)
        s->piece_of[f] = KTG_NONE;
    for (uint32_t p = 0; p < pattern->piece_count; p++)
        for (size_t f = 0; f < pattern->pieces[p].face_count; f++)
            if (pattern->pieces[p].faces[f] < pattern->face_count)
                s->piece_of[pattern->pieces[p].faces[f]] = p;
    for (size_t e = 0; e < pattern->edge_count; e++)
        for (uint32_t k = 0; k < pattern->edges[e].side_count && k < 2; k++) {
            const ktg_pattern_side *side = &pattern->edges[e].sides[k];
            if (side->face < pattern->face_count && side->corner < 3)
                s->looks[3 * (size_t)side->face + side->corner] =
                    (uint8_t)look_of(s->drawing, &pattern->edges[e]);
        }
}

/* ---- names -------------------------------------------------------------------------------- */

static int by_dots(const void *left, const void *right) {
    const sight *a = left, *b = right;
    if (a->dots != b->dots)
        return a->dots > b->dots ? -1 : 1;
    return (a->piece > b->piece) - (a->piece < b->piece);
}

/* First the middles of the pieces' dots, then the dots nearest to those. */
static void measure_dot(sight *at, int x, int y, bool nearest) {
    if (!nearest) {
        at->dots++;
        at->x += x;
        at->y += y;
        return;
    }
    double dx = x - at->x / at->dots, dy = y - at->y / at->dots, away = dx * dx + dy * dy;
    if (away < at->away) {
        at->away = away;
        at->nearest = (ktg_vec2){x + 0.5, y + 0.5};
    }
}

/* What is seen of each piece, the most first. */
static void measure_pieces(const solid *s, const ktg_view *view, sight *sights) {
    size_t count = s->drawing->pattern->piece_count;
    for (uint32_t p = 0; p < count; p++)
        sights[p] = (sight){.piece = p, .away = INFINITY};
    for (int nearest = 0; nearest < 2; nearest++)
        for (int y = 0; y < view->height; y++)
            for (int x = 0; x < view->width; x++) {
                uint32_t face = view->faces[(size_t)y * (size_t)view->width + (size_t)x];
                if (face != KTG_NONE && s->piece_of[face] != KTG_NONE)
                    measure_dot(&sights[s->piece_of[face]], x, y, nearest);
            }
    qsort(sights, count, sizeof *sights, by_dots);
}

static void name_piece(const ktg_drawing *drawing, uint32_t piece, ktg_callout *callout) {
    if (drawing->pattern->component_count == 1 && drawing->pattern->piece_count >= MANY_PIECES)
        snprintf(callout->text, sizeof callout->text, "%u", piece + 1);
    else if (drawing->pattern->component_count == 1)
        ktg_drawing_piece_part(drawing, piece, callout->text);
    else
        ktg_drawing_piece_name(drawing, piece, callout->text);
}

/* The area that leaves room for names beside a picture they would crowd on, unless the picture
 * became too small. */
static ktg_area leave_room(const ktg_drawing *drawing, cairo_t *cairo, ktg_area seen,
                           ktg_area area) {
    size_t count = drawing->pattern->piece_count;
    double widest = 0, texts = 0;
    ktg_vec2 whole = {area.x1 - area.x0, area.y1 - area.y0};
    ktg_vec2 size = {seen.x1 - seen.x0, seen.y1 - seen.y0};
    double scale = fmin(whole.x / size.x, whole.y / size.y);
    ktg_text_set(cairo, KTG_FACE_PLAIN, NAME_MM);
    for (uint32_t p = 0; p < count; p++) {
        ktg_callout callout;
        name_piece(drawing, p, &callout);
        double width = ktg_text_width(cairo, callout.text);
        widest = fmax(widest, width);
        texts += SEEN_SHARE * ktg_callouts_area(width, NAME_MM);
    }
    ktg_vec2 room = ktg_callouts_room((size_t)ceil(SEEN_SHARE * (double)count), widest, NAME_MM);
    double left = whole.x - 2 * room.x;
    if (!ktg_callouts_hide(texts, size.x * size.y * scale * scale) || room.y > whole.y ||
        left < LEAST_SHARE * size.x * scale)
        return area;
    return (ktg_area){area.x0 + room.x, area.y0, area.x1 - room.x, area.y1};
}

static ktg_area box_of(const ktg_picture *picture) {
    ktg_vec2 end = ktg_picture_point(
        picture, (ktg_vec2){(double)picture->view.width, (double)picture->view.height});
    return (ktg_area){picture->corner.x, picture->corner.y, end.x, end.y};
}

static ktg_status write_names(const solid *s, const ktg_picture *picture, cairo_t *cairo,
                              ktg_area area) {
    const ktg_drawing *drawing = s->drawing;
    size_t pieces = drawing->pattern->piece_count, count = 0;
    sight *sights = ktg_new(drawing->context, pieces, sight);
    ktg_callout *callouts = ktg_new(drawing->context, pieces, ktg_callout);
    ktg_status status = sights && callouts ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        double least = LEAST_MM * LEAST_MM / (picture->mm * picture->mm);
        measure_pieces(s, &picture->view, sights);
        for (; count < pieces && sights[count].dots >= least; count++) {
            callouts[count].at = ktg_picture_point(picture, sights[count].nearest);
            name_piece(drawing, sights[count].piece, &callouts[count]);
        }
        ktg_callouts_place(cairo, callouts, count, NAME_MM, area, NULL, 0);
        status = ktg_callouts_spread(drawing->context, cairo, callouts, count, NAME_MM, area,
                                     box_of(picture));
        ktg_callouts_draw(cairo, callouts, count, NAME_MM, KTG_FACE_PLAIN);
    }
    ktg_free(sights);
    ktg_free(callouts);
    return status;
}

/* ---- the whole ---------------------------------------------------------------------------- */

void ktg_solid_eye(unsigned up, bool from_behind, ktg_vec3 *right, ktg_vec3 *above) {
    ktg_eye eye = ktg_eye_at(up, TURN + (from_behind ? KTG_PI : 0), RISE);
    *right = eye.right;
    *above = eye.above;
}

bool ktg_solid_is_wanted(const ktg_drawing *drawing) {
    return drawing->pattern->mode == KTG_PAPER && drawing->pattern->piece_count > 1;
}

static ktg_status draw(const solid *s, cairo_t *cairo, ktg_area area, bool from_behind,
                       ktg_picture *picture) {
    const ktg_pattern *pattern = s->drawing->pattern;
    ktg_eye eye = ktg_eye_at(s->drawing->options.up, TURN + (from_behind ? KTG_PI : 0), RISE);
    ktg_look look = {s, colour_of, line_of, 0.2};
    ktg_area seen;
    if (!ktg_view_extent(pattern, NULL, &eye, &seen))
        return KTG_OK;
    ktg_area inner = pattern->piece_count > 1 ? leave_room(s->drawing, cairo, seen, area) : area;
    KTG_TRY(ktg_picture_draw(s->drawing->context, pattern, NULL, &eye, seen, &look, cairo, inner,
                             picture));
    KTG_TRY(s->sampling->status);
    return pattern->piece_count > 1 ? write_names(s, picture, cairo, area) : KTG_OK;
}

ktg_status ktg_solid_picture(const ktg_drawing *drawing, cairo_t *cairo, ktg_area area,
                             bool from_behind, ktg_picture *picture) {
    const ktg_pattern *pattern = drawing->pattern;
    sampling colours = {KTG_OK, KTG_NONE};
    solid s = {drawing, ktg_new(drawing->context, pattern->face_count, uint32_t),
               ktg_new(drawing->context, 3 * (size_t)pattern->face_count, uint8_t), &colours};
    ktg_status status = s.piece_of && s.looks ? KTG_OK : KTG_MEMORY;
    *picture = (ktg_picture){.mm = 0};
    if (status == KTG_OK) {
        fill_tables(&s);
        status = draw(&s, cairo, area, from_behind, picture);
    }
    ktg_free(s.piece_of);
    ktg_free(s.looks);
    return status;
}

ktg_status ktg_solid_draw(const ktg_drawing *drawing, cairo_t *cairo, ktg_area area,
                          bool from_behind) {
    ktg_picture picture;
    ktg_status status = ktg_solid_picture(drawing, cairo, area, from_behind, &picture);
    ktg_view_drop(&picture.view);
    return status;
}
