/* pipeline/paint.c - the model's colours on their way to the sheets. */
#include "pipeline/paint.h"

#include "core/memory.h"
#include "core/vec.h"

#include <string.h>

ktg_status ktg_paint_of_model(ktg_context *context, const ktg_pipeline_options *options,
                              const ktg_mesh *mesh, ktg_paint **paint, ktg_paint_report *report) {
    bool wanted = options->colours == KTG_COLOURS_ON ||
                  (options->colours == KTG_COLOURS_AUTO && options->mode == KTG_PAPER);
    *paint = NULL;
    if (!wanted)
        return KTG_OK;
    ktg_progress(context, "colours", 0, NULL);
    ktg_paint_options how = {options->textures_anywhere, options->colours == KTG_COLOURS_ON};
    KTG_TRY(ktg_paint_new(context, mesh, options->model, &how, paint, report));
    if (!*paint && options->colours == KTG_COLOURS_ON)
        ktg_log(context, KTG_LOG_WARNING, "%s has no colours to print", options->model);
    return KTG_OK;
}

static bool has_these_faces(const ktg_mesh *mesh, const ktg_pattern *pattern) {
    return mesh->face_count == pattern->face_count &&
           memcmp(mesh->faces, pattern->faces, 3 * sizeof *mesh->faces * mesh->face_count) == 0;
}

/* The pattern's surface as a mesh, in the model's unit. */
static ktg_status surface_of(ktg_context *context, const ktg_pattern *pattern, ktg_mesh **mesh) {
    ktg_vec3 *vertices = ktg_copy_array(context, pattern->vertices, pattern->vertex_count,
                                        sizeof *pattern->vertices);
    if (!vertices)
        return KTG_MEMORY;
    for (uint32_t v = 0; v < pattern->vertex_count; v++)
        vertices[v] = ktg_mul3(vertices[v], 1 / pattern->mm_per_unit);
    ktg_status status = ktg_mesh_new(context, &vertices->x, pattern->vertex_count, pattern->faces,
                                     pattern->face_count, mesh);
    ktg_free(vertices);
    return status;
}

ktg_status ktg_paint_onto_pattern(ktg_context *context, const ktg_mesh *mesh,
                                  const ktg_pattern *pattern, ktg_paint *paint,
                                  ktg_paint_report *report) {
    ktg_mesh *surface = NULL;
    if (has_these_faces(mesh, pattern))
        return ktg_paint_lay(context, paint, mesh, pattern->mm_per_unit, report);
    KTG_TRY(surface_of(context, pattern, &surface));
    ktg_status status = ktg_paint_lay(context, paint, surface, pattern->mm_per_unit, report);
    ktg_mesh_free(&surface);
    return status;
}
