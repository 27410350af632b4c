/* pipeline/hand.h - the user's hand: edges to be kept or cut, groups to be left out (pipeline
 * only). */
#ifndef KTG_PIPELINE_HAND_H
#define KTG_PIPELINE_HAND_H

#include "pipeline/pipeline.h"

/* What the files of edges say. Starts as {0}. */
typedef struct ktg_hand {
    ktg_edge_list *lists; /* list_count: first those of edges to be kept */
    size_t list_count, kept_lists;
    uint32_t edge_count;  /* of all lists together; the mesh's marked_numbers count them */
    bool *left_out;       /* edge_count: the faces there are left out */
    ktg_edge_rule *rules; /* rule_count, once made; for ktg_unfold_options */
    uint32_t rule_count;
} ktg_hand;

/* Reads the files, for a model as it was read. */
KTG_NODISCARD ktg_status ktg_hand_read(ktg_context *context, const ktg_pipeline_options *options,
                                       const ktg_mesh *mesh, ktg_hand *hand);

/* Then, where its vertices may have moved: leaves out what is to be left out; the edges are its
 * only marks then. */
KTG_NODISCARD ktg_status ktg_hand_take(ktg_context *context, const ktg_pipeline_options *options,
                                       ktg_mesh *mesh, ktg_hand *hand);

/* KTG_ARGUMENT when so many vertices must stay that there is no simplifying to options->faces. */
KTG_NODISCARD ktg_status ktg_hand_check_simplify(ktg_context *context,
                                                 const ktg_pipeline_options *options,
                                                 const ktg_mesh *mesh);

/* Makes the rules for the surface that is unfolded. KTG_FORMAT names an edge that is gone, or
 * lies on a border. */
KTG_NODISCARD ktg_status ktg_hand_make_rules(ktg_context *context,
                                             const ktg_pipeline_options *options,
                                             const ktg_mesh *mesh, ktg_hand *hand);

void ktg_hand_free(ktg_hand *hand);

#endif
