/* unfold/sheet_faces.c - faces and polygons that are larger than the sheet. */
#include "core/memory.h"
#include "core/vec.h"
#include "unfold/goal.h"
#include "unfold/sheet_start.h"
#include "unfold/sheets.h"

#include <string.h>

static ktg_vec2 printable(const ktg_unfold_options *o) {
    double margins = 2 * o->sheet.margin_mm;
    return (ktg_vec2){o->sheet.width_mm - margins, o->sheet.height_mm - margins};
}

/* ---- faces ---------------------------------------------------------------------------------- */

/* The corners of a face laid flat, in millimetres. */
static void flat_corners(const ktg_mesh *mesh, uint32_t face, double scale, ktg_vec2 corners[3]) {
    const uint32_t *v = mesh->faces + 3 * (size_t)face;
    ktg_vec3 a = mesh->positions[v[0]];
    ktg_vec3 b = ktg_mul3(ktg_sub3(mesh->positions[v[1]], a), scale);
    ktg_vec3 c = ktg_mul3(ktg_sub3(mesh->positions[v[2]], a), scale);
    ktg_vec3 along = ktg_unit3(b);
    corners[0] = (ktg_vec2){0, 0};
    corners[1] = (ktg_vec2){ktg_length3(b), 0};
    corners[2] = (ktg_vec2){ktg_dot3(c, along), ktg_length3(ktg_cross3(along, c))};
}

static ktg_vec3 extent_of(const ktg_mesh *mesh) {
    ktg_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t c = 0; c < 3 * (size_t)mesh->face_count; c++) {
        ktg_vec3 p = mesh->positions[mesh->faces[c]];
        low = (ktg_vec3){fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z)};
        high = (ktg_vec3){fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z)};
    }
    return ktg_sub3(high, low);
}

/* Rounded down to three digits, so that what is promised to fit does. */
static double rounded_down(double value) {
    double unit = pow(10, floor(log10(value)) - 2);
    return floor(value / unit) * unit;
}

/* The scale at which the face fits with a whole tab on every side: what may be promised. */
static ktg_status surely_fits(ktg_context *context, const ktg_mesh *mesh, uint32_t face,
                              const ktg_unfold_options *o, double *mm_per_unit) {
    double rim = 2 * o->finish.tab_height_mm, rotation, magnification;
    ktg_vec2 sheet = printable(o), room = {fmax(1, sheet.x - rim), fmax(1, sheet.y - rim)};
    ktg_vec2 corners[3], low;
    flat_corners(mesh, face, o->mm_per_unit, corners);
    KTG_TRY(ktg_best_fit(context, corners, 3, room.x, room.y, &rotation, &low, &magnification));
    *mm_per_unit = rounded_down(o->mm_per_unit * magnification);
    return KTG_OK;
}

ktg_status ktg_sheets_check_faces(ktg_context *context, const ktg_mesh *mesh,
                                  const ktg_unfold_options *o) {
    ktg_vec2 sheet = printable(o), corners[3], low;
    double least = INFINITY, rotation, magnification;
    uint32_t worst = 0;
    if (!(o->mm_per_unit > 0) || o->oversize != KTG_OVERSIZE_SPLIT)
        return KTG_OK;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        flat_corners(mesh, f, o->mm_per_unit, corners);
        KTG_TRY(
            ktg_best_fit(context, corners, 3, sheet.x, sheet.y, &rotation, &low, &magnification));
        if (magnification < least) {
            least = magnification;
            worst = f;
        }
    }
    if (least >= 1)
        return KTG_OK;
    double most;
    KTG_TRY(surely_fits(context, mesh, worst, o, &most));
    ktg_vec3 size = ktg_mul3(extent_of(mesh), most);
    return ktg_fail(context, KTG_GEOMETRY,
                    "face %u alone is larger than the printable area of %s (%.0f x %.0f mm), and a "
                    "face cannot be divided: at %.6g mm per unit it fits with its tabs, that is a "
                    "finished size (x, y, z) of %.0f x %.0f x %.0f mm; choose a smaller size, a "
                    "larger sheet, or more faces",
                    worst + 1, o->sheet.name, sheet.x, sheet.y, most, size.x, size.y, size.z);
}

/* ---- polygons ------------------------------------------------------------------------------- */

static bool is_too_large(const ktg_vec2 *points, size_t count, ktg_vec2 sheet,
                         ktg_context *context) {
    double rotation, magnification;
    ktg_vec2 low;
    return ktg_best_fit(context, points, count, sheet.x, sheet.y, &rotation, &low,
                        &magnification) == KTG_OK &&
           magnification < 1;
}

/* Lays the faces that rigid edges join with `from` flat; the corners go to points. Returns how many
 * faces. */
static uint32_t lay_polygon(const ktg_dual *dual, uint32_t from, ktg_vec2 *at, bool *seen,
                            uint32_t *faces) {
    uint32_t count = 0;
    seen[from] = true;
    faces[count++] = from;
    memcpy(at + 3 * (size_t)from, dual->flat + 3 * (size_t)from, 3 * sizeof *at);
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t h = 3 * faces[i], end = h + 3; h < end; h++) {
            uint32_t e = dual->halfedge_edge[h];
            if (e == KTG_NONE || !dual->edges[e].rigid)
                continue;
            const uint32_t *pair = dual->edges[e].halfedge;
            uint32_t mate = pair[0] == h ? pair[1] : pair[0], other = mate / 3;
            if (seen[other])
                continue;
            uint32_t next = h % 3 == 2 ? h - 2 : h + 1,
                     end_of = mate % 3 == 2 ? mate - 2 : mate + 1;
            ktg_motion2 m =
                ktg_motion2_between(dual->flat[mate], dual->flat[end_of], at[next], at[h]);
            for (uint32_t c = 3 * other; c < 3 * other + 3; c++)
                at[c] = ktg_move2(m, dual->flat[c]);
            seen[other] = true;
            faces[count++] = other;
        }
    return count;
}

static void loosen(ktg_dual *dual, const uint32_t *faces, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t h = 3 * faces[i]; h < 3 * faces[i] + 3; h++) {
            uint32_t e = dual->halfedge_edge[h];
            if (e != KTG_NONE)
                dual->edges[e].rigid = dual->edges[e].kept;
        }
}

ktg_status ktg_sheets_loosen(ktg_context *context, const ktg_unfold_options *o, double mm,
                             ktg_dual *dual) {
    size_t n = dual->face_count;
    ktg_vec2 sheet = ktg_mul2(ktg_goal_half(o, mm, 1), 2);
    ktg_vec2 *at = ktg_new(context, 3 * n, ktg_vec2), *points = ktg_new(context, 3 * n, ktg_vec2);
    bool *seen = ktg_new(context, n, bool);
    uint32_t *faces = ktg_new(context, n, uint32_t);
    bool room = at && points && seen && faces;
    for (uint32_t f = 0; room && f < n; f++) {
        if (seen[f])
            continue;
        uint32_t count = lay_polygon(dual, f, at, seen, faces);
        for (uint32_t i = 0; i < count; i++)
            memcpy(points + 3 * (size_t)i, at + 3 * (size_t)faces[i], 3 * sizeof *at);
        if (count > 1 && (is_too_large(points, 3 * (size_t)count, sheet, context) ||
                          (o->piece_faces > 0 && count > o->piece_faces)))
            loosen(dual, faces, count);
    }
    ktg_free(at);
    ktg_free(points);
    ktg_free(seen);
    ktg_free(faces);
    return room ? KTG_OK : KTG_MEMORY;
}
