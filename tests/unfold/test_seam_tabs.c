/* Tabs while branches move, and what cuts at one vertex cost. */
#include "tests/unfold/arrange_help.h"
#include "unfold/graft_step.h"
#include "unfold/leaves.h"

/* Two convex outlines keep apart: some edge of one has all of the other beyond it. */
static bool apart(const ktg_vec2 *p, uint32_t p_count, const ktg_vec2 *q, uint32_t q_count) {
    for (uint32_t i = 0; i < p_count; i++) {
        ktg_vec2 u = p[i], v = p[(i + 1) % p_count];
        bool beyond = true;
        for (uint32_t k = 0; k < q_count; k++)
            beyond = beyond && ktg_cross2(ktg_sub2(v, u), ktg_sub2(q[k], u)) <= 1e-12;
        if (beyond)
            return true;
    }
    return false;
}

static void assert_tabs_keep_clear(const ktg_seam_tabs *t) {
    const ktg_arrangement *a = t->a;
    double price = 0;
    for (uint32_t e = 0; e < t->edge_count; e++) {
        const ktg_seam_tab *tab = &t->tabs[e];
        price += tab->price;
        assert_true(tab->price >= 1 || tab->side >= 0 || a->folded[e] ||
                    a->dual->edges[e].length < t->wish.edge);
        if (tab->side < 0)
            continue;
        assert_false(a->folded[e]);
        for (uint32_t f = 0; f < a->dual->face_count; f++)
            assert_true(apart(tab->corners, tab->corner_count, a->corners + 3 * f, 3) ||
                        apart(a->corners + 3 * f, 3, tab->corners, tab->corner_count));
        for (uint32_t g = 0; g < e; g++)
            assert_true(t->tabs[g].side < 0 ||
                        apart(tab->corners, tab->corner_count, t->tabs[g].corners,
                              t->tabs[g].corner_count) ||
                        apart(t->tabs[g].corners, t->tabs[g].corner_count, tab->corners,
                              tab->corner_count));
    }
    assert_true(fabs(price - t->price) < 1e-9);
}

/* One attempt: a graft without overlaps, or a push; taken back every other time. */
static void attempt(ktg_context *context, fixture *f, ktg_seam_tabs *t, ktg_saved *saved,
                    uint32_t *grafts) {
    ktg_branch branch;
    ktg_graft graft;
    bool undo = ktg_random_below(&f->search.random, 2) == 0;
    ktg_seam_tabs_begin(t);
    if (t->unhappy_count > 0 && ktg_random_below(&f->search.random, 4) == 0) {
        uint32_t e = t->unhappy[ktg_random_below(&f->search.random, t->unhappy_count)];
        assert_int_equal(ktg_seam_tabs_push(context, t, e, undo, 1, INFINITY), KTG_OK);
        if (undo)
            assert_int_equal(ktg_seam_tabs_undo(context, t), KTG_OK);
        return;
    }
    if (!draw(f, &branch, &graft) || ktg_graft_conflicts(f->a, &branch, &graft, 0) > 0)
        return;
    ++*grafts;
    assert_int_equal(ktg_seam_tabs_damage(context, t, &branch, &graft), KTG_OK);
    ktg_branch_save(f->a, &branch, saved);
    assert_int_equal(ktg_arrangement_graft(context, f->a, &branch, &graft), KTG_OK);
    assert_int_equal(ktg_seam_tabs_follow(context, t, &branch, graft.edge, saved->fold, INFINITY),
                     KTG_OK);
    if (!undo)
        return;
    assert_int_equal(ktg_arrangement_ungraft(context, f->a, &branch, saved), KTG_OK);
    assert_int_equal(ktg_seam_tabs_lay(context, t, &branch), KTG_OK);
    assert_int_equal(ktg_seam_tabs_undo(context, t), KTG_OK);
}

static void tabs_keep_clear_of_everything_while_branches_move(void **state) {
    fixture f = start(*state, shape_bumpy_sphere(*state));
    ktg_seam_tabs *t;
    ktg_saved saved = {.faces = ktg_new(*state, f.dual->face_count, uint32_t),
                       .corners = ktg_new(*state, 3 * f.dual->face_count, ktg_vec2),
                       .turns = ktg_new(*state, f.dual->face_count, ktg_vec2)};
    uint32_t grafts = 0;
    assert_int_equal(ktg_seam_tabs_new(*state, f.a, &wish, &t), KTG_OK);
    assert_int_equal(ktg_seam_tabs_renew(*state, t, &wish), KTG_OK);
    assert_tabs_keep_clear(t);
    for (int i = 0; i < 40000; i++) {
        attempt(*state, &f, t, &saved, &grafts);
        if (i % 4000 == 0)
            assert_tabs_keep_clear(t);
    }
    assert_in_range(grafts, 20, 40000);
    assert_tabs_keep_clear(t);
    assert_preorder(f.a);
    ktg_seam_tabs_free(&t);
    ktg_free(saved.faces);
    ktg_free(saved.corners);
    ktg_free(saved.turns);
    drop(&f);
}

/* Without heat no step makes it worse, and in the end many tabs have more room. */
static void tabs_push_each_other_to_where_all_have_room(void **state) {
    fixture f = start(*state, shape_bumpy_sphere(*state));
    ktg_seam_tab_wish high = wish;
    ktg_seam_tabs *t;
    high.height *= 3; /* there is little room */
    assert_int_equal(ktg_seam_tabs_new(*state, f.a, &high, &t), KTG_OK);
    assert_int_equal(ktg_seam_tabs_renew(*state, t, &high), KTG_OK);
    double first = t->price, before = first;
    for (int i = 0; i < 3000; i++) {
        assert_int_equal(ktg_tab_step(*state, t, &f.search.random, 1, 0), KTG_OK);
        assert_true(t->price <= before + 1e-9);
        before = t->price;
    }
    assert_true(before < 0.97 * first);
    assert_tabs_keep_clear(t);
    ktg_seam_tabs_free(&t);
    drop(&f);
}

static void leaves_are_counted_as_cuts_change(void **state) {
    fixture f = start(*state, shape_bumpy_sphere(*state));
    ktg_seam_tabs *t;
    ktg_leaves leaves, anew;
    uint32_t done = 0;
    assert_int_equal(ktg_seam_tabs_new(*state, f.a, &wish, &t), KTG_OK);
    assert_int_equal(ktg_leaves_new(*state, f.a, t, &leaves), KTG_OK);
    for (int i = 0; i < 20000 && done < 50; i++) {
        ktg_branch branch;
        ktg_graft graft;
        if (!draw(&f, &branch, &graft))
            continue;
        (void)ktg_leaves_exchange(&leaves, f.a->parent_edge[branch.top], graft.edge);
        assert_int_equal(ktg_arrangement_graft(*state, f.a, &branch, &graft), KTG_OK);
        done++;
    }
    assert_int_equal(ktg_leaves_new(*state, f.a, t, &anew), KTG_OK);
    assert_true(anew.price > 0);
    assert_true(fabs(anew.price - leaves.price) < 1e-5);
    ktg_leaves_free(&leaves);
    ktg_leaves_free(&anew);
    ktg_seam_tabs_free(&t);
    drop(&f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tabs_keep_clear_of_everything_while_branches_move),
        cmocka_unit_test(tabs_push_each_other_to_where_all_have_room),
        cmocka_unit_test(leaves_are_counted_as_cuts_change),
    };
    return cmocka_run_group_tests(tests, make_context, drop_context);
}
