/* core/predicate.h - exact predicates, through CGAL (shared between folders, not installed). */
#ifndef KTG_CORE_PREDICATE_H
#define KTG_CORE_PREDICATE_H

#include "core/core.h"

#ifdef __cplusplus
extern "C" {
#endif

/* +1 when a, b, c turn counter-clockwise, -1 clockwise, 0 exactly on one line. Coordinates are
 * finite. */
int ktg_orientation2(ktg_vec2 a, ktg_vec2 b, ktg_vec2 c);

#ifdef __cplusplus
}
#endif
#endif
