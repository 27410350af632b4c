/* The names of pieces of paper: which have one, and where it stands. */
#include "nets.h"

#include "core/vec.h"

#include <setjmp.h>
#include <stdarg.h>
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

static void pieces_are_named_when_there_are_several(void **state) {
    ktg_pattern *p = net_finished(*state, make_tetrahedron(60), 1, 1, NULL);
    assert_true(net_has_text(p, "ball 1 of 4"));
    assert_true(net_has_text(p, "ball 4 of 4"));
    ktg_pattern_free(&p);
    p = net_finished(*state, make_tetrahedron(60), 4, 1, NULL);
    assert_false(net_has_text(p, "ball"));
    ktg_pattern_free(&p);
}

/* Half the room a label takes along its text and upright to it, as if letters were 0.6 wide. */
static ktg_vec2 half_of(const ktg_pattern_label *label) {
    return (ktg_vec2){0.3 * label->height_mm * (double)strlen(label->text), label->height_mm / 2};
}

/* True when the middle line of one label comes into the room of the other. */
static bool runs_into(const ktg_pattern_label *a, const ktg_pattern_label *b) {
    ktg_vec2 half = half_of(b), x = {cos(b->rotation), sin(b->rotation)};
    for (int i = -20; i <= 20; i++) {
        ktg_vec2 along = {cos(a->rotation), sin(a->rotation)};
        ktg_vec2 v = ktg_sub2(ktg_madd2(a->at, half_of(a).x * i / 20, along), b->at);
        if (fabs(ktg_dot2(v, x)) < half.x && fabs(ktg_cross2(x, v)) < half.y)
            return true;
    }
    return false;
}

static bool lies_in_piece(const ktg_pattern_piece *piece, ktg_vec2 at) {
    for (size_t f = 0; f < piece->face_count; f++) {
        bool inside = true;
        for (int k = 0; k < 3; k++) {
            ktg_vec2 a = piece->vertices[piece->corners[3 * f + k]];
            ktg_vec2 b = piece->vertices[piece->corners[3 * f + (k + 1) % 3]];
            inside &= ktg_cross2(ktg_sub2(b, a), ktg_sub2(at, a)) > 0;
        }
        if (inside)
            return true;
    }
    return false;
}

static void assert_name_has_its_room(const ktg_pattern_piece *piece,
                                     const ktg_pattern_label *name) {
    ktg_vec2 along = {cos(name->rotation), sin(name->rotation)};
    for (int end = -1; end <= 1; end += 2)
        assert_true(lies_in_piece(piece, ktg_madd2(name->at, end * half_of(name).x, along)));
    for (size_t i = 0; i < piece->label_count; i++)
        assert_true(&piece->labels[i] == name ||
                    (!runs_into(name, &piece->labels[i]) && !runs_into(&piece->labels[i], name)));
}

static void names_on_small_pieces_stay_inside_clear_of_numbers(void **state) {
    uint32_t names = 0;
    for (double radius = 8; radius < 40; radius *= 1.25)
        for (uint64_t seed = 1; seed < 6; seed++) {
            ktg_pattern *p =
                net_finished(*state, make_bumpy_ball(radius, 0.3, 1, seed), 6, seed, NULL);
            for (size_t i = 0; i < p->piece_count; i++)
                for (size_t k = 0; k < p->pieces[i].label_count; k++)
                    if (p->pieces[i].labels[k].edge == KTG_NONE) {
                        assert_name_has_its_room(&p->pieces[i], &p->pieces[i].labels[k]);
                        names++;
                    }
            ktg_pattern_free(&p);
        }
    assert_true(names > 100);
}

static void a_piece_too_small_for_its_name_says_which_part_it_is_or_nothing(void **state) {
    ktg_pattern *p = net_finished(*state, make_tetrahedron(18), 1, 1, NULL);
    assert_false(net_has_text(p, "ball 1 of 4"));
    assert_true(net_has_text(p, "1 of 4"));
    ktg_pattern_free(&p);
    p = net_finished(*state, make_tetrahedron(8), 1, 1, NULL);
    assert_false(net_has_text(p, "1 of 4"));
    ktg_pattern_free(&p);
}

/* Where an edge lies in the piece of its side 0. */
static void ends_in_piece(const ktg_pattern *p, const ktg_pattern_edge *edge, ktg_vec2 ends[2]) {
    const ktg_pattern_side *side = &edge->sides[0];
    const ktg_pattern_piece *piece = &p->pieces[side->piece];
    for (size_t f = 0; f < piece->face_count; f++)
        for (uint32_t k = 0; k < 2 && piece->faces[f] == side->face; k++)
            ends[k] = piece->vertices[piece->corners[3 * f + (side->corner + k) % 3]];
}

/* True when a and b lie on different sides of the line through c and d. */
static bool are_parted(ktg_vec2 a, ktg_vec2 b, ktg_vec2 c, ktg_vec2 d) {
    ktg_vec2 along = ktg_sub2(d, c);
    return ktg_cross2(along, ktg_sub2(a, c)) * ktg_cross2(along, ktg_sub2(b, c)) < 0;
}

static bool crosses_a_fold(const ktg_pattern *p, uint32_t piece, const ktg_pattern_label *name) {
    ktg_vec2 half = ktg_mul2((ktg_vec2){cos(name->rotation), sin(name->rotation)}, half_of(name).x);
    ktg_vec2 begin = ktg_sub2(name->at, half), end = ktg_add2(name->at, half),
             fold[2] = {{0, 0}, {0, 0}};
    for (size_t e = 0; e < p->edge_count; e++) {
        const ktg_pattern_edge *edge = &p->edges[e];
        if ((edge->kind != KTG_EDGE_MOUNTAIN && edge->kind != KTG_EDGE_VALLEY) ||
            edge->sides[0].piece != piece)
            continue;
        ends_in_piece(p, edge, fold);
        if (are_parted(begin, end, fold[0], fold[1]) && are_parted(fold[0], fold[1], begin, end))
            return true;
    }
    return false;
}

static void large_names_keep_between_the_folds_and_no_name_stands_on_its_head(void **state) {
    uint32_t large = 0;
    for (uint64_t seed = 1; seed < 20; seed++) {
        double radius = 20 + 2 * (double)seed;
        ktg_pattern *p = net_finished(*state, make_bumpy_ball(radius, 0.3, 1, seed), 6, seed, NULL);
        for (uint32_t i = 0; i < p->piece_count; i++)
            for (size_t k = 0; k < p->pieces[i].label_count; k++) {
                const ktg_pattern_label *label = &p->pieces[i].labels[k];
                if (label->edge != KTG_NONE)
                    continue;
                bool upright = fabs(cos(label->rotation)) < 1e-9;
                assert_true(upright ? sin(label->rotation) > 0 : cos(label->rotation) > 0);
                if (label->height_mm <= 2.4 + 1e-9) /* as high as those over folds may be */
                    continue;
                assert_false(crosses_a_fold(p, i, label));
                large++;
            }
        ktg_pattern_free(&p);
    }
    assert_true(large > 30);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_are_named_when_there_are_several),
        cmocka_unit_test(names_on_small_pieces_stay_inside_clear_of_numbers),
        cmocka_unit_test(large_names_keep_between_the_folds_and_no_name_stands_on_its_head),
        cmocka_unit_test(a_piece_too_small_for_its_name_says_which_part_it_is_or_nothing),
    };
    return cmocka_run_group_tests_name("pattern/names", tests, make_context, drop_context);
}
