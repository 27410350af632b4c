/* deform/bodies.c - vertices that move as one body (elimination instead of the paper's weights).
 *
 * Fixed regions, handles, rigid features and vertex-vertex links all say "these move as one": they
 * are joined by union-find, and a body then has one turn, one position and one scale. So they hold
 * to rounding, and there is no weight that means something else in another unit. */
#include "core/memory.h"
#include "core/sets.h"
#include "deform/solver.h"

#include <stdio.h>

static const char *kind_name(ktg_hold_kind kind) {
    static const char *const names[] = {"fixed", "handle", "rigid", "resize"};
    return names[kind];
}

static const char *shown(const char *name) {
    return name ? name : "";
}

/* "[handle wrist] (line 12)", for messages. */
static const char *tell(const ktg_hold *hold, char text[128]) {
    if (hold->line > 0)
        snprintf(text, 128, "[%s %.80s] (line %llu)", kind_name(hold->kind), shown(hold->name),
                 (unsigned long long)hold->line);
    else
        snprintf(text, 128, "[%s %.80s]", kind_name(hold->kind), shown(hold->name));
    return text;
}

static bool moves_alike(const ktg_edit *edit, uint32_t a, uint32_t b) {
    return a == b || a == KTG_NONE || b == KTG_NONE ||
           (edit->holds[a].kind == KTG_HOLD_FIXED && edit->holds[b].kind == KTG_HOLD_FIXED);
}

static bool sized_alike(const ktg_edit *edit, uint32_t a, uint32_t b) {
    return a == KTG_NONE || b == KTG_NONE || edit->holds[a].scale == edit->holds[b].scale;
}

static ktg_status two_ways(ktg_context *context, const ktg_frame *frame, uint32_t a, uint32_t b,
                           uint32_t vertex, const char *why, uint64_t line) {
    char one[128], other[128];
    const ktg_hold *holds = frame->edit->holds;
    const char *what = holds[a].kind == KTG_HOLD_RESIZE ? "give two sizes to" : "move";
    return ktg_edit_fail(context, frame->edit->file, line,
                         "%s and %s both %s vertex %u%s: take it out of one of them (sub), or move "
                         "them alike",
                         tell(&holds[a], one), tell(&holds[b], other), what, vertex + 1, why);
}

ktg_status ktg_bodies_join(ktg_context *context, const ktg_frame *frame, ktg_bodies *bodies,
                           uint32_t a, uint32_t b, const char *kind, const char *name,
                           uint64_t line) {
    uint32_t x = ktg_set_of(bodies->parent, a), y = ktg_set_of(bodies->parent, b);
    if (x == y)
        return KTG_OK;
    char why[160];
    snprintf(why, sizeof why, ", or what [%s %.80s] makes one body with it", kind, shown(name));
    if (!moves_alike(frame->edit, bodies->hold[x], bodies->hold[y]))
        return two_ways(context, frame, bodies->hold[x], bodies->hold[y], a, why, line);
    if (!sized_alike(frame->edit, bodies->sized[x], bodies->sized[y]))
        return two_ways(context, frame, bodies->sized[x], bodies->sized[y], a, why, line);
    ktg_set_join(bodies->parent, x, y);
    uint32_t root = x < y ? x : y, gone = x < y ? y : x;
    bodies->size[root] += bodies->size[gone];
    if (bodies->hold[root] == KTG_NONE)
        bodies->hold[root] = bodies->hold[gone];
    if (bodies->sized[root] == KTG_NONE)
        bodies->sized[root] = bodies->sized[gone];
    return KTG_OK;
}

/* ---- holds ---------------------------------------------------------------------------------- */

static ktg_status check_hold(ktg_context *context, const ktg_frame *frame, const ktg_hold *hold) {
    char text[128];
    const ktg_edit *edit = frame->edit;
    if (hold->vertex_count == 0)
        return ktg_edit_fail(context, edit->file, hold->line, "%s takes hold of no vertex",
                             tell(hold, text));
    for (uint32_t i = 0; i < hold->vertex_count; i++)
        if (hold->vertices[i] >= frame->mesh->vertex_count)
            return ktg_fail(context, KTG_ARGUMENT, "%s: there is no vertex %u", tell(hold, text),
                            hold->vertices[i] + 1);
    if (hold->kind == KTG_HOLD_RESIZE && !(hold->scale >= 0 && isfinite(hold->scale)))
        return ktg_edit_fail(context, edit->file, hold->line, "%s: a scale of %g makes no sense",
                             tell(hold, text), hold->scale);
    return KTG_OK;
}

/* All vertices of a hold that moves them; those of all fixed ones are one body. */
static ktg_status take_moved(ktg_context *context, const ktg_frame *frame, ktg_bodies *bodies,
                             uint32_t number) {
    const ktg_hold *hold = &frame->edit->holds[number];
    for (uint32_t i = 0; i < hold->vertex_count; i++) {
        uint32_t v = hold->vertices[i], root = ktg_set_of(bodies->parent, v);
        if (!moves_alike(frame->edit, bodies->hold[root], number))
            return two_ways(context, frame, bodies->hold[root], number, v, "", hold->line);
        if (bodies->hold[root] == KTG_NONE)
            bodies->hold[root] = number;
        KTG_TRY(ktg_bodies_join(context, frame, bodies, hold->vertices[0], v, kind_name(hold->kind),
                                hold->name, hold->line));
    }
    return KTG_OK;
}

/* Joins what hangs together by edges within the hold; *edges counts them. */
static ktg_status join_by_edges(ktg_context *context, const ktg_frame *frame, ktg_bodies *bodies,
                                const ktg_hold *hold, const bool *inside, uint32_t *edges) {
    for (uint32_t e = 0; e < frame->adjacency->edge_count; e++) {
        uint32_t ends[2];
        ktg_edge_ends(frame->mesh, frame->adjacency, e, ends);
        if (!inside[ends[0]] || !inside[ends[1]])
            continue;
        ++*edges;
        KTG_TRY(ktg_bodies_join(context, frame, bodies, ends[0], ends[1], kind_name(hold->kind),
                                hold->name, hold->line));
    }
    return KTG_OK;
}

static ktg_status take_shape(ktg_context *context, const ktg_frame *frame, ktg_bodies *bodies,
                             const ktg_hold *hold, bool *inside) {
    char text[128];
    uint32_t edges = 0;
    for (uint32_t i = 0; i < hold->vertex_count; i++) {
        inside[hold->vertices[i]] = true;
        if (hold->together)
            KTG_TRY(ktg_bodies_join(context, frame, bodies, hold->vertices[0], hold->vertices[i],
                                    kind_name(hold->kind), hold->name, hold->line));
    }
    ktg_status status = join_by_edges(context, frame, bodies, hold, inside, &edges);
    for (uint32_t i = 0; i < hold->vertex_count; i++)
        inside[hold->vertices[i]] = false;
    if (status == KTG_OK && edges == 0 && !(hold->together && hold->vertex_count > 1))
        return ktg_edit_fail(context, frame->edit->file, hold->line,
                             "%s has no edge between its vertices, so it keeps nothing in shape; "
                             "together = yes makes them one body",
                             tell(hold, text));
    return status;
}

/* The scale of a resized hold, to the bodies its vertices are in. */
static ktg_status take_size(ktg_context *context, const ktg_frame *frame, ktg_bodies *bodies,
                            uint32_t number) {
    const ktg_hold *hold = &frame->edit->holds[number];
    for (uint32_t i = 0; i < hold->vertex_count; i++) {
        uint32_t root = ktg_set_of(bodies->parent, hold->vertices[i]);
        if (!sized_alike(frame->edit, bodies->sized[root], number))
            return two_ways(context, frame, bodies->sized[root], number, hold->vertices[i], "",
                            hold->line);
        if (bodies->sized[root] == KTG_NONE)
            bodies->sized[root] = number;
    }
    return KTG_OK;
}

/* What moves first, so that a conflict names two sections that move. */
static ktg_status take_holds(ktg_context *context, const ktg_frame *frame, ktg_bodies *bodies,
                             bool *inside) {
    const ktg_edit *edit = frame->edit;
    for (uint32_t h = 0; h < edit->hold_count; h++) {
        KTG_TRY(check_hold(context, frame, &edit->holds[h]));
        if (edit->holds[h].kind <= KTG_HOLD_HANDLE)
            KTG_TRY(take_moved(context, frame, bodies, h));
    }
    for (uint32_t h = 0; h < edit->hold_count; h++) {
        if (edit->holds[h].kind >= KTG_HOLD_RIGID)
            KTG_TRY(take_shape(context, frame, bodies, &edit->holds[h], inside));
        if (edit->holds[h].kind == KTG_HOLD_RESIZE)
            KTG_TRY(take_size(context, frame, bodies, h));
    }
    return KTG_OK;
}

/* ---- pivots --------------------------------------------------------------------------------- */

/* The vertex of a resized body that is held; more than one cannot keep their distance. */
static ktg_status find_pivots(ktg_context *context, const ktg_frame *frame, ktg_bodies *bodies) {
    char one[128], other[128];
    for (uint32_t v = 0; v < frame->mesh->vertex_count; v++)
        bodies->pivot[v] = ktg_set_of(bodies->parent, v) == v ? v : KTG_NONE;
    for (uint32_t h = 0; h < frame->edit->hold_count; h++) {
        const ktg_hold *hold = &frame->edit->holds[h];
        for (uint32_t i = 0; hold->kind <= KTG_HOLD_HANDLE && i < hold->vertex_count; i++) {
            uint32_t v = hold->vertices[i], root = ktg_set_of(bodies->parent, v);
            uint32_t sized = bodies->sized[root];
            if (sized == KTG_NONE || frame->edit->holds[sized].scale == 1)
                continue;
            if (bodies->held[root] && bodies->pivot[root] != v)
                return ktg_edit_fail(
                    context, frame->edit->file, hold->line,
                    "%s holds more than one vertex of %s, which cannot keep their distance: hold "
                    "one, about which it is resized, or none",
                    tell(hold, one), tell(&frame->edit->holds[sized], other));
            bodies->held[root] = true;
            bodies->pivot[root] = v;
        }
    }
    return KTG_OK;
}

/* ---- the whole ------------------------------------------------------------------------------ */

static ktg_status fill(ktg_context *context, const ktg_frame *frame, ktg_bodies *bodies,
                       bool *inside) {
    uint32_t count = bodies->vertex_count = frame->mesh->vertex_count;
    bodies->parent = ktg_new(context, count, uint32_t);
    bodies->hold = ktg_new(context, count, uint32_t);
    bodies->sized = ktg_new(context, count, uint32_t);
    bodies->size = ktg_new(context, count, uint32_t);
    bodies->pivot = ktg_new(context, count, uint32_t);
    bodies->follows = ktg_new(context, count, bool);
    bodies->held = ktg_new(context, count, bool);
    if (!bodies->parent || !bodies->hold || !bodies->sized || !bodies->size || !bodies->pivot ||
        !bodies->follows || !bodies->held)
        return KTG_MEMORY;
    for (uint32_t v = 0; v < count; v++) {
        bodies->parent[v] = v;
        bodies->hold[v] = bodies->sized[v] = KTG_NONE;
        bodies->size[v] = 1;
    }
    KTG_TRY(take_holds(context, frame, bodies, inside));
    KTG_TRY(ktg_links_find(context, frame, bodies));
    return find_pivots(context, frame, bodies);
}

ktg_status ktg_bodies_new(ktg_context *context, const ktg_frame *frame, ktg_bodies **bodies) {
    bool *inside = ktg_new(context, frame->mesh->vertex_count, bool);
    *bodies = inside ? ktg_new(context, 1, ktg_bodies) : NULL;
    ktg_status status = *bodies ? fill(context, frame, *bodies, inside) : KTG_MEMORY;
    ktg_free(inside);
    if (status != KTG_OK)
        ktg_bodies_free(bodies);
    return status;
}

void ktg_bodies_free(ktg_bodies **bodies) {
    if (!bodies || !*bodies)
        return;
    ktg_bodies *old = *bodies;
    ktg_free(old->parent);
    ktg_free(old->hold);
    ktg_free(old->sized);
    ktg_free(old->size);
    ktg_free(old->pivot);
    ktg_free(old->follows);
    ktg_free(old->held);
    ktg_free(old->followers);
    ktg_free(old->pairs);
    ktg_free(old);
    *bodies = NULL;
}
