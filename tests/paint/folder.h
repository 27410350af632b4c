/* A folder for files of one test, and what the log said. */
#ifndef TEST_PAINT_FOLDER_H
#define TEST_PAINT_FOLDER_H

#include "core/core.h"

typedef struct folder {
    ktg_context *context;
    char path[64];
    char log[4096]; /* a line each */
} folder;

/* cmocka's set-up and tear-down; *state is a folder. */
int folder_begin(void **state);
int folder_end(void **state);

/* The path of a file in it; valid until the fourth next call. */
const char *folder_file(const folder *f, const char *name);
void folder_write(const folder *f, const char *name, const void *bytes, size_t size);
void folder_write_text(const folder *f, const char *name, const char *text);
/* A PNG of bytes in threes, rows from the top. */
void folder_write_png(const folder *f, const char *name, const uint8_t *rgb, uint32_t width,
                      uint32_t height);

#endif
