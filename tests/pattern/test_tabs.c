/* Tabs keep clear of everything, and there are as many as can be. */
#include "check.h"
#include "nets.h"

#include "core/vec.h"
#include "tests/short_memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return 0;
}

static void assert_tabs_are_clear(const ktg_pattern *pattern) {
    check_result r = check_tabs(pattern);
    assert_true(r.deepest < 1e-9);
    assert_true(r.most_outside < 1e-6);
    assert_true(r.least_inset >= 0.3 * (1 - 1e-6));
    assert_true(r.least_air >= 0.1 * (1 - 1e-4));
    assert_true(r.worst_outline < 1e-9);
}

/* Sizes as docs/print.md defines them, and tab_on where the tabs are. */
static void assert_tabs_are_as_counted(const ktg_pattern *pattern, const ktg_finish_options *o,
                                       const ktg_finish_report *report) {
    uint32_t full = 0, reduced = 0, none = 0, on = 0, tabs = 0;
    for (size_t p = 0; p < pattern->piece_count; p++)
        for (size_t i = 0; i < pattern->pieces[p].tab_count; i++) {
            const ktg_pattern_tab *tab = &pattern->pieces[p].tabs[i];
            const ktg_pattern_edge *edge = &pattern->edges[tab->edge];
            const ktg_vec3 *v = pattern->vertices;
            double length = ktg_length3(ktg_sub3(v[edge->vertices[1]], v[edge->vertices[0]])),
                   height = 0;
            ktg_vec2 first = tab->corners[0], last = tab->corners[tab->corner_count - 1];
            ktg_vec2 base = ktg_sub2(first, last);
            for (uint32_t k = 0; k < tab->corner_count; k++)
                height = fmax(height, ktg_cross2(ktg_unit2(base), ktg_sub2(tab->corners[k], last)));
            assert_true(edge->sides[edge->tab_on].piece == p);
            assert_true(height >= o->tab_least_mm * (1 - 1e-6));
            assert_true(height <= o->tab_height_mm * (1 + 1e-6));
            assert_true(ktg_length2(base) >=
                        (tab->size == KTG_TAB_FULL ? 0.8 : 0.5) * length * (1 - 1e-6));
            tabs++;
            if (length < o->tab_edge_mm)
                continue;
            full += tab->size == KTG_TAB_FULL;
            reduced += tab->size == KTG_TAB_REDUCED;
        }
    for (size_t e = 0; e < pattern->edge_count; e++) {
        const ktg_pattern_edge *edge = &pattern->edges[e];
        const ktg_vec3 *v = pattern->vertices;
        on += edge->tab_on >= 0;
        none += edge->kind == KTG_EDGE_CUT && edge->tab_on < 0 &&
                ktg_length3(ktg_sub3(v[edge->vertices[1]], v[edge->vertices[0]])) >= o->tab_edge_mm;
    }
    assert_int_equal(tabs, on);
    assert_int_equal(full, report->tabs_full);
    assert_int_equal(reduced, report->tabs_reduced);
    assert_int_equal(none, report->tabs_none);
}

static ktg_pattern *finished(ktg_context *context, surface *s, uint32_t most_faces, uint64_t seed,
                             const ktg_finish_options *options, ktg_finish_report *report) {
    ktg_pattern *p = grow_net(context, s, most_faces, seed);
    assert_int_equal(ktg_pattern_finish(context, p, options, report), KTG_OK);
    return p;
}

static void a_large_cube_has_full_tabs_on_every_seam_edge(void **state) {
    ktg_finish_options o;
    ktg_finish_report report;
    ktg_finish_defaults(&o);
    for (uint64_t seed = 1; seed <= 20; seed++) {
        ktg_pattern *p = finished(*state, make_cube(40), 12, seed, &o, &report);
        assert_int_equal(report.seam_edges, 7);
        assert_int_equal(report.tabs_full, 7);
        assert_int_equal(report.tabs_reduced + report.tabs_none, 0);
        assert_tabs_are_clear(p);
        assert_tabs_are_as_counted(p, &o, &report);
        ktg_pattern_free(&p);
    }
}

static void a_tetrahedron_has_three_tabs(void **state) {
    ktg_finish_report report;
    ktg_pattern *p = finished(*state, make_tetrahedron(60), 4, 3, NULL, &report);
    assert_int_equal(report.tabs_full, 3);
    assert_tabs_are_clear(p);
    for (size_t i = 0; i < p->pieces[0].tab_count; i++)
        assert_int_equal(p->pieces[0].tabs[i].corner_count, 4);
    ktg_pattern_free(&p);
}

static void small_faces_get_the_largest_tab_that_fits_under_them(void **state) {
    ktg_finish_report report;
    ktg_pattern *p = finished(*state, make_tetrahedron(7), 4, 3, NULL, &report);
    assert_tabs_are_clear(p);
    assert_int_equal(report.tabs_none, 0);
    assert_true(report.tabs_full >= 2);
    ktg_pattern_free(&p);
}

static void separate_faces_compete_for_room_and_never_collide(void **state) {
    /* Every face a piece of its own: beside it there is room, under it three may want to go. */
    for (double side = 6.7; side < 40; side *= 1.3) {
        ktg_finish_options o;
        ktg_finish_report report;
        ktg_finish_defaults(&o);
        ktg_pattern *p = finished(*state, make_tetrahedron(side), 1, 1, &o, &report);
        assert_int_equal(p->piece_count, 4);
        assert_int_equal(report.tabs_none, 0);
        assert_tabs_are_clear(p);
        assert_tabs_are_as_counted(p, &o, &report);
        ktg_pattern_free(&p);
    }
}

static void tabs_share_the_flat_region_under_a_lid(void **state) {
    uint32_t under_several = 0;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        ktg_finish_options o;
        ktg_finish_report report;
        ktg_finish_defaults(&o);
        o.tab_height_mm = seed % 2 ? 5 : 12;
        ktg_pattern *p = finished(*state, make_prism(5 + seed % 8, 12, 20), 200, seed, &o, &report);
        assert_tabs_are_clear(p);
        assert_tabs_are_as_counted(p, &o, &report);
        for (size_t i = 0; i < p->piece_count; i++)
            for (size_t t = 0; t < p->pieces[i].tab_count; t++) {
                const ktg_pattern_edge *edge = &p->edges[p->pieces[i].tabs[t].edge];
                const ktg_pattern_side *mate = &edge->sides[1 - edge->tab_on];
                for (uint32_t k = 1; k < 3; k++)
                    for (size_t e = 0; e < p->edge_count; e++)
                        for (uint32_t s = 0; s < 2; s++)
                            under_several += p->edges[e].kind == KTG_EDGE_FLAT &&
                                             p->edges[e].sides[s].face == mate->face &&
                                             p->edges[e].sides[s].corner == (mate->corner + k) % 3;
            }
        ktg_pattern_free(&p);
    }
    assert_true(under_several > 20);
}

static void random_nets_at_all_sizes_keep_their_tabs_apart(void **state) {
    for (uint64_t seed = 1; seed <= 24; seed++) {
        ktg_finish_options o;
        ktg_finish_report report;
        ktg_finish_defaults(&o);
        o.tab_side = (ktg_tab_side)(seed % 3);
        o.tab_height_mm = seed % 4 == 0 ? 9 : 5;
        double radius = 8 * pow(1.25, (double)(seed % 12));
        ktg_pattern *p = finished(*state, make_bumpy_ball(radius, 0.5, seed % 2 ? 1 : 2, seed), 60,
                                  seed, &o, &report);
        assert_tabs_are_clear(p);
        assert_tabs_are_as_counted(p, &o, &report);
        assert_true(report.tabs_full > 0 || radius < 12);
        ktg_pattern_free(&p);
    }
}

static void large_smooth_nets_lose_few_tabs(void **state) {
    ktg_finish_report report;
    ktg_pattern *p = finished(*state, make_bumpy_ball(200, 0.2, 2, 5), 20, 5, NULL, &report);
    uint32_t all = report.tabs_full + report.tabs_reduced + report.tabs_none;
    assert_tabs_are_clear(p);
    assert_true(report.tabs_full >= 0.85 * all);
    assert_true(report.tabs_none <= 0.1 * all);
    ktg_pattern_free(&p);
}

/* How many edges of multi-edge seams carry their tab on the side of the seam's first tab, and on
 * the other one. */
static void count_sides(const ktg_pattern *p, double *same, double *other) {
    *same = *other = 0;
    for (size_t s = 0; s < p->seam_count; s++) {
        const ktg_pattern_seam *seam = &p->seams[s];
        int first = p->edges[seam->edges[0]].tab_on ^ seam->first_side[0];
        for (uint32_t k = 1; k < seam->edge_count; k++) {
            int on = p->edges[seam->edges[k]].tab_on;
            if (on >= 0)
                (*((on ^ seam->first_side[k]) == first ? same : other))++;
        }
    }
}

static void the_side_policy_is_followed_where_there_is_room(void **state) {
    double same[2], other[2];
    for (int k = 0; k < 2; k++) {
        ktg_finish_options o;
        ktg_finish_report report;
        ktg_finish_defaults(&o);
        o.tab_side = k ? KTG_TAB_RUN : KTG_TAB_ALTERNATE;
        ktg_pattern *p = finished(*state, make_bumpy_ball(200, 0.1, 2, 9), 40, 9, &o, &report);
        count_sides(p, &same[k], &other[k]);
        ktg_pattern_free(&p);
    }
    assert_true(same[1] > 2 * other[1]);
    assert_true(other[0] > other[1]);
}

static void no_tabs_when_none_are_wanted(void **state) {
    ktg_finish_options o;
    ktg_finish_report report;
    ktg_finish_defaults(&o);
    o.tab_height_mm = 0;
    ktg_pattern *p = finished(*state, make_cube(40), 12, 2, &o, &report);
    assert_int_equal(report.tabs_full + report.tabs_reduced, 0);
    assert_int_equal(p->pieces[0].tab_count, 0);
    assert_int_equal(p->pieces[0].outline_count, 14);
    ktg_pattern_free(&p);
}

static void finishing_twice_gives_the_same_once(void **state) {
    ktg_finish_report first, second;
    ktg_pattern *p = finished(*state, make_bumpy_ball(60, 0.4, 1, 4), 100, 4, NULL, &first);
    ktg_pattern *copy;
    assert_int_equal(ktg_pattern_copy(*state, p, &copy), KTG_OK);
    assert_int_equal(ktg_pattern_finish(*state, copy, NULL, &second), KTG_OK);
    assert_memory_equal(&first, &second, sizeof first);
    for (size_t i = 0; i < p->piece_count; i++) {
        assert_int_equal(p->pieces[i].outline_count, copy->pieces[i].outline_count);
        assert_memory_equal(p->pieces[i].outline, copy->pieces[i].outline,
                            p->pieces[i].outline_count * sizeof(ktg_vec2));
        assert_int_equal(p->pieces[i].label_count, copy->pieces[i].label_count);
    }
    ktg_pattern_free(&copy);
    ktg_pattern_free(&p);
}

static void every_failing_allocation_is_survived(void **state) {
    ktg_context *context = *state;
    ktg_pattern *p = grow_net(context, make_cube(30), 12, 1);
    ktg_status status = KTG_MEMORY;
    for (uint64_t nth = 1; status == KTG_MEMORY; nth++) {
        ktg_context_fail_allocation(context, nth);
        status = ktg_pattern_finish(context, p, NULL, NULL);
        assert_true(nth < 1000);
    }
    end_short_memory(context, status);
    assert_int_equal(status, KTG_OK);
    assert_tabs_are_clear(p);
    ktg_pattern_free(&p);
}

static void patterns_that_do_not_hang_together_are_refused(void **state) {
    ktg_context *context = *state;
    ktg_pattern *p = grow_net(context, make_cube(30), 12, 1);
    p->mm_per_unit = 0;
    assert_int_equal(ktg_pattern_finish(context, p, NULL, NULL), KTG_ARGUMENT);
    p->mm_per_unit = 1;
    ktg_pattern_edge saved = p->edges[3];
    p->edges[3].sides[0] = p->edges[4].sides[0];
    assert_int_equal(ktg_pattern_finish(context, p, NULL, NULL), KTG_ARGUMENT);
    p->edges[3] = saved;
    p->pieces[0].faces[1] = p->pieces[0].faces[0];
    assert_int_equal(ktg_pattern_finish(context, p, NULL, NULL), KTG_ARGUMENT);
    ktg_pattern_free(&p);
    ktg_finish_options o;
    ktg_finish_defaults(&o);
    o.tab_height_mm = NAN;
    p = grow_net(context, make_cube(30), 12, 1);
    assert_int_equal(ktg_pattern_finish(context, p, &o, NULL), KTG_ARGUMENT);
    ktg_pattern_free(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_large_cube_has_full_tabs_on_every_seam_edge),
        cmocka_unit_test(a_tetrahedron_has_three_tabs),
        cmocka_unit_test(small_faces_get_the_largest_tab_that_fits_under_them),
        cmocka_unit_test(separate_faces_compete_for_room_and_never_collide),
        cmocka_unit_test(tabs_share_the_flat_region_under_a_lid),
        cmocka_unit_test(random_nets_at_all_sizes_keep_their_tabs_apart),
        cmocka_unit_test(large_smooth_nets_lose_few_tabs),
        cmocka_unit_test(the_side_policy_is_followed_where_there_is_room),
        cmocka_unit_test(no_tabs_when_none_are_wanted),
        cmocka_unit_test(finishing_twice_gives_the_same_once),
        cmocka_unit_test(every_failing_allocation_is_survived),
        cmocka_unit_test(patterns_that_do_not_hang_together_are_refused),
    };
    return cmocka_run_group_tests_name("pattern/tabs", tests, make_context, drop_context);
}
