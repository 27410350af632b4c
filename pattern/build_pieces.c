/* pattern/build_pieces.c - the pieces of a part: which is closed first, and how they are joined.
 *
 * Pieces are taken from the farthest on. A piece hangs at those taken before that it touches, and
 * makes one body of theirs: a tree again, in which a limb of several pieces is whole before the
 * piece of the trunk that it is joined to. */
#include "pattern/build_order.h"

#include "core/memory.h"

#include <stdlib.h>

typedef struct placed {
    double far;
    uint32_t piece;
} placed;

typedef struct assembly {
    ktg_build *b;
    uint32_t part, count;
    placed *places;   /* count: the pieces, the farthest first, the last one last */
    uint32_t *rank;   /* piece_count: where in places, of this part's pieces */
    uint32_t *body;   /* count: sets of places, by their last one */
    uint32_t *parent; /* count: the place a body is joined to */
    uint32_t *order;  /* count: places as they are built */
    uint32_t *joints; /* the seams of a piece with what is built */
    uint32_t *seams;  /* the seams of a piece with others, as they follow each other */
    bool *is_listed;  /* seam_count */
} assembly;           /* with room for all pieces */

static int farther_first(const void *left, const void *right) {
    const placed *a = left, *b = right;
    if (a->far != b->far)
        return a->far > b->far ? -1 : 1;
    return (a->piece > b->piece) - (a->piece < b->piece);
}

/* The mean over its corners. */
static double far_of(const ktg_build *b, uint32_t piece) {
    const ktg_pattern_piece *p = &b->pattern->pieces[piece];
    double sum = 0;
    for (size_t i = 0; i < 3 * p->face_count; i++)
        sum += b->far[b->pattern->faces[3 * (size_t)p->faces[i / 3] + i % 3]];
    return sum / (3 * (double)p->face_count);
}

static void sort_places(assembly *a) {
    const ktg_build *b = a->b;
    for (uint32_t i = 0; i < a->count; i++) {
        uint32_t piece = b->pieces.items[b->pieces.first[a->part] + i];
        a->places[i] = (placed){piece == b->last_piece ? -1 : far_of(b, piece), piece};
    }
    qsort(a->places, a->count, sizeof *a->places, farther_first);
    for (uint32_t i = 0; i < a->count; i++)
        a->rank[a->places[i].piece] = i;
}

/* The root of a set is its last place: all hang at that. */
static uint32_t body_of(const assembly *a, uint32_t place) {
    while (a->body[place] != place)
        place = a->body[place] = a->body[a->body[place]];
    return place;
}

/* The place on the other side of a border half-edge of `place`; KTG_NONE where there is none. */
static uint32_t beyond(const assembly *a, uint32_t h) {
    uint32_t mate = ktg_mate(a->b->topology, h);
    return mate == KTG_NONE ? KTG_NONE : a->rank[a->b->topology->piece_of[mate / 3]];
}

static void find_tree(assembly *a) {
    const ktg_topology *t = a->b->topology;
    for (uint32_t i = 0; i < a->count; i++) {
        uint32_t piece = a->places[i].piece;
        a->body[i] = i;
        a->parent[i] = KTG_NONE;
        for (uint32_t k = t->border_first[piece]; k < t->border_first[piece + 1]; k++) {
            uint32_t other = beyond(a, t->border[k]);
            if (other == KTG_NONE || other >= i)
                continue;
            uint32_t body = body_of(a, other);
            if (body != i)
                a->parent[body] = a->body[body] = i;
        }
    }
}

/* Children before parents, the farthest first; `stack` has room for all places. A place's children
 * are pushed the nearest first. */
static ktg_status find_order(assembly *a) {
    ktg_groups children = {NULL, NULL};
    uint32_t *stack = ktg_new(a->b->context, a->count, uint32_t), count = 0, written = a->count;
    ktg_status status =
        stack ? ktg_groups_fill(a->b->context, a->parent, a->count, a->count, &children)
              : KTG_MEMORY;
    /* Backwards, this is parent first, then the nearest child with all it has. */
    if (status == KTG_OK)
        stack[count++] = a->count - 1;
    while (count > 0) {
        uint32_t place = stack[--count];
        a->order[--written] = place;
        for (uint32_t k = children.first[place]; k < children.first[place + 1]; k++)
            stack[count++] = children.items[k];
    }
    ktg_groups_drop(&children);
    ktg_free(stack);
    return status;
}

/* ---- joints ------------------------------------------------------------------------------- */

/* The seams of a piece with others, each once, as they follow each other along its border. */
static uint32_t list_seams(assembly *a, uint32_t piece) {
    const ktg_topology *t = a->b->topology;
    uint32_t count = 0;
    for (uint32_t k = t->border_first[piece]; k < t->border_first[piece + 1]; k++) {
        uint32_t seam = ktg_edge_at(t, t->border[k])->seam;
        if (seam == KTG_NONE || a->is_listed[seam])
            continue;
        const ktg_pattern_seam *s = &a->b->pattern->seams[seam];
        if (s->pieces[0] == s->pieces[1])
            continue;
        a->is_listed[seam] = true;
        a->seams[count++] = seam;
    }
    for (uint32_t i = 0; i < count; i++)
        a->is_listed[a->seams[i]] = false;
    return count;
}

/* The place with which a seam joins the piece. */
static uint32_t partner(const assembly *a, uint32_t seam, uint32_t piece) {
    const ktg_pattern_seam *s = &a->b->pattern->seams[seam];
    return a->rank[s->pieces[s->pieces[0] == piece]];
}

/* True when the seam joins the piece with the body that was finished as `child`. */
static bool joins(const assembly *a, uint32_t seam, uint32_t piece, uint32_t child) {
    uint32_t place = partner(a, seam, piece), at = a->rank[piece];
    if (place >= at)
        return false;
    while (place != child && a->parent[place] != KTG_NONE && a->parent[place] <= child)
        place = a->parent[place];
    return place == child;
}

/* Where to begin along the border: behind a gap, else at the seam farthest away. */
static uint32_t find_start(const assembly *a, uint32_t count, uint32_t piece, uint32_t child) {
    uint32_t farthest = 0;
    double far = -1;
    for (uint32_t i = 0; i < count; i++) {
        if (!joins(a, a->seams[i], piece, child))
            continue;
        if (!joins(a, a->seams[(i + count - 1) % count], piece, child))
            return i;
        double at = a->b->far[ktg_seam_begin(a->b->pattern, a->seams[i])];
        if (at > far) {
            far = at;
            farthest = i;
        }
    }
    return farthest;
}

/* Appends the seams with one body, those that close the part excepted. */
static uint32_t list_joints(assembly *a, uint32_t count, uint32_t piece, uint32_t child,
                            uint32_t joint_count) {
    uint32_t start = find_start(a, count, piece, child);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t seam = a->seams[(start + i) % count];
        if (joins(a, seam, piece, child) && !ktg_build_is_closing(a->b, seam))
            a->joints[joint_count++] = seam;
    }
    return joint_count;
}

/* The seams that join a piece to the bodies that hang at it, body after body. */
static uint32_t find_joints(assembly *a, uint32_t place) {
    uint32_t piece = a->places[place].piece, count = list_seams(a, piece), joint_count = 0;
    for (uint32_t child = 0; count > 0 && child < place; child++)
        if (a->parent[child] == place)
            joint_count = list_joints(a, count, piece, child, joint_count);
    return joint_count;
}

/* ---- the part ----------------------------------------------------------------------------- */

/* What a chain has gathered stays with what follows only where that hangs at it. */
static void settle(assembly *a, uint32_t before, uint32_t place, ktg_chain *chain) {
    if (before != KTG_NONE && a->parent[before] != place)
        ktg_chain_flush(a->b, chain);
}

static ktg_status build_place(assembly *a, uint32_t place, ktg_chain *chain) {
    ktg_build *b = a->b;
    KTG_TRY(ktg_build_piece(b, a->places[place].piece, chain));
    uint32_t count = find_joints(a, place);
    if (chain->weight + 3 * count >= 2 * b->least && 2 * chain->weight >= b->least)
        ktg_chain_flush(b, chain);
    for (uint32_t i = 0; i < count; i++) {
        ktg_chain_add(b, chain, a->joints[i]);
        if (chain->weight >= 2 * b->least)
            ktg_chain_flush(b, chain);
    }
    if (chain->weight >= b->least)
        ktg_chain_flush(b, chain);
    return KTG_OK;
}

static ktg_status build_places(assembly *a) {
    ktg_build *b = a->b;
    ktg_chain chain = KTG_EMPTY_CHAIN;
    uint32_t first_section = b->section_count;
    for (uint32_t i = 0; i < a->count; i++) {
        settle(a, i > 0 ? a->order[i - 1] : KTG_NONE, a->order[i], &chain);
        KTG_TRY(build_place(a, a->order[i], &chain));
    }
    if (chain.weight + 3 * b->closing_count > 2 * b->least)
        ktg_chain_flush(b, &chain);
    for (uint32_t k = 0; k < b->closing_count; k++) {
        b->is_last[b->closing[k]] = true;
        ktg_chain_add(b, &chain, b->closing[k]);
    }
    ktg_chain_flush(b, &chain);
    ktg_chain_end(b, &chain, first_section);
    return KTG_OK;
}

static ktg_status build_part(assembly *a, uint32_t part) {
    ktg_build *b = a->b;
    if (b->seams.first[part] == b->seams.first[part + 1])
        return KTG_OK;
    ktg_build_find_closing(b, part);
    KTG_TRY(ktg_build_find_far(b, part));
    if (b->is_open)
        b->closing_count = 0;
    a->part = part;
    a->count = b->pieces.first[part + 1] - b->pieces.first[part];
    sort_places(a);
    find_tree(a);
    KTG_TRY(find_order(a));
    return build_places(a);
}

static ktg_status make_room(assembly *a) {
    ktg_context *context = a->b->context;
    size_t pieces = a->b->pattern->piece_count, seams = a->b->pattern->seam_count;
    a->places = ktg_new(context, pieces, placed);
    a->rank = ktg_new(context, pieces, uint32_t);
    a->body = ktg_new(context, pieces, uint32_t);
    a->parent = ktg_new(context, pieces, uint32_t);
    a->order = ktg_new(context, pieces, uint32_t);
    a->joints = ktg_new(context, seams, uint32_t);
    a->seams = ktg_new(context, seams, uint32_t);
    a->is_listed = ktg_new(context, seams, bool);
    return a->places && a->rank && a->body && a->parent && a->order && a->joints && a->seams &&
                   a->is_listed
               ? KTG_OK
               : KTG_MEMORY;
}

ktg_status ktg_build_parts(ktg_build *b) {
    assembly a = {.b = b};
    ktg_status status = make_room(&a);
    for (uint32_t part = 0; status == KTG_OK && part < b->part_count; part++)
        status = build_part(&a, part);
    ktg_free(a.places);
    ktg_free(a.rank);
    ktg_free(a.body);
    ktg_free(a.parent);
    ktg_free(a.order);
    ktg_free(a.joints);
    ktg_free(a.seams);
    ktg_free(a.is_listed);
    return status;
}
