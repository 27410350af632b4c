/* mesh/simplify_collapse.c - which edge is next: a heap of candidate collapses by quadric error.
 *
 * An edge is first tried at the position of least error, then at its ends; on a border only at its
 * ends, so that a border goes through vertices that it always had. A locked vertex stays where it
 * is. A candidate is out of
 * date when one of its vertices has changed since. When the heap runs dry before the target is
 * reached, all edges are tried again as long as that helps, then again with laxer shapes. */
#include "core/memory.h"
#include "mesh/simplify.h"

/* Built anew when this part of its faces is left. */
static const double stale_tree = 0.5;

static bool comes_before(const ktg_candidate *a, const ktg_candidate *b) {
    if (a->cost != b->cost)
        return a->cost < b->cost;
    if (a->to != b->to)
        return a->to < b->to;
    return a->from != b->from ? a->from < b->from : a->choice < b->choice;
}

static ktg_status push(ktg_simplify *s, const ktg_candidate *candidate) {
    KTG_TRY(ktg_reserve(s->context, &s->heap, &s->heap_capacity, s->heap_count + 1));
    size_t at = s->heap_count++;
    for (; at > 0 && comes_before(candidate, &s->heap[(at - 1) / 2]); at = (at - 1) / 2)
        s->heap[at] = s->heap[(at - 1) / 2];
    s->heap[at] = *candidate;
    return KTG_OK;
}

static ktg_candidate pop(ktg_simplify *s) {
    ktg_candidate top = s->heap[0], last = s->heap[--s->heap_count];
    size_t at = 0;
    for (size_t child; (child = 2 * at + 1) < s->heap_count; at = child) {
        if (child + 1 < s->heap_count && comes_before(&s->heap[child + 1], &s->heap[child]))
            child++;
        if (!comes_before(&s->heap[child], &last))
            break;
        s->heap[at] = s->heap[child];
    }
    s->heap[at] = last;
    return top;
}

static ktg_vec3 to_frame(const ktg_simplify *s, ktg_vec3 p) {
    return ktg_mul3(ktg_sub3(p, s->centre), s->scale);
}

static ktg_vec3 from_frame(const ktg_simplify *s, ktg_vec3 p) {
    return ktg_add3(ktg_mul3(p, 1 / s->scale), s->centre);
}

/* The normal of the surface at a vertex, of any length. */
static ktg_vec3 normal_at(const ktg_simplify *s, uint32_t vertex) {
    const uint32_t *faces;
    uint32_t count = ktg_halfedges_faces(s->halfedges, vertex, &faces);
    ktg_vec3 normal = {0, 0, 0};
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t *c = s->faces + 3 * (size_t)faces[i];
        ktg_vec3 p = to_frame(s, s->positions[c[0]]);
        ktg_vec3 u = ktg_sub3(to_frame(s, s->positions[c[1]]), p);
        ktg_vec3 v = ktg_sub3(to_frame(s, s->positions[c[2]]), p);
        normal = ktg_add3(normal, ktg_cross3(u, v));
    }
    return ktg_unit3(normal);
}

/* The position of least error, in the frame; false where there is none to choose from. A vertex of
 * a seam that others join keeps its place on the seam and only rises or sinks. */
static bool choose_best(const ktg_simplify *s, const ktg_candidate *c, const ktg_quadric *q,
                        ktg_vec3 *best) {
    ktg_vec3 a = to_frame(s, s->positions[c->from]), b = to_frame(s, s->positions[c->to]);
    ktg_vec3 middle = ktg_mul3(ktg_add3(a, b), 0.5);
    if (s->border[c->to] || s->locked[c->to])
        return false;
    bool found = ktg_simplify_bond(s, c->to) > ktg_simplify_bond(s, c->from)
                     ? ktg_quadric_least_along(q, b, normal_at(s, c->to), best)
                     : ktg_quadric_least(q, middle, best);
    return found && ktg_length3(ktg_sub3(*best, middle)) <= 2 * ktg_length3(ktg_sub3(b, a));
}

/* Whether `from` may go, and along this edge. */
static bool may_go(const ktg_simplify *s, const ktg_candidate *c) {
    ktg_seam_bond bond = ktg_simplify_bond(s, c->from);
    return !s->locked[c->from] && (!s->border[c->from] || s->border[c->to]) &&
           bond != KTG_SEAM_JUNCTION && ktg_simplify_bond(s, c->to) >= bond;
}

/* The position and the cost of candidate->choice, or of the next one where it is impossible; false
 * when there is none. */
static bool choose(const ktg_simplify *s, ktg_candidate *c, ktg_vec3 *position) {
    if (!may_go(s, c))
        return false;
    ktg_quadric q = ktg_quadric_sum(&s->quadrics[c->from], &s->quadrics[c->to]);
    ktg_vec3 best;
    bool fixed = s->locked[c->to] || (s->border[c->to] && !s->border[c->from]) ||
                 ktg_simplify_bond(s, c->to) > ktg_simplify_bond(s, c->from);
    if (c->choice == 0 && choose_best(s, c, &q, &best)) {
        *position = from_frame(s, best);
        c->cost = ktg_quadric_error(&q, best);
        return true;
    }
    if (c->choice == 0)
        c->choice = 1;
    if (c->choice > (fixed ? 1 : 2))
        return false;
    double at_from = ktg_quadric_error(&q, to_frame(s, s->positions[c->from]));
    double at_to = ktg_quadric_error(&q, to_frame(s, s->positions[c->to]));
    bool use_to = fixed || (at_to <= at_from) == (c->choice == 1);
    *position = s->positions[use_to ? c->to : c->from];
    c->cost = use_to ? at_to : at_from;
    return true;
}

/* Who is to stay. */
static int rank_of(const ktg_simplify *s, uint32_t vertex) {
    ktg_seam_bond bond = ktg_simplify_bond(s, vertex);
    bool stays = s->locked[vertex] || bond == KTG_SEAM_JUNCTION;
    return 4 * stays + 2 * (bond == KTG_ON_SEAM) + s->border[vertex];
}

/* A locked vertex stays, then one of a seam or the border where an inner one joins it; otherwise
 * the lower number. */
static ktg_status push_edge(ktg_simplify *s, uint32_t a, uint32_t b) {
    ktg_vec3 position;
    int rank_a = rank_of(s, a), rank_b = rank_of(s, b);
    bool swap = rank_a == rank_b ? a > b : rank_b > rank_a;
    ktg_candidate c = {.to = swap ? b : a, .from = swap ? a : b};
    c.stamp = s->stamps[a] + s->stamps[b];
    return choose(s, &c, &position) ? push(s, &c) : KTG_OK;
}

static ktg_status push_all(ktg_simplify *s) {
    s->heap_count = 0;
    for (uint32_t f = 0; f < s->face_count; f++)
        for (uint32_t k = 0; k < 3 && s->alive[f]; k++) {
            uint32_t a = s->faces[3 * (size_t)f + k], b = s->faces[3 * (size_t)f + (k + 1) % 3];
            if (a < b || (s->border[a] && s->border[b])) /* a border edge has this face only */
                KTG_TRY(push_edge(s, a, b));
        }
    return KTG_OK;
}

ktg_status ktg_simplify_box_faces(ktg_simplify *s) {
    ktg_box *boxes = ktg_new(s->context, s->live_faces, ktg_box);
    uint32_t *items = ktg_new(s->context, s->live_faces, uint32_t), count = 0;
    ktg_status status = boxes && items ? KTG_OK : KTG_MEMORY;
    ktg_boxes_free(&s->boxes);
    for (uint32_t f = 0; status == KTG_OK && f < s->face_count; f++) {
        const uint32_t *c = s->faces + 3 * (size_t)f;
        if (!s->alive[f])
            continue;
        boxes[count] = ktg_box_of(s->positions[c[0]], s->positions[c[1]], s->positions[c[2]]);
        items[count++] = f;
    }
    if (status == KTG_OK)
        status = ktg_boxes_new(s->context, boxes, items, count, s->face_count, &s->boxes);
    s->boxed_faces = s->live_faces;
    ktg_free(boxes);
    ktg_free(items);
    return status;
}

/* Carries out what the rules just allowed: their lists tell which faces change. */
static ktg_status collapse(ktg_simplify *s, const ktg_candidate *c, ktg_vec3 position) {
    const uint32_t *around;
    s->quadrics[c->to] = ktg_quadric_sum(&s->quadrics[c->to], &s->quadrics[c->from]);
    KTG_TRY(ktg_halfedges_collapse(s->context, s->halfedges, c->from, c->to));
    ktg_simplify_blend_colours(s, c, position);
    ktg_simplify_move_uvs(s, c);
    s->positions[c->to] = position;
    s->stamps[c->from]++;
    s->stamps[c->to]++;
    for (size_t i = 0; i < s->changed_count; i++) {
        uint32_t *corner = s->faces + 3 * (size_t)s->changed[i];
        const ktg_vec3 *shape = s->shapes + 6 * i + 3;
        for (int k = 0; k < 3; k++)
            if (corner[k] == c->from)
                corner[k] = c->to;
        ktg_boxes_set(s->boxes, s->changed[i], ktg_box_of(shape[0], shape[1], shape[2]));
    }
    for (size_t i = s->changed_count; i < s->changed_count + s->removed_count; i++) {
        s->alive[s->changed[i]] = false;
        ktg_boxes_remove(s->boxes, s->changed[i]);
        s->live_faces--;
    }
    uint32_t count = ktg_halfedges_neighbours(s->halfedges, c->to, &around);
    for (uint32_t i = 0; i < count; i++)
        KTG_TRY(push_edge(s, c->to, around[i]));
    return s->live_faces < stale_tree * s->boxed_faces ? ktg_simplify_box_faces(s) : KTG_OK;
}

/* Takes the next candidate: collapses it, or sets it back to its next choice. */
static ktg_status step(ktg_simplify *s) {
    ktg_candidate c = pop(s);
    ktg_vec3 position;
    bool allowed = false;
    if (c.stamp != s->stamps[c.from] + s->stamps[c.to] || !choose(s, &c, &position))
        return KTG_OK;
    KTG_TRY(ktg_halfedges_may_collapse(s->context, s->halfedges, c.from, c.to, &allowed));
    if (!allowed)
        return KTG_OK;
    KTG_TRY(ktg_simplify_allowed(s, &c, position, &allowed));
    if (allowed)
        return collapse(s, &c, position);
    c.choice++;
    return choose(s, &c, &position) ? push(s, &c) : KTG_OK;
}

static void tell_progress(const ktg_simplify *s, uint32_t target_faces) {
    double done = s->face_count - s->live_faces, all = s->face_count - target_faces;
    ktg_progress(s->context, "simplify", done / all, NULL);
}

ktg_status ktg_simplify_run(ktg_simplify *s, uint32_t target_faces) {
    uint64_t steps = 0;
    while (s->live_faces > target_faces && s->strictness < KTG_STRICTNESS_COUNT) {
        uint32_t before = s->live_faces;
        KTG_TRY(push_all(s));
        while (s->live_faces > target_faces && s->heap_count > 0) {
            if (steps++ % 512 == 0) {
                KTG_TRY(ktg_check_cancel(s->context));
                tell_progress(s, target_faces);
            }
            KTG_TRY(step(s));
        }
        if (s->live_faces == before && s->uv.kept)
            s->uv.kept = false;
        else if (s->live_faces == before)
            s->strictness++;
    }
    return KTG_OK;
}
