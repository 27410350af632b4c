/* unfold/arrange_draw.c - which branch to hang where: drawn at random, or for a seam that lacks its
 * tab. */
#include "unfold/annealing.h"
#include "unfold/graft_step.h"

static bool may_be_cut(const ktg_arrangement *a, uint32_t face) {
    uint32_t fold = a->parent_edge[face];
    return fold != KTG_NONE && !a->dual->edges[fold].rigid;
}

bool ktg_annealing_draw(const ktg_annealing *s, ktg_branch *branch, ktg_graft *graft) {
    size_t face = ktg_random_below(&s->search->random, s->a->dual->face_count);
    return ktg_draw_graft(s->a, &s->search->random, (uint32_t)face, branch, graft);
}

static uint32_t parent_of(const ktg_arrangement *a, uint32_t face) {
    uint32_t e = a->parent_edge[face];
    if (e == KTG_NONE)
        return KTG_NONE;
    const uint32_t *pair = a->dual->edges[e].halfedge;
    return pair[0] / 3 == face ? pair[1] / 3 : pair[0] / 3;
}

/* Closes an unhappy seam: one of the branches that hold its one side and not the other. */
static bool draw_closing(const ktg_annealing *s, uint32_t seam, ktg_branch *branch,
                         ktg_graft *graft) {
    const ktg_arrangement *a = s->a;
    ktg_random *random = &s->search->random;
    size_t side = ktg_random_below(random, 2);
    uint32_t own = a->dual->edges[seam].halfedge[side];
    uint32_t other = a->dual->edges[seam].halfedge[1 - side], count = 0;
    if (seam >= a->dual->edge_count)
        return false;
    for (uint32_t face = own / 3; face != KTG_NONE; face = parent_of(a, face)) {
        ktg_branch b = ktg_branch_at(a, face);
        if (ktg_branch_holds(a, &b, other / 3))
            break;
        if (may_be_cut(a, face) && ktg_random_below(random, ++count) == 0)
            *branch = b;
    }
    *graft = (ktg_graft){.edge = seam, .own = own, .other = other};
    if (count > 0)
        ktg_graft_motion(a, graft);
    return count > 0;
}

/* Opens a fold around one end of an unhappy seam, so that the seam no longer ends there. */
static bool draw_opening(const ktg_annealing *s, uint32_t seam, ktg_branch *branch,
                         ktg_graft *graft) {
    const ktg_arrangement *a = s->a;
    ktg_random *random = &s->search->random;
    uint32_t h = a->dual->edges[seam].halfedge[ktg_random_below(random, 2)];
    bool start = ktg_random_below(random, 2) == 0;
    size_t turns = 1 + ktg_random_below(random, 3);
    for (;;) { /* around the vertex where h starts, or ends */
        h = start ? (h % 3 == 0 ? h + 2 : h - 1) : (h % 3 == 2 ? h - 2 : h + 1);
        uint32_t e = a->dual->halfedge_edge[h];
        if (e == KTG_NONE || !a->folded[e])
            return false;
        uint32_t across = ktg_arrangement_across(a, e, h);
        if (--turns == 0) {
            uint32_t top = a->parent_edge[h / 3] == e ? h / 3 : across / 3;
            return ktg_draw_graft(a, random, top, branch, graft);
        }
        h = across;
    }
}

bool ktg_annealing_draw_for_tabs(const ktg_annealing *s, ktg_branch *branch, ktg_graft *graft) {
    ktg_random *random = &s->search->random;
    uint32_t seam = s->tabs->unhappy[ktg_random_below(random, s->tabs->unhappy_count)];
    return ktg_random_below(random, 2) == 0 ? draw_closing(s, seam, branch, graft)
                                            : draw_opening(s, seam, branch, graft);
}
