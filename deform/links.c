/* deform/links.c - virtual links between parts (section 3.1 of the paper): vertices in rigid pairs,
 * and vertices that follow an edge or a face.
 *
 * A vertex is in one pair of a link at most: were all linked to their nearest vertex, whole
 * stretches would become one body. */
#include "core/memory.h"
#include "core/sets.h"
#include "core/text.h"
#include "deform/nearest.h"
#include "deform/solver.h"

#include <stdio.h>
#include <stdlib.h>

/* Two vertices that could become a pair. */
typedef struct candidate {
    double distance;
    uint32_t from, to;
} candidate;

typedef struct finder {
    ktg_context *context;
    const ktg_frame *frame;
    ktg_bodies *bodies;
    const ktg_edit_link *link;
    double most;      /* normalised */
    bool within;      /* the sets overlap: links lie between different parts only */
    bool *is_to;      /* vertex_count */
    bool *taken;      /* vertex_count: in a pair of this link */
    uint32_t *number; /* vertex_count: its follower, from 1; 0: it follows nothing */
    uint32_t *stack;  /* vertex_count, for depends_on */
    uint32_t *seen;   /* vertex_count: the last question that came by */
    uint32_t question;
    ktg_near_item *items; /* to search among */
    uint32_t item_count;
    candidate *candidates; /* from_count */
    uint32_t found;        /* links of this section */
} finder;

static ktg_status link_fail(finder *f, const char *text) {
    return ktg_edit_fail(f->context, f->frame->edit->file, f->link->line, "[link %.80s] %s",
                         f->link->name ? f->link->name : "", text);
}

/* ---- making links --------------------------------------------------------------------------- */

/* Does the vertex, followed up along its masters, hang on `on`? */
static bool depends_on(finder *f, uint32_t vertex, uint32_t on) {
    size_t depth = 0;
    f->question++;
    f->stack[depth++] = vertex;
    while (depth > 0) {
        uint32_t v = f->stack[--depth];
        if (v == on)
            return true;
        if (f->number[v] == 0)
            continue;
        const ktg_follower *follower = &f->bodies->followers[f->number[v] - 1];
        for (int k = 0; k < 3 && follower->masters[k] != KTG_NONE; k++)
            if (f->seen[follower->masters[k]] != f->question) {
                f->seen[follower->masters[k]] = f->question;
                f->stack[depth++] = follower->masters[k];
            }
    }
    return false;
}

/* A vertex may follow others when nothing else says where it goes. */
static bool is_free(const finder *f, uint32_t vertex) {
    uint32_t root = ktg_set_of(f->bodies->parent, vertex);
    return !f->bodies->follows[vertex] && f->bodies->size[root] == 1 &&
           f->bodies->hold[root] == KTG_NONE;
}

static ktg_status add_follower(finder *f, const ktg_follower *wanted) {
    ktg_bodies *b = f->bodies;
    KTG_TRY(ktg_reserve(f->context, &b->followers, &b->follower_capacity,
                        (size_t)b->follower_count + 1));
    b->followers[b->follower_count++] = *wanted;
    f->number[wanted->vertex] = b->follower_count;
    b->follows[wanted->vertex] = true;
    f->found++;
    return KTG_OK;
}

static ktg_status follow_vertex(finder *f, uint32_t vertex, uint32_t master) {
    ktg_follower wanted = {vertex, {master, KTG_NONE, KTG_NONE}, {1, 0, 0}, {0, 0, 0}};
    if (depends_on(f, master, vertex)) {
        f->bodies->left_out++;
        f->found++;
        return KTG_OK;
    }
    return add_follower(f, &wanted);
}

static ktg_status add_pair(finder *f, uint32_t from, uint32_t to) {
    ktg_bodies *b = f->bodies;
    if (b->follows[to] && is_free(f, from))
        return follow_vertex(f, from, to);
    if (b->follows[from] && is_free(f, to))
        return follow_vertex(f, to, from);
    f->found++;
    if (b->follows[to] || b->follows[from]) {
        b->left_out++;
        return KTG_OK;
    }
    KTG_TRY(
        ktg_bodies_join(f->context, f->frame, b, from, to, "link", f->link->name, f->link->line));
    KTG_TRY(ktg_reserve(f->context, &b->pairs, &b->pair_capacity, (size_t)b->pair_count + 1));
    b->pairs[b->pair_count++] = (ktg_pair){from, to};
    return KTG_OK;
}

/* The vertex follows the point `hit`; what is part of a larger body already is paired instead. */
static ktg_status follow_point(finder *f, uint32_t vertex, const ktg_near_hit *hit) {
    const ktg_near_item *item = &f->items[hit->item];
    ktg_follower wanted = {vertex, {KTG_NONE, KTG_NONE, KTG_NONE}, {0}, {0, 0, 0}};
    uint32_t count = 0, heaviest = 0;
    bool circle = false;
    for (uint32_t k = 0; k < 3; k++) {
        if (!(hit->weights[k] > 0))
            continue;
        if (hit->weights[k] > hit->weights[heaviest])
            heaviest = k;
        circle |= depends_on(f, item->vertices[k], vertex);
        wanted.masters[count] = item->vertices[k];
        wanted.weights[count++] = hit->weights[k];
    }
    if (circle || f->bodies->follows[vertex]) {
        f->bodies->left_out++;
        f->found++;
        return KTG_OK;
    }
    if (!is_free(f, vertex))
        return add_pair(f, vertex, item->vertices[heaviest]);
    return add_follower(f, &wanted);
}

/* ---- searching ------------------------------------------------------------------------------ */

static void add_item(finder *f, uint32_t a, uint32_t b, uint32_t c) {
    f->items[f->item_count++] = (ktg_near_item){{a, b, c}, f->frame->component[a]};
}

static void list_vertices(finder *f) {
    f->item_count = 0;
    for (uint32_t i = 0; i < f->link->to_count; i++)
        if (f->frame->component[f->link->to[i]] != KTG_NONE)
            add_item(f, f->link->to[i], KTG_NONE, KTG_NONE);
}

static void list_edges(finder *f) {
    f->item_count = 0;
    for (uint32_t e = 0; e < f->frame->adjacency->edge_count; e++) {
        uint32_t ends[2];
        ktg_edge_ends(f->frame->mesh, f->frame->adjacency, e, ends);
        if (f->is_to[ends[0]] && f->is_to[ends[1]])
            add_item(f, ends[0], ends[1], KTG_NONE);
    }
}

static void list_faces(finder *f) {
    f->item_count = 0;
    for (size_t t = 0; t < f->frame->mesh->face_count; t++) {
        const uint32_t *c = f->frame->mesh->faces + 3 * t;
        if (f->is_to[c[0]] && f->is_to[c[1]] && f->is_to[c[2]])
            add_item(f, c[0], c[1], c[2]);
    }
}

static uint32_t part_to_skip(const finder *f, uint32_t vertex) {
    return f->within ? f->frame->component[vertex] : KTG_NONE;
}

static int by_distance(const void *left, const void *right) {
    const candidate *a = left, *b = right;
    if (a->distance != b->distance)
        return a->distance < b->distance ? -1 : 1;
    if (a->from != b->from)
        return a->from < b->from ? -1 : 1;
    return (a->to > b->to) - (a->to < b->to);
}

static ktg_status match(finder *f) {
    ktg_near *tree = NULL;
    uint32_t count = 0;
    list_vertices(f);
    KTG_TRY(ktg_near_new(f->context, f->frame->rest, f->items, f->item_count, &tree));
    for (uint32_t i = 0; i < f->link->from_count; i++) {
        uint32_t v = f->link->from[i];
        ktg_near_hit hit;
        if (f->frame->component[v] != KTG_NONE &&
            ktg_near_find(tree, v, f->most, part_to_skip(f, v), &hit))
            f->candidates[count++] = (candidate){hit.distance, v, f->items[hit.item].vertices[0]};
    }
    ktg_near_free(&tree);
    qsort(f->candidates, count, sizeof *f->candidates, by_distance);
    for (uint32_t i = 0; i < count; i++) {
        candidate c = f->candidates[i];
        if (f->taken[c.from] || f->taken[c.to])
            continue;
        f->taken[c.from] = f->taken[c.to] = true;
        KTG_TRY(add_pair(f, c.from, c.to));
    }
    return KTG_OK;
}

static ktg_status follow(finder *f) {
    ktg_near *tree = NULL;
    if (f->link->kind != KTG_LINK_EDGE)
        list_faces(f);
    if (f->link->kind == KTG_LINK_EDGE || (f->link->kind == KTG_LINK_AUTO && f->item_count == 0))
        list_edges(f);
    KTG_TRY(ktg_near_new(f->context, f->frame->rest, f->items, f->item_count, &tree));
    ktg_status status = KTG_OK;
    for (uint32_t i = 0; status == KTG_OK && i < f->link->from_count; i++) {
        uint32_t v = f->link->from[i];
        ktg_near_hit hit;
        if (!f->taken[v] && f->frame->component[v] != KTG_NONE &&
            ktg_near_find(tree, v, f->most, part_to_skip(f, v), &hit))
            status = follow_point(f, v, &hit);
    }
    ktg_near_free(&tree);
    return status;
}

/* ---- one section ---------------------------------------------------------------------------- */

static ktg_status check_link(finder *f) {
    const ktg_edit_link *link = f->link;
    uint32_t vertices = f->frame->mesh->vertex_count;
    if (link->from_count > vertices || link->to_count > vertices)
        return link_fail(f, "names a vertex twice");
    if (link->from_count == 0 || link->to_count == 0)
        return link_fail(f, "ties no vertices");
    if (!(link->most >= 0 && isfinite(link->most)))
        return link_fail(f, "wants a length for max");
    for (uint32_t i = 0; i < link->from_count; i++)
        if (link->from[i] >= vertices)
            return link_fail(f, "names a vertex that is not there");
    for (uint32_t i = 0; i < link->to_count; i++)
        if (link->to[i] >= vertices)
            return link_fail(f, "names a vertex that is not there");
    return KTG_OK;
}

/* How far off the nearest would have been. */
static ktg_status no_pair(finder *f) {
    ktg_near *tree = NULL;
    double least = INFINITY;
    char text[160] = "finds nothing to tie";
    list_vertices(f);
    KTG_TRY(ktg_near_new(f->context, f->frame->rest, f->items, f->item_count, &tree));
    for (uint32_t i = 0; i < f->link->from_count; i++) {
        ktg_near_hit hit;
        if (ktg_near_find(tree, f->link->from[i], INFINITY, part_to_skip(f, f->link->from[i]),
                          &hit))
            least = fmin(least, hit.distance);
    }
    ktg_near_free(&tree);
    if (isfinite(least))
        ktg_format(text, sizeof text,
                   "finds no pair within max = %g: the nearest two vertices are %g apart",
                   f->link->most, ldexp(least, f->frame->exponent));
    return link_fail(f, text);
}

static ktg_status find_link(finder *f) {
    const ktg_edit_link *link = f->link;
    KTG_TRY(check_link(f));
    f->most = ldexp(link->most, -f->frame->exponent);
    f->within = false;
    f->found = 0;
    for (uint32_t i = 0; i < link->to_count; i++)
        f->is_to[link->to[i]] = true;
    for (uint32_t i = 0; i < link->from_count; i++)
        f->within |= f->is_to[link->from[i]];
    ktg_free(f->candidates);
    f->candidates = ktg_new(f->context, link->from_count, candidate);
    if (!f->candidates)
        return KTG_MEMORY;
    if (link->kind == KTG_LINK_AUTO || link->kind == KTG_LINK_VERTEX)
        KTG_TRY(match(f));
    if (link->kind != KTG_LINK_VERTEX)
        KTG_TRY(follow(f));
    if (f->found == 0)
        return no_pair(f);
    for (uint32_t i = 0; i < link->to_count; i++)
        f->is_to[link->to[i]] = f->taken[link->to[i]] = false;
    for (uint32_t i = 0; i < link->from_count; i++)
        f->taken[link->from[i]] = false;
    return KTG_OK;
}

/* ---- the order of those who follow ---------------------------------------------------------- */

static void set_gaps(ktg_bodies *b, const ktg_vec3 *rest) {
    for (uint32_t i = 0; i < b->follower_count; i++) {
        ktg_follower *follower = &b->followers[i];
        follower->gap = rest[follower->vertex];
        for (int k = 0; k < 3 && follower->masters[k] != KTG_NONE; k++)
            follower->gap =
                ktg_madd3(follower->gap, -follower->weights[k], rest[follower->masters[k]]);
    }
}

/* Stable passes: whoever has no master left to be placed is placed. There are no circles. */
static ktg_status sort_followers(finder *f) {
    ktg_bodies *b = f->bodies;
    ktg_follower *sorted = ktg_new(f->context, b->follower_count, ktg_follower);
    bool *waits = ktg_new(f->context, b->vertex_count, bool);
    uint32_t placed = 0;
    ktg_status status = sorted && waits ? KTG_OK : KTG_MEMORY;
    for (uint32_t i = 0; status == KTG_OK && i < b->follower_count; i++)
        waits[b->followers[i].vertex] = true;
    while (status == KTG_OK && placed < b->follower_count)
        for (uint32_t i = 0; i < b->follower_count; i++) {
            const ktg_follower *follower = &b->followers[i];
            bool ready = waits[follower->vertex];
            for (int k = 0; k < 3 && follower->masters[k] != KTG_NONE; k++)
                ready = ready && !waits[follower->masters[k]];
            if (!ready)
                continue;
            waits[follower->vertex] = false;
            sorted[placed++] = *follower;
        }
    ktg_free(waits);
    if (status == KTG_OK) {
        ktg_free(b->followers);
        b->followers = sorted;
    } else {
        ktg_free(sorted);
    }
    return status;
}

/* ---- the whole ------------------------------------------------------------------------------ */

static ktg_status find_all(finder *f) {
    const ktg_frame *frame = f->frame;
    size_t vertices = frame->mesh->vertex_count, room = vertices + frame->adjacency->edge_count;
    if (room < frame->mesh->face_count)
        room = frame->mesh->face_count;
    f->is_to = ktg_new(f->context, vertices, bool);
    f->taken = ktg_new(f->context, vertices, bool);
    f->number = ktg_new(f->context, vertices, uint32_t);
    f->stack = ktg_new(f->context, vertices + 1, uint32_t);
    f->seen = ktg_new(f->context, vertices, uint32_t);
    f->items = ktg_new(f->context, room, ktg_near_item);
    if (!f->is_to || !f->taken || !f->number || !f->stack || !f->seen || !f->items)
        return KTG_MEMORY;
    for (size_t i = 0; i < frame->edit->link_count; i++) {
        f->link = &frame->edit->links[i];
        KTG_TRY(find_link(f));
    }
    set_gaps(f->bodies, frame->rest);
    return sort_followers(f);
}

ktg_status ktg_links_find(ktg_context *context, const ktg_frame *frame, ktg_bodies *bodies) {
    finder f = {.context = context, .frame = frame, .bodies = bodies};
    if (frame->edit->link_count == 0)
        return KTG_OK;
    ktg_status status = find_all(&f);
    ktg_free(f.is_to);
    ktg_free(f.taken);
    ktg_free(f.number);
    ktg_free(f.stack);
    ktg_free(f.seen);
    ktg_free(f.items);
    ktg_free(f.candidates);
    return status;
}
