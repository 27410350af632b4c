#include "folder.h"

#include <dirent.h>
#include <png.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static void keep_log(void *user, ktg_log_level level, const char *text) {
    folder *f = user;
    size_t used = strlen(f->log);
    snprintf(f->log + used, sizeof f->log - used, "%s%s\n",
             level == KTG_LOG_WARNING ? "warning: " : "", text);
}

int folder_begin(void **state) {
    folder *f = calloc(1, sizeof *f);
    *state = f;
    strcpy(f->path, "/tmp/ktg-paint-XXXXXX");
    if (!mkdtemp(f->path) || ktg_context_new(&f->context) != KTG_OK)
        return -1;
    ktg_context_set_log(f->context, keep_log, f);
    return 0;
}

int folder_end(void **state) {
    folder *f = *state;
    DIR *open = opendir(f->path);
    for (struct dirent *entry; open && (entry = readdir(open));)
        unlink(folder_file(f, entry->d_name));
    if (open)
        closedir(open);
    rmdir(f->path);
    ktg_context_free(&f->context);
    free(f);
    return 0;
}

const char *folder_file(const folder *f, const char *name) {
    static char paths[4][512];
    static int next;
    next = (next + 1) % 4;
    snprintf(paths[next], sizeof paths[next], "%s/%s", f->path, name);
    return paths[next];
}

void folder_write(const folder *f, const char *name, const void *bytes, size_t size) {
    FILE *file = fopen(folder_file(f, name), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

void folder_write_text(const folder *f, const char *name, const char *text) {
    folder_write(f, name, text, strlen(text));
}

void folder_write_png(const folder *f, const char *name, const uint8_t *rgb, uint32_t width,
                      uint32_t height) {
    png_image png = {
        .version = PNG_IMAGE_VERSION, .width = width, .height = height, .format = PNG_FORMAT_RGB};
    assert_true(png_image_write_to_file(&png, folder_file(f, name), 0, rgb, 0, NULL));
}
