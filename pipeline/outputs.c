/* pipeline/outputs.c - which files to write, and writing them all or none. */
#include "pipeline/outputs.h"
#include "core/memory.h"
#include "core/target.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

typedef enum output_kind {
    OUTPUT_UNKNOWN,
    OUTPUT_PDF,
    OUTPUT_SVG,
    OUTPUT_PNG,
    OUTPUT_DXF,
    OUTPUT_JSON
} output_kind;

static const char *ending_of(const char *path) {
    const char *dot = strrchr(path, '.'), *slash = strrchr(path, '/');
    return dot && (!slash || dot > slash) ? dot : path + strlen(path);
}

static output_kind kind_of(const char *path) {
    static const char *const endings[] = {"", ".pdf", ".svg", ".png", ".dxf", ".json"};
    if (strcmp(path, "-") == 0)
        return OUTPUT_PDF;
    for (int kind = OUTPUT_PDF; kind <= OUTPUT_JSON; kind++)
        if (strcasecmp(ending_of(path), endings[kind]) == 0)
            return (output_kind)kind;
    return OUTPUT_UNKNOWN;
}

/* The i-th path to be written, the report being the last one; NULL when there are no more. */
static const char *path_at(const ktg_pipeline_options *options, size_t i) {
    if (i < options->output_count)
        return options->outputs[i];
    return i == options->output_count ? options->report : NULL;
}

/* Among the files of edges. */
static bool names_edges(const ktg_pipeline_options *options, const char *path) {
    for (size_t i = 0; i < options->keep_count; i++)
        if (ktg_target_same(path, options->keep[i]))
            return true;
    for (size_t i = 0; i < options->cut_count; i++)
        if (ktg_target_same(path, options->cut[i]))
            return true;
    return false;
}

/* What is read is somebody's work. */
static ktg_status check_not_read(ktg_context *context, const ktg_pipeline_options *options,
                                 const char *path) {
    if (strcmp(path, "-") == 0)
        return KTG_OK;
    if (options->model && ktg_target_same(path, options->model))
        return ktg_fail(context, KTG_ARGUMENT, "%s: is the model itself; name another output",
                        path);
    if (names_edges(options, path))
        return ktg_fail(context, KTG_ARGUMENT,
                        "%s: is a file of edges or handles to be read; name another output", path);
    if (options->edit && ktg_target_same(path, options->edit))
        return ktg_fail(context, KTG_ARGUMENT,
                        "%s: is the edit file to be read; name another output", path);
    return KTG_OK;
}

/* "-", too, can be written once only. */
static bool same_output(const char *a, const char *b) {
    return strcmp(a, "-") == 0 || strcmp(b, "-") == 0 ? strcmp(a, b) == 0 : ktg_target_same(a, b);
}

ktg_status ktg_outputs_check(ktg_context *context, const ktg_pipeline_options *options) {
    const char *path;
    for (size_t i = 0; (path = path_at(options, i)); i++) {
        if (i < options->output_count && kind_of(path) == OUTPUT_UNKNOWN)
            return ktg_fail(context, KTG_ARGUMENT,
                            "%s: no such kind of output; .pdf, .svg, .dxf, .png and .json can be "
                            "written",
                            path);
        KTG_TRY(check_not_read(context, options, path));
        for (size_t j = 0; j < i; j++)
            if (same_output(path, options->outputs[j]))
                return ktg_fail(context, KTG_ARGUMENT,
                                "%s: is to be written twice; name another output", path);
    }
    for (size_t i = 0; (path = path_at(options, i)); i++)
        KTG_TRY(ktg_output_check(context, path));
    return KTG_OK;
}

/* Is the last one to be what another one is to be? */
static bool is_there_twice(const ktg_outputs *open) {
    const ktg_output *last = open->items[open->count - 1];
    const char *place = ktg_output_target(last);
    for (size_t i = 0; place && i + 1 < open->count; i++) {
        const char *other = ktg_output_target(open->items[i]);
        if (other && strcmp(place, other) == 0)
            return true;
    }
    return false;
}

/* Files of sheets have names that are known only now, and may meet another output's, or that of a
 * file that is read. */
static ktg_status open_next(ktg_context *context, const ktg_pipeline_options *options,
                            ktg_outputs *open, const char *path, ktg_output **output) {
    KTG_TRY(check_not_read(context, options, path));
    if (open->count > 0) /* so that few are open at a time */
        KTG_TRY(ktg_output_finish(context, open->items[open->count - 1]));
    KTG_TRY(ktg_reserve(context, &open->items, &open->capacity, open->count + 1));
    KTG_TRY(ktg_output_open(context, path, &open->items[open->count]));
    *output = open->items[open->count++];
    if (is_there_twice(open))
        return ktg_fail(context, KTG_ARGUMENT, "%s: is to be written twice; name another output",
                        path);
    return KTG_OK;
}

/* Where a sheet's number goes in a path: its "%d" in the last part; NULL where there is none. */
static const char *number_place(const char *path) {
    const char *slash = strrchr(path, '/');
    return strstr(slash ? slash + 1 : path, "%d");
}

/* The path of one sheet's file: the number in the place of "%d", or NAME-01.svg, NAME-02.svg, ...
 * where there are several. Free with ktg_free. */
static char *sheet_path(ktg_context *context, const ktg_pattern *pattern, const char *path,
                        size_t sheet) {
    const char *ending = ending_of(path), *place = number_place(path);
    int digits = pattern->sheet_count > 999 ? 6 : pattern->sheet_count > 99 ? 3 : 2;
    size_t size = strlen(path) + 32;
    char *name = ktg_alloc(context, size, 1);
    if (!name)
        return NULL;
    if (place)
        snprintf(name, size, "%.*s%0*zu%s", (int)(place - path), path, digits, sheet + 1,
                 place + 2);
    else if (pattern->sheet_count > 1)
        snprintf(name, size, "%.*s-%0*zu%s", (int)(ending - path), path, digits, sheet + 1, ending);
    else
        snprintf(name, size, "%s", path);
    return name;
}

static ktg_status write_sheet(ktg_context *context, const ktg_pipeline_options *options,
                              const ktg_pattern *pattern, const char *path, output_kind kind,
                              size_t sheet, ktg_outputs *open) {
    char *name = sheet_path(context, pattern, path, sheet);
    if (!name)
        return KTG_MEMORY;
    ktg_output *output = NULL;
    ktg_status status = open_next(context, options, open, name, &output);
    ktg_free(name);
    if (status != KTG_OK)
        return status;
    return kind == OUTPUT_SVG   ? ktg_render_svg(context, pattern, sheet, &options->render, output)
           : kind == OUTPUT_DXF ? ktg_render_dxf(context, pattern, sheet, &options->render, output)
                                : ktg_render_png(context, pattern, sheet, &options->render, output);
}

static ktg_status write_one(ktg_context *context, const ktg_pipeline_options *options,
                            const ktg_pattern *pattern, const char *path, ktg_outputs *open) {
    output_kind kind = kind_of(path);
    ktg_output *output = NULL;
    if (kind == OUTPUT_PDF || kind == OUTPUT_JSON) {
        KTG_TRY(open_next(context, options, open, path, &output));
        return kind == OUTPUT_PDF ? ktg_render_pdf(context, pattern, &options->render, output)
                                  : ktg_pattern_write_json(context, pattern, output);
    }
    if (kind == OUTPUT_PNG && pattern->sheet_count > 1 && !number_place(path)) {
        KTG_TRY(open_next(context, options, open, path, &output));
        return ktg_render_contact(context, pattern, &options->render, output);
    }
    if (kind == OUTPUT_DXF && pattern->mode == KTG_CLOTH && !options->render.plain_dxf) {
        KTG_TRY(open_next(context, options, open, path, &output));
        return ktg_render_astm(context, pattern, &options->render, output);
    }
    for (size_t sheet = 0; sheet < pattern->sheet_count; sheet++)
        KTG_TRY(write_sheet(context, options, pattern, path, kind, sheet, open));
    return KTG_OK;
}

ktg_status ktg_outputs_write(ktg_context *context, const ktg_pipeline_options *options,
                             const ktg_pattern *pattern, ktg_outputs *outputs) {
    for (size_t i = 0; i < options->output_count; i++) {
        ktg_progress(context, "write", (double)i / options->output_count, options->outputs[i]);
        KTG_TRY(write_one(context, options, pattern, options->outputs[i], outputs));
    }
    return KTG_OK;
}

ktg_status ktg_outputs_write_report(ktg_context *context, const ktg_pipeline_options *options,
                                    const ktg_pipeline_report *report, const ktg_pattern *pattern,
                                    ktg_outputs *outputs) {
    ktg_output *output = NULL;
    if (!options->report)
        return KTG_OK;
    KTG_TRY(open_next(context, options, outputs, options->report, &output));
    return ktg_pipeline_write_report(context, options, report, pattern, output);
}

ktg_status ktg_outputs_finish(ktg_context *context, ktg_outputs *outputs) {
    for (size_t i = 0; i < outputs->count; i++)
        KTG_TRY(ktg_output_finish(context, outputs->items[i]));
    return KTG_OK;
}

ktg_status ktg_outputs_commit(ktg_context *context, ktg_outputs *outputs) {
    for (size_t i = 0; i < outputs->count; i++) {
        char path[PATH_MAX];
        snprintf(path, sizeof path, "%s", ktg_output_path(outputs->items[i]));
        KTG_TRY(ktg_output_commit(context, &outputs->items[i]));
        if (strcmp(path, "-") != 0)
            ktg_log(context, KTG_LOG_NOTE, "wrote %s", path);
    }
    return KTG_OK;
}

void ktg_outputs_discard(ktg_outputs *outputs) {
    for (size_t i = 0; i < outputs->count; i++)
        ktg_output_discard(&outputs->items[i]);
    ktg_free(outputs->items);
    *outputs = (ktg_outputs){0};
}
