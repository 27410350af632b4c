/* tests/pattern/check.h - proves the tabs of a finished pattern by looking at all pairs. It shares
 * nothing with pattern/ but the data. */
#ifndef KTG_TESTS_PATTERN_CHECK_H
#define KTG_TESTS_PATTERN_CHECK_H

#include "pattern/pattern.h"

typedef struct check_result {
    double deepest;       /* mm: largest overlap of a tab with a face or tab of its piece, or of two
                             tabs under one flat region */
    double most_outside;  /* mm^2: largest part of a moved tab outside the mate's flat region */
    double least_inset;   /* mm: smallest distance of a moved tab to the region's other borders */
    double least_air;     /* mm: smallest distance of a tab to its piece's other borders or tabs */
    double worst_outline; /* largest relative error of the outline's area against faces and tabs */
    uint32_t tabs;
} check_result;

check_result check_tabs(const ktg_pattern *pattern);

/* True when the polygon is simple: no two of its sides meet but neighbours at their corner. */
bool is_simple(const ktg_vec2 *points, size_t count);
double area_of_polygon(const ktg_vec2 *points, size_t count);

#endif
