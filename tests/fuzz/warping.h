/* tests/fuzz/warping.h - what must hold of a file of handles. */
#ifndef KTG_TESTS_FUZZ_WARPING_H
#define KTG_TESTS_FUZZ_WARPING_H

#include "flatten/flatten.h"
#include "tests/fuzz/model.h"

/* Warps a copy of the flat model: what comes out is finite, and a refusal leaves it alone. */
void fuzz_warping(ktg_context *context, const ktg_mesh *model, const char *handles,
                  const ktg_warp_options *options);

#endif
