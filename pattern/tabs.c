/* pattern/tabs.c - glue tabs of a pattern: plan them, write them down, count them. */
#include "pattern/tabs.h"

#include "core/memory.h"

static void drop_plan(ktg_tab_plan *plan) {
    ktg_free(plan->cuts);
    ktg_free(plan->slots);
    ktg_free(plan->conflicts);
    ktg_free(plan->preferred);
    ktg_free(plan->choices);
    ktg_free(plan->shifts);
}

static ktg_tab_size size_of(const ktg_tab_plan *plan, uint32_t c) {
    const ktg_tab_choice *choice = &plan->choices[c];
    if (choice->side < 0)
        return KTG_TAB_NONE;
    return ktg_trapezoid_is_full(&choice->shape, &plan->slots[2 * c + choice->side].wish)
               ? KTG_TAB_FULL
               : KTG_TAB_REDUCED;
}

/* The tab in its piece: from the base's corner that the border comes to first, around the top. */
static ktg_pattern_tab tab_of(const ktg_tab_plan *plan, uint32_t c) {
    const ktg_tab_choice *choice = &plan->choices[c];
    const ktg_tab_slot *slot = &plan->slots[2 * c + choice->side];
    ktg_pattern_tab tab = {plan->cuts[c], 0, {{0, 0}}, size_of(plan, c)};
    ktg_vec2 corners[4];
    tab.corner_count = ktg_trapezoid_corners(&choice->shape, corners);
    for (uint32_t i = 0; i < tab.corner_count; i++)
        tab.corners[i] =
            ktg_from_frame(&slot->frames[KTG_LAYER_OUTSIDE], corners[(i + 1) % tab.corner_count]);
    return tab;
}

static void forget_tabs(ktg_pattern *pattern) {
    for (size_t e = 0; e < pattern->edge_count; e++)
        pattern->edges[e].tab_on = -1;
    for (size_t p = 0; p < pattern->piece_count; p++) {
        ktg_free(pattern->pieces[p].tabs);
        pattern->pieces[p].tabs = NULL;
        pattern->pieces[p].tab_count = 0;
    }
}

/* Writes each piece's tabs in the order of its border. */
static ktg_status write_tabs(ktg_context *context, const ktg_tab_plan *plan, uint32_t *cut_of,
                             ktg_pattern *pattern) {
    const ktg_topology *t = plan->topology;
    for (uint32_t c = 0; c < plan->cut_count; c++) {
        cut_of[plan->cuts[c]] = c;
        pattern->edges[plan->cuts[c]].tab_on = plan->choices[c].side;
    }
    for (uint32_t p = 0; p < pattern->piece_count; p++) {
        ktg_pattern_piece *piece = &pattern->pieces[p];
        size_t room = t->border_first[p + 1] - t->border_first[p];
        if (!(piece->tabs = ktg_new(context, room, ktg_pattern_tab)))
            return KTG_MEMORY;
        for (uint32_t k = t->border_first[p]; k < t->border_first[p + 1]; k++) {
            uint32_t e = t->edge_of[t->border[k]];
            const ktg_pattern_edge *edge = &pattern->edges[e];
            if (edge->kind == KTG_EDGE_CUT && edge->tab_on == t->side_of[t->border[k]])
                piece->tabs[piece->tab_count++] = tab_of(plan, cut_of[e]);
        }
    }
    return KTG_OK;
}

static void count_tabs(const ktg_tab_plan *plan, ktg_finish_report *report) {
    uint32_t counts[3] = {0, 0, 0};
    for (uint32_t c = 0; c < plan->cut_count; c++)
        if (plan->slots[2 * c].wish.length >= plan->options->tab_edge_mm)
            counts[size_of(plan, c)]++;
    report->tabs_none = counts[KTG_TAB_NONE];
    report->tabs_reduced = counts[KTG_TAB_REDUCED];
    report->tabs_full = counts[KTG_TAB_FULL];
}

static ktg_status place(ktg_context *context, ktg_tab_plan *plan, ktg_pattern *pattern) {
    KTG_TRY(ktg_tab_plan_slots(context, plan));
    KTG_TRY(ktg_tab_plan_conflicts(context, plan));
    KTG_TRY(ktg_tab_plan_place(context, plan));
    uint32_t *cut_of = ktg_new(context, pattern->edge_count, uint32_t);
    if (!cut_of)
        return KTG_MEMORY;
    ktg_status status = write_tabs(context, plan, cut_of, pattern);
    ktg_free(cut_of);
    return status;
}

ktg_status ktg_tabs_place(ktg_context *context, const ktg_topology *topology,
                          const ktg_finish_options *options, ktg_pattern *pattern,
                          ktg_finish_report *report) {
    ktg_tab_plan plan = {.topology = topology, .options = options};
    forget_tabs(pattern);
    ktg_status status = place(context, &plan, pattern);
    if (status == KTG_OK)
        count_tabs(&plan, report);
    drop_plan(&plan);
    return status;
}
