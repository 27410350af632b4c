/* Seams, outlines, labels. */
#include "check.h"
#include "cloth.h"
#include "nets.h"

#include "core/vec.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return 0;
}

/* Surface vertices from and to of a seam's k-th edge, as its side 0 runs. */
static void ends_of(const ktg_pattern *p, const ktg_pattern_seam *seam, uint32_t k, uint32_t *from,
                    uint32_t *to) {
    const ktg_pattern_side *side = &p->edges[seam->edges[k]].sides[seam->first_side[k]];
    *from = p->faces[3 * side->face + side->corner];
    *to = p->faces[3 * side->face + (side->corner + 1) % 3];
}

static void every_cut_edge_is_in_one_seam_and_seams_are_chains(void **state) {
    for (uint64_t seed = 1; seed < 10; seed++) {
        ktg_pattern *p = net_finished(*state, make_bumpy_ball(70, 0.3, 1, seed), 20, seed, NULL);
        uint32_t *uses = calloc(p->edge_count, sizeof *uses);
        for (size_t s = 0; s < p->seam_count; s++) {
            const ktg_pattern_seam *seam = &p->seams[s];
            uint32_t before = 0, from, to;
            double length = 0;
            for (uint32_t k = 0; k < seam->edge_count; k++) {
                const ktg_pattern_edge *edge = &p->edges[seam->edges[k]];
                uses[seam->edges[k]]++;
                assert_int_equal(edge->seam, s);
                assert_int_equal(edge->sides[seam->first_side[k]].piece, seam->pieces[0]);
                assert_int_equal(edge->sides[1 - seam->first_side[k]].piece, seam->pieces[1]);
                ends_of(p, seam, k, &from, &to);
                assert_true(k == 0 || from == before);
                before = to;
                length += ktg_length3(ktg_sub3(p->vertices[to], p->vertices[from]));
            }
            assert_true(fabs(seam->lengths_mm[0] - length) < 1e-9 * length);
            assert_true(fabs(seam->lengths_mm[1] - length) < 1e-9 * length);
        }
        for (size_t e = 0; e < p->edge_count; e++)
            assert_int_equal(uses[e], p->edges[e].kind == KTG_EDGE_CUT);
        free(uses);
        ktg_pattern_free(&p);
    }
}

/* Cut edges at a surface vertex. */
static uint32_t cuts_at(const ktg_pattern *p, uint32_t vertex) {
    uint32_t cuts = 0;
    for (size_t e = 0; e < p->edge_count; e++)
        cuts += p->edges[e].kind == KTG_EDGE_CUT &&
                (p->edges[e].vertices[0] == vertex || p->edges[e].vertices[1] == vertex);
    return cuts;
}

static void seams_break_just_where_other_than_two_cuts_meet(void **state) {
    for (uint64_t seed = 1; seed < 10; seed++) {
        ktg_pattern *p = net_finished(*state, make_bumpy_ball(70, 0.3, 1, seed), 1000, seed, NULL);
        if (p->piece_count == 1) {
            size_t ends = 0;
            for (size_t s = 0; s < p->seam_count; s++) {
                const ktg_pattern_seam *seam = &p->seams[s];
                uint32_t from, to;
                ends_of(p, seam, 0, &from, &to);
                assert_int_not_equal(cuts_at(p, from), 2);
                ends_of(p, seam, seam->edge_count - 1, &from, &to);
                assert_int_not_equal(cuts_at(p, to), 2);
                ends += 2;
            }
            size_t wanted = 0;
            for (uint32_t v = 0; v < p->vertex_count; v++)
                wanted += cuts_at(p, v) == 2 ? 0 : cuts_at(p, v);
            assert_int_equal(ends, wanted);
        }
        ktg_pattern_free(&p);
    }
}

static void a_seam_that_zips_up_a_leaf_ends_there(void **state) {
    for (uint64_t seed = 1; seed < 10; seed++) {
        ktg_pattern *p = net_finished(*state, make_bumpy_ball(70, 0.3, 1, seed), 1000, seed, NULL);
        for (size_t s = 0; s < p->seam_count; s++) {
            const ktg_pattern_seam *seam = &p->seams[s];
            uint32_t first, last, unused;
            ends_of(p, seam, 0, &first, &unused);
            ends_of(p, seam, seam->edge_count - 1, &unused, &last);
            if (cuts_at(p, first) == 1)
                assert_int_equal(cuts_at(p, last), 1);
        }
        ktg_pattern_free(&p);
    }
}

static void outlines_are_closed_counter_clockwise_walks_with_all_tabs(void **state) {
    ktg_pattern *p = net_finished(*state, make_bumpy_ball(70, 0.3, 1, 3), 20, 3, NULL);
    for (size_t i = 0; i < p->piece_count; i++) {
        const ktg_pattern_piece *piece = &p->pieces[i];
        size_t border = 0, corners = 0;
        for (size_t e = 0; e < p->edge_count; e++)
            for (uint32_t s = 0; s < p->edges[e].side_count; s++)
                border += p->edges[e].kind == KTG_EDGE_CUT && p->edges[e].sides[s].piece == i;
        for (size_t t = 0; t < piece->tab_count; t++)
            corners += piece->tabs[t].corner_count;
        assert_int_equal(piece->outline_count, border + corners);
        assert_true(area_of_polygon(piece->outline, piece->outline_count) > 0);
    }
    ktg_pattern_free(&p);
}

/* Half width and height of a text about its centre, as labels are planned. */
static bool inside_tab(const ktg_pattern_label *label, const ktg_pattern_tab *tab) {
    double c = cos(label->rotation), s = sin(label->rotation);
    double w = 0.4 * label->height_mm * (double)strlen(label->text), h = label->height_mm / 2;
    for (int k = 0; k < 4; k++) {
        double x = k & 1 ? w : -w, y = k & 2 ? h : -h;
        ktg_vec2 p = {label->at.x + c * x - s * y, label->at.y + s * x + c * y};
        for (uint32_t i = 0; i < tab->corner_count; i++) {
            ktg_vec2 a = tab->corners[i], b = tab->corners[(i + 1) % tab->corner_count];
            if (ktg_cross2(ktg_sub2(b, a), ktg_sub2(p, a)) < 0)
                return false;
        }
    }
    return true;
}

static void every_seam_has_its_number_twice_and_on_large_nets_on_the_tab(void **state) {
    ktg_pattern *p = net_finished(*state, make_bumpy_ball(150, 0.2, 1, 3), 20, 3, NULL);
    uint32_t on_tabs = 0;
    for (size_t s = 0; s < p->seam_count; s++) {
        char text[24];
        uint32_t found = 0;
        snprintf(text, sizeof text, "%zu", s + 1);
        for (size_t i = 0; i < p->piece_count; i++)
            for (size_t k = 0; k < p->pieces[i].label_count; k++) {
                const ktg_pattern_label *label = &p->pieces[i].labels[k];
                if (label->edge == KTG_NONE || p->edges[label->edge].seam != s)
                    continue;
                found++;
                assert_int_equal(strtoul(label->text, NULL, 10), s + 1);
                assert_true(label->height_mm >= 1.6 && label->height_mm <= 2.4 + 1e-9);
                for (size_t t = 0; t < p->pieces[i].tab_count; t++)
                    if (p->pieces[i].tabs[t].edge == label->edge)
                        on_tabs += inside_tab(label, &p->pieces[i].tabs[t]);
            }
        assert_int_equal(found, 2);
    }
    assert_true(on_tabs >= 0.9 * p->seam_count);
    ktg_pattern_free(&p);
}

/* Where the two copies of a seam's edge lie, flat. */
static void copies_of(const ktg_pattern *p, const ktg_pattern_seam *seam, uint32_t k,
                      ktg_vec2 ends[2][2]) {
    const ktg_pattern_edge *edge = &p->edges[seam->edges[k]];
    for (int s = 0; s < 2; s++) {
        const ktg_pattern_side *side = &edge->sides[seam->first_side[k] ^ s];
        const ktg_pattern_piece *piece = &p->pieces[side->piece];
        for (size_t f = 0; f < piece->face_count; f++)
            for (uint32_t c = 0; c < 2 && piece->faces[f] == side->face; c++)
                ends[s][c] = piece->vertices[piece->corners[3 * f + (side->corner + c) % 3]];
    }
}

static size_t labels_on(const ktg_pattern *p, const ktg_pattern_seam *seam) {
    size_t count = 0;
    for (size_t i = 0; i < p->piece_count; i++)
        for (size_t k = 0; k < p->pieces[i].label_count; k++)
            for (uint32_t e = 0; e < seam->edge_count; e++)
                count += p->pieces[i].labels[k].edge == seam->edges[e];
    return count;
}

static void seams_in_narrow_notches_bear_no_number_and_come_last(void **state) {
    size_t obvious = 0, plain = 0;
    for (uint64_t seed = 1; seed < 10; seed++) {
        ktg_pattern *p = net_finished(*state, make_bumpy_ball(20, 0.2, 2, seed), 1000, seed, NULL);
        bool before = false;
        for (size_t s = 0; s < p->seam_count; s++) {
            const ktg_pattern_seam *seam = &p->seams[s];
            assert_true(seam->obvious || !before);
            before = seam->obvious;
            assert_int_equal(labels_on(p, seam), seam->obvious ? 0 : 2);
            if (!seam->obvious) {
                plain++;
                continue;
            }
            obvious++;
            bool meet = false;
            for (uint32_t k = 0; k < seam->edge_count; k++) {
                ktg_vec2 e[2][2];
                copies_of(p, seam, k, e);
                ktg_vec2 apart = ktg_sub2(ktg_add2(e[0][0], e[0][1]), ktg_add2(e[1][0], e[1][1]));
                assert_true(ktg_length2(apart) / 2 <= 12 + 1e-9);
                meet = meet || ktg_length2(ktg_sub2(e[0][0], e[1][1])) < 1e-9 ||
                       ktg_length2(ktg_sub2(e[0][1], e[1][0])) < 1e-9;
            }
            assert_true(meet);
        }
        ktg_pattern_free(&p);
    }
    assert_true(obvious > 10 && plain > 10);
    ktg_finish_options o;
    ktg_finish_defaults(&o);
    o.numbers = KTG_NUMBER_EDGE; /* then all are numbered */
    ktg_pattern *p = net_finished(*state, make_bumpy_ball(20, 0.2, 2, 1), 1000, 1, &o);
    for (size_t s = 0; s < p->seam_count; s++)
        assert_int_equal(labels_on(p, &p->seams[s]), 2 * p->seams[s].edge_count);
    ktg_pattern_free(&p);
}

static void numbers_without_room_have_a_leader_to_their_edge(void **state) {
    size_t leaders = 0, covered = 0;
    ktg_finish_options o;
    ktg_finish_defaults(&o);
    o.numbers = KTG_NUMBER_EDGE;
    for (uint64_t seed = 1; seed < 5; seed++) {
        ktg_pattern *p = net_finished(*state, make_prism(24, 2.2, 40), 1000, seed, &o);
        for (size_t i = 0; i < p->piece_count; i++)
            for (size_t k = 0; k < p->pieces[i].label_count; k++) {
                const ktg_pattern_label *label = &p->pieces[i].labels[k];
                for (size_t j = 0; j < k; j++)
                    covered += ktg_length2(ktg_sub2(p->pieces[i].labels[j].at, label->at)) < 1.2;
                if (!label->leader)
                    continue;
                leaders++;
                assert_true(label->edge != KTG_NONE);
                double nearest = INFINITY;
                for (int s = 0; s < 2; s++) {
                    ktg_vec2 e[2][2];
                    uint32_t edge = label->edge;
                    ktg_pattern_seam one = {1, &edge, &(uint8_t){0}, {0, 0}, {0, 0}, false};
                    copies_of(p, &one, 0, e);
                    ktg_vec2 middle = ktg_mul2(ktg_add2(e[s][0], e[s][1]), 0.5);
                    nearest = fmin(nearest, ktg_length2(ktg_sub2(label->foot, middle)));
                }
                assert_true(nearest < 0.31);
                for (size_t j = 0; j < k; j++) {
                    const ktg_pattern_label *other = &p->pieces[i].labels[j];
                    assert_true(ktg_length2(ktg_sub2(other->at, label->at)) >= 1.6 - 1e-9);
                }
            }
        ktg_pattern_free(&p);
    }
    assert_true(leaders > 5 && covered < leaders / 8);
}

static void numbers_that_read_upside_down_have_a_dot(void **state) {
    ktg_finish_options o;
    ktg_finish_defaults(&o);
    o.numbers = KTG_NUMBER_EDGE;
    ktg_pattern *p = net_finished(*state, make_bumpy_ball(150, 0.2, 2, 3), 3, 3, &o);
    const char *with[] = {"6.", "9.", "16.", "66.", "68.", "86.", "89.", "98.", "99.", "106."};
    const char *without[] = {"1", "8", "11", "60", "69", "88", "96", "101", "7", "26"};
    for (size_t k = 0; k < 10; k++)
        assert_true(net_has_text(p, with[k]));
    for (size_t k = 0; k < 10; k++)
        assert_true(net_has_text(p, without[k]));
    assert_false(net_has_text(p, "6"));
    assert_false(net_has_text(p, "99"));
    ktg_pattern_free(&p);
}

static void numbers_in_a_face_do_not_cover_each_other(void **state) {
    ktg_pattern *p = net_finished(*state, make_tetrahedron(60), 1, 1, NULL);
    for (size_t i = 0; i < p->piece_count; i++)
        for (size_t a = 0; a < p->pieces[i].label_count; a++)
            for (size_t b = 0; b < a; b++) {
                const ktg_pattern_label *l = p->pieces[i].labels;
                assert_true(ktg_length2(ktg_sub2(l[a].at, l[b].at)) >=
                            fmin(l[a].height_mm, l[b].height_mm));
            }
    ktg_pattern_free(&p);
}

/* Two oblongs joined along a side that is broken: the lower part of it is too short for a number of
 * the wished height. */
static void a_seam_bears_its_number_where_that_is_highest(void **state) {
    const cloth_piece pieces[] = {
        {"left", 5, {{0, 0}, {40, 0}, {40, 2}, {40, 40}, {0, 40}}, {0, 1, 2, 3, 4}},
        {"right", 5, {{40, 0}, {40, 40}, {0, 40}, {0, 2}, {0, 0}}, {5, 6, 3, 2, 1}}};
    const ktg_vec3 positions[] = {{0, 0, 0},  {40, 0, 0}, {40, 2, 0}, {40, 40, 0},
                                  {0, 40, 0}, {80, 0, 0}, {80, 40, 0}};
    ktg_finish_options o;
    ktg_finish_defaults(&o);
    o.tab_height_mm = 0;
    ktg_pattern *p = cloth_make(*state, pieces, 2, positions, 7);
    p->mode = KTG_PAPER;
    assert_int_equal(ktg_pattern_finish(*state, p, &o, NULL), KTG_OK);
    assert_int_equal(p->seam_count, 1);
    assert_int_equal(labels_on(p, &p->seams[0]), 2);
    for (size_t i = 0; i < p->piece_count; i++)
        for (size_t k = 0; k < p->pieces[i].label_count; k++)
            if (p->pieces[i].labels[k].edge != KTG_NONE)
                assert_true(p->pieces[i].labels[k].height_mm == o.number_mm);
    ktg_pattern_free(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_cut_edge_is_in_one_seam_and_seams_are_chains),
        cmocka_unit_test(seams_break_just_where_other_than_two_cuts_meet),
        cmocka_unit_test(a_seam_that_zips_up_a_leaf_ends_there),
        cmocka_unit_test(outlines_are_closed_counter_clockwise_walks_with_all_tabs),
        cmocka_unit_test(every_seam_has_its_number_twice_and_on_large_nets_on_the_tab),
        cmocka_unit_test(seams_in_narrow_notches_bear_no_number_and_come_last),
        cmocka_unit_test(numbers_without_room_have_a_leader_to_their_edge),
        cmocka_unit_test(numbers_that_read_upside_down_have_a_dot),
        cmocka_unit_test(numbers_in_a_face_do_not_cover_each_other),
        cmocka_unit_test(a_seam_bears_its_number_where_that_is_highest),
    };
    return cmocka_run_group_tests_name("pattern/seams", tests, make_context, drop_context);
}
