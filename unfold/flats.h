/* unfold/flats.h - flat regions: faces of one plane that no search parts, laid out together (unfold
 * only). A tab may lie under all of such a region, not only under the face at its edge. */
#ifndef KTG_UNFOLD_FLATS_H
#define KTG_UNFOLD_FLATS_H

#include "unfold/dual.h"

typedef struct ktg_flats {
    uint32_t region_count;
    uint32_t *region;  /* face_count */
    uint32_t *first;   /* region_count + 1: where a region's sides begin */
    uint32_t *sides;   /* half-edges on the borders of the regions */
    ktg_vec2 *corners; /* 3 face_count: each region in a frame of its own */
} ktg_flats;

KTG_NODISCARD ktg_status ktg_flats_new(ktg_context *context, const ktg_dual *dual,
                                       ktg_flats *flats);
void ktg_flats_free(ktg_flats *flats);

#endif
