/* Patterns of cloth pass; each kind of damage is refused with its reason. */
#include "tests/pattern/cloth.h"
#include "verify/verify.h"

static int make_context(void **state) {
    return ktg_context_new((ktg_context **)state);
}

static int drop_context(void **state) {
    ktg_context_free((ktg_context **)state);
    return 0;
}

static ktg_pattern *finished(ktg_context *context, ktg_pattern *p, const char *on_fold) {
    ktg_finish_options options;
    ktg_finish_defaults(&options);
    options.on_fold = &on_fold;
    options.on_fold_count = on_fold ? 1 : 0;
    assert_int_equal(ktg_pattern_finish(context, p, &options, NULL), KTG_OK);
    return p;
}

/* Verifies and frees the pattern; `words`: what the refusal must say, NULL: none. */
static void check(ktg_context *context, ktg_pattern *p, const char *words) {
    ktg_status status = ktg_verify(context, p, NULL, NULL);
    const char *message = ktg_context_message(context);
    if (words ? status != KTG_UNSOUND || !strstr(message, words) : status != KTG_OK)
        fail_msg("\"%s\" instead of \"%s\"", message, words ? words : "sound");
    ktg_pattern_free(&p);
}

static void what_was_made_is_sound(void **state) {
    check(*state, finished(*state, cloth_oblongs(*state), NULL), NULL);
    check(*state, finished(*state, cloth_with_dart(*state), NULL), NULL);
    check(*state, finished(*state, cloth_with_dart(*state), "skirt"), NULL);
}

/* Marks begin at the cut, however far that is from the seam. */
static void wide_allowances_are_sound(void **state) {
    ktg_pattern *p = cloth_oblongs(*state);
    ktg_finish_options options;
    ktg_finish_defaults(&options);
    options.allowance_mm = 300;
    assert_int_equal(ktg_pattern_finish(*state, p, &options, NULL), KTG_OK);
    assert_true(p->seams[0].notch_count > 0);
    check(*state, p, NULL);
}

/* Wherever the line starts. */
static void a_cutting_line_that_crosses_itself_is_refused(void **state) {
    for (int start = 0; start < 6; start++) {
        ktg_pattern *p = finished(*state, cloth_oblongs(*state), NULL);
        const ktg_vec2 *o = p->pieces[0].outline;
        const ktg_vec2 loop[6] = {/* outside the first corner */
                                  ktg_add2(o[0], (ktg_vec2){-50, -50}), o[2], o[1],
                                  ktg_add2(o[1], (ktg_vec2){-50, 60}),  o[3], o[0]};
        ktg_vec2 *grown = ktg_new(*state, 6, ktg_vec2);
        for (int i = 0; i < 6; i++)
            grown[i] = loop[(i + start) % 6];
        free(p->pieces[0].outline);
        p->pieces[0].outline = grown;
        p->pieces[0].outline_count = 6;
        check(*state, p, "cutting line of piece 1 crosses itself");
    }
}

static void cloth_outside_its_cutting_line_is_refused(void **state) {
    ktg_pattern *p = finished(*state, cloth_oblongs(*state), NULL);
    for (int i = 0; i < 4; i++)
        p->pieces[0].outline[i].x += 40;
    check(*state, p, "reaches over its cutting line");
}

static void a_notch_without_its_mark_is_refused(void **state) {
    ktg_pattern *p = finished(*state, cloth_oblongs(*state), NULL);
    p->seams[0].notches[1].at += 0.01; /* 6 mm away */
    check(*state, p, "Seam 1 has no mark in piece 1");
    p = finished(*state, cloth_oblongs(*state), NULL);
    p->seams[0].notches[0].marks = 2;
    check(*state, p, "Seam 1 has no mark");
    p = finished(*state, cloth_oblongs(*state), NULL);
    p->seams[0].notches[0].at = 1.5;
    check(*state, p, "makes no sense");
}

static void twins_that_differ_are_refused(void **state) {
    ktg_pattern *p = finished(*state, cloth_oblongs(*state), NULL);
    assert_int_equal(p->pieces[1].cut_count, 0);
    for (size_t i = 0; i < p->pieces[0].line_count; i++)
        if (p->pieces[0].lines[i].kind == KTG_LINE_SEW)
            p->pieces[0].lines[i].points[3].x -= 5;
    check(*state, p, "are cut as one, but their shapes differ");
    p = finished(*state, cloth_oblongs(*state), NULL);
    p->pieces[0].cut_mirrored = 0;
    check(*state, p, "cut less often than it has twins");
    p = finished(*state, cloth_oblongs(*state), NULL);
    p->pieces[1].twin_of = 1;
    check(*state, p, "cut with a piece that is not cut");
}

/* Once for itself, and once for its twin. */
static void a_piece_is_laid_as_often_as_it_is_cut(void **state) {
    for (uint32_t times = 1; times <= 3; times++) {
        ktg_pattern *p = finished(*state, cloth_oblongs(*state), NULL);
        assert_int_equal(p->pieces[0].cut_mirrored, 1);
        p->sheet_count = 1;
        p->sheets = ktg_new(*state, 1, ktg_pattern_sheet);
        *p->sheets = (ktg_pattern_sheet){KTG_ROLL, 900, 900, {0, 0, 900, 900}, times};
        p->sheets->placements = ktg_new(*state, times, ktg_pattern_placement);
        for (uint32_t k = 0; k < times; k++)
            p->sheets->placements[k] = (ktg_pattern_placement){0, 100 + 200 * k, 100, 0};
        check(*state, p, times < 3 ? NULL : "Piece 1 is placed 3 times");
    }
}

static void half_a_piece_needs_its_fold(void **state) {
    ktg_pattern *p = finished(*state, cloth_with_dart(*state), "skirt");
    for (size_t i = 0; i < p->pieces[0].line_count; i++)
        if (p->pieces[0].lines[i].kind == KTG_LINE_FOLD)
            p->pieces[0].lines[i].kind = KTG_LINE_INTERNAL;
    check(*state, p, "a fold that is not drawn");
    p = finished(*state, cloth_with_dart(*state), "skirt");
    p->pieces[0].on_fold = false;
    check(*state, p, "encloses");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_was_made_is_sound),
        cmocka_unit_test(wide_allowances_are_sound),
        cmocka_unit_test(a_cutting_line_that_crosses_itself_is_refused),
        cmocka_unit_test(cloth_outside_its_cutting_line_is_refused),
        cmocka_unit_test(a_notch_without_its_mark_is_refused),
        cmocka_unit_test(twins_that_differ_are_refused),
        cmocka_unit_test(a_piece_is_laid_as_often_as_it_is_cut),
        cmocka_unit_test(half_a_piece_needs_its_fold),
    };
    return cmocka_run_group_tests_name("verify/cloth", tests, make_context, drop_context);
}
