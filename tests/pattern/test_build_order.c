/* The order in which seams are glued, told by taking the model through it step by step. */
#include "nets.h"

#include "core/vec.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
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

static ktg_pattern *finish(ktg_context *context, ktg_pattern *p, unsigned up) {
    ktg_finish_options o;
    ktg_finish_defaults(&o);
    o.up = up;
    assert_int_equal(ktg_pattern_finish(context, p, &o, NULL), KTG_OK);
    return p;
}

/* A ball in one piece, or in pieces of at most so many faces. */
static ktg_pattern *ball(ktg_context *context, uint32_t most_faces, uint64_t seed) {
    return finish(context, grow_net(context, make_bumpy_ball(70, 0.3, 2, seed), most_faces, seed),
                  1);
}

/* The surface's vertices where a seam begins (0) and ends (1). */
static uint32_t end_of(const ktg_pattern *p, size_t seam, int end) {
    const ktg_pattern_seam *s = &p->seams[seam];
    uint32_t k = end ? s->edge_count - 1 : 0;
    const ktg_pattern_edge *e = &p->edges[s->edges[k]];
    return e->vertices[s->first_side[k] ^ (uint32_t)end];
}

static void numbers_are_the_order_and_steps_follow_each_other(void **state) {
    for (uint64_t seed = 1; seed < 10; seed++) {
        ktg_pattern *p = ball(*state, seed % 2 ? 1000 : 25, seed);
        uint32_t section = 1;
        for (size_t s = 0; s < p->seam_count; s++) {
            assert_int_equal(p->seams[s].number, s + 1);
            assert_true(p->seams[s].section > 0);
            if (p->seams[s].obvious)
                continue;
            assert_true(p->seams[s].section == section || p->seams[s].section == section + 1);
            section = p->seams[s].section;
        }
        for (size_t s = 0; s < p->seam_count; s++)
            assert_true(p->seams[s].section <= section);
        ktg_pattern_free(&p);
    }
}

/* Whether all seams at a vertex but `seam` and those that close the model are glued. */
static bool is_closed(const ktg_pattern *p, const bool *glued, size_t seam, uint32_t vertex) {
    for (size_t s = 0; s < p->seam_count; s++)
        if (s != seam && !glued[s] && (end_of(p, s, 0) == vertex || end_of(p, s, 1) == vertex))
            return false;
    return true;
}

static void each_seam_of_one_piece_closes_like_a_zip(void **state) {
    for (uint64_t seed = 1; seed < 20; seed++) {
        ktg_pattern *p = ball(*state, 1000, seed);
        bool *glued = calloc(p->seam_count, sizeof *glued);
        for (int obvious = 1; p->piece_count == 1 && obvious >= 0; obvious--)
            for (size_t s = 0; s < p->seam_count; s++) {
                if (p->seams[s].obvious != obvious)
                    continue;
                if (!p->seams[s].closing)
                    assert_true(is_closed(p, glued, s, end_of(p, s, 0)) ||
                                is_closed(p, glued, s, end_of(p, s, 1)));
                glued[s] = true;
            }
        free(glued);
        ktg_pattern_free(&p);
    }
}

static void the_last_numbers_close_the_model(void **state) {
    for (uint64_t seed = 1; seed < 20; seed++) {
        ktg_pattern *p = ball(*state, seed % 2 ? 1000 : 25, seed);
        size_t closing = 0, numbered = 0;
        for (size_t s = 0; s < p->seam_count; s++) {
            assert_false(closing > 0 && !p->seams[s].obvious && !p->seams[s].closing);
            closing += p->seams[s].closing;
            numbered += !p->seams[s].obvious;
        }
        assert_true(closing >= 1 && closing <= 4 && numbered > closing);
        ktg_pattern_free(&p);
    }
}

/* True when all corners of the face on that side of an edge are at that height. */
static bool lies_in_plane(const ktg_pattern *p, const ktg_pattern_side *side, double z) {
    for (uint32_t k = 0; k < 3; k++)
        if (fabs(p->vertices[p->faces[3 * side->face + k]].z - z) > 1e-9)
            return false;
    return true;
}

/* Of the lids, which a net may cut apart, the lower one where both are as good. */
static void a_flat_prism_is_closed_with_a_lid(void **state) {
    size_t low = 0, high = 0;
    for (uint64_t seed = 1; seed < 10; seed++) {
        ktg_pattern *p = finish(*state, grow_net(*state, make_prism(6, 40, 15), 1000, seed), 2);
        size_t closing = 0;
        for (size_t s = 0; s < p->seam_count; s++) {
            const ktg_pattern_edge *e = &p->edges[p->seams[s].edges[0]];
            if (!p->seams[s].closing)
                continue;
            bool at_bottom = lies_in_plane(p, &e->sides[0], 0) || lies_in_plane(p, &e->sides[1], 0);
            assert_true(at_bottom || lies_in_plane(p, &e->sides[0], 15) ||
                        lies_in_plane(p, &e->sides[1], 15));
            low += at_bottom;
            high += !at_bottom;
            closing++;
        }
        assert_true(closing > 0);
        ktg_pattern_free(&p);
    }
    assert_true(low > 2 * high);
}

/* A vessel, wider above, with a swollen lid: an oblong of 50 x 50 between slopes of 9 degrees. The
 * slopes are its first faces. */
static surface *make_vessel(void) {
    static const double halves[3] = {30, 40, 25}, heights[3] = {0, 30, 32.376};
    surface *s = calloc(1, sizeof *s);
    for (uint32_t v = 0; v < 12; v++) {
        double half = halves[v / 4], x = v % 4 == 1 || v % 4 == 2 ? half : -half;
        s->vertices[v] = (ktg_vec3){x, v % 4 < 2 ? -half : half, heights[v / 4]};
    }
    s->vertex_count = 12;
    static const uint32_t flat[12] = {8, 9, 10, 8, 10, 11, 0, 2, 1, 0, 3, 2};
    for (uint32_t k = 0; k < 8; k++) {
        uint32_t low = k < 4 ? 4 : 0, a = low + k % 4, b = low + (k + 1) % 4;
        uint32_t six[6] = {a, b, b + 4, a, b + 4, a + 4};
        memcpy(&s->faces[6 * k], six, sizeof six);
    }
    memcpy(&s->faces[48], flat, sizeof flat);
    s->face_count = 20;
    return s;
}

/* The lid as a whole is larger than the bottom; grown from one of its slopes it is not. */
static void a_swollen_lid_closes_like_a_flat_one(void **state) {
    size_t low = 0, high = 0;
    for (uint64_t seed = 1; seed < 10; seed++) {
        ktg_pattern *p = finish(*state, grow_net(*state, make_vessel(), 1000, seed), 2);
        for (size_t s = 0; s < p->seam_count; s++)
            for (uint32_t k = 0; k < p->seams[s].edge_count && p->seams[s].closing; k++) {
                const uint32_t *v = p->edges[p->seams[s].edges[k]].vertices;
                low += v[0] < 4 && v[1] < 4;
                high += v[0] >= 4 && v[1] >= 4;
            }
        ktg_pattern_free(&p);
    }
    assert_true(high > 2 * low);
}

static uint32_t set_of(const uint32_t *parent, uint32_t i) {
    while (parent[i] != i)
        i = parent[i];
    return i;
}

/* False when a seam not yet glued lies within that body. */
static bool is_whole(const ktg_pattern *p, const bool *glued, const uint32_t *parent,
                     uint32_t body) {
    for (size_t s = 0; s < p->seam_count; s++)
        if (!glued[s] && !p->seams[s].obvious && set_of(parent, p->seams[s].pieces[0]) == body &&
            set_of(parent, p->seams[s].pieces[1]) == body)
            return false;
    return true;
}

static void limbs_are_whole_before_they_are_joined(void **state) {
    size_t joined = 0;
    for (uint64_t seed = 1; seed < 20; seed++) {
        ktg_pattern *p = ball(*state, 12, seed);
        assert_true(p->piece_count > 5);
        bool *glued = calloc(p->seam_count, sizeof *glued);
        uint32_t *parent = calloc(p->piece_count, sizeof *parent);
        for (uint32_t i = 0; i < p->piece_count; i++)
            parent[i] = i;
        for (size_t s = 0; s < p->seam_count && !p->seams[s].obvious; s++) {
            uint32_t a = set_of(parent, p->seams[s].pieces[0]);
            uint32_t b = set_of(parent, p->seams[s].pieces[1]);
            if (a != b) {
                assert_true(is_whole(p, glued, parent, a) && is_whole(p, glued, parent, b));
                parent[a] = b;
                joined++;
            }
            glued[s] = true;
        }
        free(glued);
        free(parent);
        ktg_pattern_free(&p);
    }
    assert_true(joined > 100);
}

/* Whether two seams have an end in common. */
static bool touch(const ktg_pattern *p, size_t a, size_t b) {
    for (int k = 0; k < 4; k++)
        if (end_of(p, a, k & 1) == end_of(p, b, k >> 1))
            return true;
    return false;
}

/* The seams that join two bodies, as they are glued, none where it is with them that the model is
 * closed; `joints` has room for all. */
static uint32_t joints_between(const ktg_pattern *p, const uint32_t *parent, uint32_t a, uint32_t b,
                               uint32_t *joints) {
    uint32_t count = 0;
    for (uint32_t s = 0; s < p->seam_count; s++) {
        uint32_t c = set_of(parent, p->seams[s].pieces[0]);
        uint32_t d = set_of(parent, p->seams[s].pieces[1]);
        if (!(c == a && d == b) && !(c == b && d == a))
            continue;
        if (p->seams[s].closing)
            return 0;
        joints[count++] = s;
    }
    return count;
}

/* How many runs of touching seams there are, and how many times the next one does not touch. */
static void count_runs(const ktg_pattern *p, const uint32_t *joints, uint32_t count, uint32_t *runs,
                       uint32_t *jumps) {
    uint32_t parent[100];
    *runs = *jumps = 0;
    for (uint32_t i = 0; i < count; i++) {
        parent[i] = i;
        *jumps += i > 0 && !touch(p, joints[i - 1], joints[i]);
        for (uint32_t k = 0; k < i; k++)
            if (touch(p, joints[i], joints[k]))
                parent[set_of(parent, i)] = set_of(parent, k);
    }
    for (uint32_t i = 0; i < count; i++)
        *runs += parent[i] == i;
}

static void a_piece_is_joined_from_one_end_to_the_other(void **state) {
    size_t joined = 0;
    for (uint64_t seed = 1; seed < 20; seed++) {
        ktg_pattern *p = ball(*state, 12, seed);
        uint32_t *parent = calloc(p->piece_count, sizeof *parent), joints[100];
        assert_true(p->seam_count <= 100);
        for (uint32_t i = 0; i < p->piece_count; i++)
            parent[i] = i;
        for (size_t s = 0; s < p->seam_count && !p->seams[s].obvious; s++) {
            uint32_t a = set_of(parent, p->seams[s].pieces[0]), runs, jumps;
            uint32_t b = set_of(parent, p->seams[s].pieces[1]);
            if (a == b)
                continue;
            uint32_t count = joints_between(p, parent, a, b, joints);
            count_runs(p, joints, count, &runs, &jumps);
            assert_true(jumps < runs || count == 0);
            joined += count > 2;
            parent[a] = b;
        }
        free(parent);
        ktg_pattern_free(&p);
    }
    assert_true(joined > 50);
}

static void steps_are_neither_small_nor_large(void **state) {
    for (uint64_t seed = 1; seed < 10; seed++) {
        ktg_pattern *p = ball(*state, 1000, seed);
        size_t counts[200] = {0}, small = 0;
        uint32_t sections = 0;
        for (size_t s = 0; s < p->seam_count; s++)
            if (!p->seams[s].obvious) {
                assert_true(p->seams[s].section < 200);
                counts[p->seams[s].section]++;
                sections = p->seams[s].section;
            }
        for (uint32_t i = 1; i <= sections; i++) {
            assert_true(counts[i] >= 1 && counts[i] <= 18);
            small += counts[i] < 4;
        }
        assert_true(small <= 2);
        ktg_pattern_free(&p);
    }
}

/* Whether one of the seams that close the model begins or ends at a vertex. */
static bool is_at_opening(const ktg_pattern *p, uint32_t vertex) {
    for (size_t s = 0; s < p->seam_count; s++)
        if (p->seams[s].closing && (end_of(p, s, 0) == vertex || end_of(p, s, 1) == vertex))
            return true;
    return false;
}

/* At a vertex, or by the opening they both lie at. */
static bool seams_meet(const ktg_pattern *p, uint32_t a, uint32_t b) {
    bool met = false, a_opens = false, b_opens = false;
    for (int k = 0; k < 4; k++)
        met = met || end_of(p, a, k & 1) == end_of(p, b, k >> 1);
    for (int k = 0; k < 2; k++) {
        a_opens = a_opens || is_at_opening(p, end_of(p, a, k));
        b_opens = b_opens || is_at_opening(p, end_of(p, b, k));
    }
    return met || (a_opens && b_opens);
}

static void each_step_hangs_together(void **state) {
    for (uint64_t seed = 1; seed < 10; seed++) {
        ktg_pattern *p = ball(*state, 1000, seed);
        uint32_t *parent = calloc(p->seam_count, sizeof *parent);
        for (uint32_t s = 0; s < p->seam_count; s++)
            parent[s] = s;
        for (uint32_t a = 0; a < p->seam_count; a++)
            for (uint32_t b = 0; b < a; b++)
                if (p->seams[a].section == p->seams[b].section && seams_meet(p, a, b))
                    parent[set_of(parent, a)] = set_of(parent, b);
        for (uint32_t a = 0; p->piece_count == 1 && a < p->seam_count; a++)
            for (uint32_t b = 0; b < a; b++)
                if (p->seams[a].section == p->seams[b].section)
                    assert_int_equal(set_of(parent, a), set_of(parent, b));
        free(parent);
        ktg_pattern_free(&p);
    }
}

static void an_open_model_is_closed_towards_its_border(void **state) {
    ktg_pattern *p = finish(*state, grow_net(*state, make_strip(20, 5, 20), 9, 1), 1);
    assert_true(p->seam_count >= 4);
    for (size_t s = 0; s < p->seam_count; s++) {
        assert_false(p->seams[s].closing);
        assert_int_equal(p->seams[s].number, s + 1);
    }
    ktg_pattern_free(&p);
}

/* The obvious seams depend on the size; without those of narrow notches nothing may. A prism's net
 * has none. */
static void twice_the_size_has_the_same_order(void **state) {
    for (uint64_t seed = 1; seed < 10; seed++) {
        ktg_pattern *p = finish(*state, grow_net(*state, make_prism(7, 40, 15), 5, seed), 1);
        ktg_pattern *twice = NULL;
        assert_int_equal(ktg_pattern_copy(*state, p, &twice), KTG_OK);
        assert_int_equal(ktg_pattern_scale(*state, twice, 2), KTG_OK);
        finish(*state, twice, 1);
        assert_true(p->seam_count > 3);
        for (size_t e = 0; e < p->edge_count; e++)
            assert_int_equal(p->edges[e].seam, twice->edges[e].seam);
        ktg_pattern_free(&twice);
        ktg_pattern_free(&p);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_the_order_and_steps_follow_each_other),
        cmocka_unit_test(each_seam_of_one_piece_closes_like_a_zip),
        cmocka_unit_test(the_last_numbers_close_the_model),
        cmocka_unit_test(a_flat_prism_is_closed_with_a_lid),
        cmocka_unit_test(a_swollen_lid_closes_like_a_flat_one),
        cmocka_unit_test(limbs_are_whole_before_they_are_joined),
        cmocka_unit_test(a_piece_is_joined_from_one_end_to_the_other),
        cmocka_unit_test(steps_are_neither_small_nor_large),
        cmocka_unit_test(each_step_hangs_together),
        cmocka_unit_test(an_open_model_is_closed_towards_its_border),
        cmocka_unit_test(twice_the_size_has_the_same_order),
    };
    return cmocka_run_group_tests(tests, make_context, drop_context);
}
