/* pipeline/size.c - how large the finished model becomes. */
#include "pipeline/size.h"
#include "core/vec.h"

#include <string.h>

ktg_axis ktg_size_up(const ktg_pipeline_options *options) {
    if (options->up != KTG_AXIS_AUTO)
        return options->up;
    ktg_mesh_format format = options->model_format;
    if (format == KTG_MESH_BY_ENDING)
        format = ktg_mesh_format_of(options->model);
    return format == KTG_MESH_STL ? KTG_AXIS_Z : KTG_AXIS_Y;
}

ktg_vec3 ktg_size_of(const ktg_vec3 *vertices, uint32_t vertex_count, ktg_axis up) {
    ktg_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t v = 0; v < vertex_count; v++) {
        ktg_vec3 p = vertices[v];
        low = (ktg_vec3){fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z)};
        high = (ktg_vec3){fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z)};
    }
    ktg_vec3 size = ktg_sub3(high, low);
    if (up == KTG_AXIS_X)
        return (ktg_vec3){size.z, size.x, size.y};
    if (up == KTG_AXIS_Z)
        return (ktg_vec3){size.x, size.z, size.y};
    return size;
}

ktg_status ktg_size_check(ktg_context *context, const ktg_pipeline_options *options) {
    const ktg_sheet_format *sheet = &options->layout.sheet;
    if (!(2 * sheet->margin_mm < fmin(sheet->width_mm, sheet->height_mm)))
        return ktg_fail(context, KTG_ARGUMENT,
                        "margins of %g mm leave nothing of a sheet of %g x %g mm", sheet->margin_mm,
                        sheet->width_mm, sheet->height_mm);
    if (options->size_rule == KTG_SIZE_FIT) {
        if (options->layout.roll)
            return ktg_fail(context, KTG_ARGUMENT,
                            "a roll has no size that a model could fill: say how large it is to "
                            "become (--height 200mm)");
        if (options->mode == KTG_PAPER)
            return KTG_OK;
        return ktg_fail(
            context, KTG_ARGUMENT,
            "cloth needs a size: say which unit the model has (--unit cm) or how tall it is");
    }
    if (!(options->size_mm > 0) || !isfinite(options->size_mm))
        return ktg_fail(context, KTG_ARGUMENT, "a size of %g mm cannot be made", options->size_mm);
    return KTG_OK;
}

/* By the size that is asked for: the vertices' extent along one axis, or a factor. */
static ktg_status asked_scale(ktg_context *context, const ktg_pipeline_options *options,
                              const ktg_vec3 *vertices, uint32_t vertex_count,
                              double *mm_per_unit) {
    static const char *const names[] = {"", "height", "width", "length"};
    ktg_vec3 size = ktg_size_of(vertices, vertex_count, ktg_size_up(options));
    const double extents[] = {0, size.y, size.x, size.z};
    if (options->size_rule == KTG_SIZE_FACTOR) {
        *mm_per_unit = options->size_mm;
        return KTG_OK;
    }
    double extent = extents[options->size_rule];
    double largest = fmax(size.x, fmax(size.y, size.z));
    if (!(extent > 1e-9 * largest))
        return ktg_fail(
            context, KTG_GEOMETRY,
            "the model has no %s along that axis; choose another with --up, or give another size",
            names[options->size_rule]);
    *mm_per_unit = options->size_mm / extent;
    return KTG_OK;
}

ktg_status ktg_size_known(ktg_context *context, const ktg_pipeline_options *options,
                          const ktg_mesh *mesh, double *mm_per_unit) {
    *mm_per_unit = 0;
    if (options->size_rule == KTG_SIZE_FIT)
        return KTG_OK;
    return asked_scale(context, options, mesh->positions, mesh->vertex_count, mm_per_unit);
}

ktg_status ktg_size_scale(ktg_context *context, const ktg_pipeline_options *options,
                          const ktg_pattern *pattern, double *mm_per_unit) {
    if (options->size_rule == KTG_SIZE_FIT)
        return ktg_pattern_fit(context, pattern, &options->layout.sheet, options->layout.gap_mm,
                               &options->finish, mm_per_unit);
    return asked_scale(context, options, pattern->vertices, pattern->vertex_count, mm_per_unit);
}
