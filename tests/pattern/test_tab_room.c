/* A tab that something stands beside: how it is cut back. */
#include "pattern/tab_room.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static const ktg_tab_wish wish = {.length = 20, .height = 5, .least = 2};

static double distance_to_line(ktg_vec2 p, ktg_vec2 a, ktg_vec2 b) {
    ktg_vec2 along = ktg_sub2(b, a);
    return fabs(ktg_cross2(along, ktg_sub2(p, a))) / ktg_length2(along);
}

/* A spike comes down from above until it nearly touches a flank, at the left or at the right. */
static void a_flank_leans_just_so_far_that_the_spike_is_clear(void **state) {
    (void)state;
    for (int right = 0; right < 2; right++) {
        ktg_vec2 spike[3] = {{2.6, 3}, {2.7, 9}, {2.5, 9}};
        for (int k = 0; k < 3 && right; k++)
            spike[k].x = wish.length - spike[k].x;
        ktg_trapezoid tab = ktg_trapezoid_wished(wish.length, wish.height, 0.84, 0.3);
        double base = tab.right - tab.left;
        ktg_trapezoid_cut(&tab, &wish, spike, 3, 0.3);
        ktg_vec2 corners[4];
        assert_int_equal(ktg_trapezoid_corners(&tab, corners), 4);
        assert_true(tab.right - tab.left == base && tab.height == wish.height);
        double away = right ? distance_to_line(spike[0], corners[1], corners[2])
                            : distance_to_line(spike[0], corners[0], corners[3]);
        assert_true(fabs(away - 0.3) < 1e-9);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_flank_leans_just_so_far_that_the_spike_is_clear),
    };
    return cmocka_run_group_tests_name("pattern/tab_room", tests, NULL, NULL);
}
