/* tests/fuzz/fixed.h - the models that targets of text files are about, made once. */
#ifndef KTG_TESTS_FUZZ_FIXED_H
#define KTG_TESTS_FUZZ_FIXED_H

#include "mesh/mesh.h"

/* Three boxes of quadrangles, "body", "head" (1 above it) and "plate" (beside both, open), in
 * groups "low" and "high" and materials "red" and "blue"; 10 units large. */
const ktg_mesh *fuzz_boxes(void);

/* A flat grid of 4 x 3 cells of 10 x 10, z = 0. */
const ktg_mesh *fuzz_grid(void);

#endif
