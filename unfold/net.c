/* unfold/net.c - a spanning tree laid flat, its conflicts, and moving a part of it. */
#include "unfold/net.h"
#include "core/memory.h"
#include "unfold/overlap.h"

#include <string.h>

void ktg_net_free(ktg_net **net) {
    if (!net || !*net)
        return;
    ktg_net *n = *net;
    ktg_free(n->folded);
    ktg_free(n->parent_edge);
    ktg_free(n->parent);
    ktg_free(n->below);
    ktg_free(n->neighbour);
    ktg_free(n->corners);
    ktg_free(n->turn);
    ktg_net_grid_free(&n->grid);
    ktg_free(n->conflicts);
    ktg_free(n->live);
    ktg_free(n->first);
    ktg_free(n->weight);
    ktg_free(n->mark);
    ktg_free(n->queue);
    ktg_free(n);
    *net = NULL;
}

uint32_t ktg_net_stamp(ktg_net *net) {
    if (++net->stamp == 0) {
        memset(net->mark, 0, net->dual->face_count * sizeof *net->mark);
        net->stamp = 1;
    }
    return net->stamp;
}

/* ---- conflicts ---------------------------------------------------------------------------- */

/* Which end of a conflict a face is. */
static int end_of(const ktg_conflict *conflict, uint32_t face) {
    return conflict->faces[0] == face ? 0 : 1;
}

static ktg_status add_conflict(ktg_context *context, ktg_net *net, uint32_t a, uint32_t b) {
    uint32_t id = net->free_conflict;
    KTG_TRY(ktg_reserve(context, &net->live, &net->live_capacity, net->live_count + 1));
    if (id != KTG_NONE) {
        net->free_conflict = net->conflicts[id].next[0];
    } else {
        KTG_TRY(ktg_reserve(context, &net->conflicts, &net->conflict_capacity,
                            net->conflict_count + 1));
        id = (uint32_t)net->conflict_count++;
    }
    ktg_conflict *c = &net->conflicts[id];
    *c = (ktg_conflict){.faces = {a, b}, .place = (uint32_t)net->live_count};
    net->live[net->live_count++] = id;
    for (int i = 0; i < 2; i++) {
        uint32_t face = c->faces[i], first = net->first[face];
        c->previous[i] = KTG_NONE;
        c->next[i] = first;
        if (first != KTG_NONE)
            net->conflicts[first].previous[end_of(&net->conflicts[first], face)] = id;
        net->first[face] = id;
    }
    return KTG_OK;
}

static void remove_conflict(ktg_net *net, uint32_t id) {
    ktg_conflict *c = &net->conflicts[id];
    for (int i = 0; i < 2; i++) {
        uint32_t face = c->faces[i], next = c->next[i], previous = c->previous[i];
        if (previous != KTG_NONE)
            net->conflicts[previous].next[end_of(&net->conflicts[previous], face)] = next;
        else
            net->first[face] = next;
        if (next != KTG_NONE)
            net->conflicts[next].previous[end_of(&net->conflicts[next], face)] = previous;
    }
    uint32_t last = net->live[--net->live_count];
    net->live[c->place] = last;
    net->conflicts[last].place = c->place;
    c->next[0] = net->free_conflict;
    net->free_conflict = id;
}

/* ---- faces that overlap a place ------------------------------------------------------------ */

static bool overlap(const ktg_net *net, uint32_t face, const ktg_vec2 corners[3], uint32_t other) {
    return ktg_triangles_overlap(corners, net->dual->lengths + 3 * (size_t)face,
                                 net->corners + 3 * (size_t)other,
                                 net->dual->lengths + 3 * (size_t)other, KTG_OVERLAP_DEPTH);
}

static void put_in_grid(ktg_net *net, uint32_t face) {
    ktg_net_grid_put_face(&net->grid, face, net->corners + 3 * (size_t)face);
}

void ktg_net_shift(ktg_net *net, ktg_vec2 by) {
    for (size_t c = 0; c < 3 * (size_t)net->dual->face_count; c++)
        net->corners[c] = ktg_add2(net->corners[c], by);
    for (uint32_t f = 0; f < net->dual->face_count; f++)
        put_in_grid(net, f);
}

/* ---- laying flat ---------------------------------------------------------------------------- */

/* The turn the face of half-edge `own` has when it lies against half-edge `other`: from the edge's
 * vectors in both faces' own frames, which are precise however short the edge is. */
static ktg_vec2 turn_against(const ktg_net *net, uint32_t other, uint32_t own) {
    ktg_vec2 turn = net->turn[other / 3], from = net->dual->flat_vectors[own];
    ktg_vec2 v = net->dual->flat_vectors[other];
    ktg_vec2 along = {-(turn.x * v.x - turn.y * v.y), -(turn.y * v.x + turn.x * v.y)};
    return ktg_unit2((ktg_vec2){ktg_dot2(from, along), ktg_cross2(from, along)});
}

/* The motion with a given turn that brings the middle of a - b to the middle of A - B. */
static ktg_motion2 motion_to(ktg_vec2 turn, ktg_vec2 a, ktg_vec2 b, ktg_vec2 A, ktg_vec2 B) {
    ktg_motion2 m = {turn.x, turn.y, {0, 0}};
    m.t = ktg_sub2(ktg_mul2(ktg_add2(A, B), 0.5), ktg_move2(m, ktg_mul2(ktg_add2(a, b), 0.5)));
    return m;
}

static void lay_against(ktg_net *net, uint32_t other, uint32_t own) {
    uint32_t face = own / 3;
    const ktg_vec2 *flat = net->dual->flat + 3 * (size_t)face;
    const ktg_vec2 *there = net->corners + 3 * (size_t)(other / 3);
    int j = own % 3, k = other % 3;
    net->turn[face] = turn_against(net, other, own);
    ktg_motion2 m =
        motion_to(net->turn[face], flat[j], flat[(j + 1) % 3], there[(k + 1) % 3], there[k]);
    for (int i = 0; i < 3; i++)
        net->corners[3 * (size_t)face + i] = ktg_move2(m, flat[i]);
}

/* Marks an edge as a fold or a cut. */
static void set_fold(ktg_net *net, uint32_t edge, bool folded) {
    const uint32_t *pair = net->dual->edges[edge].halfedge;
    net->folded[edge] = folded;
    net->neighbour[pair[0]] = folded ? pair[1] / 3 : KTG_NONE;
    net->neighbour[pair[1]] = folded ? pair[0] / 3 : KTG_NONE;
}

/* Breadth first from face 0; parents point back. */
static void lay_tree(ktg_net *net) {
    uint32_t count = 1, *queue = net->queue;
    memcpy(net->corners, net->dual->flat, 3 * sizeof(ktg_vec2));
    memset(net->neighbour, 0xff, 3 * (size_t)net->dual->face_count * sizeof *net->neighbour);
    for (uint32_t e = 0; e < net->dual->edge_count; e++)
        set_fold(net, e, net->folded[e]);
    net->parent[0] = net->parent_edge[0] = KTG_NONE;
    net->turn[0] = (ktg_vec2){1, 0};
    queue[0] = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t face = queue[i];
        net->below[face] = 1;
        for (uint32_t h = 3 * face; h < 3 * face + 3; h++) {
            uint32_t other = net->neighbour[h], e = net->dual->halfedge_edge[h];
            if (other == KTG_NONE || e == net->parent_edge[face])
                continue;
            net->parent_edge[other] = e;
            net->parent[other] = face;
            lay_against(net, h, ktg_net_across(net, e, face));
            queue[count++] = other;
        }
    }
    for (uint32_t i = count - 1; i > 0; i--)
        net->below[net->parent[queue[i]]] += net->below[queue[i]];
}

ktg_status ktg_net_refresh(ktg_context *context, ktg_net *net) {
    uint32_t n = net->dual->face_count;
    lay_tree(net);
    memset(net->first, 0xff, n * sizeof *net->first);
    net->conflict_count = net->live_count = 0;
    net->free_conflict = KTG_NONE;
    for (uint32_t f = 0; f < n; f++)
        put_in_grid(net, f);
    for (uint32_t f = 0; f < n; f++) {
        ktg_net_walk walk;
        const ktg_vec2 *corners = net->corners + 3 * (size_t)f;
        if (!ktg_net_walk_start(&walk, &net->grid, corners))
            continue;
        for (uint32_t g; (g = ktg_net_walk_next(&walk)) != KTG_NONE;)
            if (g > f && overlap(net, f, corners, g))
                KTG_TRY(add_conflict(context, net, f, g));
    }
    return KTG_OK;
}

static ktg_status allocate(ktg_context *context, ktg_net *net) {
    size_t n = net->dual->face_count;
    net->parent_edge = ktg_new(context, n, uint32_t);
    net->corners = ktg_new(context, 3 * n, ktg_vec2);
    net->turn = ktg_new(context, n, ktg_vec2);
    net->first = ktg_new(context, n, uint32_t);
    net->weight = ktg_new(context, n, uint32_t);
    net->mark = ktg_new(context, n, uint32_t);
    net->parent = ktg_new(context, n, uint32_t);
    net->below = ktg_new(context, n, uint32_t);
    net->neighbour = ktg_new(context, 3 * n, uint32_t);
    net->queue = ktg_new(context, n, uint32_t);
    double *sizes = ktg_new(context, n, double);
    ktg_status status = KTG_MEMORY;
    if (net->parent_edge && net->corners && net->turn && net->first && net->weight && net->mark &&
        net->parent && net->below && net->neighbour && net->queue && sizes) {
        for (size_t f = 0; f < n; f++) {
            const double *l = net->dual->lengths + 3 * f;
            sizes[f] = fmax(l[0], fmax(l[1], l[2]));
        }
        status = ktg_net_grid_new(context, sizes, (uint32_t)n, &net->grid);
    }
    ktg_free(sizes);
    return status;
}

ktg_status ktg_net_new(ktg_context *context, const ktg_dual *dual, const bool *folded,
                       ktg_net **net) {
    *net = ktg_new(context, 1, ktg_net);
    if (!*net)
        return KTG_MEMORY;
    (*net)->dual = dual;
    (*net)->folded = ktg_copy_array(context, folded, dual->edge_count, sizeof *folded);
    ktg_status status = (*net)->folded ? allocate(context, *net) : KTG_MEMORY;
    if (status == KTG_OK)
        status = ktg_net_refresh(context, *net);
    if (status != KTG_OK)
        ktg_net_free(net);
    return status;
}

/* ---- paths and sides ------------------------------------------------------------------------ */

/* Climbs from both faces in turn until one comes where the other has been; then both ways up to
 * there are the path. */
uint32_t ktg_net_path(ktg_net *net, uint32_t a, uint32_t b, uint32_t *path) {
    uint32_t of_a = ktg_net_stamp(net), of_b = ktg_net_stamp(net);
    uint32_t at[2] = {a, b}, meeting = KTG_NONE, count = 0;
    const uint32_t own[2] = {of_a, of_b};
    net->mark[a] = of_a;
    if (a == b)
        return 0;
    net->mark[b] = of_b;
    while (meeting == KTG_NONE) {
        for (int i = 0; i < 2 && meeting == KTG_NONE; i++) {
            uint32_t up = at[i] == KTG_NONE ? KTG_NONE : net->parent[at[i]];
            at[i] = up;
            if (up == KTG_NONE)
                continue;
            if (net->mark[up] == own[1 - i])
                meeting = up;
            net->mark[up] = own[i];
        }
    }
    const uint32_t from[2] = {a, b};
    for (int i = 0; i < 2; i++)
        for (uint32_t face = from[i]; face != meeting; face = net->parent[face])
            path[count++] = net->parent_edge[face];
    return count;
}

/* The face of a fold that hangs from the other. */
static uint32_t lower_face(const ktg_net *net, uint32_t fold) {
    const uint32_t *pair = net->dual->edges[fold].halfedge;
    return net->parent_edge[pair[0] / 3] == fold ? pair[0] / 3 : pair[1] / 3;
}

uint32_t ktg_net_side_count(const ktg_net *net, uint32_t fold) {
    uint32_t below = net->below[lower_face(net, fold)], all = net->dual->face_count;
    return below < all - below ? below : all - below;
}

bool ktg_net_smaller_side(ktg_net *net, uint32_t fold, uint32_t most, ktg_body *body) {
    uint32_t from = lower_face(net, fold), count = ktg_net_side_count(net, fold), filled = 1;
    if (count > most)
        return false;
    uint32_t other = net->parent[from], stamp = ktg_net_stamp(net), *queue = net->queue;
    if (net->below[from] != count) {
        uint32_t swap = from;
        from = other;
        other = swap;
    }
    /* the other side is left out by marking where it begins */
    net->mark[from] = net->mark[other] = stamp;
    queue[0] = from;
    for (uint32_t i = 0; i < filled; i++) {
        const uint32_t *neighbours = net->neighbour + 3 * (size_t)queue[i];
        for (int k = 0; k < 3; k++) {
            uint32_t next = neighbours[k];
            if (next == KTG_NONE || net->mark[next] == stamp)
                continue;
            net->mark[next] = stamp;
            queue[filled++] = next;
        }
    }
    net->mark[other] = stamp - 1;
    *body = (ktg_body){queue, count, stamp};
    return true;
}

/* ---- transplants ---------------------------------------------------------------------------- */

uint32_t ktg_net_rims(const ktg_net *net, const ktg_body *body, uint32_t fold, uint32_t *edges) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < body->count; i++) {
        uint32_t face = body->faces[i];
        for (uint32_t h = 3 * face; h < 3 * face + 3; h++) {
            uint32_t e = net->dual->halfedge_edge[h];
            if (e != KTG_NONE && e != fold && !net->folded[e] &&
                net->mark[ktg_net_across(net, e, face) / 3] != body->stamp)
                edges[count++] = e;
        }
    }
    return count;
}

static uint32_t cost_of(const ktg_net *net, uint32_t a, uint32_t b) {
    return 1 + net->weight[a] + net->weight[b];
}

uint32_t ktg_net_conflicts_now(const ktg_net *net, const ktg_body *body) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < body->count; i++) {
        uint32_t face = body->faces[i];
        for (uint32_t c = net->first[face]; c != KTG_NONE;) {
            const ktg_conflict *conflict = &net->conflicts[c];
            int end = end_of(conflict, face);
            if (net->mark[conflict->faces[1 - end]] != body->stamp)
                count += cost_of(net, face, conflict->faces[1 - end]);
            c = conflict->next[end];
        }
    }
    return count;
}

ktg_motion2 ktg_net_motion(const ktg_net *net, const ktg_body *body, uint32_t edge) {
    const uint32_t *pair = net->dual->edges[edge].halfedge;
    int inside = net->mark[pair[0] / 3] == body->stamp ? 0 : 1;
    uint32_t own = pair[inside], other = pair[1 - inside];
    const ktg_vec2 *here = net->corners + 3 * (size_t)(own / 3);
    const ktg_vec2 *there = net->corners + 3 * (size_t)(other / 3);
    ktg_vec2 now = net->turn[own / 3], then = turn_against(net, other, own);
    ktg_vec2 turn = ktg_unit2((ktg_vec2){ktg_dot2(now, then), ktg_cross2(now, then)});
    return motion_to(turn, here[own % 3], here[(own % 3 + 1) % 3], there[(other % 3 + 1) % 3],
                     there[other % 3]);
}

static void move_face(const ktg_net *net, uint32_t face, const ktg_motion2 *motion,
                      ktg_vec2 moved[3]) {
    for (int k = 0; k < 3; k++)
        moved[k] = ktg_move2(*motion, net->corners[3 * (size_t)face + k]);
}

uint32_t ktg_net_conflicts_moved(const ktg_net *net, const ktg_body *body,
                                 const ktg_motion2 *motion, uint32_t most) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < body->count && count <= most; i++) {
        ktg_vec2 moved[3];
        ktg_net_walk walk;
        move_face(net, body->faces[i], motion, moved);
        if (!ktg_net_walk_start(&walk, &net->grid, moved))
            continue;
        for (uint32_t g; (g = ktg_net_walk_next(&walk)) != KTG_NONE;)
            if (net->mark[g] != body->stamp && overlap(net, body->faces[i], moved, g))
                count += cost_of(net, body->faces[i], g);
    }
    return count;
}

static void drop_conflicts(ktg_net *net, const ktg_body *body) {
    for (uint32_t i = 0; i < body->count; i++) {
        uint32_t face = body->faces[i];
        for (uint32_t c = net->first[face]; c != KTG_NONE;) {
            const ktg_conflict *conflict = &net->conflicts[c];
            int end = end_of(conflict, face);
            uint32_t next = conflict->next[end];
            if (net->mark[conflict->faces[1 - end]] != body->stamp)
                remove_conflict(net, c);
            c = next;
        }
    }
}

static ktg_status find_conflicts(ktg_context *context, ktg_net *net, const ktg_body *body) {
    for (uint32_t i = 0; i < body->count; i++) {
        uint32_t face = body->faces[i];
        const ktg_vec2 *corners = net->corners + 3 * (size_t)face;
        ktg_net_walk walk;
        if (!ktg_net_walk_start(&walk, &net->grid, corners))
            continue;
        for (uint32_t g; (g = ktg_net_walk_next(&walk)) != KTG_NONE;)
            if (net->mark[g] != body->stamp && overlap(net, face, corners, g))
                KTG_TRY(add_conflict(context, net, face, g));
    }
    return KTG_OK;
}

static void add_below(ktg_net *net, uint32_t face, uint32_t count) {
    for (; face != KTG_NONE; face = net->parent[face])
        net->below[face] += count;
}

/* What hangs below `fold` hangs from `edge` now: parents turn round on the way from there up to the
 * fold. Costs what the ways to the root cost. */
static void hang_from(ktg_net *net, const ktg_body *body, uint32_t fold, uint32_t edge) {
    uint32_t top = lower_face(net, fold), all = net->below[top];
    const uint32_t *ends = net->dual->edges[edge].halfedge;
    bool moves = net->mark[top] == body->stamp;
    int inside = (net->mark[ends[0] / 3] == body->stamp) == moves ? 0 : 1;
    uint32_t face = ends[inside] / 3, above = ends[1 - inside] / 3, link = edge, passed = 0;
    add_below(net, net->parent[top], 0u - all);
    for (uint32_t next, last = fold; link != last; face = next) {
        uint32_t up = net->parent_edge[face], below = net->below[face];
        next = net->parent[face];
        net->parent_edge[face] = link;
        net->parent[face] = above;
        net->below[face] = all - passed;
        passed = below;
        above = face;
        link = up;
    }
    add_below(net, ends[1 - inside] / 3, all);
}

ktg_status ktg_net_transplant(ktg_context *context, ktg_net *net, const ktg_body *body,
                              uint32_t fold, uint32_t edge) {
    ktg_motion2 motion = ktg_net_motion(net, body, edge);
    drop_conflicts(net, body);
    for (uint32_t i = 0; i < body->count; i++) {
        ktg_vec2 *turn = &net->turn[body->faces[i]];
        *turn = ktg_unit2((ktg_vec2){motion.c * turn->x - motion.s * turn->y,
                                     motion.s * turn->x + motion.c * turn->y});
        move_face(net, body->faces[i], &motion, net->corners + 3 * (size_t)body->faces[i]);
        put_in_grid(net, body->faces[i]);
    }
    hang_from(net, body, fold, edge);
    set_fold(net, fold, false);
    set_fold(net, edge, true);
    return find_conflicts(context, net, body);
}
