/* The last resort of tabs: a low triangle between walls, where cutting back leaves nothing. */
#include "pattern/tab_room.h"

#include "core/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#define LENGTH 20.0

static const ktg_tab_wish wish = {LENGTH, 5, 2};

/* The distance of a point to a wall. */
static double distance(ktg_vec2 p, const ktg_tab_wall *wall) {
    ktg_vec2 d = ktg_sub2(wall->ends[1], wall->ends[0]), v = ktg_sub2(p, wall->ends[0]);
    double s = fmax(0, fmin(1, ktg_dot2(v, d) / ktg_dot2(d, d)));
    return ktg_length2(ktg_madd2(v, -s, d));
}

/* By samples: every point of the tab keeps the wall's clearance, but for what is below the edge. */
static void assert_keeps_clear(const ktg_trapezoid *t, const ktg_tab_wall *wall) {
    for (int i = 0; i <= 40; i++)
        for (int j = 0; j <= 40; j++) {
            double y = t->height * i / 40, left = t->left + t->left_cot * y;
            double right = t->right - t->right_cot * y;
            ktg_vec2 p = {left + (right - left) * j / 40, y};
            assert_true(distance(p, wall) >= wall->clearance * (1 - 1e-6));
        }
}

static void a_wedge_of_seven_degrees_takes_a_low_tab(void **state) {
    (void)state;
    double angle = 7 * KTG_PI / 180;
    ktg_tab_wall walls[] = {{{{0, 0}, {30 * cos(angle), 30 * sin(angle)}}, 0.1},
                            {{{LENGTH, 0}, {LENGTH + 5, -8}}, 0.1}};
    ktg_trapezoid room;
    assert_true(ktg_trapezoid_search(&room, &wish, 0.3, walls, 2));
    assert_true(ktg_trapezoid_is_tab(&room, &wish));
    assert_true(room.left > 0 && room.right < LENGTH);
    assert_true(room.height < LENGTH * tan(angle));
}

static void under_a_low_ceiling_there_is_no_tab(void **state) {
    (void)state;
    ktg_tab_wall walls[] = {{{{-5, 2.05}, {25, 2.05}}, 0.1}};
    ktg_trapezoid room;
    assert_false(ktg_trapezoid_search(&room, &wish, 0.3, walls, 1));
    walls[0].ends[0].y = walls[0].ends[1].y = 2.2;
    assert_true(ktg_trapezoid_search(&room, &wish, 0.3, walls, 1));
    assert_true(room.height >= 2 && room.height <= 2.1);
}

static void the_way_between_two_spikes_is_found(void **state) {
    (void)state;
    ktg_tab_wall walls[] = {{{{5, 9}, {5, 0.9}}, 0.1}, {{{15, 9}, {15, 0.9}}, 0.1}};
    ktg_trapezoid room;
    assert_true(ktg_trapezoid_search(&room, &wish, 0.3, walls, 2));
    assert_true(room.right - room.left >= 0.5 * LENGTH);
    for (int k = 0; k < 2; k++)
        assert_keeps_clear(&room, &walls[k]);
}

static void whatever_is_found_keeps_clear_of_random_walls(void **state) {
    (void)state;
    ktg_random random;
    ktg_random_seed(&random, 7);
    int found = 0;
    for (int round = 0; round < 400; round++) {
        ktg_tab_wall walls[6];
        for (int k = 0; k < 6; k++) {
            ktg_vec2 a = {30 * ktg_random_unit(&random) - 5, 0.2 + 6 * ktg_random_unit(&random)};
            double angle = 2 * KTG_PI * ktg_random_unit(&random);
            ktg_vec2 b = ktg_madd2(a, 4, (ktg_vec2){cos(angle), sin(angle)});
            b.y = fmax(b.y, 0.2); /* above the edge all of it counts */
            walls[k] = (ktg_tab_wall){{a, b}, k % 2 ? 0.1 : 0.3};
        }
        ktg_trapezoid room;
        if (!ktg_trapezoid_search(&room, &wish, 0.3, walls, 6))
            continue;
        found++;
        assert_true(ktg_trapezoid_is_tab(&room, &wish));
        assert_true(room.height <= wish.height);
        for (int k = 0; k < 6; k++)
            assert_keeps_clear(&room, &walls[k]);
    }
    assert_in_range(found, 60, 399);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_wedge_of_seven_degrees_takes_a_low_tab),
        cmocka_unit_test(under_a_low_ceiling_there_is_no_tab),
        cmocka_unit_test(the_way_between_two_spikes_is_found),
        cmocka_unit_test(whatever_is_found_keeps_clear_of_random_walls),
    };
    return cmocka_run_group_tests_name("pattern/tab_low", tests, NULL, NULL);
}
