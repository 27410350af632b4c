/* unfold/rules.c - which edge of the surface each rule is about, and what it does to the dual. */
#include "unfold/rules.h"
#include "core/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *ktg_rule_name(const ktg_edge_rule *rule, char text[KTG_RULE_NAME_SIZE]) {
    if (rule->file)
        snprintf(text, KTG_RULE_NAME_SIZE, "edge %u-%u (%.100s:%llu)", rule->numbers[0],
                 rule->numbers[1], rule->file, (unsigned long long)rule->line);
    else
        snprintf(text, KTG_RULE_NAME_SIZE, "edge %u-%u", rule->numbers[0], rule->numbers[1]);
    return text;
}

/* ---- rules and edges ------------------------------------------------------------------------ */

/* An edge of the surface by its two vertices, the lower one first. */
typedef struct edge_key {
    uint64_t ends;
    uint32_t edge;
} edge_key;

static uint64_t ends_of(uint32_t a, uint32_t b) {
    return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}

static int compare_keys(const void *a, const void *b) {
    const edge_key *x = a, *y = b;
    return (x->ends > y->ends) - (x->ends < y->ends);
}

static edge_key *sorted_edges(ktg_context *context, const ktg_mesh *mesh, const ktg_adjacency *a) {
    edge_key *keys = ktg_new(context, a->edge_count, edge_key);
    for (uint32_t e = 0; keys && e < a->edge_count; e++) {
        uint32_t h = a->edge_halfedges[a->edge_first[e]];
        uint32_t next = h % 3 == 2 ? h - 2 : h + 1;
        keys[e] = (edge_key){ends_of(mesh->faces[h], mesh->faces[next]), e};
    }
    if (keys)
        qsort(keys, a->edge_count, sizeof *keys, compare_keys);
    return keys;
}

static ktg_status take_rule(ktg_context *context, const edge_key *keys, const ktg_adjacency *a,
                            uint32_t index, ktg_rules *rules) {
    const ktg_edge_rule *rule = &rules->list[index];
    char name[KTG_RULE_NAME_SIZE], other[KTG_RULE_NAME_SIZE];
    edge_key wanted = {.ends = ends_of(rule->vertices[0], rule->vertices[1])};
    const edge_key *found = bsearch(&wanted, keys, a->edge_count, sizeof *keys, compare_keys);
    if (!found)
        return ktg_fail(context, KTG_ARGUMENT, "%s is no edge of the surface",
                        ktg_rule_name(rule, name));
    if (a->edge_first[found->edge + 1] - a->edge_first[found->edge] < 2)
        return ktg_fail(context, KTG_ARGUMENT,
                        "%s lies on the border, where one face has nothing to be joined to",
                        ktg_rule_name(rule, name));
    uint32_t *place = &rules->of_edge[found->edge];
    if (*place != KTG_NONE && rules->list[*place].cut != rule->cut)
        return ktg_fail(context, KTG_ARGUMENT, "%s is both to be kept and to be cut: so says %s",
                        ktg_rule_name(rule, name), ktg_rule_name(&rules->list[*place], other));
    if (*place == KTG_NONE)
        *place = index;
    return KTG_OK;
}

/* Takes the twins from edges that are to be cut. */
static ktg_status cut_twins(ktg_context *context, const ktg_adjacency *a, ktg_rules *rules) {
    rules->adjacency = *a;
    rules->adjacency.twin = ktg_copy_array(context, a->twin, a->halfedge_count, sizeof *a->twin);
    if (!rules->adjacency.twin)
        return KTG_MEMORY;
    for (uint32_t h = 0; h < a->halfedge_count; h++)
        if (ktg_rules_cut(rules, a->halfedge_edge[h]))
            rules->adjacency.twin[h] = KTG_NONE;
    return KTG_OK;
}

ktg_status ktg_rules_new(ktg_context *context, const ktg_mesh *mesh, const ktg_adjacency *adjacency,
                         const ktg_unfold_options *options, ktg_rules *rules) {
    *rules = (ktg_rules){.list = options->rules,
                         .of_edge = ktg_new(context, adjacency->edge_count, uint32_t)};
    if (!rules->of_edge)
        return KTG_MEMORY;
    memset(rules->of_edge, 0xff, adjacency->edge_count * sizeof *rules->of_edge);
    ktg_status status = KTG_OK;
    if (options->rule_count > 0) {
        edge_key *keys = sorted_edges(context, mesh, adjacency);
        status = keys ? KTG_OK : KTG_MEMORY;
        for (uint32_t i = 0; status == KTG_OK && i < options->rule_count; i++)
            status = take_rule(context, keys, adjacency, i, rules);
        ktg_free(keys);
    }
    return status == KTG_OK ? cut_twins(context, adjacency, rules) : status;
}

void ktg_rules_free(ktg_rules *rules) {
    ktg_free(rules->of_edge);
    ktg_free(rules->adjacency.twin);
    *rules = (ktg_rules){0};
}

/* ---- rules and the dual --------------------------------------------------------------------- */

const ktg_edge_rule *ktg_rules_of_dual(const ktg_rules *rules, const ktg_dual *dual,
                                       const ktg_dual_edge *edge) {
    uint32_t h = edge->halfedge[0];
    uint32_t e = rules->adjacency.halfedge_edge[3 * dual->mesh_face[h / 3] + h % 3];
    return rules->of_edge[e] == KTG_NONE ? NULL : &rules->list[rules->of_edge[e]];
}

/* The dual's number of a half-edge of the mesh; KTG_NONE when its face is in another part. */
static uint32_t local_halfedge(const ktg_dual *dual, uint32_t halfedge) {
    uint32_t face = ktg_dual_face(dual, halfedge / 3);
    return face == KTG_NONE ? KTG_NONE : 3 * face + halfedge % 3;
}

/* Appends the forced cuts both of whose faces are here (`inside`), or those to other parts. */
static void append_cuts(const ktg_adjacency *adjacency, bool inside, ktg_dual *dual) {
    for (uint32_t h = 0; h < 3 * dual->face_count; h++) {
        uint32_t twin = adjacency->twin[3 * dual->mesh_face[h / 3] + h % 3];
        if (dual->halfedge_edge[h] != KTG_NONE || twin == KTG_NONE)
            continue;
        uint32_t other = local_halfedge(dual, twin);
        if ((other != KTG_NONE) != inside || other < h)
            continue;
        uint32_t *count = inside ? &dual->forced_count : &dual->outer_count;
        dual->edges[dual->edge_count + dual->forced_count + dual->outer_count] =
            (ktg_dual_edge){.halfedge = {h, other},
                            .vertices = {dual->faces[h], dual->faces[h % 3 == 2 ? h - 2 : h + 1]},
                            .length = dual->lengths[h]};
        ++*count;
    }
}

void ktg_rules_apply(const ktg_rules *rules, const ktg_adjacency *adjacency, ktg_dual *dual) {
    for (uint32_t e = 0; e < dual->edge_count; e++)
        if (ktg_rules_of_dual(rules, dual, &dual->edges[e]))
            dual->edges[e].kept = dual->edges[e].rigid = true; /* a cut would not be here */
    append_cuts(adjacency, true, dual);
    append_cuts(adjacency, false, dual);
}
