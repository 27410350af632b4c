/* unfold/spread.c - how far faces lie from the middle of their sheets. */
#include "unfold/spread.h"
#include "core/memory.h"

/* Turns tried for a piece in half a circle. */
#define TURNS 36

static double area_of(const ktg_dual *dual, uint32_t face) {
    const ktg_vec2 *p = dual->flat + 3 * (size_t)face;
    return 0.5 * ktg_cross2(ktg_sub2(p[1], p[0]), ktg_sub2(p[2], p[0]));
}

double ktg_dual_area(const ktg_dual *dual) {
    double all = 0;
    for (uint32_t f = 0; f < dual->face_count; f++)
        all += area_of(dual, f);
    return all;
}

static double raised(double x, int power) {
    for (x *= x, power /= 2; power > 1; power /= 2)
        x *= x;
    return x;
}

/* A face costs its area times the distances of its corner that is furthest out, along x and along
 * y: what counts in the end is what stands out. */
static double cost_at(const ktg_spread *s, uint32_t face, const ktg_motion2 *motion) {
    const ktg_vec2 *p = s->a->corners + 3 * (size_t)face;
    double x = 0, y = 0;
    for (int k = 0; k < 3; k++) {
        ktg_vec2 q = motion ? ktg_move2(*motion, p[k]) : p[k];
        q = (ktg_vec2){fabs(q.x), fabs(q.y)};
        x = q.x > x ? q.x : x;
        y = q.y > y ? q.y : y;
    }
    return s->area[face] * (raised(x * s->per.x, s->power) + raised(y * s->per.y, s->power));
}

void ktg_spread_recount(ktg_spread *s, int power) {
    s->power = power;
    s->total = 0;
    for (uint32_t f = 0; f < s->a->dual->face_count; f++)
        s->total += s->cost[f] = cost_at(s, f, NULL);
}

ktg_status ktg_spread_new(ktg_context *context, const ktg_arrangement *a, ktg_vec2 half,
                          ktg_spread *s) {
    uint32_t n = a->dual->face_count;
    *s = (ktg_spread){.a = a,
                      .per = {1 / half.x, 1 / half.y},
                      .area = ktg_new(context, n, double),
                      .cost = ktg_new(context, n, double)};
    if (!s->area || !s->cost)
        return KTG_MEMORY;
    double all = ktg_dual_area(a->dual);
    for (uint32_t f = 0; f < n; f++)
        s->area[f] = area_of(a->dual, f) / all;
    ktg_spread_recount(s, 4);
    return KTG_OK;
}

void ktg_spread_free(ktg_spread *s) {
    ktg_free(s->area);
    ktg_free(s->cost);
    *s = (ktg_spread){0};
}

bool ktg_spread_allows(const ktg_spread *s, const ktg_branch *branch, const ktg_graft *graft,
                       double allowed, double *change, uint64_t *work) {
    const uint32_t *faces = s->a->order + branch->first;
    double before = 0, after = 0;
    for (uint32_t i = 0; i < branch->count; i++)
        before += s->cost[faces[i]];
    double most = before + allowed;
    for (uint32_t i = 0; i < branch->count; i++) {
        after += cost_at(s, faces[i], &graft->motion);
        if (after > most) {
            *work += i;
            return false;
        }
    }
    *work += branch->count;
    *change = after - before;
    return true;
}

void ktg_spread_follow(ktg_spread *s, const ktg_branch *branch) {
    for (uint32_t i = 0; i < branch->count; i++) {
        uint32_t face = s->a->order[branch->first + i];
        double cost = cost_at(s, face, NULL);
        s->total += cost - s->cost[face];
        s->cost[face] = cost;
    }
}

static double turned_cost(const ktg_spread *s, uint32_t piece, const ktg_motion2 *turn) {
    double sum = 0;
    for (uint32_t f = 0; f < s->a->dual->face_count; f++)
        if (s->a->piece[f] == piece)
            sum += cost_at(s, f, turn);
    return sum;
}

ktg_status ktg_spread_pose(ktg_context *context, ktg_arrangement *a, ktg_spread *s) {
    for (uint32_t p = 0; p < a->piece_count; p++) {
        ktg_motion2 best = {1, 0, {0, 0}};
        double least = INFINITY;
        for (int k = 0; k < TURNS; k++) {
            ktg_motion2 turn = {cos(KTG_PI * k / TURNS), sin(KTG_PI * k / TURNS), {0, 0}};
            double cost = turned_cost(s, p, &turn);
            if (cost < least * (1 - 1e-9)) {
                least = cost;
                best = turn;
            }
        }
        KTG_TRY(ktg_arrangement_move(context, a, p, best));
    }
    ktg_spread_recount(s, s->power);
    return KTG_OK;
}
