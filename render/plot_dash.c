/* render/plot_dash.c - dashes as short paths, for machines that do not know dashed lines. */
#include "render/plot.h"

#include "core/memory.h"

#define CORNER (15 * KTG_PI / 180) /* a run of dashes ends where a path turns more */

typedef struct dashing {
    const ktg_vec2 *points; /* of a run */
    size_t count;
    ktg_vec2 *dash; /* the one at hand; count + 2 */
    ktg_dash_draw *draw;
    void *user;
} dashing;

static double length_of(const ktg_vec2 *points, size_t count) {
    double length = 0;
    for (size_t i = 1; i < count; i++)
        length += ktg_length2(ktg_sub2(points[i], points[i - 1]));
    return length;
}

/* What of the run lies between two distances from its beginning. */
static ktg_status draw_part(const dashing *d, double from, double to) {
    double at = 0;
    size_t used = 0;
    for (size_t i = 1; i < d->count; i++) {
        ktg_vec2 a = d->points[i - 1], way = ktg_sub2(d->points[i], a);
        double length = ktg_length2(way), end = at + length;
        if (length > 0 && end > from && at < to) {
            if (used == 0)
                d->dash[used++] = ktg_madd2(a, fmax(from - at, 0) / length, way);
            d->dash[used++] = ktg_madd2(a, fmin(to - at, length) / length, way);
        }
        at = end;
    }
    return used > 1 ? d->draw(d->user, d->dash, used) : KTG_OK;
}

static ktg_status draw_run(const dashing *d, ktg_dashes wished) {
    double length = length_of(d->points, d->count);
    ktg_dashes fitted = ktg_dashes_fit(wished, length);
    if (!(fitted.dash > 0))
        return KTG_OK;
    for (double at = 0; at < length - 1e-6;) {
        KTG_TRY(draw_part(d, at, fmin(at + fitted.dash, length)));
        at += fitted.dash + fitted.gap;
        if (fitted.dot > 0 && at < length - 1e-6) {
            KTG_TRY(draw_part(d, at, at + fitted.dot));
            at += fitted.dot + fitted.gap;
        }
    }
    return KTG_OK;
}

static bool is_corner(const ktg_vec2 *p) {
    ktg_vec2 in = ktg_sub2(p[0], p[-1]), out = ktg_sub2(p[1], p[0]);
    return fabs(atan2(ktg_cross2(in, out), ktg_dot2(in, out))) > CORNER;
}

static ktg_status draw_runs(dashing *d, const ktg_vec2 *points, size_t count, ktg_dashes wished) {
    size_t begin = 0;
    for (size_t i = 1; i < count; i++) {
        if (i + 1 < count && !is_corner(points + i))
            continue;
        d->points = points + begin;
        d->count = i + 1 - begin;
        KTG_TRY(draw_run(d, wished));
        begin = i;
    }
    return KTG_OK;
}

ktg_status ktg_plot_dash(const ktg_plot *plot, const ktg_plot_path *path, ktg_dash_draw *draw,
                         void *user) {
    ktg_context *context = plot->page.drawing->context;
    ktg_dashes wished = ktg_stroke_dashes(plot->page.drawing, path->stroke);
    size_t count = path->count + (path->closed ? 1 : 0);
    ktg_vec2 *points = ktg_new(context, count, ktg_vec2),
             *dash = ktg_new(context, count + 2, ktg_vec2);
    ktg_status status = points && dash ? KTG_OK : KTG_MEMORY;
    for (size_t i = 0; status == KTG_OK && i < count; i++)
        points[i] = plot->points[path->first + i % path->count];
    if (status == KTG_OK) {
        dashing d = {.dash = dash, .draw = draw, .user = user};
        status = wished.dash > 0 ? draw_runs(&d, points, count, wished) : draw(user, points, count);
    }
    ktg_free(points);
    ktg_free(dash);
    return status;
}
