/* Short texts at points of a picture: at their points, or in columns beside it. */
#include "render/callouts.h"

#include "tests/short_memory.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#define DIGIT_MM 2.0
#define MOST     20

static const ktg_area page = {0, 0, 100, 60}, picture = {30, 5, 70, 55};

typedef struct board {
    ktg_context *context;
    cairo_surface_t *surface;
    cairo_t *cairo;
    ktg_callout callouts[MOST];
    size_t count;
} board;

static int make_board(void **state) {
    static board b;
    b.count = 0;
    b.surface = cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, NULL);
    b.cairo = cairo_create(b.surface);
    ktg_page_begin(b.cairo);
    *state = &b;
    return ktg_context_new(&b.context);
}

static int drop_board(void **state) {
    board *b = *state;
    cairo_destroy(b->cairo);
    cairo_surface_destroy(b->surface);
    ktg_context_free(&b->context);
    return 0;
}

static void tell(board *b, double x, double y) {
    ktg_callout *c = &b->callouts[b->count++];
    *c = (ktg_callout){.at = {x, y}};
    snprintf(c->text, sizeof c->text, "shoulder-%zu", b->count);
}

/* Points in a knot in the middle of the picture, none above another. */
static void tell_many(board *b, size_t count) {
    for (size_t i = 0; i < count; i++)
        tell(b, 50 + 0.8 * (double)(7 * i % count) - 0.4 * (double)count,
             30 + 0.5 * (double)(11 * i % 13));
}

static void put(board *b) {
    ktg_callouts_place(b->cairo, b->callouts, b->count, DIGIT_MM, page, NULL, 0);
    assert_int_equal(
        ktg_callouts_spread(b->context, b->cairo, b->callouts, b->count, DIGIT_MM, page, picture),
        KTG_OK);
}

static bool meet(ktg_area a, ktg_area b) {
    return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

static bool is_beside(const ktg_callout *c) {
    return c->is_placed && (c->box.x1 < picture.x0 || c->box.x0 > picture.x1);
}

static size_t count_beside(const board *b) {
    size_t beside = 0;
    for (size_t i = 0; i < b->count; i++)
        beside += is_beside(&b->callouts[i]);
    return beside;
}

/* A callout's leader, from the edge of its box. */
static ktg_vec2 start_of(const ktg_callout *c) {
    return (ktg_vec2){c->box.x1 < c->at.x ? c->box.x1 : c->box.x0, (c->box.y0 + c->box.y1) / 2};
}

static bool is_left(ktg_vec2 a, ktg_vec2 b, ktg_vec2 p) {
    return ktg_cross2(ktg_sub2(b, a), ktg_sub2(p, a)) > 0;
}

static void assert_apart(const ktg_callout *a, const ktg_callout *b) {
    ktg_vec2 p = start_of(a), q = start_of(b);
    assert_false(meet(a->box, b->box));
    assert_false(is_left(p, a->at, q) != is_left(p, a->at, b->at) &&
                 is_left(q, b->at, p) != is_left(q, b->at, a->at));
}

static void few_texts_stay_at_their_points(void **state) {
    board *b = *state;
    tell(b, 50, 15);
    tell(b, 50, 30);
    tell(b, 50, 45);
    put(b);
    assert_int_equal(count_beside(b), 0);
    for (size_t i = 0; i < b->count; i++)
        assert_true(b->callouts[i].is_placed &&
                    fabs(b->callouts[i].box.x0 + b->callouts[i].box.x1 - 100) < 1e-9);
}

static void a_crowd_goes_beside_the_picture(void **state) {
    board *b = *state;
    for (size_t count = 6; count <= MOST; count++) {
        b->count = 0;
        tell_many(b, count);
        put(b);
        assert_int_equal(count_beside(b), count);
        size_t left = 0;
        for (size_t i = 0; i < count; i++) {
            ktg_area box = b->callouts[i].box;
            assert_true(box.x0 >= page.x0 && box.x1 <= page.x1);
            assert_true(box.y0 >= page.y0 && box.y1 <= page.y1);
            left += box.x1 < picture.x0;
            for (size_t k = 0; k < i; k++)
                assert_apart(&b->callouts[i], &b->callouts[k]);
        }
        assert_int_equal(left, (count + 1) / 2);
    }
}

/* Heights are those of the points, where nothing is in the way. */
static void leaders_are_level_where_they_can_be(void **state) {
    board *b = *state;
    for (int i = 0; i < 8; i++)
        tell(b, i % 2 ? 42 : 58, 9 + 6.0 * i);
    for (int i = 0; i < 8; i++)
        snprintf(b->callouts[i].text, sizeof b->callouts[i].text, "a shoulder to lean on");
    ktg_area wide = {-60, 0, 160, 60};
    ktg_callouts_place(b->cairo, b->callouts, b->count, DIGIT_MM, wide, NULL, 0);
    assert_int_equal(
        ktg_callouts_spread(b->context, b->cairo, b->callouts, b->count, DIGIT_MM, wide, picture),
        KTG_OK);
    assert_int_equal(count_beside(b), 8);
    for (size_t i = 0; i < b->count; i++)
        assert_true(fabs(start_of(&b->callouts[i]).y - b->callouts[i].at.y) < 1e-9);
}

static void without_room_beside_nothing_changes(void **state) {
    board *b = *state;
    ktg_area wide = {10, 5, 90, 55};
    ktg_callout before[MOST];
    tell_many(b, 12);
    ktg_callouts_place(b->cairo, b->callouts, b->count, DIGIT_MM, page, NULL, 0);
    memcpy(before, b->callouts, sizeof before);
    assert_int_equal(
        ktg_callouts_spread(b->context, b->cairo, b->callouts, b->count, DIGIT_MM, page, wide),
        KTG_OK);
    assert_memory_equal(before, b->callouts, b->count * sizeof *before);
    ktg_area low = {0, 25, 100, 38}; /* nor above each other */
    assert_int_equal(
        ktg_callouts_spread(b->context, b->cairo, b->callouts, b->count, DIGIT_MM, low, picture),
        KTG_OK);
    assert_memory_equal(before, b->callouts, b->count * sizeof *before);
}

static void the_room_that_is_told_is_just_enough(void **state) {
    board *b = *state;
    tell_many(b, 12);
    ktg_callouts_place(b->cairo, b->callouts, b->count, DIGIT_MM, page, NULL, 0);
    double widest = 0;
    for (size_t i = 0; i < b->count; i++)
        widest = fmax(widest, ktg_text_width(b->cairo, b->callouts[i].text));
    ktg_vec2 room = ktg_callouts_room(b->count, widest, DIGIT_MM);
    for (int enough = 0; enough < 2; enough++) {
        double x = room.x + (enough ? 0 : -0.1);
        ktg_area shown = {page.x0 + x, 5, page.x1 - x, 55};
        assert_int_equal(
            ktg_callouts_spread(b->context, b->cairo, b->callouts, b->count, DIGIT_MM, page, shown),
            KTG_OK);
        size_t beside = 0;
        for (size_t i = 0; i < b->count; i++)
            beside += b->callouts[i].box.x1 < shown.x0 - 2 || b->callouts[i].box.x0 > shown.x1 + 2;
        assert_int_equal(beside, enough ? b->count : 0);
    }
}

static void short_memory_is_told(void **state) {
    board *b = *state;
    ktg_status status = KTG_MEMORY;
    tell_many(b, 12);
    ktg_callouts_place(b->cairo, b->callouts, b->count, DIGIT_MM, page, NULL, 0);
    for (uint64_t nth = 1; status == KTG_MEMORY; nth++) {
        ktg_context_fail_allocation(b->context, nth);
        status = ktg_callouts_spread(b->context, b->cairo, b->callouts, b->count, DIGIT_MM, page,
                                     picture);
        assert_int_equal(status == KTG_OK, nth == 4);
    }
    end_short_memory(b->context, status);
}

#define CASE(name) cmocka_unit_test_setup_teardown(name, make_board, drop_board)

int main(void) {
    const struct CMUnitTest tests[] = {
        CASE(few_texts_stay_at_their_points),       CASE(a_crowd_goes_beside_the_picture),
        CASE(leaders_are_level_where_they_can_be),  CASE(without_room_beside_nothing_changes),
        CASE(the_room_that_is_told_is_just_enough), CASE(short_memory_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
