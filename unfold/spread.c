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
    double x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
    return power == 4 ? x4 : power == 8 ? x8 : x8 * x8;
}

static double cost_at(const ktg_spread *s, uint32_t face, ktg_vec2 middle) {
    return s->area[face] *
           (raised(middle.x * s->per.x, s->power) + raised(middle.y * s->per.y, s->power));
}

static ktg_vec2 middle_of(const ktg_arrangement *a, uint32_t face) {
    const ktg_vec2 *p = a->corners + 3 * (size_t)face;
    return (ktg_vec2){(p[0].x + p[1].x + p[2].x) / 3, (p[0].y + p[1].y + p[2].y) / 3};
}

void ktg_spread_recount(ktg_spread *s, int power) {
    s->power = power;
    s->total = 0;
    for (uint32_t f = 0; f < s->a->dual->face_count; f++)
        s->total += s->cost[f] = cost_at(s, f, middle_of(s->a, f));
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
        after += cost_at(s, faces[i], ktg_move2(graft->motion, middle_of(s->a, faces[i])));
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
        double cost = cost_at(s, face, middle_of(s->a, face));
        s->total += cost - s->cost[face];
        s->cost[face] = cost;
    }
}

static double turned_cost(const ktg_spread *s, uint32_t piece, const ktg_motion2 *turn) {
    double sum = 0;
    for (uint32_t f = 0; f < s->a->dual->face_count; f++)
        if (s->a->piece[f] == piece)
            sum += cost_at(s, f, ktg_move2(*turn, middle_of(s->a, f)));
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
