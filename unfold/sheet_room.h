/* unfold/sheet_room.h - how far the pieces of an arrangement reach over their sheets (unfold only).
 *
 * A corner inside its sheet costs nothing, one that stands out its distance, and the square of it.
 * A faint pull towards the middle makes room at the edges. Every piece keeps a margin of its own,
 * for the tabs that will stand on its border. */
#ifndef KTG_UNFOLD_SHEET_ROOM_H
#define KTG_UNFOLD_SHEET_ROOM_H

#include "unfold/arrangement.h"

typedef struct ktg_sheet_room {
    const ktg_arrangement *a;
    ktg_vec2 half;  /* of the printable area */
    double unit;    /* the distance that costs 1, and 1 for its square */
    double *margin; /* piece_count */
    double *cost;   /* face_count */
    double total;
} ktg_sheet_room;

KTG_NODISCARD ktg_status ktg_sheet_room_new(ktg_context *context, const ktg_arrangement *a,
                                            ktg_vec2 half, double margin, ktg_sheet_room *room);
void ktg_sheet_room_free(ktg_sheet_room *room);

/* Counts everything anew; after margins have changed. */
void ktg_sheet_room_recount(ktg_sheet_room *room);

/* What a graft would change. False when that is more than `allowed`, which is found out early.
 * Adds the faces looked at to *work. */
bool ktg_sheet_room_allows(const ktg_sheet_room *room, const ktg_branch *branch,
                           const ktg_graft *graft, double allowed, double *change, uint64_t *work);
/* The branch lies elsewhere now. */
void ktg_sheet_room_follow(ktg_sheet_room *room, const ktg_branch *branch);

/* What stands out, without the pull, and how many pieces do; over_piece: piece_count, or NULL. */
double ktg_sheet_room_over(const ktg_sheet_room *room, double *over_piece, uint32_t *pieces);

/* Turns and moves every piece to where it fits its sheet best, where that costs less than now. */
KTG_NODISCARD ktg_status ktg_sheet_room_pose(ktg_context *context, ktg_arrangement *a,
                                             ktg_sheet_room *room);

#endif
