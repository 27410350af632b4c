/* tests/unfold/arrange_help.h - arrangements to move branches of, for the tests. */
#ifndef KTG_TESTS_UNFOLD_ARRANGE_HELP_H
#define KTG_TESTS_UNFOLD_ARRANGE_HELP_H

#include "core/random.h"
#include "tests/unfold/help.h"
#include "unfold/arrange.h"
#include "unfold/net.h"
#include "unfold/transplant.h"

#include <stdlib.h>
#include <string.h>

/* A net without overlaps, and the arrangement of its tree. */
typedef struct fixture {
    ktg_mesh *mesh;
    ktg_dual *dual;
    bool *tree;
    ktg_arrangement *a;
    ktg_search search;
} fixture;

static inline fixture start(ktg_context *context, ktg_mesh *mesh) {
    fixture f = {.mesh = mesh, .dual = dual_of(context, mesh)};
    ktg_net *net;
    f.tree = ktg_new(context, f.dual->edge_count, bool);
    f.search.faces_all = f.dual->face_count;
    ktg_random_seed(&f.search.random, 1);
    assert_int_equal(ktg_dual_spanning_tree(context, f.dual, 0, NULL, f.tree), KTG_OK);
    assert_int_equal(ktg_net_new(context, f.dual, f.tree, &net), KTG_OK);
    assert_int_equal(ktg_transplant_run(context, net, 5000, &f.search), KTG_OK);
    assert_int_equal(net->live_count, 0);
    memcpy(f.tree, net->folded, f.dual->edge_count * sizeof *f.tree);
    ktg_net_free(&net);
    assert_int_equal(ktg_arrangement_new(context, f.dual, f.tree, (ktg_vec2){2, 2}, &f.a), KTG_OK);
    return f;
}

static inline void drop(fixture *f) {
    ktg_arrangement_free(&f->a);
    ktg_dual_free(&f->dual);
    ktg_mesh_free(&f->mesh);
    ktg_free(f->tree);
}

/* Parents are folds, and each subtree is the stretch of its size behind its top. */
static inline void assert_preorder(const ktg_arrangement *a) {
    uint32_t folds = 0;
    for (uint32_t e = 0; e < a->dual->edge_count; e++)
        folds += a->folded[e];
    assert_int_equal(folds, a->dual->face_count - a->piece_count);
    for (uint32_t i = 0; i < a->dual->face_count; i++) {
        uint32_t face = a->order[i], e = a->parent_edge[face];
        assert_int_equal(a->place[face], i);
        assert_in_range(a->size[face], 1, a->dual->face_count - i);
        if (e == KTG_NONE)
            continue;
        assert_true(a->folded[e]);
        const uint32_t *pair = a->dual->edges[e].halfedge;
        uint32_t parent = pair[0] / 3 == face ? pair[1] / 3 : pair[0] / 3;
        assert_in_range(i, a->place[parent] + 1, a->place[parent] + a->size[parent] - 1);
        assert_true(i + a->size[face] <= a->place[parent] + a->size[parent]);
        assert_int_equal(a->piece[face], a->piece[parent]);
    }
}

/* A random branch and a random place for it, whatever it costs. */
static inline bool draw(fixture *f, ktg_branch *branch, ktg_graft *graft) {
    const ktg_arrangement *a = f->a;
    uint32_t own = (uint32_t)ktg_random_below(&f->search.random, 3 * a->dual->face_count);
    uint32_t e = a->dual->halfedge_edge[own];
    *branch = ktg_branch_at(a, (uint32_t)ktg_random_below(&f->search.random, a->dual->face_count));
    if (a->parent_edge[branch->top] == KTG_NONE || a->folded[e] ||
        !ktg_branch_holds(a, branch, own / 3))
        return false;
    *graft = (ktg_graft){.edge = e, .own = own, .other = ktg_arrangement_across(a, e, own)};
    if (ktg_branch_holds(a, branch, graft->other / 3))
        return false;
    ktg_graft_motion(a, graft);
    return true;
}

static const ktg_seam_tab_wish wish = {0.03, 0.012, 0.024, 0.002, 0.001, 0.84, {2, 2}};

#endif
