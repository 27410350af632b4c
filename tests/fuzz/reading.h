/* tests/fuzz/reading.h - what must hold of a model file that is read. */
#ifndef KTG_TESTS_FUZZ_READING_H
#define KTG_TESTS_FUZZ_READING_H

#include "tests/fuzz/model.h"

/* Reads the bytes as a model; where that works: what is read is in range, can be written in every
 * format, reads back the same, and can be checked and repaired. */
void fuzz_reading(const uint8_t *data, size_t size, ktg_mesh_format format, const char *name);

#endif
