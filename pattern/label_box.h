/* pattern/label_box.h - the room a text takes and where it may lie (pattern only). */
#ifndef KTG_PATTERN_LABEL_BOX_H
#define KTG_PATTERN_LABEL_BOX_H

#include "core/memory.h"
#include "pattern/grid.h"
#include "pattern/topology.h"

/* Smaller digits are hard to read and to print. */
#define KTG_LABEL_LEAST_MM 1.6

/* A rectangle: p = at + x along + y perp(along), |x| <= half.x, |y| <= half.y. */
typedef struct ktg_label_box {
    ktg_vec2 at, along, half;
} ktg_label_box;

/* A number that has found no room: at the edge through `middle` along `along`, the piece on its
 * left. */
typedef struct ktg_label_want {
    uint32_t piece, edge;
    ktg_vec2 middle, along;
    char text[16];
} ktg_label_want;

/* Labels of a pattern as they are written, with what keeps them apart. */
typedef struct ktg_label_sheet {
    const ktg_topology *topology;
    const ktg_finish_options *options;
    ktg_pattern *pattern;
    size_t *capacities;    /* piece_count: of the pieces' labels */
    ktg_grid *grids;       /* piece_count: over the border's half-edges, in order */
    ktg_box *boxes;        /* border_count: what they are made of */
    uint32_t *face_labels; /* face_count: the last label on a face, or KTG_NONE */
    uint32_t *next_label;  /* by label number: the one before on the same face */
    size_t next_capacity;
    ktg_label_box *places; /* by label number: where it lies */
    size_t place_capacity;
    uint32_t label_count; /* of all pieces */
    ktg_label_want *wants;
    size_t want_count, want_capacity;
} ktg_label_sheet;

KTG_NODISCARD ktg_status ktg_label_sheet_open(ktg_context *context, ktg_label_sheet *sheet);
void ktg_label_sheet_drop(ktg_label_sheet *sheet);

/* A number as it is written, with a dot where it would mislead upside down. */
void ktg_number_text(uint32_t number, char text[16]);

/* Width of a text over its digits' height, as common sans-serif faces have it. */
double ktg_label_width(const char *text);

/* True when two boxes overlap. */
bool ktg_label_boxes_meet(const ktg_label_box *a, const ktg_label_box *b);
/* True when the segment passes through the box. */
bool ktg_label_box_cut(const ktg_label_box *box, ktg_vec2 a, ktg_vec2 b);
/* True when a label on `face` overlaps the box. */
bool ktg_label_face_taken(const ktg_label_sheet *sheet, uint32_t face, const ktg_label_box *box);
/* True when any label of the piece overlaps the box. */
bool ktg_label_piece_taken(const ktg_label_sheet *sheet, uint32_t piece, const ktg_label_box *box);
/* True when the piece's border passes through the box. */
bool ktg_label_on_border(ktg_label_sheet *sheet, uint32_t piece, const ktg_label_box *box);

/* Writes a label whose box is known; `face` (KTG_NONE: none, on a tab) is where it lies. */
KTG_NODISCARD ktg_status ktg_label_write(ktg_context *context, ktg_label_sheet *sheet,
                                         uint32_t piece, uint32_t face, uint32_t edge,
                                         const char *text, const ktg_label_box *box);

/* Writes a number near its edge, with a leader (label_leader.c). */
KTG_NODISCARD ktg_status ktg_label_lead(ktg_context *context, ktg_label_sheet *sheet,
                                        const ktg_label_want *want);

/* The name of a piece of paper, if it needs one, where there is most room (label_name.c). */
KTG_NODISCARD ktg_status ktg_label_name(ktg_context *context, ktg_label_sheet *sheet,
                                        uint32_t piece);

#endif
