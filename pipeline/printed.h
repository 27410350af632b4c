/* pipeline/printed.h - the pieces of a pattern that go onto paper (pipeline only). */
#ifndef KTG_PIPELINE_PRINTED_H
#define KTG_PIPELINE_PRINTED_H

#include "pattern/pattern.h"

/* A pattern with the pieces of another one that are printed: all but those that are cut with their
 * twins. */
typedef struct ktg_printed {
    ktg_pattern view; /* its own: pieces (the array) and sheets */
    uint32_t *pieces; /* view.piece_count: indices into the other pattern's pieces */
} ktg_printed;

KTG_NODISCARD ktg_status ktg_printed_view(ktg_context *context, const ktg_pattern *pattern,
                                          ktg_printed *printed);

/* Gives the view's sheets to the pattern, in place of its own. */
void ktg_printed_take_sheets(ktg_printed *printed, ktg_pattern *pattern);

void ktg_printed_drop(ktg_printed *printed);

#endif
