/* unfold/compact.c - annealing a net towards the shape of its sheet. */
#include "unfold/compact.h"
#include "core/memory.h"

#include <math.h>
#include <stdio.h>

/* The temperature falls geometrically, from this part of the first cost to this much. Measured on
 * closed/500. */
#define HOT  0.02
#define COLD 2e-5

typedef struct compact {
    ktg_net *net;
    ktg_search *search;
    uint32_t *rims;      /* 3 face_count */
    double *area;        /* face_count, over the net's area */
    double *cost;        /* face_count: what each face costs where it lies */
    double total;        /* of all faces */
    double per_x, per_y; /* 1 / a, 1 / b */
    double temperature;
    uint64_t work; /* faces of bodies looked at so far */
} compact;

static double cost_at(const compact *c, uint32_t face, const ktg_vec2 corners[3]) {
    double x = (corners[0].x + corners[1].x + corners[2].x) / 3 * c->per_x;
    double y = (corners[0].y + corners[1].y + corners[2].y) / 3 * c->per_y;
    return c->area[face] * (x * x * x * x + y * y * y * y);
}

/* What the body costs after a motion minus what it costs now. */
static double cost_change(const compact *c, const ktg_body *body, const ktg_motion2 *motion) {
    double change = 0;
    for (uint32_t i = 0; i < body->count; i++) {
        uint32_t face = body->faces[i];
        ktg_vec2 moved[3];
        for (int k = 0; k < 3; k++)
            moved[k] = ktg_move2(*motion, c->net->corners[3 * (size_t)face + k]);
        change += cost_at(c, face, moved) - c->cost[face];
    }
    return change;
}

/* A fold drawn at random; KTG_NONE when the draw was none. */
static uint32_t draw_fold(const compact *c) {
    const ktg_dual *dual = c->net->dual;
    uint32_t e = (uint32_t)ktg_random_below(&c->search->random, dual->edge_count);
    return c->net->folded[e] && !dual->edges[e].rigid ? e : KTG_NONE;
}

static void settle(compact *c, const ktg_body *body, double change) {
    for (uint32_t i = 0; i < body->count; i++) {
        uint32_t face = body->faces[i];
        c->cost[face] = cost_at(c, face, c->net->corners + 3 * (size_t)face);
    }
    c->total += change;
}

/* One tried move: the cost is looked at first, because it is cheaper than overlaps. */
static ktg_status try_move(ktg_context *context, compact *c) {
    ktg_random *random = &c->search->random;
    uint32_t fold = draw_fold(c);
    ktg_body body;
    c->work++;
    if (fold == KTG_NONE || !ktg_net_smaller_side(c->net, fold, c->net->dual->face_count, &body))
        return KTG_OK;
    c->work += body.count;
    uint32_t rims = ktg_net_rims(c->net, &body, fold, c->rims);
    if (rims == 0)
        return KTG_OK;
    uint32_t edge = c->rims[ktg_random_below(random, rims)];
    ktg_motion2 motion = ktg_net_motion(c->net, &body, edge);
    double change = cost_change(c, &body, &motion);
    if (change > -c->temperature * log(1 - ktg_random_unit(random)) ||
        ktg_net_conflicts_moved(c->net, &body, &motion, 0) > 0)
        return KTG_OK;
    KTG_TRY(ktg_net_transplant(context, c->net, &body, fold, edge));
    settle(c, &body, change);
    return KTG_OK;
}

/* Areas, the middle moved to the origin, the sheet's shape. */
static void prepare(compact *c, double aspect) {
    ktg_net *net = c->net;
    double all = 0;
    ktg_vec2 middle = {0, 0};
    for (uint32_t f = 0; f < net->dual->face_count; f++) {
        const ktg_vec2 *p = net->corners + 3 * (size_t)f;
        c->area[f] = fabs(0.5 * ktg_cross2(ktg_sub2(p[1], p[0]), ktg_sub2(p[2], p[0])));
        all += c->area[f];
        for (int k = 0; k < 3; k++)
            middle = ktg_madd2(middle, c->area[f] / 3, p[k]);
    }
    middle = ktg_mul2(middle, 1 / all);
    ktg_net_shift(net, ktg_mul2(middle, -1));
    c->per_x = 1 / sqrt(all * aspect);
    c->per_y = aspect * c->per_x;
    for (uint32_t f = 0; f < net->dual->face_count; f++) {
        c->area[f] /= all;
        c->cost[f] = cost_at(c, f, net->corners + 3 * (size_t)f);
        c->total += c->cost[f];
    }
}

static ktg_status run(ktg_context *context, compact *c, uint64_t most_work) {
    double hot = HOT * c->total, first = c->total, face_count = c->net->dual->face_count;
    for (uint64_t i = 0; c->work < most_work; i++) {
        if (i % 256 == 0) {
            double done = (double)c->work / (double)most_work;
            char detail[64];
            snprintf(detail, sizeof detail, "one piece, %.0f %% of its first spread",
                     100 * pow(c->total / first, 0.25));
            c->temperature = hot * pow(COLD / hot, done);
            ktg_search_progress(context, c->search, done * face_count, detail);
            if (!ktg_search_goes_on(context, c->search))
                break;
        }
        KTG_TRY(try_move(context, c));
    }
    return KTG_OK;
}

ktg_status ktg_compact_run(ktg_context *context, ktg_net *net, double aspect, uint64_t most_work,
                           ktg_search *search) {
    size_t n = net->dual->face_count;
    compact c = {.net = net,
                 .search = search,
                 .rims = ktg_new(context, 3 * n, uint32_t),
                 .area = ktg_new(context, n, double),
                 .cost = ktg_new(context, n, double)};
    ktg_status status = c.rims && c.area && c.cost ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        prepare(&c, aspect);
        status = run(context, &c, most_work);
    }
    ktg_free(c.rims);
    ktg_free(c.area);
    ktg_free(c.cost);
    return status;
}
