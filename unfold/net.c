/* unfold/net.c - a spanning tree laid flat, its conflicts, and moving a part of it. */
#include "unfold/net.h"
#include "core/memory.h"
#include "unfold/lay.h"
#include "unfold/overlap.h"

#include <string.h>

/* Draws for an edge where a body could hang. */
#define DRAWS 64
/* Faces of a large body that are tried first, and how many times as many conflicts as would be too
 * many they must stand for to be taken at their word. */
#define SAMPLE   16
#define HOPELESS 0.8

void ktg_net_free(ktg_net **net) {
    if (!net || !*net)
        return;
    ktg_net *n = *net;
    ktg_net_tree_free(&n->tree);
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

/* ---- laying flat ---------------------------------------------------------------------------- */

static void lay_against(ktg_net *net, uint32_t other, uint32_t own) {
    uint32_t face = own / 3;
    const ktg_vec2 *flat = net->dual->flat + 3 * (size_t)face;
    const ktg_vec2 *there = net->corners + 3 * (size_t)(other / 3);
    int j = own % 3, k = other % 3;
    net->turn[face] = ktg_lay_turn(net->dual, net->turn[other / 3], other, own);
    ktg_motion2 m =
        ktg_lay_motion(net->turn[face], flat[j], flat[(j + 1) % 3], there[(k + 1) % 3], there[k]);
    for (int i = 0; i < 3; i++)
        net->corners[3 * (size_t)face + i] = ktg_move2(m, flat[i]);
}

/* Roots lie where their own frame has them. */
static void lay_tree(ktg_net *net) {
    const ktg_net_tree *tree = &net->tree;
    for (uint32_t k = 0; k < net->dual->face_count; k++) {
        uint32_t face = tree->order[k], edge = tree->parent_edge[face];
        if (edge != KTG_NONE) {
            lay_against(net, ktg_net_across(net, edge, face), ktg_net_own(net, edge, face));
            continue;
        }
        net->turn[face] = (ktg_vec2){1, 0};
        memcpy(net->corners + 3 * (size_t)face, net->dual->flat + 3 * (size_t)face,
               3 * sizeof(ktg_vec2));
    }
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
    net->corners = ktg_new(context, 3 * n, ktg_vec2);
    net->turn = ktg_new(context, n, ktg_vec2);
    net->first = ktg_new(context, n, uint32_t);
    net->weight = ktg_new(context, n, uint32_t);
    net->mark = ktg_new(context, n, uint32_t);
    net->queue = ktg_new(context, n, uint32_t);
    double *sizes = ktg_new(context, n, double);
    ktg_status status = KTG_MEMORY;
    if (net->corners && net->turn && net->first && net->weight && net->mark && net->queue &&
        sizes) {
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
    ktg_status status = ktg_net_tree_new(context, dual, folded, &(*net)->tree);
    (*net)->folded = (*net)->tree.folded;
    if (status == KTG_OK)
        status = allocate(context, *net);
    if (status == KTG_OK)
        status = ktg_net_refresh(context, *net);
    if (status != KTG_OK)
        ktg_net_free(net);
    return status;
}

/* ---- paths and sides ------------------------------------------------------------------------ */

static uint32_t face_of(const ktg_net *net, const ktg_body *body, uint32_t i) {
    return ktg_net_part_face(&net->tree, &body->part, i);
}

uint32_t ktg_net_path(const ktg_net *net, uint32_t a, uint32_t b, uint32_t *path) {
    return ktg_net_tree_path(&net->tree, a, b, path);
}

ktg_body ktg_net_side(const ktg_net *net, uint32_t fold) {
    ktg_net_part part = ktg_net_tree_side(&net->tree, fold);
    return (ktg_body){.part = part, .count = part.count};
}

bool ktg_net_smaller_side(ktg_net *net, uint32_t fold, uint32_t most, ktg_body *body) {
    *body = ktg_net_side(net, fold);
    if (body->count > most)
        return false;
    body->stamp = ktg_net_stamp(net);
    body->faces = net->queue;
    for (uint32_t i = 0; i < body->count; i++) {
        net->queue[i] = face_of(net, body, i);
        net->mark[net->queue[i]] = body->stamp;
    }
    return true;
}

/* ---- transplants ---------------------------------------------------------------------------- */

/* True when the body could hang from the half-edge of one of its faces. */
static bool is_rim(const ktg_net *net, const ktg_body *body, uint32_t fold, uint32_t h) {
    uint32_t e = net->dual->halfedge_edge[h];
    return e != KTG_NONE && e != fold && net->tree.neighbour[h] == KTG_NONE &&
           !ktg_net_has(net, body, ktg_net_across(net, e, h / 3) / 3);
}

uint32_t ktg_net_rims(const ktg_net *net, const ktg_body *body, uint32_t fold, uint32_t *edges) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < body->count; i++) {
        uint32_t h = 3 * face_of(net, body, i);
        for (int k = 0; k < 3; k++, h++)
            if (is_rim(net, body, fold, h))
                edges[count++] = net->dual->halfedge_edge[h];
    }
    return count;
}

uint32_t ktg_net_draw_rim(const ktg_net *net, const ktg_body *body, uint32_t fold,
                          ktg_random *random) {
    for (int i = 0; i < DRAWS; i++) {
        size_t k = ktg_random_below(random, 3 * (size_t)body->count);
        uint32_t h = 3 * face_of(net, body, (uint32_t)(k / 3)) + (uint32_t)(k % 3);
        if (is_rim(net, body, fold, h))
            return net->dual->halfedge_edge[h];
    }
    return KTG_NONE;
}

/* The half-edge before or after h in its face. */
static uint32_t beside(uint32_t h, bool forwards) {
    uint32_t corner = h % 3, other = forwards ? (corner + 1) % 3 : (corner + 2) % 3;
    return h - corner + other;
}

uint32_t ktg_net_near_rim(const ktg_net *net, const ktg_body *body, uint32_t fold, uint32_t steps,
                          bool forwards) {
    const ktg_dual *dual = net->dual;
    const uint32_t *pair = dual->edges[fold].halfedge;
    uint32_t h = ktg_net_has(net, body, pair[0] / 3) ? pair[0] : pair[1];
    while (steps > 0) {
        h = beside(h, forwards); /* round the corner, through the body's faces */
        for (;;) {
            uint32_t edge = dual->halfedge_edge[h];
            if (edge == KTG_NONE || edge == fold)
                return KTG_NONE;
            uint32_t across = ktg_net_across(net, edge, h / 3);
            if (!ktg_net_has(net, body, across / 3))
                break;
            h = beside(across, forwards);
        }
        steps--;
    }
    return dual->halfedge_edge[h];
}

static uint32_t cost_of(const ktg_net *net, uint32_t a, uint32_t b) {
    return 1 + net->weight[a] + net->weight[b];
}

uint32_t ktg_net_conflicts_now(const ktg_net *net, const ktg_body *body) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < body->count; i++) {
        uint32_t face = face_of(net, body, i);
        for (uint32_t c = net->first[face]; c != KTG_NONE;) {
            const ktg_conflict *conflict = &net->conflicts[c];
            int end = end_of(conflict, face);
            if (!ktg_net_has(net, body, conflict->faces[1 - end]))
                count += cost_of(net, face, conflict->faces[1 - end]);
            c = conflict->next[end];
        }
    }
    return count;
}

ktg_motion2 ktg_net_motion(const ktg_net *net, const ktg_body *body, uint32_t edge) {
    const uint32_t *pair = net->dual->edges[edge].halfedge;
    int inside = ktg_net_has(net, body, pair[0] / 3) ? 0 : 1;
    uint32_t own = pair[inside], other = pair[1 - inside];
    const ktg_vec2 *here = net->corners + 3 * (size_t)(own / 3);
    const ktg_vec2 *there = net->corners + 3 * (size_t)(other / 3);
    ktg_vec2 now = net->turn[own / 3],
             then = ktg_lay_turn(net->dual, net->turn[other / 3], other, own);
    ktg_vec2 turn = ktg_unit2((ktg_vec2){ktg_dot2(now, then), ktg_cross2(now, then)});
    return ktg_lay_motion(turn, here[own % 3], here[(own % 3 + 1) % 3], there[(other % 3 + 1) % 3],
                          there[other % 3]);
}

static void move_face(const ktg_net *net, uint32_t face, const ktg_motion2 *motion,
                      ktg_vec2 moved[3]) {
    for (int k = 0; k < 3; k++)
        moved[k] = ktg_move2(*motion, net->corners[3 * (size_t)face + k]);
}

/* What the conflicts of one face of the body would cost. */
static uint32_t cost_moved(const ktg_net *net, const ktg_body *body, uint32_t i,
                           const ktg_motion2 *motion) {
    uint32_t cost = 0, face = face_of(net, body, i);
    ktg_vec2 moved[3];
    ktg_net_walk walk;
    move_face(net, face, motion, moved);
    if (!ktg_net_walk_start(&walk, &net->grid, moved))
        return 0;
    for (uint32_t g; (g = ktg_net_walk_next(&walk)) != KTG_NONE;)
        if (!ktg_net_has(net, body, g) && overlap(net, face, moved, g))
            cost += cost_of(net, face, g);
    return cost;
}

/* A sample of faces spread over a large body comes first, and the others follow as they are listed:
 * a hopeless place shows soon. */
static uint32_t count_moved(const ktg_net *net, const ktg_body *body, const ktg_motion2 *motion,
                            uint32_t most, bool guess) {
    uint32_t cost = 0, largest = 0, stride = body->count / SAMPLE;
    if (stride > 1) {
        for (uint32_t i = 0; i < body->count && cost <= most; i += stride) {
            uint32_t own = cost_moved(net, body, i, motion);
            largest = own > largest ? own : largest;
            cost += own;
        }
        /* one face may be far heavier than all others, and stands for itself only */
        if (guess && (double)(cost - largest) * stride > HOPELESS * ((double)most + SAMPLE))
            return most + 1;
    }
    for (uint32_t i = 0; i < body->count && cost <= most; i++)
        if (stride <= 1 || i % stride > 0)
            cost += cost_moved(net, body, i, motion);
    return cost;
}

uint32_t ktg_net_conflicts_moved(const ktg_net *net, const ktg_body *body,
                                 const ktg_motion2 *motion, uint32_t most) {
    return count_moved(net, body, motion, most, false);
}

uint32_t ktg_net_conflicts_guess(const ktg_net *net, const ktg_body *body,
                                 const ktg_motion2 *motion, uint32_t most) {
    return count_moved(net, body, motion, most, true);
}

static void drop_conflicts(ktg_net *net, const ktg_body *body) {
    for (uint32_t i = 0; i < body->count; i++) {
        uint32_t face = face_of(net, body, i);
        for (uint32_t c = net->first[face]; c != KTG_NONE;) {
            const ktg_conflict *conflict = &net->conflicts[c];
            int end = end_of(conflict, face);
            uint32_t next = conflict->next[end];
            if (!ktg_net_has(net, body, conflict->faces[1 - end]))
                remove_conflict(net, c);
            c = next;
        }
    }
}

static ktg_status find_conflicts(ktg_context *context, ktg_net *net, const ktg_body *body) {
    for (uint32_t i = 0; i < body->count; i++) {
        uint32_t face = face_of(net, body, i);
        const ktg_vec2 *corners = net->corners + 3 * (size_t)face;
        ktg_net_walk walk;
        if (!ktg_net_walk_start(&walk, &net->grid, corners))
            continue;
        for (uint32_t g; (g = ktg_net_walk_next(&walk)) != KTG_NONE;)
            if (!ktg_net_has(net, body, g) && overlap(net, face, corners, g))
                KTG_TRY(add_conflict(context, net, face, g));
    }
    return KTG_OK;
}

ktg_status ktg_net_transplant(ktg_context *context, ktg_net *net, const ktg_body *body,
                              uint32_t fold, uint32_t edge) {
    ktg_motion2 motion = ktg_net_motion(net, body, edge);
    drop_conflicts(net, body);
    for (uint32_t i = 0; i < body->count; i++) {
        uint32_t face = face_of(net, body, i);
        ktg_vec2 *turn = &net->turn[face];
        *turn = ktg_unit2((ktg_vec2){motion.c * turn->x - motion.s * turn->y,
                                     motion.s * turn->x + motion.c * turn->y});
        move_face(net, face, &motion, net->corners + 3 * (size_t)face);
        put_in_grid(net, face);
    }
    KTG_TRY(find_conflicts(context, net, body));
    ktg_net_tree_hang(&net->tree, &body->part, fold, edge);
    return KTG_OK;
}
