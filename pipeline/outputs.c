/* pipeline/outputs.c - which files to write, and writing them all or none. */
#include "pipeline/outputs.h"
#include "core/memory.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

typedef enum output_kind {
    OUTPUT_UNKNOWN,
    OUTPUT_PDF,
    OUTPUT_SVG,
    OUTPUT_PNG,
    OUTPUT_JSON
} output_kind;

static const char *ending_of(const char *path) {
    const char *dot = strrchr(path, '.'), *slash = strrchr(path, '/');
    return dot && (!slash || dot > slash) ? dot : path + strlen(path);
}

static output_kind kind_of(const char *path) {
    static const char *const endings[] = {"", ".pdf", ".svg", ".png", ".json"};
    if (strcmp(path, "-") == 0)
        return OUTPUT_PDF;
    for (int kind = OUTPUT_PDF; kind <= OUTPUT_JSON; kind++)
        if (strcasecmp(ending_of(path), endings[kind]) == 0)
            return (output_kind)kind;
    return OUTPUT_UNKNOWN;
}

static bool same_file(const char *a, const char *b) {
    struct stat x, y;
    if (strcmp(a, b) == 0)
        return true;
    return stat(a, &x) == 0 && stat(b, &y) == 0 && S_ISREG(x.st_mode) && x.st_dev == y.st_dev &&
           x.st_ino == y.st_ino;
}

ktg_status ktg_outputs_check(ktg_context *context, const ktg_pipeline_options *options) {
    for (size_t i = 0; i < options->output_count; i++) {
        const char *path = options->outputs[i];
        if (kind_of(path) == OUTPUT_UNKNOWN)
            return ktg_fail(context, KTG_ARGUMENT,
                            "%s: no such kind of output; .pdf, .svg, .png and .json can be written",
                            path);
        if (strcmp(path, "-") != 0 && same_file(path, options->model))
            return ktg_fail(context, KTG_ARGUMENT, "%s: is the model itself; name another output",
                            path);
        for (size_t j = 0; j < i; j++)
            if (same_file(path, options->outputs[j]))
                return ktg_fail(context, KTG_ARGUMENT, "%s: is to be written twice", path);
    }
    return KTG_OK;
}

typedef struct open_outputs {
    ktg_output **items;
    size_t count, capacity;
} open_outputs;

static ktg_status open_next(ktg_context *context, open_outputs *open, const char *path,
                            ktg_output **output) {
    KTG_TRY(ktg_reserve(context, &open->items, &open->capacity, open->count + 1));
    KTG_TRY(ktg_output_open(context, path, &open->items[open->count]));
    *output = open->items[open->count++];
    return KTG_OK;
}

/* A file for each sheet where there are several: NAME-01.svg, NAME-02.svg, ... */
static ktg_status write_sheet(ktg_context *context, const ktg_pipeline_options *options,
                              const ktg_pattern *pattern, const char *path, output_kind kind,
                              size_t sheet, open_outputs *open) {
    const char *ending = ending_of(path);
    int digits = pattern->sheet_count > 999 ? 6 : pattern->sheet_count > 99 ? 3 : 2;
    size_t size = strlen(path) + 32;
    char *name = ktg_alloc(context, size, 1);
    if (!name)
        return KTG_MEMORY;
    if (pattern->sheet_count > 1)
        snprintf(name, size, "%.*s-%0*zu%s", (int)(ending - path), path, digits, sheet + 1, ending);
    else
        snprintf(name, size, "%s", path);
    ktg_output *output = NULL;
    ktg_status status = open_next(context, open, name, &output);
    ktg_free(name);
    if (status != KTG_OK)
        return status;
    return kind == OUTPUT_SVG ? ktg_render_svg(context, pattern, sheet, &options->render, output)
                              : ktg_render_png(context, pattern, sheet, &options->render, output);
}

static ktg_status write_one(ktg_context *context, const ktg_pipeline_options *options,
                            const ktg_pattern *pattern, const char *path, open_outputs *open) {
    output_kind kind = kind_of(path);
    ktg_output *output = NULL;
    if (kind == OUTPUT_PDF || kind == OUTPUT_JSON) {
        KTG_TRY(open_next(context, open, path, &output));
        return kind == OUTPUT_PDF ? ktg_render_pdf(context, pattern, &options->render, output)
                                  : ktg_pattern_write_json(context, pattern, output);
    }
    for (size_t sheet = 0; sheet < pattern->sheet_count; sheet++)
        KTG_TRY(write_sheet(context, options, pattern, path, kind, sheet, open));
    return KTG_OK;
}

ktg_status ktg_outputs_write(ktg_context *context, const ktg_pipeline_options *options,
                             const ktg_pattern *pattern) {
    open_outputs open = {0};
    ktg_status status = KTG_OK;
    for (size_t i = 0; status == KTG_OK && i < options->output_count; i++) {
        ktg_progress(context, "write", (double)i / options->output_count, options->outputs[i]);
        status = write_one(context, options, pattern, options->outputs[i], &open);
    }
    if (status == KTG_OK)
        status = ktg_check_cancel(context);
    for (size_t i = 0; i < open.count; i++) {
        if (status == KTG_OK)
            status = ktg_output_commit(context, &open.items[i]);
        else
            ktg_output_discard(&open.items[i]);
    }
    ktg_free(open.items);
    return status;
}
