/* tests/pipeline/bench.c - a workbench for runs of the whole job: a new folder, options, outputs.
 */
#include "bench.h"
#include "verify/verify.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

int bench_setup(void **state) {
    bench *b = calloc(1, sizeof *b);
    *state = b;
    strcpy(b->folder, "/tmp/ktg-pipeline-XXXXXX");
    ktg_pipeline_defaults(&b->options);
    b->options.layout.effort = KTG_EFFORT_QUICK; /* tests are run often */
    b->options.outputs = b->outputs;
    return ktg_context_new(&b->context) != KTG_OK || !mkdtemp(b->folder);
}

int bench_teardown(void **state) {
    bench *b = *state;
    DIR *folder = opendir(b->folder);
    for (struct dirent *entry; folder && (entry = readdir(folder));)
        if (entry->d_name[0] != '.')
            unlink(bench_path(b, entry->d_name));
    closedir(folder);
    int left = rmdir(b->folder);
    ktg_context_free(&b->context);
    free(b);
    return left;
}

void bench_sample(bench *b, const char *name) {
    snprintf(b->model, sizeof b->model, "%s/%s", KTG_SAMPLES, name);
    b->options.model = b->model;
    b->options.faces = KTG_ALL_FACES;
}

const char *bench_path(bench *b, const char *name) {
    static char path[512];
    snprintf(path, sizeof path, "%s/%s", b->folder, name);
    return path;
}

const char *bench_output(bench *b, const char *name) {
    size_t i = b->options.output_count++;
    assert_true(i < BENCH_OUTPUTS);
    snprintf(b->paths[i], sizeof b->paths[i], "%s/%s", b->folder, name);
    return b->outputs[i] = b->paths[i];
}

void bench_no_outputs(bench *b) {
    b->options.output_count = 0;
}

void bench_write(bench *b, const char *name, const char *text) {
    FILE *file = fopen(bench_path(b, name), "wb");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

char *bench_read(bench *b, const char *name, size_t *size) {
    FILE *file = fopen(bench_path(b, name), "rb");
    if (!file)
        return NULL;
    fseek(file, 0, SEEK_END);
    *size = (size_t)ftell(file);
    rewind(file);
    char *bytes = calloc(*size + 1, 1);
    assert_int_equal(fread(bytes, 1, *size, file), *size);
    fclose(file);
    return bytes;
}

bool bench_exists(bench *b, const char *name) {
    return access(bench_path(b, name), F_OK) == 0;
}

size_t bench_count(bench *b) {
    size_t count = 0;
    DIR *folder = opendir(b->folder);
    assert_non_null(folder);
    for (struct dirent *entry; (entry = readdir(folder));)
        count += entry->d_name[0] != '.';
    closedir(folder);
    return count;
}

void bench_run(bench *b, ktg_pipeline_report *report) {
    if (ktg_pipeline_run(b->context, &b->options, report) != KTG_OK)
        fail_msg("%s", ktg_context_message(b->context));
}

void bench_refused(bench *b, ktg_status status, const char *words) {
    ktg_pipeline_report report;
    ktg_status got = ktg_pipeline_run(b->context, &b->options, &report);
    if (got != status || !strstr(ktg_context_message(b->context), words))
        fail_msg("%s, \"%s\" instead of \"%s\"", ktg_status_name(got),
                 ktg_context_message(b->context), words);
}

ktg_pattern *bench_pattern(bench *b, const char *name) {
    ktg_pattern *pattern = NULL;
    if (ktg_pattern_read_json(b->context, bench_path(b, name), &pattern) != KTG_OK)
        fail_msg("%s", ktg_context_message(b->context));
    return pattern;
}

void bench_sound(bench *b, const ktg_pattern *pattern) {
    ktg_mesh *model = NULL;
    ktg_repair_report repair;
    ktg_verify_report report;
    ktg_status status = ktg_mesh_read(b->context, b->options.model, KTG_MESH_BY_ENDING, &model);
    if (status == KTG_OK)
        status = ktg_mesh_repair(b->context, model, &repair);
    if (status == KTG_OK)
        status = ktg_verify(b->context, pattern, model, &report);
    ktg_mesh_free(&model);
    if (status != KTG_OK)
        fail_msg("%s", ktg_context_message(b->context));
}
