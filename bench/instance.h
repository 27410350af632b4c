/* bench/instance.h - strip-packing instances: polygons to be laid on a strip as short as can be. */
#ifndef KTG_BENCH_INSTANCE_H
#define KTG_BENCH_INSTANCE_H

#include "layout/nest.h"

/* {"name": ..., "strip_height": H, "items": [{"demand": N, "allowed_orientations": [degrees, ...],
 * "shape": {"data": [[x, y], ...]}}, ...]}; without orientations any turn is allowed. */
typedef struct bench_instance {
    char name[64];
    ktg_nest_shape *shapes;
    size_t shape_count;
    uint32_t *items;
    size_t item_count;
    double width;  /* the strip's height, in the file's words */
    double area;   /* of all items */
    double record; /* the best density known, 0..1; 0: not known here */
} bench_instance;

/* False, with a sentence on standard error, when the file is none. */
bool bench_instance_read(const char *path, bench_instance *instance);
void bench_instance_drop(bench_instance *instance);

/* All items in rows by their boxes; KTG_GEOMETRY when one is wider than the strip. */
KTG_NODISCARD ktg_status bench_instance_start(ktg_context *context, const bench_instance *instance,
                                              ktg_nest_place *places);

#endif
