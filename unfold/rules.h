/* unfold/rules.h - the user's hand on the seams: edges that stay folds, edges that are cut (unfold
 * only). */
#ifndef KTG_UNFOLD_RULES_H
#define KTG_UNFOLD_RULES_H

#include "unfold/dual.h"
#include "unfold/unfold.h"

/* What is wanted of each edge of the surface. */
typedef struct ktg_rules {
    const ktg_edge_rule *list;
    uint32_t *of_edge;       /* adjacency->edge_count: index into list, KTG_NONE: nothing wanted */
    ktg_adjacency adjacency; /* the surface's, but with no twins across edges that are to be cut;
                                only its twins are its own */
} ktg_rules;

/* KTG_ARGUMENT when a rule names no inner edge of the surface, or an edge is both kept and cut. */
KTG_NODISCARD ktg_status ktg_rules_new(ktg_context *context, const ktg_mesh *mesh,
                                       const ktg_adjacency *adjacency,
                                       const ktg_unfold_options *options, ktg_rules *rules);
void ktg_rules_free(ktg_rules *rules);

static inline bool ktg_rules_cut(const ktg_rules *rules, uint32_t edge) {
    return rules->of_edge[edge] != KTG_NONE && rules->list[rules->of_edge[edge]].cut;
}
static inline bool ktg_rules_keep(const ktg_rules *rules, uint32_t edge) {
    return rules->of_edge[edge] != KTG_NONE && !rules->list[rules->of_edge[edge]].cut;
}

/* The name of a rule's edge for messages: "edge 3-4 (keep.txt:7)". */
#define KTG_RULE_NAME_SIZE 160
const char *ktg_rule_name(const ktg_edge_rule *rule, char text[KTG_RULE_NAME_SIZE]);

/* The rule of a dual edge; NULL where nothing is wanted. */
const ktg_edge_rule *ktg_rules_of_dual(const ktg_rules *rules, const ktg_dual *dual,
                                       const ktg_dual_edge *edge);

/* Marks the kept edges of a dual that was made from rules->adjacency, and appends its forced cuts
 * (dual.h). `adjacency` is the surface's own. */
void ktg_rules_apply(const ktg_rules *rules, const ktg_adjacency *adjacency, ktg_dual *dual);

/* What the joinable edges connect, component by component. */
typedef struct ktg_parts {
    uint32_t count;
    uint32_t *component; /* count: the component each is of, rising */
    uint32_t *first;     /* count + 1: where its faces begin */
    uint32_t *faces;     /* face_count, part by part, rising within one */
} ktg_parts;

KTG_NODISCARD ktg_status ktg_parts_new(ktg_context *context, const ktg_mesh *mesh,
                                       const ktg_rules *rules, const uint32_t *face_component,
                                       uint32_t component_count, ktg_parts *parts);
void ktg_parts_free(ktg_parts *parts);

/* Whether the kept folds of a part can be laid flat at all, whatever else is done: a ring of them
 * must lie around vertices that are flat, and faces that they hold together must not overlap.
 * KTG_GEOMETRY says which cannot. */
KTG_NODISCARD ktg_status ktg_kept_check(ktg_context *context, const ktg_mesh *mesh,
                                        const ktg_rules *rules, const ktg_dual *dual, double scale);

/* Whether they all are folds (edge_count flags); KTG_GEOMETRY names one that is not. */
KTG_NODISCARD ktg_status ktg_kept_are_folds(ktg_context *context, const ktg_rules *rules,
                                            const ktg_dual *dual, const bool *joined);

#endif
