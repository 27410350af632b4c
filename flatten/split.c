/* flatten/split.c - ways to cut a panel that does not fit.
 *
 * Darts and cuts through the places where the panel is curved most; planes across its extents;
 * front from back by the way it faces; creases. Which is best is for measuring to say. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/sheet.h"

#include <string.h>

enum { peak_count = 3 };

/* A fold of this angle is a crease. */
static const double crease_angle = 40 * KTG_PI / 180;

struct ktg_split {
    const ktg_sheet *sheet;
    uint32_t peaks[peak_count]; /* vertices, or KTG_NONE */
    ktg_vec3 *centres;          /* face_count */
    ktg_vec3 *normals;          /* face_count, smoothed */
    ktg_vec3 extents[3], facing[3];
};

/* ---- peaks --------------------------------------------------------------------------------- */

/* The vertex of largest scale, and then those far from the ones before. */
static void find_peaks(const ktg_sheet *sheet, const double *scale, uint32_t *peaks) {
    const ktg_vec3 *p = sheet->mesh->positions;
    double apart = 0.2 * sqrt(sheet->area);
    memset(peaks, 0xff, peak_count * sizeof *peaks);
    for (int k = 0; k < peak_count && (k == 0 || peaks[k - 1] != KTG_NONE); k++) {
        double most = 1e-6;
        for (uint32_t v = 0; v < sheet->mesh->vertex_count; v++) {
            bool far = scale[v] > most && !sheet->border[v];
            for (int j = 0; far && j < k; j++)
                far = ktg_length3(ktg_sub3(p[v], p[peaks[j]])) > apart;
            if (far)
                most = scale[peaks[k] = v];
        }
    }
}

/* ---- facing -------------------------------------------------------------------------------- */

/* Faces near each other are to face alike: rounds of averaging over neighbours, as many as reach
 * over a twentieth of the sheet. */
static uint32_t smoothing_rounds(const ktg_sheet *sheet) {
    double edges = 0.05 * sqrt(sheet->area) / sheet->mean_edge;
    return (uint32_t)ktg_min(60, 2 + edges * edges);
}

static void smooth_normals(const ktg_sheet *sheet, ktg_vec3 *normals, ktg_vec3 *next) {
    const uint32_t *twin = sheet->adjacency->twin;
    for (uint32_t round = smoothing_rounds(sheet); round > 0; round--) {
        for (uint32_t f = 0; f < sheet->mesh->face_count; f++) {
            next[f] = normals[f];
            for (uint32_t h = 3 * f; h < 3 * f + 3; h++)
                if (twin[h] != KTG_NONE)
                    next[f] = ktg_add3(next[f], normals[twin[h] / 3]);
            next[f] = ktg_unit3(next[f]);
        }
        memcpy(normals, next, sheet->mesh->face_count * sizeof *next);
    }
}

/* ---- preparation --------------------------------------------------------------------------- */

static ktg_status prepare(ktg_context *context, ktg_split *s, double **scale) {
    const ktg_mesh *mesh = s->sheet->mesh;
    ktg_vec3 mean;
    s->centres = ktg_new(context, mesh->face_count, ktg_vec3);
    s->normals = ktg_new(context, mesh->face_count, ktg_vec3);
    *scale = ktg_new(context, mesh->vertex_count, double);
    if (!s->centres || !s->normals || !*scale)
        return KTG_MEMORY;
    for (uint32_t f = 0; f < mesh->face_count; f++)
        s->normals[f] = ktg_unit3(ktg_sheet_area(mesh, f));
    smooth_normals(s->sheet, s->normals, s->centres);
    for (uint32_t f = 0; f < mesh->face_count; f++)
        s->centres[f] = ktg_face_centre(mesh, f);
    ktg_axes_of_vectors(mesh, s->centres, &mean, s->extents);
    ktg_axes_of_vectors(mesh, s->normals, &mean, s->facing);
    ktg_status status = ktg_fit_scales(context, mesh, *scale);
    if (status == KTG_GEOMETRY)
        return KTG_OK; /* too thin for the digits: no peaks */
    KTG_TRY(status);
    find_peaks(s->sheet, *scale, s->peaks);
    return KTG_OK;
}

ktg_status ktg_split_new(ktg_context *context, const ktg_sheet *sheet, ktg_split **split) {
    ktg_split *made = ktg_new(context, 1, ktg_split);
    double *scale = NULL;
    *split = NULL;
    if (!made)
        return KTG_MEMORY;
    made->sheet = sheet;
    memset(made->peaks, 0xff, sizeof made->peaks);
    ktg_status status = prepare(context, made, &scale);
    ktg_free(scale);
    if (status != KTG_OK)
        ktg_split_free(&made);
    *split = made;
    return status;
}

void ktg_split_free(ktg_split **split) {
    if (!split || !*split)
        return;
    ktg_free((*split)->centres);
    ktg_free((*split)->normals);
    ktg_free(*split);
    *split = NULL;
}

/* ---- darts and cuts through ---------------------------------------------------------------- */

/* Workspace of paths: vertex_count each. */
typedef struct lines {
    bool *from, *to, *forbidden;
    uint32_t *edges;
} lines;

/* From the peak to the border; edges in order from the peak. */
static ktg_status lead_to_border(ktg_context *context, const ktg_sheet *s, uint32_t peak,
                                 uint32_t straight_on, lines *l, uint32_t *count) {
    l->from[peak] = true;
    ktg_path_query query = {.sheet = s,
                            .cost = s->cost,
                            .from = l->from,
                            .to = l->to,
                            .forbidden = l->forbidden,
                            .straight_on = straight_on};
    return ktg_path_find(context, &query, l->edges, count);
}

static void set_cut(const uint32_t *edges, uint32_t count, bool *cut) {
    for (uint32_t i = 0; i < count; i++)
        cut[edges[i]] = true;
}

/* The vertex where a line from the peak ends. */
static uint32_t line_end(const ktg_sheet *s, uint32_t peak, const lines *l, uint32_t count,
                         double *length) {
    uint32_t v = peak;
    *length = 0;
    for (uint32_t i = 0; i < count; i++) {
        *length += s->length[l->edges[i]];
        v = ktg_sheet_other_end(s, l->edges[i], v);
    }
    return v;
}

/* The next line is not to end within that length of where the last one did. */
static void turn_away(const ktg_sheet *s, uint32_t end, double length, lines *l) {
    for (uint32_t v = 0; v < s->mesh->vertex_count; v++) {
        ktg_vec3 away = ktg_sub3(s->mesh->positions[v], s->mesh->positions[end]);
        if (ktg_length3(away) < length)
            l->to[v] = false;
    }
}

/* The second line leaves the peak on the other side, and ends far from where the first did. */
static ktg_status lead_on(ktg_context *context, const ktg_sheet *s, uint32_t peak, lines *l,
                          uint32_t count, bool *cut) {
    uint32_t v = peak, straight_on = l->edges[0], more;
    double length;
    uint32_t end = line_end(s, peak, l, count, &length);
    turn_away(s, end, length, l);
    for (uint32_t i = 0; i < count; i++)
        l->forbidden[v = ktg_sheet_other_end(s, l->edges[i], v)] = true;
    KTG_TRY(lead_to_border(context, s, peak, straight_on, l, &more));
    set_cut(l->edges, more, cut);
    return KTG_OK;
}

/* What a line should do: number `turn` of those that end apart from each other; on through the peak
 * or not. */
typedef struct line_kind {
    int peak, turn;
    bool through;
} line_kind;

static ktg_status make_lines(ktg_context *context, const ktg_sheet *s, uint32_t peak,
                             line_kind kind, lines *l, bool *cut) {
    const uint32_t vertex_count = s->mesh->vertex_count;
    uint32_t count = 0;
    l->from = ktg_new(context, vertex_count, bool);
    l->to = ktg_copy_array(context, s->outer, vertex_count, sizeof(bool));
    l->forbidden = ktg_copy_array(context, s->border, vertex_count, sizeof(bool));
    l->edges = ktg_new(context, vertex_count, uint32_t);
    if (!l->from || !l->to || !l->forbidden || !l->edges)
        return KTG_MEMORY;
    for (int turn = 0; turn <= kind.turn; turn++) {
        KTG_TRY(lead_to_border(context, s, peak, KTG_NONE, l, &count));
        if (turn < kind.turn) {
            double length;
            uint32_t end = line_end(s, peak, l, count, &length);
            turn_away(s, end, 0.7 * length, l);
        }
    }
    set_cut(l->edges, count, cut);
    return kind.through && count > 0 ? lead_on(context, s, peak, l, count, cut) : KTG_OK;
}

static ktg_status cut_lines(ktg_context *context, const ktg_split *split, line_kind kind,
                            bool *cut) {
    lines l = {0};
    if (split->peaks[kind.peak] == KTG_NONE)
        return KTG_OK;
    ktg_status status = make_lines(context, split->sheet, split->peaks[kind.peak], kind, &l, cut);
    ktg_free(l.from);
    ktg_free(l.to);
    ktg_free(l.forbidden);
    ktg_free(l.edges);
    return status;
}

/* ---- by a value of each face --------------------------------------------------------------- */

static ktg_status cut_between(ktg_context *context, const ktg_sheet *sheet, const ktg_vec3 *vectors,
                              ktg_vec3 axis, double part, bool *cut, double *at) {
    const uint32_t face_count = sheet->mesh->face_count;
    double *value = ktg_new(context, face_count, double);
    bool *side = ktg_new(context, face_count, bool);
    ktg_status status = value && side ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        for (uint32_t f = 0; f < face_count; f++)
            value[f] = ktg_dot3(vectors[f], axis);
        status = ktg_label_by_value(context, sheet, value, part, side, at);
    }
    if (status == KTG_OK)
        ktg_label_edges(sheet, side, cut);
    ktg_free(value);
    ktg_free(side);
    return status;
}

static ktg_status cut_plane(ktg_context *context, const ktg_split *split, ktg_vec3 axis, bool *cut,
                            double *cost) {
    double at;
    KTG_TRY(cut_between(context, split->sheet, split->centres, axis, 0.5, cut, &at));
    ktg_plane_cost(split->sheet, axis, at, cost);
    return KTG_OK;
}

static void cut_creases(const ktg_sheet *s, bool *cut) {
    for (uint32_t h = 0; h < s->adjacency->halfedge_count; h++) {
        uint32_t twin = s->adjacency->twin[h];
        if (twin == KTG_NONE || twin < h)
            continue;
        ktg_vec3 a = ktg_sheet_area(s->mesh, h / 3), b = ktg_sheet_area(s->mesh, twin / 3);
        if (atan2(ktg_length3(ktg_cross3(a, b)), ktg_dot3(a, b)) > crease_angle)
            cut[s->adjacency->halfedge_edge[h]] = true;
    }
}

ktg_status ktg_split_make(ktg_context *context, const ktg_split *split, uint32_t way, bool *cut,
                          double *cost) {
    static const ktg_vec3 world[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const line_kind kinds[] = {{0, 0, false}, {0, 1, false}, {0, 2, false},
                                      {0, 0, true},  {1, 0, false}, {1, 0, true}};
    double at;
    if (way < 6)
        return cut_lines(context, split, kinds[way], cut);
    if (way < 9)
        return cut_plane(context, split, split->extents[way - 6], cut, cost);
    if (way < 12)
        return cut_plane(context, split, world[way - 9], cut, cost);
    if (way < 17)
        return cut_between(context, split->sheet, split->normals,
                           way < 14 ? split->facing[way - 12] : world[way - 14], 0, cut, &at);
    if (way == 17)
        cut_creases(split->sheet, cut);
    else
        for (int k = 0; k < 2; k++)
            KTG_TRY(cut_lines(context, split, kinds[4 * k], cut));
    return KTG_OK;
}

ktg_status ktg_split_halve(ktg_context *context, const ktg_sheet *sheet, bool *cut) {
    ktg_vec3 *centres = ktg_new(context, sheet->mesh->face_count, ktg_vec3), mean, extents[3];
    double at;
    if (!centres)
        return KTG_MEMORY;
    for (uint32_t f = 0; f < sheet->mesh->face_count; f++)
        centres[f] = ktg_face_centre(sheet->mesh, f);
    ktg_axes_of_vectors(sheet->mesh, centres, &mean, extents);
    ktg_status status = KTG_OK;
    for (int k = 0; status == KTG_OK && k < 3; k++) {
        status = cut_between(context, sheet, centres, extents[k], 0.5, cut, &at);
        for (uint32_t e = 0; k < 2 && e < sheet->edge_count; e++)
            k = cut[e] ? 2 : k;
    }
    ktg_free(centres);
    return status;
}
