/* unfold/split.c - cutting a net where its overlaps are. */
#include "unfold/split.h"
#include "core/memory.h"

/* How many overlapping pairs each fold lies between. */
static void count_paths(ktg_net *net, uint32_t *path, uint32_t *uses) {
    for (size_t i = 0; i < net->live_count; i++) {
        const uint32_t *faces = net->conflicts[net->live[i]].faces;
        uint32_t length = ktg_net_path(net, faces[0], faces[1], path);
        for (uint32_t k = 0; k < length; k++)
            uses[path[k]]++;
    }
}

/* The fold of the path to cut, never a kept one; KTG_NONE when one is cut already. */
static uint32_t choose_fold(const ktg_net *net, const uint32_t *path, uint32_t length,
                            const uint32_t *uses, const bool *joined) {
    uint32_t best = KTG_NONE;
    for (uint32_t k = 0; k < length; k++) {
        uint32_t fold = path[k];
        if (!joined[fold])
            return KTG_NONE;
        if (net->dual->edges[fold].kept)
            continue;
        bool rigid = net->dual->edges[fold].rigid;
        if (best == KTG_NONE) {
            best = fold;
            continue;
        }
        bool best_rigid = net->dual->edges[best].rigid;
        if (rigid != best_rigid ? best_rigid : uses[fold] > uses[best])
            best = fold;
    }
    return best;
}

ktg_status ktg_split_conflicts(ktg_context *context, ktg_net *net, bool *joined, uint32_t *pieces) {
    uint32_t *path = ktg_new(context, net->dual->face_count, uint32_t);
    uint32_t *uses = ktg_new(context, net->dual->edge_count, uint32_t);
    ktg_status status = path && uses ? KTG_OK : KTG_MEMORY;
    *pieces = 1;
    if (status == KTG_OK) {
        count_paths(net, path, uses);
        for (size_t i = 0; i < net->live_count; i++) {
            const uint32_t *faces = net->conflicts[net->live[i]].faces;
            uint32_t length = ktg_net_path(net, faces[0], faces[1], path);
            uint32_t fold = choose_fold(net, path, length, uses, joined);
            if (fold == KTG_NONE)
                continue;
            joined[fold] = false;
            ++*pieces;
        }
    }
    ktg_free(path);
    ktg_free(uses);
    return status;
}
