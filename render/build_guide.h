/* render/build_guide.h - "How to build it": the pages behind the sheets (render only). */
#ifndef KTG_RENDER_BUILD_GUIDE_H
#define KTG_RENDER_BUILD_GUIDE_H

#include "render/callouts.h"
#include "render/more_pages.h"
#include "render/view.h"

typedef struct ktg_named_eye {
    ktg_eye eye;
    char name[64]; /* "from the front right, below" */
} ktg_named_eye;

#define KTG_MOST_EYES 2

/* Some seams that are glued one after the other: a section of the pattern. */
typedef struct ktg_step {
    uint32_t seam_count, numbered; /* those with numbers come first */
    uint32_t *seams;               /* in the guide's seams_in */
    uint32_t low, high;            /* the numbers its seams have on the sheets; 0: none has one */
    uint32_t part;                 /* the body it belongs to, by its first piece */
    uint32_t closing;              /* how many of its seams close that body */
    bool is_begin;                 /* no earlier step touches it */
    uint32_t follows[2];           /* the last steps of the bodies it goes on from, or 0 */
    int eye_count;                 /* pictures: none, one, or another one of what that hides */
    ktg_named_eye eyes[KTG_MOST_EYES];
} ktg_step;

/* What happens at a side of a face. */
typedef enum ktg_side_kind {
    KTG_SIDE_FLAT,
    KTG_SIDE_FOLD,
    KTG_SIDE_BORDER,
    KTG_SIDE_SEAM
} ktg_side_kind;

struct ktg_build_guide {
    const ktg_drawing *drawing;
    uint32_t step_count; /* steps[0] is step 1 */
    ktg_step *steps;
    uint32_t *seams_in;     /* the seams of the steps */
    uint32_t *low, *high;   /* seam_count: the numbers a seam's labels say; 0: none */
    uint32_t *piece_of;     /* face_count; KTG_NONE */
    uint32_t *part_of;      /* piece_count: the smallest piece of the body */
    uint32_t *first_step;   /* piece_count: the step in which it is first seen; 0: in none */
    uint32_t *stage;        /* face_count: the step in which the face gets its place; 0: in none */
    uint8_t *sides;         /* 3 face_count: ktg_side_kind */
    uint32_t *seam_of;      /* 3 face_count, KTG_NONE */
    bool *shown;            /* face_count: for the picture being drawn */
    uint32_t *starts;       /* seam_count: the surface's vertex where its gluing begins, because all
                               else is closed there; KTG_NONE: at either end, or at none */
    bool *is_told;          /* seam_count: its number stands in a picture of its step */
    uint32_t picture_least; /* steps of fewer seams have no picture: there are too many */

    bool has_begun;
    double shape;                   /* of a picture: its height by its width */
    uint32_t cell_count, next_cell; /* pictures and texts side by side; the next to be drawn */
};

/* ---- build_steps.c ------------------------------------------------------------------------ */

/* Fills the tables. */
KTG_NODISCARD ktg_status ktg_guide_find_steps(ktg_build_guide *guide);
/* Fills `starts` (build_starts.c). */
KTG_NODISCARD ktg_status ktg_guide_find_starts(ktg_build_guide *guide);
/* Fills `stage`, once the other tables are there (build_stages.c). */
KTG_NODISCARD ktg_status ktg_guide_find_stages(ktg_build_guide *guide);
/* The step of a seam, from 1; 0 where nobody said. */
uint32_t ktg_guide_step_of(const ktg_build_guide *guide, size_t seam);

/* ---- build_words.c ------------------------------------------------------------------------ */

#define KTG_WORDS_SIZE 1024

/* Whether there are bodies that no seam joins. */
bool ktg_guide_has_bodies(const ktg_build_guide *guide);
/* "1-9", "12", "" */
void ktg_words_range(uint32_t low, uint32_t high, char text[32]);
/* Which paper is right for the size of the finished model and of its faces. */
void ktg_words_paper(const ktg_build_guide *guide, char text[KTG_WORDS_SIZE]);
/* "3. Seams 17-23" */
void ktg_words_title(const ktg_build_guide *guide, uint32_t step, char text[KTG_WORDS_SIZE]);
/* "14, 15": the numbers that stand in no picture of the step; "" when all do. */
void ktg_words_missing(const ktg_build_guide *guide, uint32_t step, char text[KTG_WORDS_SIZE]);
/* What is done in a step, where, and what it goes on from. */
void ktg_words_step(const ktg_build_guide *guide, uint32_t step, char text[KTG_WORDS_SIZE]);

/* ---- build_eye.c -------------------------------------------------------------------------- */

/* Chooses the eyes that see most of each step's seams. */
KTG_NODISCARD ktg_status ktg_guide_choose_eyes(ktg_build_guide *guide);
/* Sets `shown`: the pieces of the body that are there once the step is done. */
void ktg_guide_show_pieces(ktg_build_guide *guide, uint32_t step);

/* ---- build_picture.c ---------------------------------------------------------------------- */

/* The finished model, with the names of its pieces, or the numbers of its seams. */
KTG_NODISCARD ktg_status ktg_guide_draw_model(const ktg_build_guide *guide, cairo_t *cairo,
                                              ktg_area area, bool from_behind);
/* A step as one of its eyes sees it, with those of its numbers that do not stand in an earlier
 * picture of it. */
KTG_NODISCARD ktg_status ktg_guide_draw_step(ktg_build_guide *guide, uint32_t step, int eye,
                                             cairo_t *cairo, ktg_area area);
/* Colours of the key: what a step closes, what was built before, what is still open. */
#define KTG_GUIDE_NOW    0xffcf70u
#define KTG_GUIDE_BEFORE 0xaab7c5u
#define KTG_GUIDE_OPEN   0xffffffu

#endif
