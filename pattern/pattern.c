/* pattern/pattern.c - the pattern as plain data: copying, scaling, freeing. */
#include "pattern/pattern.h"
#include "core/memory.h"
#include "core/vec.h"

#include <string.h>

static void lines_free(ktg_pattern_piece *piece) {
    for (size_t i = 0; piece->lines && i < piece->line_count; i++)
        ktg_free(piece->lines[i].points);
    ktg_free(piece->lines);
    piece->lines = NULL;
    piece->line_count = 0;
}

static void piece_free(ktg_pattern_piece *piece) {
    ktg_free(piece->name);
    ktg_free(piece->vertices);
    ktg_free(piece->faces);
    ktg_free(piece->corners);
    ktg_free(piece->outline);
    ktg_free(piece->tabs);
    ktg_free(piece->labels);
    lines_free(piece);
}

static void seams_free(ktg_pattern *pattern) {
    for (size_t i = 0; pattern->seams && i < pattern->seam_count; i++) {
        ktg_free(pattern->seams[i].edges);
        ktg_free(pattern->seams[i].first_side);
        ktg_free(pattern->seams[i].notches);
    }
    ktg_free(pattern->seams);
    pattern->seams = NULL;
    pattern->seam_count = 0;
}

static void sheets_free(ktg_pattern *pattern) {
    for (size_t i = 0; pattern->sheets && i < pattern->sheet_count; i++)
        ktg_free(pattern->sheets[i].placements);
    ktg_free(pattern->sheets);
    pattern->sheets = NULL;
    pattern->sheet_count = 0;
}

void ktg_pattern_free(ktg_pattern **pattern) {
    if (!pattern || !*pattern)
        return;
    ktg_pattern *p = *pattern;
    for (size_t i = 0; p->pieces && i < p->piece_count; i++)
        piece_free(&p->pieces[i]);
    for (size_t i = 0; p->components && i < p->component_count; i++)
        ktg_free(p->components[i].name);
    seams_free(p);
    sheets_free(p);
    for (size_t i = 0; p->omitted && i < p->omitted_count; i++)
        ktg_free(p->omitted[i]);
    ktg_free(p->omitted);
    ktg_free(p->model_file);
    ktg_free(p->vertices);
    ktg_free(p->faces);
    ktg_free(p->face_strain);
    ktg_free(p->components);
    ktg_free(p->pieces);
    ktg_free(p->edges);
    ktg_free(p);
    *pattern = NULL;
}

/* *to = a copy of `count` items at `from`; NULL stays NULL. */
static ktg_status copy_items(ktg_context *context, const void *from, size_t count, size_t size,
                             void *to) {
    void *copy = NULL;
    if (from && !(copy = ktg_copy_array(context, from, count, size)))
        return KTG_MEMORY;
    memcpy(to, &copy, sizeof copy);
    return KTG_OK;
}

static ktg_status copy_string(ktg_context *context, const char *from, char **to) {
    return copy_items(context, from, from ? strlen(from) + 1 : 0, 1, to);
}

/* Each fill function sets every pointer of *c itself, so that a copy given up halfway can be freed.
 */
static ktg_status fill_piece(ktg_context *context, const ktg_pattern_piece *p,
                             ktg_pattern_piece *c) {
    c->component = p->component;
    c->cut_count = p->cut_count;
    c->cut_mirrored = p->cut_mirrored;
    c->twin_of = p->twin_of;
    c->on_fold = p->on_fold;
    c->vertex_count = p->vertex_count;
    c->face_count = p->face_count;
    c->outline_count = p->outline_count;
    c->tab_count = p->tab_count;
    c->label_count = p->label_count;
    KTG_TRY(copy_string(context, p->name, &c->name));
    KTG_TRY(copy_items(context, p->vertices, p->vertex_count, sizeof *p->vertices, &c->vertices));
    KTG_TRY(copy_items(context, p->faces, p->face_count, sizeof *p->faces, &c->faces));
    KTG_TRY(copy_items(context, p->corners, 3 * p->face_count, sizeof *p->corners, &c->corners));
    KTG_TRY(copy_items(context, p->outline, p->outline_count, sizeof *p->outline, &c->outline));
    KTG_TRY(copy_items(context, p->tabs, p->tab_count, sizeof *p->tabs, &c->tabs));
    KTG_TRY(copy_items(context, p->labels, p->label_count, sizeof *p->labels, &c->labels));
    if (!p->lines)
        return KTG_OK;
    c->lines = ktg_new(context, p->line_count, ktg_pattern_line);
    if (!c->lines)
        return KTG_MEMORY;
    c->line_count = p->line_count;
    for (size_t i = 0; i < p->line_count; i++) {
        c->lines[i].kind = p->lines[i].kind;
        c->lines[i].point_count = p->lines[i].point_count;
        KTG_TRY(copy_items(context, p->lines[i].points, p->lines[i].point_count, sizeof(ktg_vec2),
                           &c->lines[i].points));
    }
    return KTG_OK;
}

static ktg_status fill_pieces(ktg_context *context, const ktg_pattern *p, ktg_pattern *c) {
    c->pieces = ktg_new(context, p->piece_count, ktg_pattern_piece);
    c->components = ktg_new(context, p->component_count, ktg_pattern_component);
    if (!c->pieces || !c->components)
        return KTG_MEMORY;
    c->piece_count = p->piece_count;
    c->component_count = p->component_count;
    for (size_t i = 0; i < p->piece_count; i++)
        KTG_TRY(fill_piece(context, &p->pieces[i], &c->pieces[i]));
    for (size_t i = 0; i < p->component_count; i++)
        KTG_TRY(copy_string(context, p->components[i].name, &c->components[i].name));
    return KTG_OK;
}

static ktg_status fill_seams_and_sheets(ktg_context *context, const ktg_pattern *p,
                                        ktg_pattern *c) {
    c->seams = ktg_new(context, p->seam_count, ktg_pattern_seam);
    c->sheets = ktg_new(context, p->sheet_count, ktg_pattern_sheet);
    if (!c->seams || !c->sheets)
        return KTG_MEMORY;
    c->seam_count = p->seam_count;
    c->sheet_count = p->sheet_count;
    for (size_t i = 0; i < p->seam_count; i++) {
        const ktg_pattern_seam *from = &p->seams[i];
        ktg_pattern_seam *to = &c->seams[i];
        *to = *from;
        to->edges = NULL;
        to->first_side = NULL;
        to->notches = NULL;
        KTG_TRY(
            copy_items(context, from->edges, from->edge_count, sizeof *from->edges, &to->edges));
        KTG_TRY(copy_items(context, from->first_side, from->edge_count, 1, &to->first_side));
        KTG_TRY(copy_items(context, from->notches, from->notch_count, sizeof *from->notches,
                           &to->notches));
    }
    for (size_t i = 0; i < p->sheet_count; i++) {
        c->sheets[i] = p->sheets[i];
        c->sheets[i].placements = NULL;
        KTG_TRY(copy_items(context, p->sheets[i].placements, p->sheets[i].placement_count,
                           sizeof(ktg_pattern_placement), &c->sheets[i].placements));
    }
    return KTG_OK;
}

ktg_status ktg_pattern_set_omitted(ktg_context *context, ktg_pattern *p, const char *const *names,
                                   size_t count) {
    if (count == 0)
        return KTG_OK;
    p->omitted = ktg_new(context, count, char *);
    if (!p->omitted)
        return KTG_MEMORY;
    p->omitted_count = count;
    for (size_t i = 0; i < count; i++)
        KTG_TRY(copy_string(context, names[i], &p->omitted[i]));
    return KTG_OK;
}

static ktg_status fill_copy(ktg_context *context, const ktg_pattern *p, ktg_pattern *c) {
    c->mode = p->mode;
    c->model_faces = p->model_faces;
    c->mm_per_unit = p->mm_per_unit;
    c->simplified = p->simplified;
    c->vertex_count = p->vertex_count;
    c->face_count = p->face_count;
    c->edge_count = p->edge_count;
    KTG_TRY(copy_string(context, p->model_file, &c->model_file));
    KTG_TRY(ktg_pattern_set_omitted(context, c, (const char *const *)p->omitted, p->omitted_count));
    KTG_TRY(copy_items(context, p->vertices, p->vertex_count, sizeof *p->vertices, &c->vertices));
    KTG_TRY(copy_items(context, p->faces, 3 * (size_t)p->face_count, sizeof *p->faces, &c->faces));
    KTG_TRY(copy_items(context, p->face_strain, p->face_count, sizeof *p->face_strain,
                       &c->face_strain));
    KTG_TRY(copy_items(context, p->edges, p->edge_count, sizeof *p->edges, &c->edges));
    KTG_TRY(fill_pieces(context, p, c));
    return fill_seams_and_sheets(context, p, c);
}

ktg_status ktg_pattern_copy(ktg_context *context, const ktg_pattern *pattern, ktg_pattern **copy) {
    *copy = ktg_new(context, 1, ktg_pattern);
    if (!*copy)
        return KTG_MEMORY;
    ktg_status status = fill_copy(context, pattern, *copy);
    if (status != KTG_OK)
        ktg_pattern_free(copy);
    return status;
}

/* Takes away what ktg_pattern_finish made: it has sizes of its own. */
static void unfinish_piece(ktg_pattern_piece *piece) {
    ktg_free(piece->outline);
    ktg_free(piece->tabs);
    ktg_free(piece->labels);
    lines_free(piece);
    piece->outline = NULL;
    piece->tabs = NULL;
    piece->labels = NULL;
    piece->outline_count = piece->tab_count = piece->label_count = 0;
}

ktg_status ktg_pattern_scale(ktg_context *context, ktg_pattern *pattern, double factor) {
    if (!(factor > 0) || !isfinite(factor))
        return ktg_fail(context, KTG_ARGUMENT, "a pattern cannot be scaled by %g", factor);
    for (uint32_t v = 0; v < pattern->vertex_count; v++)
        pattern->vertices[v] = ktg_mul3(pattern->vertices[v], factor);
    for (size_t i = 0; i < pattern->piece_count; i++) {
        ktg_pattern_piece *piece = &pattern->pieces[i];
        for (size_t v = 0; v < piece->vertex_count; v++)
            piece->vertices[v] = ktg_mul2(piece->vertices[v], factor);
        unfinish_piece(piece);
    }
    for (size_t e = 0; e < pattern->edge_count; e++) {
        pattern->edges[e].tab_on = -1;
        pattern->edges[e].seam = KTG_NONE;
    }
    seams_free(pattern);
    sheets_free(pattern);
    pattern->mm_per_unit = (pattern->mm_per_unit > 0 ? pattern->mm_per_unit : 1) * factor;
    return KTG_OK;
}
