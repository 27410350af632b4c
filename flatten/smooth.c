/* flatten/smooth.c - seams led anew, near where they were, so that they can be sewn. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/sheet.h"

#include <string.h>

/* How far a seam may move: edges or, where that is more, part of its length and of the sheet's
 * extent. */
static const double reach_edges = 2.5, reach_length = 0.1, reach_extent = 0.06;

/* Rounds in which a line's points move half way to the middle between their neighbours: wiggles of
 * less than about ten edges are gone then. */
enum { line_rounds = 40 };

/* A piece of a run that is led anew. */
typedef struct stretch {
    const ktg_sheet *sheet;
    const double *cost;
    bool *cut;
    const uint32_t *old; /* edges in order */
    uint32_t count;
    uint32_t ends[2];
    double reach;
    /* workspace: vertex_count each */
    bool *on, *from, *to, *forbidden;
    double *distance;
    uint32_t *via;
    double *along; /* where on the old run the nearest place is */
    uint32_t *edges;
    uint32_t *seams; /* seam edges at each vertex */
    bool *open;      /* edge_count: edges that the new path may take */
} stretch;

static ktg_status take_memory(ktg_context *context, stretch *s) {
    const uint32_t count = s->sheet->mesh->vertex_count;
    s->on = ktg_new(context, count, bool);
    s->from = ktg_new(context, count, bool);
    s->to = ktg_new(context, count, bool);
    s->forbidden = ktg_new(context, count, bool);
    s->distance = ktg_new(context, count, double);
    s->via = ktg_new(context, count, uint32_t);
    s->along = ktg_new(context, count, double);
    s->edges = ktg_new(context, count, uint32_t);
    s->seams = ktg_new(context, count, uint32_t);
    s->open = ktg_new(context, s->sheet->edge_count, bool);
    return s->on && s->from && s->to && s->forbidden && s->distance && s->via && s->along &&
                   s->edges && s->seams && s->open
               ? KTG_OK
               : KTG_MEMORY;
}

static void free_memory(stretch *s) {
    ktg_free(s->on);
    ktg_free(s->from);
    ktg_free(s->to);
    ktg_free(s->forbidden);
    ktg_free(s->distance);
    ktg_free(s->via);
    ktg_free(s->along);
    ktg_free(s->edges);
    ktg_free(s->seams);
    ktg_free(s->open);
}

static void set_edges(const stretch *s, const uint32_t *edges, uint32_t count, bool value) {
    for (uint32_t i = 0; i < count; i++)
        s->cut[edges[i]] = value;
}

static void count_seams(stretch *s) {
    memset(s->seams, 0, s->sheet->mesh->vertex_count * sizeof *s->seams);
    for (uint32_t e = 0; e < s->sheet->edge_count; e++)
        if (s->cut[e] && !ktg_sheet_is_border(s->sheet, e))
            for (int k = 0; k < 2; k++)
                s->seams[s->sheet->ends[2 * (size_t)e + k]]++;
}

/* Where the path may start (or end): the old end, and where that is the border and no other seam
 * ends there, the border nearby. */
static void set_ends(const stretch *s, uint32_t end, bool slides, bool *flags) {
    const ktg_vec3 *p = s->sheet->mesh->positions;
    memset(flags, 0, s->sheet->mesh->vertex_count * sizeof *flags);
    flags[end] = true;
    if (!slides || !s->sheet->border[end] || s->seams[end] > 0)
        return;
    for (uint32_t v = 0; v < s->sheet->mesh->vertex_count; v++)
        if (s->sheet->border[v] && s->seams[v] == 0 && s->distance[v] <= s->reach &&
            ktg_length3(ktg_sub3(p[v], p[end])) <= s->reach)
            flags[v] = true;
}

static bool ends_are_apart(const stretch *s) {
    for (uint32_t v = 0; v < s->sheet->mesh->vertex_count; v++)
        if (s->from[v] && s->to[v])
            return false;
    return true;
}

/* The old run itself: its vertices, and how far along it each lies. */
static void mark_old(stretch *s) {
    uint32_t v = s->ends[0];
    double along = 0;
    memset(s->on, 0, s->sheet->mesh->vertex_count * sizeof *s->on);
    s->on[v] = true;
    s->along[v] = 0;
    for (uint32_t i = 0; i < s->count; i++) {
        v = ktg_sheet_other_end(s->sheet, s->old[i], v);
        s->on[v] = true;
        s->along[v] = along += s->sheet->length[s->old[i]];
    }
}

/* Of a vertex within reach: by the way to the old run. */
static double find_along(const stretch *s, uint32_t v) {
    while (s->via[v] != KTG_NONE)
        v = ktg_sheet_other_end(s->sheet, s->via[v], v);
    return s->along[v];
}

/* Where the surface is thin, places that are far apart along the run are near each other: no way
 * leads from one to the other. */
static void open_edges(stretch *s) {
    const ktg_sheet *sheet = s->sheet;
    for (uint32_t e = 0; e < sheet->edge_count; e++) {
        uint32_t a = sheet->ends[2 * (size_t)e], b = sheet->ends[2 * (size_t)e + 1];
        s->open[e] = !ktg_sheet_is_border(sheet, e) && s->distance[a] <= s->reach &&
                     s->distance[b] <= s->reach &&
                     fabs(find_along(s, a) - find_along(s, b)) <= 2 * s->reach + sheet->length[e];
    }
}

static ktg_status find_corridor(ktg_context *context, stretch *s) {
    const ktg_sheet *sheet = s->sheet;
    mark_old(s);
    KTG_TRY(ktg_path_distances(context, sheet, sheet->length, s->on, s->distance, s->via));
    open_edges(s);
    count_seams(s);
    for (uint32_t v = 0; v < sheet->mesh->vertex_count; v++)
        s->forbidden[v] = s->distance[v] > s->reach || sheet->border[v] || s->seams[v] > 0;
    for (int slides = 1; slides >= 0; slides--) {
        set_ends(s, s->ends[0], slides, s->from);
        set_ends(s, s->ends[1], slides, s->to);
        if (ends_are_apart(s))
            break;
    }
    return KTG_OK;
}

/* ---- the line that edges should follow ----------------------------------------------------- */

void ktg_line_smooth(ktg_vec3 *points, uint32_t count) {
    for (int round = 0; round < line_rounds; round++) {
        ktg_vec3 before = points[0];
        for (uint32_t i = 1; i + 1 < count; i++) {
            ktg_vec3 here = points[i];
            ktg_vec3 middle = ktg_mul3(ktg_add3(before, points[i + 1]), 0.5);
            points[i] = ktg_mul3(ktg_add3(here, middle), 0.5);
            before = here;
        }
    }
}

static double distance_from_line(ktg_vec3 p, const ktg_vec3 *points, uint32_t count) {
    double least = INFINITY;
    for (uint32_t i = 0; i + 1 < count; i++) {
        ktg_vec3 along = ktg_sub3(points[i + 1], points[i]), from = ktg_sub3(p, points[i]);
        double t = ktg_dot3(from, along) / ktg_max(1e-300, ktg_dot3(along, along));
        ktg_vec3 away = ktg_madd3(from, -ktg_max(0, ktg_min(1, t)), along);
        least = ktg_min(least, ktg_dot3(away, away));
    }
    return sqrt(least);
}

/* Edges cost more the further from the line they run. Of no account where the path may not go. */
static void set_line_cost(const stretch *s, const ktg_vec3 *points, uint32_t count, double *away,
                          double *cost) {
    const ktg_sheet *sheet = s->sheet;
    for (uint32_t v = 0; v < sheet->mesh->vertex_count; v++)
        away[v] = s->forbidden[v] && !s->from[v] && !s->to[v]
                      ? INFINITY
                      : distance_from_line(sheet->mesh->positions[v], points, count);
    for (uint32_t e = 0; e < sheet->edge_count; e++) {
        double mean = (away[sheet->ends[2 * (size_t)e]] + away[sheet->ends[2 * (size_t)e + 1]]) / 2;
        double edges = ktg_min(1e3, mean / sheet->mean_edge);
        cost[e] = ktg_sheet_is_crease(sheet, e) ? sheet->cost[e]
                                                : sheet->length[e] * (1 + 4 * edges * edges);
    }
}

/* Fills the points of a path; *end: its last vertex. */
static void list_points(const ktg_sheet *sheet, const uint32_t *edges, uint32_t count,
                        uint32_t start, ktg_vec3 *points, uint32_t *end) {
    points[0] = sheet->mesh->positions[start];
    for (uint32_t i = 0; i < count; i++) {
        start = ktg_sheet_other_end(sheet, edges[i], start);
        points[i + 1] = sheet->mesh->positions[start];
    }
    *end = start;
}

/* The first vertex of a path of at least one edge. */
static uint32_t path_start(const stretch *s, uint32_t count) {
    const uint32_t *first = s->sheet->ends + 2 * (size_t)s->edges[0];
    if (count == 1)
        return s->from[first[0]] ? first[0] : first[1];
    const uint32_t *second = s->sheet->ends + 2 * (size_t)s->edges[1];
    return first[0] == second[0] || first[0] == second[1] ? first[1] : first[0];
}

static ktg_status follow_line(ktg_context *context, stretch *s, ktg_vec3 *points, double *away,
                              double *cost, uint32_t *count) {
    uint32_t start = path_start(s, *count), end;
    list_points(s->sheet, s->edges, *count, start, points, &end);
    ktg_line_smooth(points, *count + 1);
    memset(s->from, 0, s->sheet->mesh->vertex_count * sizeof *s->from);
    memset(s->to, 0, s->sheet->mesh->vertex_count * sizeof *s->to);
    s->from[start] = s->to[end] = true;
    set_line_cost(s, points, *count + 1, away, cost);
    ktg_path_query query = {.sheet = s->sheet,
                            .cost = cost,
                            .from = s->from,
                            .to = s->to,
                            .forbidden = s->forbidden,
                            .edges_only = s->open,
                            .straight_on = KTG_NONE};
    return ktg_path_find(context, &query, s->edges, count);
}

/* A path by edges alone has few bends but far ones; what it means is the smooth line along it, and
 * that is followed closely. */
static ktg_status straighten(ktg_context *context, stretch *s, uint32_t *count) {
    if (*count < 3)
        return KTG_OK;
    ktg_vec3 *points = ktg_new(context, (size_t)*count + 1, ktg_vec3);
    double *away = ktg_new(context, s->sheet->mesh->vertex_count, double);
    double *cost = ktg_new(context, s->sheet->edge_count, double);
    ktg_status status = KTG_MEMORY;
    if (points && away && cost)
        status = follow_line(context, s, points, away, cost, count);
    ktg_free(points);
    ktg_free(away);
    ktg_free(cost);
    return status;
}

/* The old edges are out of `cut` meanwhile. */
static ktg_status lead_anew(ktg_context *context, stretch *s, uint32_t *count) {
    *count = 0;
    KTG_TRY(find_corridor(context, s));
    if (s->ends[0] == s->ends[1])
        return KTG_OK;
    ktg_path_query query = {.sheet = s->sheet,
                            .cost = s->cost,
                            .from = s->from,
                            .to = s->to,
                            .forbidden = s->forbidden,
                            .edges_only = s->open,
                            .straight_on = KTG_NONE};
    KTG_TRY(ktg_path_find(context, &query, s->edges, count));
    return straighten(context, s, count);
}

static ktg_status smooth_stretch(ktg_context *context, stretch *s) {
    uint32_t count = 0;
    KTG_TRY(ktg_check_cancel(context));
    set_edges(s, s->old, s->count, false);
    ktg_status status = take_memory(context, s);
    if (status == KTG_OK)
        status = lead_anew(context, s, &count);
    bool found = status == KTG_OK && count > 0;
    set_edges(s, found ? s->edges : s->old, found ? count : s->count, true);
    free_memory(s);
    return status;
}

/* The vertex between edges i - 1 and i of a run. */
static uint32_t vertex_at(const ktg_sheet *sheet, const uint32_t *edges, uint32_t start,
                          uint32_t i) {
    uint32_t v = start;
    for (uint32_t k = 0; k < i; k++)
        v = ktg_sheet_other_end(sheet, edges[k], v);
    return v;
}

/* What comes back to its start is led anew half by half. */
ktg_status ktg_chain_smooth(ktg_context *context, const ktg_sheet *sheet, const double *cost,
                            const ktg_chains *chains, uint32_t chain, bool *cut) {
    const ktg_chain *c = &chains->chains[chain];
    const uint32_t *edges = chains->edges + c->first;
    uint32_t middle = c->ends[0] == c->ends[1] ? c->count / 2 : c->count;
    stretch s = {.sheet = sheet, .cost = cost, .cut = cut, .old = edges, .count = middle};
    s.reach = ktg_max(reach_edges * sheet->mean_edge,
                      ktg_min(reach_length * c->length, reach_extent * sqrt(sheet->area)));
    s.ends[0] = c->ends[0];
    s.ends[1] = vertex_at(sheet, edges, c->ends[0], middle);
    if (middle > 0)
        KTG_TRY(smooth_stretch(context, &s));
    if (middle == c->count)
        return KTG_OK;
    stretch rest = {.sheet = sheet, .cost = cost, .cut = cut, .reach = s.reach};
    rest.old = edges + middle;
    rest.count = c->count - middle;
    rest.ends[0] = s.ends[1];
    rest.ends[1] = c->ends[1];
    return smooth_stretch(context, &rest);
}

ktg_status ktg_seams_smooth(ktg_context *context, const ktg_sheet *sheet, const double *cost,
                            const bool *fixed, bool *cut) {
    for (int round = 0; round < 2; round++) {
        ktg_chains chains;
        KTG_TRY(ktg_chains_find(context, sheet, cut, fixed, &chains));
        ktg_status status = KTG_OK;
        for (uint32_t c = 0; status == KTG_OK && c < chains.count; c++)
            status = ktg_chain_smooth(context, sheet, cost, &chains, c, cut);
        ktg_chains_free(&chains);
        KTG_TRY(status);
    }
    return KTG_OK;
}
