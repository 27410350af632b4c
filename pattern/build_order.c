/* pattern/build_order.c - the order in which the seams of a paper model are glued. */
#include "pattern/build_order.h"

#include "core/memory.h"
#include "core/sets.h"

#define NUMBERED_WEIGHT                                                                            \
    3 /* of a seam; one without a number, a narrow notch, is closed in passing */
#define NOTCH_WEIGHT  1
#define LEAST_SEAMS   7  /* of a step, which has up to twice as many; more ... */
#define MOST_SECTIONS 40 /* ... where there would be more steps than about so many */

uint32_t ktg_seam_begin(const ktg_pattern *pattern, uint32_t seam) {
    const ktg_pattern_seam *s = &pattern->seams[seam];
    return pattern->edges[s->edges[0]].vertices[s->first_side[0]];
}

uint32_t ktg_seam_end(const ktg_pattern *pattern, uint32_t seam) {
    const ktg_pattern_seam *s = &pattern->seams[seam];
    uint32_t last = s->edge_count - 1;
    return pattern->edges[s->edges[last]].vertices[1 - s->first_side[last]];
}

/* ---- chains ------------------------------------------------------------------------------- */

void ktg_chain_add(ktg_build *b, ktg_chain *chain, uint32_t seam) {
    bool obvious = b->pattern->seams[seam].obvious;
    ktg_chain one = {seam, seam, obvious ? NOTCH_WEIGHT : NUMBERED_WEIGHT, !obvious};
    b->next[seam] = KTG_NONE;
    ktg_chain_join(b, chain, &one);
}

void ktg_chain_join(ktg_build *b, ktg_chain *chain, ktg_chain *tail) {
    if (chain->first == KTG_NONE) {
        *chain = *tail;
    } else if (tail->first != KTG_NONE) {
        b->next[chain->last] = tail->first;
        *chain = (ktg_chain){chain->first, tail->last, chain->weight + tail->weight,
                             chain->numbered + tail->numbered};
    }
    *tail = KTG_EMPTY_CHAIN;
}

static void write_chain(ktg_build *b, ktg_chain *chain) {
    for (uint32_t seam = chain->first; seam != KTG_NONE; seam = b->next[seam]) {
        b->section_of[seam] = b->section_count;
        b->order[b->order_count++] = seam;
    }
    *chain = KTG_EMPTY_CHAIN;
}

void ktg_chain_flush(ktg_build *b, ktg_chain *chain) {
    if (chain->numbered == 0)
        return;
    b->section_count++;
    write_chain(b, chain);
}

void ktg_chain_end(ktg_build *b, ktg_chain *chain, uint32_t first_section) {
    if (chain->first != KTG_NONE && b->section_count == first_section)
        b->section_count++;
    write_chain(b, chain);
}

/* ---- tables ------------------------------------------------------------------------------- */

/* Pieces that hang together by seams become one part. */
static ktg_status find_parts(ktg_build *b) {
    const ktg_pattern *p = b->pattern;
    uint32_t *number = ktg_new(b->context, p->piece_count, uint32_t);
    if (!number)
        return KTG_MEMORY;
    for (uint32_t i = 0; i < p->piece_count; i++)
        b->part_of[i] = i;
    for (size_t s = 0; s < p->seam_count; s++)
        ktg_set_join(b->part_of, p->seams[s].pieces[0], p->seams[s].pieces[1]);
    for (uint32_t i = 0; i < p->piece_count; i++) /* the smallest piece stands for its set */
        if (ktg_set_of(b->part_of, i) == i)
            number[i] = b->part_count++;
    for (uint32_t i = 0; i < p->piece_count; i++)
        number[i] = number[ktg_set_of(b->part_of, i)];
    for (uint32_t i = 0; i < p->piece_count; i++)
        b->part_of[i] = number[i];
    ktg_free(number);
    return KTG_OK;
}

static ktg_status group_seams(ktg_build *b, uint32_t *keys) {
    const ktg_pattern *p = b->pattern;
    uint32_t seams = (uint32_t)p->seam_count, pieces = (uint32_t)p->piece_count;
    for (uint32_t s = 0; s < seams; s++)
        keys[s] = b->part_of[p->seams[s].pieces[0]];
    KTG_TRY(ktg_groups_fill(b->context, keys, seams, b->part_count, &b->seams));
    for (uint32_t s = 0; s < seams; s++)
        keys[s] = p->seams[s].pieces[0] == p->seams[s].pieces[1] ? p->seams[s].pieces[0] : KTG_NONE;
    KTG_TRY(ktg_groups_fill(b->context, keys, seams, pieces, &b->own));
    return ktg_groups_fill(b->context, b->part_of, pieces, b->part_count, &b->pieces);
}

static ktg_status group_edges(ktg_build *b, uint32_t *keys) {
    const ktg_pattern *p = b->pattern;
    uint32_t edges = (uint32_t)p->edge_count;
    for (uint32_t e = 0; e < edges; e++)
        keys[e] = b->part_of[p->edges[e].sides[0].piece];
    KTG_TRY(ktg_groups_fill(b->context, keys, edges, b->part_count, &b->edges));
    for (uint32_t e = 0; e < 2 * edges; e++)
        keys[e] = p->edges[e / 2].vertices[e % 2];
    return ktg_groups_fill(b->context, keys, 2 * edges, p->vertex_count, &b->edges_at);
}

/* Where a piece meets others or ends. */
static void mark_ground(ktg_build *b) {
    for (size_t e = 0; e < b->pattern->edge_count; e++) {
        const ktg_pattern_edge *edge = &b->pattern->edges[e];
        if (edge->side_count == 2 && edge->sides[0].piece == edge->sides[1].piece)
            continue;
        b->is_ground[edge->vertices[0]] = b->is_ground[edge->vertices[1]] = true;
    }
}

static ktg_status fill_tables(ktg_build *b) {
    const ktg_pattern *p = b->pattern;
    size_t most = 2 * p->edge_count > p->seam_count ? 2 * p->edge_count : p->seam_count;
    KTG_TRY(find_parts(b));
    uint32_t *keys = ktg_new(b->context, most, uint32_t);
    if (!keys)
        return KTG_MEMORY;
    ktg_status status = group_seams(b, keys);
    if (status == KTG_OK)
        status = group_edges(b, keys);
    ktg_free(keys);
    KTG_TRY(status);
    mark_ground(b);
    return ktg_build_find_patches(b);
}

static ktg_status make_room(ktg_build *b) {
    const ktg_pattern *p = b->pattern;
    b->part_of = ktg_new(b->context, p->piece_count, uint32_t);
    b->patch_of = ktg_new(b->context, p->face_count, uint32_t);
    b->patches = ktg_new(b->context, p->face_count, ktg_patch);
    b->far = ktg_new(b->context, p->vertex_count, double);
    b->is_ground = ktg_new(b->context, p->vertex_count, bool);
    b->next = ktg_new(b->context, p->seam_count, uint32_t);
    b->section_of = ktg_new(b->context, p->seam_count, uint32_t);
    b->order = ktg_new(b->context, p->seam_count, uint32_t);
    b->is_last = ktg_new(b->context, p->seam_count, bool);
    return b->part_of && b->patch_of && b->patches && b->far && b->is_ground && b->next &&
                   b->section_of && b->order && b->is_last
               ? KTG_OK
               : KTG_MEMORY;
}

static void drop(ktg_build *b) {
    ktg_groups *groups[] = {&b->pieces, &b->seams, &b->edges, &b->edges_at, &b->own};
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++)
        ktg_groups_drop(groups[i]);
    ktg_free(b->part_of);
    ktg_free(b->patch_of);
    ktg_free(b->patches);
    ktg_free(b->far);
    ktg_free(b->is_ground);
    ktg_free(b->next);
    ktg_free(b->section_of);
    ktg_free(b->order);
    ktg_free(b->is_last);
}

/* ---- the whole ---------------------------------------------------------------------------- */

/* Moves the seams to their places. */
static ktg_status renumber(ktg_build *b, ktg_pattern *pattern) {
    size_t count = pattern->seam_count, next = 0;
    ktg_pattern_seam *sorted = ktg_new(b->context, count, ktg_pattern_seam);
    if (!sorted)
        return KTG_MEMORY;
    for (int obvious = 0; obvious < 2; obvious++)
        for (size_t i = 0; i < count; i++)
            if (pattern->seams[b->order[i]].obvious == obvious) {
                sorted[next] = pattern->seams[b->order[i]];
                sorted[next].section = b->section_of[b->order[i]];
                sorted[next].closing = b->is_last[b->order[i]];
                sorted[next].number = (uint32_t)next + 1;
                next++;
            }
    ktg_free(pattern->seams);
    pattern->seams = sorted;
    for (size_t s = 0; s < count; s++)
        for (uint32_t k = 0; k < sorted[s].edge_count; k++)
            pattern->edges[sorted[s].edges[k]].seam = (uint32_t)s;
    return KTG_OK;
}

static uint32_t least_weight(const ktg_pattern *pattern) {
    uint32_t numbered = 0;
    for (size_t s = 0; s < pattern->seam_count; s++)
        numbered += !pattern->seams[s].obvious;
    uint32_t seams = (numbered + MOST_SECTIONS - 1) / MOST_SECTIONS;
    return NUMBERED_WEIGHT * (seams > LEAST_SEAMS ? seams : LEAST_SEAMS);
}

ktg_status ktg_build_order(ktg_context *context, const ktg_topology *topology, unsigned up,
                           ktg_pattern *pattern) {
    ktg_build b = {.context = context,
                   .topology = topology,
                   .pattern = pattern,
                   .up = up,
                   .least = least_weight(pattern)};
    ktg_status status = make_room(&b);
    if (status == KTG_OK)
        status = fill_tables(&b);
    if (status == KTG_OK)
        status = ktg_build_parts(&b);
    if (status == KTG_OK && b.order_count != pattern->seam_count)
        status =
            ktg_fail(context, KTG_INTERNAL, "only %u of %zu seams have a place in the building",
                     b.order_count, pattern->seam_count);
    if (status == KTG_OK)
        status = renumber(&b, pattern);
    drop(&b);
    return status;
}
