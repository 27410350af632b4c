/* pattern/fit.c - the largest scale at which a whole pattern, finished, fits one sheet.
 *
 * Tabs and allowances do not grow with the model, and which tabs there are changes with the scale,
 * so the scale is bracketed and halved, each step finishing the scaled pattern for real. Pieces are
 * turned and packed just as layout does it, with a hair to spare. */
#include "pattern/finish.h"

#include "core/memory.h"

/* Relative: what is left free for rounding, and how narrow the bracket becomes. */
#define SPARE  1e-9
#define NARROW 1e-3

/* How often the scale is halved in search of one that fits. */
#define HALVINGS 60

typedef struct fitting {
    const ktg_pattern *original;
    ktg_pattern *scaled; /* a copy whose pieces are rewritten for each scale */
    ktg_topology topology;
    const ktg_finish_options *options;
    ktg_vec2 room; /* the printable area, less the spare hair */
    double gap;
    ktg_row_box *boxes; /* piece_count */
} fitting;

/* The size of the outline turned by `rotation`, computed as layout does. */
static ktg_vec2 turned_size(const ktg_pattern_piece *piece, double rotation) {
    ktg_motion2 turn = {cos(rotation), sin(rotation), {0, 0}};
    ktg_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < piece->outline_count; i++) {
        ktg_vec2 p = ktg_move2(turn, piece->outline[i]);
        low = (ktg_vec2){fmin(low.x, p.x), fmin(low.y, p.y)};
        high = (ktg_vec2){fmax(high.x, p.x), fmax(high.y, p.y)};
    }
    return ktg_sub2(high, low);
}

static bool fits_room(ktg_vec2 size, ktg_vec2 room) {
    return size.x <= room.x && size.y <= room.y;
}

/* The smallest box, its longer side across or up, the other way where only that fits; else the turn
 * with the most room. */
static ktg_status size_for_rows(ktg_context *context, const fitting *f,
                                const ktg_pattern_piece *piece, bool longer_up, ktg_vec2 *size) {
    double rotation, magnification;
    ktg_vec2 low;
    KTG_TRY(ktg_smallest_box(context, piece->outline, piece->outline_count, &rotation, &low, size));
    if ((size->y > size->x) != longer_up)
        rotation += KTG_PI / 2;
    *size = turned_size(piece, rotation);
    if (fits_room(*size, f->room))
        return KTG_OK;
    *size = turned_size(piece, rotation + KTG_PI / 2);
    if (fits_room(*size, f->room))
        return KTG_OK;
    KTG_TRY(ktg_best_fit(context, piece->outline, piece->outline_count, f->room.x, f->room.y,
                         &rotation, &low, &magnification));
    *size = turned_size(piece, rotation);
    return KTG_OK;
}

static ktg_status rows_fit(ktg_context *context, fitting *f, bool longer_up, bool *fits) {
    uint32_t sheets = 0;
    *fits = false;
    for (size_t p = 0; p < f->scaled->piece_count; p++) {
        ktg_vec2 size;
        KTG_TRY(size_for_rows(context, f, &f->scaled->pieces[p], longer_up, &size));
        if (!fits_room(size, f->room))
            return KTG_OK;
        f->boxes[p] = (ktg_row_box){size.x, size.y, 0, 0, 0};
    }
    KTG_TRY(ktg_rows_pack(context, f->room.x, f->room.y, f->gap, f->boxes, f->scaled->piece_count,
                          &sheets));
    *fits = sheets <= 1;
    return KTG_OK;
}

/* Does the pattern, finished at this scale, fit the sheet? */
static ktg_status fits_at(ktg_context *context, fitting *f, double scale, bool *fits) {
    ktg_finish_report report = {0};
    for (size_t p = 0; p < f->scaled->piece_count; p++) {
        const ktg_pattern_piece *from = &f->original->pieces[p];
        for (size_t v = 0; v < from->vertex_count; v++)
            f->scaled->pieces[p].vertices[v] = ktg_mul2(from->vertices[v], scale);
    }
    KTG_TRY(ktg_check_cancel(context));
    KTG_TRY(ktg_finish_shapes(context, &f->topology, f->options, f->scaled, &report));
    if (f->scaled->piece_count > 1) {
        KTG_TRY(rows_fit(context, f, false, fits));
        return *fits ? KTG_OK : rows_fit(context, f, true, fits);
    }
    const ktg_pattern_piece *piece = f->scaled->pieces;
    double rotation, magnification;
    ktg_vec2 low;
    KTG_TRY(ktg_best_fit(context, piece->outline, piece->outline_count, f->room.x, f->room.y,
                         &rotation, &low, &magnification));
    *fits = fits_room(turned_size(piece, rotation), f->room);
    return KTG_OK;
}

/* The scale at which every piece alone, without tabs, would fit a room less `rim` on each side; 0
 * where the rim eats it up. */
static ktg_status bare_scale(ktg_context *context, const fitting *f, double rim, double *scale) {
    double width = f->room.x - 2 * rim, height = f->room.y - 2 * rim;
    *scale = width > 0 && height > 0 ? INFINITY : 0;
    for (size_t p = 0; p<f->original->piece_count && * scale> 0; p++) {
        const ktg_pattern_piece *piece = &f->original->pieces[p];
        double rotation, magnification;
        ktg_vec2 low;
        KTG_TRY(ktg_best_fit(context, piece->vertices, piece->vertex_count, width, height,
                             &rotation, &low, &magnification));
        *scale = fmin(*scale, magnification);
    }
    return KTG_OK;
}

static ktg_status nothing_fits(ktg_context *context, const fitting *f) {
    return ktg_fail(context, KTG_GEOMETRY,
                    "no size of this pattern fits %.1f x %.1f mm with its %zu pieces: choose a "
                    "larger sheet, smaller margins or smaller gaps",
                    f->room.x, f->room.y, f->original->piece_count);
}

/* A scale that fits: first the one that leaves a rim for the tabs, then ever smaller ones. `*most`
 * is one that does not fit, on the way down the last such. */
static ktg_status find_fitting(ktg_context *context, fitting *f, double *most, double *scale) {
    double rim =
        f->scaled->mode == KTG_CLOTH ? 2.5 * f->options->allowance_mm : f->options->tab_height_mm;
    bool fits = false;
    KTG_TRY(bare_scale(context, f, rim, scale));
    if (!(*scale > 0) || f->original->piece_count > 1)
        *scale = *most / 2;
    for (int k = 0; k < HALVINGS; k++) {
        KTG_TRY(fits_at(context, f, *scale, &fits));
        if (fits)
            return KTG_OK;
        *most = *scale;
        *scale /= 2;
    }
    return nothing_fits(context, f);
}

static ktg_status find_largest(ktg_context *context, fitting *f, double *mm_per_unit) {
    double most, scale;
    bool fits;
    KTG_TRY(bare_scale(context, f, 0, &most));
    if (!(most > 0) || !isfinite(most))
        return nothing_fits(context, f);
    KTG_TRY(fits_at(context, f, most, &fits));
    if (fits) {
        *mm_per_unit = most;
        return KTG_OK;
    }
    KTG_TRY(find_fitting(context, f, &most, &scale));
    while (most > scale * (1 + NARROW)) {
        double middle = (scale + most) / 2;
        KTG_TRY(fits_at(context, f, middle, &fits));
        *(fits ? &scale : &most) = middle;
    }
    *mm_per_unit = scale;
    return KTG_OK;
}

static ktg_status fit(ktg_context *context, fitting *f, double *mm_per_unit) {
    KTG_TRY(ktg_pattern_copy(context, f->original, &f->scaled));
    KTG_TRY(ktg_topology_build(context, f->scaled, &f->topology));
    if (!(f->boxes = ktg_new(context, f->original->piece_count, ktg_row_box)))
        return KTG_MEMORY;
    KTG_TRY(ktg_seams_find(context, &f->topology, f->scaled));
    return find_largest(context, f, mm_per_unit);
}

ktg_status ktg_pattern_fit(ktg_context *context, const ktg_pattern *pattern,
                           const ktg_sheet_format *sheet, double gap_mm,
                           const ktg_finish_options *options, double *mm_per_unit) {
    ktg_finish_options defaults;
    ktg_finish_defaults(&defaults);
    fitting f = {.original = pattern, .options = options ? options : &defaults, .gap = gap_mm};
    KTG_TRY(ktg_finish_check(context, f.options));
    if (!(gap_mm >= 0) || !isfinite(gap_mm))
        return ktg_fail(context, KTG_ARGUMENT, "a gap of %g mm between pieces makes no sense",
                        gap_mm);
    if (pattern->piece_count == 0)
        return ktg_fail(context, KTG_ARGUMENT, "the pattern has no pieces to fit on a sheet");
    f.room = (ktg_vec2){(sheet->width_mm - 2 * sheet->margin_mm) * (1 - SPARE),
                        (sheet->height_mm - 2 * sheet->margin_mm) * (1 - SPARE)};
    if (!(f.room.x > 0) || !(f.room.y > 0) || !(sheet->margin_mm >= 0))
        return ktg_fail(context, KTG_GEOMETRY,
                        "margins of %g mm leave nothing of a sheet of %g x %g mm: choose smaller "
                        "margins or a larger sheet",
                        sheet->margin_mm, sheet->width_mm, sheet->height_mm);
    ktg_status status = fit(context, &f, mm_per_unit);
    ktg_topology_drop(&f.topology);
    ktg_pattern_free(&f.scaled);
    ktg_free(f.boxes);
    return status;
}
