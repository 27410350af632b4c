/* unfold/transplant.c - conflict-driven subtree transplant. */
#include "unfold/transplant.h"
#include "core/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Chosen by measurement on closed/1000, closed/2000 and scale/; docs/unfold.md has the figures. */
#define FOLDS_TRIED 8    /* folds of the path looked at in a step */
#define EDGES_TRIED 4    /* places tried for each body */
#define TEMPERATURE 1.0  /* what a step may cost, on average of the accepted */
#define MOST_WEIGHT 1000 /* of a face; so sums of costs fit 32 bits */
#define TABU_LEAST  10   /* steps for which a changed edge stays as it is: this and */
#define TABU_MORE   20   /* up to that many more, */
#define TABU_CUTS   60   /* and less in proportion where a net has fewer cuts than this */
/* Bodies are at most so many faces large, drawn log-uniformly from this up to all of them. */
#define SMALL_BODY 8
/* All places for bodies up to this large are listed before some are drawn. */
#define LISTED_BODY 64
/* How far along its line a larger body may slide, in edges. */
#define FARTHEST_RIM 32

typedef struct transplant {
    ktg_net *net;
    ktg_search *search;
    uint32_t *path;       /* face_count: folds between two overlapping faces */
    uint32_t *rims;       /* 3 face_count: edges where a body could hang */
    uint64_t *tabu_until; /* per dual edge: the step before which it stays as it is */
    uint64_t step;
    uint32_t faces[2]; /* the conflict of this step */
    uint32_t most;     /* faces of a body in this step */
    uint32_t tabu_least, tabu_more;
    double temperature;
} transplant;

typedef struct proposal {
    uint32_t fold, edge;
    int64_t cost; /* of conflicts afterwards minus now; anything proposed must cost less */
    bool found;
} proposal;

static bool is_tabu(const transplant *t, uint32_t edge) {
    return t->tabu_until[edge] > t->step;
}

/* Log-uniformly up to FARTHEST_RIM. */
static uint32_t draw_steps(ktg_random *random) {
    return (uint32_t)pow(FARTHEST_RIM + 1, ktg_random_unit(random));
}

/* Where the body could hang: all such edges of a small one. Of a large one a few drawn at random
 * and a few near the fold: far places would throw hundreds of faces onto others, and a conflict
 * between two large parts may have no other way out. */
static uint32_t find_rims(transplant *t, const ktg_body *body, uint32_t fold) {
    uint32_t count = 0;
    ktg_random *random = &t->search->random;
    if (body->count <= LISTED_BODY)
        return ktg_net_rims(t->net, body, fold, t->rims);
    for (int i = 0; i < EDGES_TRIED; i++) {
        uint32_t edge = i % 2
                            ? ktg_net_draw_rim(t->net, body, fold, random)
                            : ktg_net_near_rim(t->net, body, fold, draw_steps(random), i % 4 == 0);
        if (edge != KTG_NONE)
            t->rims[count++] = edge;
    }
    return count;
}

static void try_fold(transplant *t, uint32_t fold, proposal *best) {
    ktg_body body = ktg_net_side(t->net, fold);
    uint32_t rims = find_rims(t, &body, fold);
    uint32_t now = ktg_net_conflicts_now(t->net, &body);
    for (int tried = 0; tried < EDGES_TRIED && rims > 0;) {
        size_t k = ktg_random_below(&t->search->random, rims);
        uint32_t edge = t->rims[k];
        t->rims[k] = t->rims[--rims];
        if (is_tabu(t, edge))
            continue;
        tried++;
        int64_t limit = best->cost + (int64_t)now - 1;
        if (limit < 0)
            return;
        ktg_motion2 motion = ktg_net_motion(t->net, &body, edge);
        int64_t cost =
            (int64_t)ktg_net_conflicts_guess(t->net, &body, &motion, (uint32_t)limit) - now;
        if (cost < best->cost)
            *best = (proposal){fold, edge, cost, true};
    }
}

/* Keeps those folds of the path that may be cut and whose smaller side is small enough. */
static uint32_t movable(transplant *t, uint32_t length) {
    uint32_t count = 0;
    for (uint32_t k = 0; k < length; k++) {
        uint32_t fold = t->path[k];
        if (!t->net->dual->edges[fold].rigid && !is_tabu(t, fold) &&
            ktg_net_side(t->net, fold).count <= t->most)
            t->path[count++] = fold;
    }
    return count;
}

/* Looks at a few folds on the way between two overlapping faces. */
static proposal find_proposal(transplant *t) {
    ktg_random *random = &t->search->random;
    ktg_net *net = t->net;
    uint32_t pick = net->live[ktg_random_below(random, net->live_count)];
    const uint32_t *faces = memcpy(t->faces, net->conflicts[pick].faces, sizeof t->faces);
    double threshold = -t->temperature * log(1 - ktg_random_unit(random));
    proposal best = {.cost = 1 + (int64_t)threshold};
    double range = fmax(1, (double)net->dual->face_count / SMALL_BODY);
    t->most = (uint32_t)(SMALL_BODY * pow(range, ktg_random_unit(random)));
    uint32_t length = movable(t, ktg_net_path(net, faces[0], faces[1], t->path));
    for (int i = 0; i < FOLDS_TRIED && length > 0; i++) {
        size_t k = ktg_random_below(random, length);
        uint32_t fold = t->path[k];
        t->path[k] = t->path[--length];
        try_fold(t, fold, &best);
    }
    return best;
}

/* A pair that no move of the sample resolves for less than it costs weighs more from now on, until
 * pushing others aside for it pays. */
static void grow_heavier(transplant *t) {
    for (int i = 0; i < 2; i++)
        if (t->net->weight[t->faces[i]] < MOST_WEIGHT)
            t->net->weight[t->faces[i]]++;
}

static ktg_status take_step(ktg_context *context, transplant *t) {
    proposal best = find_proposal(t);
    if (!best.found || best.cost >= 0)
        grow_heavier(t);
    if (!best.found)
        return KTG_OK;
    ktg_body body = ktg_net_side(t->net, best.fold);
    KTG_TRY(ktg_net_transplant(context, t->net, &body, best.fold, best.edge));
    t->tabu_until[best.fold] = t->tabu_until[best.edge] =
        t->step + t->tabu_least + ktg_random_below(&t->search->random, t->tabu_more);
    return KTG_OK;
}

static void tell_progress(ktg_context *context, const transplant *t) {
    ktg_search *search = t->search;
    char detail[64];
    size_t left = t->net->live_count;
    double own = 1.0 / (1.0 + (double)left) * t->net->dual->face_count;
    snprintf(detail, sizeof detail, "%zu overlap%s left", left, left == 1 ? "" : "s");
    ktg_search_progress(context, search, own, detail);
}

/* A region with a long border has few cuts inside it: were all of them tabu, nothing could move;
 * and with few places to choose from, the best of a step would rarely be a good one. */
static void set_pace(transplant *t) {
    uint32_t cuts = t->net->dual->edge_count - (t->net->dual->face_count - 1);
    double part = fmin(1, (double)cuts / TABU_CUTS);
    t->tabu_least = (uint32_t)(TABU_LEAST * part);
    t->tabu_more = (uint32_t)fmax(1, TABU_MORE * part);
    t->temperature = TEMPERATURE * fmax(0.1, part * part);
}

static ktg_status run(ktg_context *context, transplant *t, uint64_t patience) {
    uint64_t last_gain = 0;
    size_t least = t->net->live_count;
    for (t->step = 1; t->net->live_count > 0 && t->step - last_gain <= patience; t->step++) {
        if (t->step % 64 == 1) {
            tell_progress(context, t);
            if (!ktg_search_goes_on(context, t->search))
                break;
        }
        KTG_TRY(take_step(context, t));
        if (t->net->live_count < least) {
            least = t->net->live_count;
            last_gain = t->step;
        }
    }
    memset(t->net->weight, 0, t->net->dual->face_count * sizeof *t->net->weight);
    t->search->report.evaluations += t->step - 1;
    return KTG_OK;
}

ktg_status ktg_transplant_run(ktg_context *context, ktg_net *net, uint64_t patience,
                              ktg_search *search) {
    size_t faces = net->dual->face_count;
    transplant t = {.net = net,
                    .search = search,
                    .path = ktg_new(context, faces, uint32_t),
                    .rims = ktg_new(context, 3 * faces, uint32_t),
                    .tabu_until = ktg_new(context, net->dual->edge_count, uint64_t)};
    set_pace(&t);
    ktg_status status = t.path && t.rims && t.tabu_until ? run(context, &t, patience) : KTG_MEMORY;
    ktg_free(t.path);
    ktg_free(t.rims);
    ktg_free(t.tabu_until);
    return status;
}
