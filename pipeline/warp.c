/* pipeline/warp.c - a piece of a pattern moved by handles, and what that means for the others. */
#include "core/memory.h"
#include "core/vec.h"
#include "pipeline/outputs.h"
#include "pipeline/sheets.h"
#include "pipeline/stages.h"
#include "pipeline/stated.h"

#include <stdlib.h>
#include <string.h>

/* What two sides of a seam may differ by without a word. */
static const double worth_telling_mm = 0.5;
enum { most_told = 20 };

/* What one run takes and frees. */
typedef struct work {
    const ktg_warp_job *job;
    ktg_pattern *pattern;
    uint32_t piece;
    ktg_mesh *mesh;  /* the piece */
    uint32_t *place; /* face_count of the surface: where its piece lists a face */
    double *before;  /* 2 edge_count: length of each side as the file has it */
    bool *was_twin;  /* piece_count: was cut with the piece, or that with it */
    const char **fold_names;
    ktg_outputs outputs;
    ktg_warp_result result;
} work;

/* ---- which piece -------------------------------------------------------------------------- */

static ktg_status no_such_piece(ktg_context *context, const work *w, const char *why) {
    const ktg_pattern *p = w->pattern;
    return ktg_fail(context, KTG_ARGUMENT, "%s: %s; its pieces are #piece1 to #piece%zu%s%s%s",
                    w->job->pattern, why, p->piece_count, p->pieces[0].name ? " (\"" : "",
                    p->pieces[0].name ? p->pieces[0].name : "",
                    p->pieces[0].name ? "\" is the first)" : "");
}

/* "piece3" or "3". */
static bool piece_number(const char *text, unsigned long *number) {
    char *end;
    if (strncmp(text, "piece", 5) == 0)
        text += 5;
    if (*text < '0' || *text > '9')
        return false;
    *number = strtoul(text, &end, 10);
    return *end == 0;
}

static ktg_status find_piece(ktg_context *context, work *w) {
    const char *wanted = w->job->piece;
    unsigned long number;
    if (w->pattern->piece_count == 0)
        return ktg_fail(context, KTG_ARGUMENT, "%s: has no pieces", w->job->pattern);
    if (!wanted && w->pattern->piece_count == 1)
        return KTG_OK;
    if (!wanted)
        return no_such_piece(context, w, "say which piece is to be warped");
    for (uint32_t p = 0; p < w->pattern->piece_count; p++)
        if (w->pattern->pieces[p].name && strcmp(w->pattern->pieces[p].name, wanted) == 0) {
            w->piece = p;
            return KTG_OK;
        }
    if (!piece_number(wanted, &number) || number < 1 || number > w->pattern->piece_count)
        return no_such_piece(context, w, "has no such piece");
    w->piece = (uint32_t)number - 1;
    return KTG_OK;
}

static const char *name_of(const work *w, uint32_t piece) {
    const char *name = w->pattern->pieces[piece].name;
    return name ? name : "a piece without a name";
}

/* ---- the piece as a mesh, and back -------------------------------------------------------- */

static ktg_status take_mesh(ktg_context *context, work *w) {
    const ktg_pattern_piece *piece = &w->pattern->pieces[w->piece];
    ktg_vec3 *positions = ktg_new(context, piece->vertex_count, ktg_vec3);
    if (!positions)
        return KTG_MEMORY;
    for (size_t v = 0; v < piece->vertex_count; v++)
        positions[v] = (ktg_vec3){piece->vertices[v].x, piece->vertices[v].y, 0};
    ktg_status status = ktg_mesh_new(context, &positions[0].x, (uint32_t)piece->vertex_count,
                                     piece->corners, (uint32_t)piece->face_count, &w->mesh);
    ktg_free(positions);
    return status;
}

/* The larger of |s - 1| of the map of a face in space to a triangle of the plane. */
static double strain_of(const ktg_vec3 p[3], const ktg_vec2 q[3]) {
    ktg_vec3 along = ktg_sub3(p[1], p[0]), third = ktg_sub3(p[2], p[0]);
    double length = ktg_length3(along), x = ktg_dot3(along, third) / length;
    double height = ktg_length3(ktg_cross3(along, third)) / length;
    ktg_vec2 a = ktg_mul2(ktg_sub2(q[1], q[0]), 1 / length);
    ktg_vec2 b = ktg_mul2(ktg_madd2(ktg_sub2(q[2], q[0]), -x, a), 1 / height);
    double conformal = hypot(a.x + b.y, a.y - b.x) / 2;
    double anticonformal = hypot(a.x - b.y, a.y + b.x) / 2;
    return fmax(fabs(conformal + anticonformal - 1), fabs(conformal - anticonformal - 1));
}

static void measure_strain(const work *w) {
    const ktg_pattern *p = w->pattern;
    const ktg_pattern_piece *piece = &p->pieces[w->piece];
    for (size_t f = 0; p->face_strain && f < piece->face_count; f++) {
        ktg_vec3 space[3];
        ktg_vec2 plane[3];
        for (int k = 0; k < 3; k++) {
            space[k] = p->vertices[p->faces[3 * (size_t)piece->faces[f] + (size_t)k]];
            plane[k] = piece->vertices[piece->corners[3 * f + (size_t)k]];
        }
        double strain = strain_of(space, plane);
        p->face_strain[piece->faces[f]] = isfinite(strain) ? strain : 0;
    }
}

/* What is printed never folds over. */
static ktg_status check_sound(ktg_context *context, const work *w) {
    const ktg_warp_report *r = &w->result.warp;
    if (r->shape.folded_faces > 0)
        return ktg_fail(context, KTG_GEOMETRY,
                        "\"%s\" cannot be moved so far: %u of its faces would fold over; move "
                        "fewer handles, or less far",
                        name_of(w, w->piece), r->shape.folded_faces);
    if (r->crossed)
        return ktg_fail(context, KTG_GEOMETRY,
                        "\"%s\" cannot be moved so far: it would lie on itself",
                        name_of(w, w->piece));
    return KTG_OK;
}

static ktg_status warp_piece(ktg_context *context, work *w) {
    ktg_pattern_piece *piece = &w->pattern->pieces[w->piece];
    KTG_TRY(take_mesh(context, w));
    KTG_TRY(ktg_warp(context, w->mesh, w->job->handles, &w->job->warp, &w->result.warp));
    KTG_TRY(check_sound(context, w));
    for (size_t v = 0; v < piece->vertex_count; v++)
        piece->vertices[v] = (ktg_vec2){w->mesh->positions[v].x, w->mesh->positions[v].y};
    measure_strain(w);
    return KTG_OK;
}

/* ---- seams -------------------------------------------------------------------------------- */

static double side_length(const work *w, const ktg_pattern_side *side) {
    const ktg_pattern_piece *piece = &w->pattern->pieces[side->piece];
    const uint32_t *corners = piece->corners + 3 * (size_t)w->place[side->face];
    return ktg_length2(ktg_sub2(piece->vertices[corners[(side->corner + 1) % 3]],
                                piece->vertices[corners[side->corner]]));
}

/* A pattern may come from any file: its edges may name a piece that the face is not in. */
static ktg_status check_side(ktg_context *context, const work *w, size_t edge, uint32_t k) {
    const ktg_pattern_side *side = &w->pattern->edges[edge].sides[k];
    const ktg_pattern_piece *piece = &w->pattern->pieces[side->piece];
    uint32_t place = w->place[side->face];
    if (place < piece->face_count && piece->faces[place] == side->face)
        return KTG_OK;
    return ktg_fail(context, KTG_FORMAT,
                    "%s: edge %zu says that face %u lies in piece %u, where it is not; katagami "
                    "verify tells what else is wrong with this pattern",
                    w->job->pattern, edge + 1, side->face, side->piece + 1);
}

static ktg_status take_lengths(ktg_context *context, work *w) {
    const ktg_pattern *p = w->pattern;
    w->place = ktg_new(context, p->face_count, uint32_t);
    w->before = ktg_new(context, 2 * p->edge_count, double);
    w->was_twin = ktg_new(context, p->piece_count, bool);
    if (!w->place || !w->before || !w->was_twin)
        return KTG_MEMORY;
    for (size_t k = 0; k < p->piece_count; k++)
        for (size_t f = 0; f < p->pieces[k].face_count; f++)
            w->place[p->pieces[k].faces[f]] = (uint32_t)f;
    for (size_t e = 0; e < p->edge_count; e++)
        for (uint32_t k = 0; k < p->edges[e].side_count; k++) {
            KTG_TRY(check_side(context, w, e, k));
            w->before[2 * e + k] = side_length(w, &p->edges[e].sides[k]);
        }
    for (uint32_t k = 0; k < p->piece_count; k++) {
        const ktg_pattern_piece *one = &p->pieces[k], *other = &p->pieces[w->piece];
        w->was_twin[k] = k != w->piece && ((one->cut_count == 0 && one->twin_of == w->piece) ||
                                           (other->cut_count == 0 && other->twin_of == k));
    }
    return KTG_OK;
}

/* What a seam's sides differed by before. */
static double difference_before(const work *w, const ktg_pattern_seam *seam) {
    double lengths[2] = {0, 0};
    for (uint32_t k = 0; k < seam->edge_count; k++)
        for (int side = 0; side < 2; side++)
            lengths[side] += w->before[2 * (size_t)seam->edges[k] + (seam->first_side[k] ^ side)];
    return fabs(lengths[0] - lengths[1]);
}

static void tell_seam(ktg_context *context, const work *w, const ktg_pattern_seam *seam,
                      double before) {
    double off = fabs(seam->lengths_mm[0] - seam->lengths_mm[1]);
    ktg_log(context, KTG_LOG_WARNING,
            "%s %u: %.1f mm on %s, %.1f mm on %s: they differ by %.1f mm (before: %.1f mm)",
            seam->dart ? "dart" : "seam", seam->number, seam->lengths_mm[0],
            name_of(w, seam->pieces[0]), seam->lengths_mm[1], name_of(w, seam->pieces[1]), off,
            before);
}

static void compare_seams(ktg_context *context, work *w) {
    ktg_warp_result *r = &w->result;
    for (size_t s = 0; s < w->pattern->seam_count; s++) {
        const ktg_pattern_seam *seam = &w->pattern->seams[s];
        if (seam->pieces[0] != w->piece && seam->pieces[1] != w->piece)
            continue;
        double off = fabs(seam->lengths_mm[0] - seam->lengths_mm[1]);
        double before = difference_before(w, seam);
        r->seam_error_mm = fmax(r->seam_error_mm, off);
        r->seam_error_before_mm = fmax(r->seam_error_before_mm, before);
        if (off > worth_telling_mm && r->seams_off++ < most_told)
            tell_seam(context, w, seam, before);
    }
}

static void compare_twins(ktg_context *context, work *w) {
    const ktg_pattern *p = w->pattern;
    for (uint32_t k = 0; k < p->piece_count; k++) {
        const ktg_pattern_piece *one = &p->pieces[k], *other = &p->pieces[w->piece];
        bool twin = (one->cut_count == 0 && one->twin_of == w->piece) ||
                    (other->cut_count == 0 && other->twin_of == k);
        if (!w->was_twin[k] || twin)
            continue;
        w->result.twins_lost++;
        ktg_log(context, KTG_LOG_WARNING, "%s and %s were cut together and are no twins any more",
                name_of(w, w->piece), name_of(w, k));
    }
}

/* ---- all ---------------------------------------------------------------------------------- */

static ktg_status finish(ktg_context *context, work *w, ktg_pipeline_options *options) {
    ktg_pipeline_report report = {0};
    KTG_TRY(ktg_stated_finish(context, w->pattern, w->job, &options->finish, &w->fold_names));
    if (!w->job->sheet_given)
        ktg_stated_sheet(w->pattern, &options->layout);
    options->size_rule = KTG_SIZE_FACTOR;
    options->size_mm = 1;
    options->layout.keep_grain = true;
    KTG_TRY(warp_piece(context, w));
    KTG_TRY(ktg_sheets_put(context, options, &w->pattern, &report));
    w->result.finish = report.finish;
    w->result.layout = report.layout;
    w->result.allowance_mm = options->finish.allowance_mm;
    w->result.hem_mm = options->finish.hem_mm;
    compare_seams(context, w);
    compare_twins(context, w);
    return KTG_OK;
}

/* What ktg_outputs_check and ktg_outputs_write look at. */
static void set_options(const ktg_warp_job *job, ktg_pipeline_options *options) {
    options->mode = KTG_CLOTH;
    options->model = job->pattern;
    options->cut = &job->handles;
    options->cut_count = 1;
    options->keep_count = 0;
    options->report = NULL;
    options->marker = false;
}

static ktg_status run(ktg_context *context, ktg_pipeline_options *options, work *w) {
    if (options->output_count == 0)
        return ktg_fail(context, KTG_ARGUMENT, "no output is named");
    KTG_TRY(ktg_outputs_check(context, options));
    KTG_TRY(ktg_pattern_read_json(context, w->job->pattern, &w->pattern));
    if (w->pattern->mode != KTG_CLOTH)
        return ktg_fail(context, KTG_ARGUMENT,
                        "%s: is a net of paper, which would no longer fold into its model; only "
                        "cloth can be warped",
                        w->job->pattern);
    KTG_TRY(find_piece(context, w));
    w->result.piece = w->piece;
    KTG_TRY(take_lengths(context, w));
    KTG_TRY(ktg_about_file(context, w->job->pattern, finish(context, w, options)));
    if (!options->render.title)
        options->render.title = w->pattern->model_file;
    KTG_TRY(ktg_outputs_write(context, options, w->pattern, &w->outputs));
    KTG_TRY(ktg_check_cancel(context));
    KTG_TRY(ktg_outputs_finish(context, &w->outputs));
    return ktg_outputs_commit(context, &w->outputs);
}

ktg_status ktg_pipeline_warp(ktg_context *context, const ktg_pipeline_options *options,
                             const ktg_warp_job *job, ktg_warp_result *result) {
    work w = {.job = job};
    ktg_pipeline_options own = *options;
    set_options(job, &own);
    ktg_status status = run(context, &own, &w);
    if (result)
        *result = w.result;
    ktg_outputs_discard(&w.outputs);
    ktg_pattern_free(&w.pattern);
    ktg_mesh_free(&w.mesh);
    ktg_free(w.place);
    ktg_free(w.before);
    ktg_free(w.was_twin);
    ktg_free(w.fold_names);
    return status;
}
