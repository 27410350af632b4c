/* unfold/goal.h - sheets and tabs in the unit of the dual graph (unfold only). */
#ifndef KTG_UNFOLD_GOAL_H
#define KTG_UNFOLD_GOAL_H

#include "unfold/seam_tabs.h"
#include "unfold/unfold.h"

/* How many millimetres a normalised unit becomes: by the options' scale, where they have one, else
 * the scale at which faces of the given area (normalised) fill as much of the sheet as can be
 * hoped for. `scale`: normalised units in a unit of the model. */
double ktg_goal_mm(const ktg_unfold_options *options, double area, double scale);

/* The tabs to be wished for. False when there are to be none. */
bool ktg_goal_tabs(const ktg_unfold_options *options, double mm, ktg_seam_tab_wish *wish);

/* Half of a printable area that has `part` of the sheet's. */
ktg_vec2 ktg_goal_half(const ktg_unfold_options *options, double mm, double part);

#endif
