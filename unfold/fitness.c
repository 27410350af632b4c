/* unfold/fitness.c - the fitness of a set of patches. */
#include "unfold/fitness.h"
#include "core/vec.h"

/* Directions in which a patch's box is measured: every 90 / 12 degrees. */
#define DIRECTIONS 12

/* Extents of a patch along a direction and across it. */
static ktg_vec2 extents(const ktg_patches *p, const ktg_patch *patch, double c, double s) {
    double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
    const ktg_vec2 *corner = p->slot_corners + 3 * (size_t)patch->first;
    for (uint32_t i = 0; i < 3 * patch->count; i++) {
        double x = c * corner[i].x + s * corner[i].y, y = c * corner[i].y - s * corner[i].x;
        x0 = x < x0 ? x : x0;
        x1 = x > x1 ? x : x1;
        y0 = y < y0 ? y : y0;
        y1 = y > y1 ? y : y1;
    }
    return (ktg_vec2){x1 - x0, y1 - y0};
}

/* The smallest of the boxes in the directions tried, its longer side lying. */
static ktg_row_box small_box(const ktg_patches *p, const ktg_patch *patch) {
    ktg_vec2 best = {0, 0};
    for (int i = 0; i < DIRECTIONS; i++) {
        double angle = i * (KTG_PI / 2 / DIRECTIONS);
        ktg_vec2 size = extents(p, patch, cos(angle), sin(angle));
        if (i == 0 || size.x * size.y < best.x * best.y)
            best = size;
    }
    return (ktg_row_box){.width = fmax(best.x, best.y), .height = fmin(best.x, best.y)};
}

static double face_area(const ktg_dual *dual) {
    double area = 0;
    for (uint32_t f = 0; f < dual->face_count; f++) {
        const ktg_vec2 *v = dual->flat_vectors + 3 * (size_t)f;
        area += 0.5 * ktg_cross2(v[0], v[1]);
    }
    return area;
}

ktg_status ktg_fitness(ktg_context *context, const ktg_patches *p, ktg_row_box *boxes,
                       double *fitness) {
    size_t count = 0;
    double box_area = 0, widest = 0, used_width = 0, used_height = 0;
    for (uint32_t i = 0; i < p->dual->face_count; i++) {
        if (p->patches[i].count == 0)
            continue;
        boxes[count] = small_box(p, &p->patches[i]);
        box_area += boxes[count].width * boxes[count].height;
        widest = fmax(widest, boxes[count++].width);
    }
    uint32_t sheets;
    ktg_status status =
        ktg_rows_pack(context, fmax(widest, sqrt(box_area)), INFINITY, 0, boxes, count, &sheets);
    for (size_t i = 0; i < count; i++) {
        used_width = fmax(used_width, boxes[i].x + boxes[i].width);
        used_height = fmax(used_height, boxes[i].y + boxes[i].height);
    }
    double sheet_area = used_width * used_height, all = face_area(p->dual);
    *fitness = p->patch_count - (double)p->largest / p->dual->face_count;
    if (sheet_area > 0)
        *fitness -= all / sheet_area;
    return status;
}
