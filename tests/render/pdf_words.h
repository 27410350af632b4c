/* tests/render/pdf_words.h - what a PDF says, and what other programs say about it. */
#ifndef KTG_TESTS_RENDER_PDF_WORDS_H
#define KTG_TESTS_RENDER_PDF_WORDS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

/* How often a text stands in some bytes. */
static inline size_t count_text(const char *bytes, size_t size, const char *text) {
    size_t count = 0, length = strlen(text);
    for (const char *at = bytes; (at = memmem(at, size - (size_t)(at - bytes), text, length)); at++)
        count++;
    return count;
}

static inline size_t count_pages(const char *bytes, size_t size) {
    return count_text(bytes, size, "/Type /Page") - count_text(bytes, size, "/Type /Pages");
}

static inline bool installed(const char *program) {
    char command[100];
    snprintf(command, sizeof command, "command -v %s >/dev/null 2>&1", program);
    return system(command) == 0;
}

/* What `program` (with options, "%s" for the file) prints about a PDF of these bytes. */
static inline char *tell(const char *program, const char *bytes, size_t size) {
    char path[] = "/tmp/ktg-pdf-XXXXXX", command[200];
    char *text = calloc(1, 100000);
    FILE *file = fdopen(mkstemp(path), "wb");
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
    snprintf(command, sizeof command, program, path);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    assert_true(fread(text, 1, 99999, pipe) > 0);
    assert_int_equal(pclose(pipe), 0);
    unlink(path);
    return text;
}

#endif
