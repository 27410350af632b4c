/* tests/fuzz/editing.h - what must hold of an edit file. */
#ifndef KTG_TESTS_FUZZ_EDITING_H
#define KTG_TESTS_FUZZ_EDITING_H

#include "tests/fuzz/model.h"

/* Reads the edit; where that works, writes its sets and deforms a copy of the model: what comes out
 * is finite and has the same faces. */
void fuzz_editing(ktg_context *context, const ktg_mesh *model, const char *edit_path);

#endif
