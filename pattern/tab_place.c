/* pattern/tab_place.c - which side of each cut edge takes the tab, and how much of its room.
 *
 * Edges with the least freedom choose first. Then whatever went without, or with less, pushes its
 * neighbours to another side or to a smaller shape wherever all of them together gain by it. */
#include "pattern/tabs.h"

#include "core/memory.h"

#include <stdlib.h>

/* What a tab is worth, besides its trapezoid's value (1 .. 2.5): having one at all, and standing on
 * the side the policy prefers. */
#define WORTH_OF_A_TAB   2.0
#define WORTH_OF_A_SIDE  0.25
#define WORTH_OF_A_RUN   0.6
#define SHORT_EDGE_WORTH 0.1

/* Repairing stops after this many passes, and does not move more neighbours than this at once. */
#define PASSES        4
#define MOST_BLOCKERS 4

static bool is_placed(const ktg_tab_plan *plan, uint32_t slot) {
    return plan->choices[slot / 2].side == (int)(slot % 2);
}

/* Cuts *shape back by the placed tabs it is in conflict with. */
static void cut_by_tabs(const ktg_tab_plan *plan, uint32_t i, double air, ktg_trapezoid *shape) {
    const ktg_tab_slot *slot = &plan->slots[i];
    for (uint32_t k = slot[0].conflict_first; k < slot[1].conflict_first; k++) {
        const ktg_tab_conflict *conflict = &plan->conflicts[k];
        if (!is_placed(plan, conflict->slot))
            continue;
        ktg_vec2 corners[4];
        uint32_t count = ktg_trapezoid_corners(&plan->choices[conflict->slot / 2].shape, corners);
        const ktg_tab_frame *from = &plan->slots[conflict->slot].frames[conflict->layer];
        for (uint32_t c = 0; c < count; c++)
            corners[c] =
                ktg_to_frame(&slot->frames[conflict->layer], ktg_from_frame(from, corners[c]));
        ktg_trapezoid_cut(shape, &slot->wish, corners, count, air);
    }
}

static bool is_short(const ktg_tab_plan *plan, uint32_t i) {
    return plan->slots[i].wish.length < plan->options->tab_edge_mm;
}

static double score_of(const ktg_tab_plan *plan, uint32_t i, const ktg_trapezoid *shape) {
    const ktg_tab_slot *slot = &plan->slots[i];
    if (!ktg_trapezoid_is_tab(shape, &slot->wish))
        return 0;
    double score = WORTH_OF_A_TAB + ktg_trapezoid_value(shape, &slot->wish);
    if (plan->preferred[i / 2] == i % 2)
        score += plan->options->tab_side == KTG_TAB_RUN ? WORTH_OF_A_RUN : WORTH_OF_A_SIDE;
    return is_short(plan, i) ? SHORT_EDGE_WORTH * score : score;
}

/* The best tab of slot i beside the tabs there are, at most `part` of its height. */
static ktg_tab_choice best_in_slot(const ktg_tab_plan *plan, uint32_t i, double part) {
    const ktg_tab_slot *slot = &plan->slots[i];
    ktg_tab_choice choice = {-1, slot->room, 0};
    if (!slot->usable)
        return choice;
    choice.shape.height = fmin(slot->room.height, fmax(slot->wish.least, part * slot->wish.height));
    ktg_trapezoid airy = choice.shape;
    cut_by_tabs(plan, i, KTG_TAB_AIR_MM, &airy);
    double score = score_of(plan, i, &airy);
    if (!ktg_trapezoid_is_full(&airy, &slot->wish))
        cut_by_tabs(plan, i, KTG_TAB_AIR_LEAST_MM, &choice.shape);
    choice.score = score_of(plan, i, &choice.shape);
    if (score >= choice.score || ktg_trapezoid_is_full(&airy, &slot->wish)) {
        choice.score = score;
        choice.shape = airy;
    }
    choice.side = choice.score > 0 ? (int)(i % 2) : -1;
    return choice;
}

/* Takes away the tab of cut edge c and gives it the best one there is room for now. */
static void choose(ktg_tab_plan *plan, uint32_t c) {
    plan->choices[c] = (ktg_tab_choice){.side = -1};
    ktg_tab_choice first = best_in_slot(plan, 2 * c, 1), second = best_in_slot(plan, 2 * c + 1, 1);
    plan->choices[c] = second.score > first.score ? second : first;
}

/* ---- in order of freedom ------------------------------------------------------------------ */

typedef struct turn {
    uint32_t cut;
    uint32_t freedom; /* usable sides; short edges come last */
    double value;     /* of the better room */
} turn;

static int by_freedom(const void *left, const void *right) {
    const turn *a = left, *b = right;
    if (a->freedom != b->freedom)
        return a->freedom < b->freedom ? -1 : 1;
    if (a->value != b->value)
        return a->value < b->value ? -1 : 1;
    return (a->cut > b->cut) - (a->cut < b->cut);
}

static ktg_status choose_in_order(ktg_context *context, ktg_tab_plan *plan) {
    turn *turns = ktg_new(context, plan->cut_count, turn);
    if (!turns)
        return KTG_MEMORY;
    for (uint32_t c = 0; c < plan->cut_count; c++) {
        turns[c].cut = c;
        turns[c].freedom = is_short(plan, 2 * c) ? 4 : 0;
        for (uint32_t i = 2 * c; i < 2 * c + 2; i++) {
            const ktg_tab_slot *slot = &plan->slots[i];
            if (!slot->usable)
                continue;
            turns[c].freedom++;
            turns[c].value = fmax(turns[c].value, ktg_trapezoid_value(&slot->room, &slot->wish));
        }
        plan->choices[c].side = -1;
    }
    qsort(turns, plan->cut_count, sizeof *turns, by_freedom);
    for (uint32_t k = 0; k < plan->cut_count; k++)
        choose(plan, turns[k].cut);
    ktg_free(turns);
    return KTG_OK;
}

/* ---- repair ------------------------------------------------------------------------------- */

/* The edges one attempt moves, the needy one first, and what they had. */
typedef struct party {
    uint32_t cuts[MOST_BLOCKERS + 1];
    ktg_tab_choice before[MOST_BLOCKERS + 1];
    uint32_t count;
} party;

static double score_together(const ktg_tab_plan *plan, const party *p) {
    double sum = 0;
    for (uint32_t k = 0; k < p->count; k++)
        sum += plan->choices[p->cuts[k]].score;
    return sum;
}

/* Adds cut edge c, once; false when the party is full. */
static bool invite(const ktg_tab_plan *plan, party *p, uint32_t c) {
    for (uint32_t k = 0; k < p->count; k++)
        if (p->cuts[k] == c)
            return true;
    if (p->count == MOST_BLOCKERS + 1)
        return false;
    p->cuts[p->count] = c;
    p->before[p->count++] = plan->choices[c];
    return true;
}

/* The edge of slot i and those whose tabs are in its way; false when they are none or too many. */
static bool gather(const ktg_tab_plan *plan, uint32_t i, party *p) {
    p->count = 0;
    (void)invite(plan, p, i / 2);
    for (uint32_t k = plan->slots[i].conflict_first; k < plan->slots[i + 1].conflict_first; k++)
        if (is_placed(plan, plan->conflicts[k].slot) &&
            !invite(plan, p, plan->conflicts[k].slot / 2))
            return false;
    return p->count > 1;
}

/* Slot i first, with at most `part` of its height, then the others around it, then whoever can grow
 * into what is left. */
static void rearrange(ktg_tab_plan *plan, uint32_t i, double part, const party *p) {
    for (uint32_t k = 0; k < p->count; k++)
        plan->choices[p->cuts[k]] = (ktg_tab_choice){.side = -1};
    plan->choices[i / 2] = best_in_slot(plan, i, part);
    for (uint32_t k = 1; k < p->count; k++)
        choose(plan, p->cuts[k]);
    for (uint32_t k = 0; k < p->count; k++) {
        ktg_tab_choice had = plan->choices[p->cuts[k]];
        if (had.side >= 0 &&
            ktg_trapezoid_is_full(&had.shape, &plan->slots[2 * p->cuts[k] + had.side].wish))
            continue;
        choose(plan, p->cuts[k]);
        if (plan->choices[p->cuts[k]].score < had.score)
            plan->choices[p->cuts[k]] = had;
    }
}

/* True when the tab in slot i, at the cost of its neighbours, made all of them better off. */
static bool push(ktg_tab_plan *plan, uint32_t i) {
    static const double parts[] = {1, 0.7, 0.45};
    party p;
    if (!plan->slots[i].usable || !gather(plan, i, &p))
        return false;
    double before = score_together(plan, &p);
    for (int k = 0; k < 3; k++) {
        rearrange(plan, i, parts[k], &p);
        if (score_together(plan, &p) > before + 1e-6)
            return true;
        for (uint32_t m = 0; m < p.count; m++)
            plan->choices[p.cuts[m]] = p.before[m];
    }
    return false;
}

static bool is_content(const ktg_tab_plan *plan, uint32_t c) {
    const ktg_tab_choice *choice = &plan->choices[c];
    return choice->side >= 0 &&
           ktg_trapezoid_is_full(&choice->shape, &plan->slots[2 * c + choice->side].wish);
}

/* Gives every edge that is not content a chance; true when any gained. */
static bool repair(ktg_tab_plan *plan, bool only_without) {
    bool gained = false;
    for (uint32_t c = 0; c < plan->cut_count; c++) {
        if (is_content(plan, c) || (only_without && plan->choices[c].side >= 0))
            continue;
        ktg_tab_choice had = plan->choices[c];
        choose(plan, c);
        if (plan->choices[c].score > had.score + 1e-6)
            gained = true;
        else
            plan->choices[c] = had;
        for (uint32_t i = 2 * c; i < 2 * c + 2 && !is_content(plan, c); i++)
            gained |= push(plan, i);
    }
    return gained;
}

/* ---- the policy --------------------------------------------------------------------------- */

static double face_area(const ktg_topology *t, uint32_t halfedge) {
    uint32_t first = halfedge - halfedge % 3;
    ktg_vec2 a = ktg_corner_at(t, first);
    return ktg_cross2(ktg_sub2(ktg_corner_at(t, first + 1), a),
                      ktg_sub2(ktg_corner_at(t, first + 2), a));
}

/* The seam's side (0 or 1) with the better rooms, the first one on a tie. */
static uint32_t better_side(const ktg_tab_plan *plan, const ktg_pattern_seam *seam,
                            const uint32_t *cut_of) {
    double values[2] = {0, 0};
    for (uint32_t k = 0; k < seam->edge_count; k++)
        for (uint32_t s = 0; s < 2; s++) {
            const ktg_tab_slot *slot =
                &plan->slots[2 * cut_of[seam->edges[k]] + (seam->first_side[k] ^ s)];
            if (slot->usable)
                values[s] += 1 + ktg_trapezoid_value(&slot->room, &slot->wish);
        }
    return values[1] > values[0] * (1 + 1e-9);
}

static void prefer_along(ktg_tab_plan *plan, const ktg_pattern_seam *seam, const uint32_t *cut_of) {
    bool run = plan->options->tab_side == KTG_TAB_RUN;
    uint32_t side = run ? better_side(plan, seam, cut_of) : 0;
    for (uint32_t k = 0; k < seam->edge_count; k++)
        plan->preferred[cut_of[seam->edges[k]]] =
            (uint8_t)(seam->first_side[k] ^ (run ? side : k % 2));
}

static ktg_status set_preferences(ktg_context *context, ktg_tab_plan *plan) {
    const ktg_pattern *pattern = plan->topology->pattern;
    uint32_t *cut_of = ktg_new(context, pattern->edge_count, uint32_t);
    if (!cut_of)
        return KTG_MEMORY;
    for (uint32_t c = 0; c < plan->cut_count; c++)
        cut_of[plan->cuts[c]] = c;
    for (size_t s = 0; s < pattern->seam_count; s++)
        prefer_along(plan, &pattern->seams[s], cut_of);
    ktg_free(cut_of);
    if (plan->options->tab_side != KTG_TAB_SMALLER)
        return KTG_OK;
    for (uint32_t c = 0; c < plan->cut_count; c++) {
        double areas[2] = {face_area(plan->topology, plan->slots[2 * c].halfedge),
                           face_area(plan->topology, plan->slots[2 * c + 1].halfedge)};
        if (fabs(areas[0] - areas[1]) > 1e-9 * (areas[0] + areas[1]))
            plan->preferred[c] = areas[1] < areas[0];
    }
    return KTG_OK;
}

ktg_status ktg_tab_plan_place(ktg_context *context, ktg_tab_plan *plan) {
    plan->preferred = ktg_new(context, plan->cut_count, uint8_t);
    plan->choices = ktg_new(context, plan->cut_count, ktg_tab_choice);
    if (!plan->preferred || !plan->choices)
        return KTG_MEMORY;
    KTG_TRY(set_preferences(context, plan));
    KTG_TRY(choose_in_order(context, plan));
    (void)repair(plan, true);
    for (int pass = 0; pass < PASSES && repair(plan, false); pass++)
        ;
    return KTG_OK;
}
