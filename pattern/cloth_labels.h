/* pattern/cloth_labels.h - what is written on pieces of cloth (pattern only). */
#ifndef KTG_PATTERN_CLOTH_LABELS_H
#define KTG_PATTERN_CLOTH_LABELS_H

#include "pattern/cloth.h"
#include "pattern/label_box.h"

/* Numbers of seams on both sides, names of pieces and how often each is cut; darts need no number.
 */
KTG_NODISCARD ktg_status ktg_cloth_labels_write(ktg_context *context, ktg_label_sheet *sheet);

#endif
