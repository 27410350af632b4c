/* pipeline/hand.c - from files of edges to rules for the unfolding.
 *
 * The files name vertices of the model as it was read. Its edges carry marks with numbers through
 * repair and simplification; what the marks lie on in the end is what the rules are about. */
#include "pipeline/hand.h"
#include "core/memory.h"

#include <stdlib.h>
#include <string.h>

void ktg_hand_free(ktg_hand *hand) {
    for (size_t i = 0; hand->lists && i < hand->list_count; i++)
        ktg_edge_list_free(&hand->lists[i]);
    ktg_free(hand->lists);
    ktg_free(hand->left_out);
    ktg_free(hand->rules);
    *hand = (ktg_hand){0};
}

/* ---- reading -------------------------------------------------------------------------------- */

static ktg_status read_lists(ktg_context *context, const ktg_pipeline_options *options,
                             const ktg_mesh *mesh, ktg_hand *hand) {
    size_t count = options->keep_count + options->cut_count;
    uint64_t edges = 0;
    hand->lists = ktg_new(context, count, ktg_edge_list);
    if (!hand->lists)
        return KTG_MEMORY;
    hand->kept_lists = options->keep_count;
    for (size_t i = 0; i < count; i++) {
        const char *path =
            i < options->keep_count ? options->keep[i] : options->cut[i - options->keep_count];
        KTG_TRY(ktg_mesh_read_edges(context, path, mesh, &hand->lists[i]));
        hand->list_count++;
        edges += hand->lists[i].count;
    }
    if (edges >= KTG_NONE)
        return ktg_fail(context, KTG_LIMIT,
                        "more edges are to be kept or cut than can be numbered");
    hand->edge_count = (uint32_t)edges;
    return KTG_OK;
}

/* The edges of all lists become the mesh's marks. */
static ktg_status mark_all(ktg_context *context, ktg_mesh *mesh, const ktg_hand *hand) {
    uint32_t *edges = ktg_new(context, 2 * (size_t)hand->edge_count, uint32_t);
    size_t at = 0;
    if (!edges)
        return KTG_MEMORY;
    for (size_t i = 0; i < hand->list_count; i++) {
        size_t count = 2 * (size_t)hand->lists[i].count;
        memcpy(edges + at, hand->lists[i].vertices, count * sizeof *edges);
        at += count;
    }
    ktg_status status = ktg_mesh_mark(context, mesh, edges, hand->edge_count);
    ktg_free(edges);
    return status;
}

static ktg_status leave_out(ktg_context *context, const ktg_pipeline_options *options,
                            ktg_mesh *mesh, ktg_hand *hand) {
    uint32_t before = mesh->face_count;
    hand->left_out = ktg_new(context, hand->edge_count, bool);
    if (!hand->left_out)
        return KTG_MEMORY;
    if (options->omit_count == 0)
        return KTG_OK;
    KTG_TRY(ktg_about_file(context, options->model,
                           ktg_mesh_omit(context, mesh, options->omit, options->omit_count)));
    for (uint32_t i = 0; i < hand->edge_count; i++)
        hand->left_out[i] = true;
    for (uint32_t i = 0; hand->edge_count > 0 && i < mesh->marked_count; i++)
        hand->left_out[mesh->marked_numbers[i]] = false;
    ktg_log(context, KTG_LOG_NOTE, "left out: %u of %u faces", before - mesh->face_count, before);
    return KTG_OK;
}

ktg_status ktg_hand_read(ktg_context *context, const ktg_pipeline_options *options,
                         const ktg_mesh *mesh, ktg_hand *hand) {
    if (options->mode != KTG_PAPER && options->keep_count > 0)
        return ktg_fail(context, KTG_ARGUMENT,
                        "edges can be kept in paper, not in cloth: leave them out");
    return read_lists(context, options, mesh, hand);
}

ktg_status ktg_hand_take(ktg_context *context, const ktg_pipeline_options *options, ktg_mesh *mesh,
                         ktg_hand *hand) {
    /* the model's own marks mean nothing to a net, and to cloth only where no file says more */
    if (options->mode == KTG_PAPER || options->cut_count > 0)
        KTG_TRY(mark_all(context, mesh, hand));
    return leave_out(context, options, mesh, hand);
}

/* ---- simplifying ---------------------------------------------------------------------------- */

/* A closed surface has half as many vertices as faces. When more than half of them had to stay,
 * there would be no vertices left for the shape. */
ktg_status ktg_hand_check_simplify(ktg_context *context, const ktg_pipeline_options *options,
                                   const ktg_mesh *mesh) {
    uint64_t count = 0;
    if (!mesh->marked_numbers)
        return KTG_OK;
    bool *stays = ktg_new(context, mesh->vertex_count, bool);
    if (!stays)
        return KTG_MEMORY;
    for (size_t i = 0; i < 2 * (size_t)mesh->marked_count; i++) {
        count += !stays[mesh->marked_edges[i]];
        stays[mesh->marked_edges[i]] = true;
    }
    ktg_free(stays);
    if (4 * count <= options->faces)
        return KTG_OK;
    return ktg_fail(context, KTG_ARGUMENT,
                    "the %llu vertices of edges to be kept or cut must stay, too many to simplify "
                    "the model to %u faces: ask for --faces %llu or more, or for --faces all, or "
                    "simplify it first and name edges of what comes out",
                    (unsigned long long)count, options->faces, (unsigned long long)(4 * count));
}

/* ---- rules ---------------------------------------------------------------------------------- */

/* A mark by its two vertices. */
typedef struct mark_key {
    uint64_t ends;
    uint32_t mark;
} mark_key;

static uint64_t ends_of(uint32_t a, uint32_t b) {
    return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}

static int compare_keys(const void *a, const void *b) {
    const mark_key *x = a, *y = b;
    if (x->ends != y->ends)
        return x->ends < y->ends ? -1 : 1;
    return (x->mark > y->mark) - (x->mark < y->mark);
}

/* How many faces meet at each mark. */
static void count_faces(const ktg_mesh *mesh, const ktg_adjacency *a, const mark_key *keys,
                        uint32_t *faces) {
    for (uint32_t e = 0; e < a->edge_count; e++) {
        uint32_t h = a->edge_halfedges[a->edge_first[e]];
        uint64_t ends = ends_of(mesh->faces[h], mesh->faces[h % 3 == 2 ? h - 2 : h + 1]);
        size_t low = 0, high = mesh->marked_count;
        while (low < high) {
            size_t middle = low + (high - low) / 2;
            if (keys[middle].ends < ends)
                low = middle + 1;
            else
                high = middle;
        }
        for (; low < mesh->marked_count && keys[low].ends == ends; low++)
            faces[keys[low].mark] = a->edge_first[e + 1] - a->edge_first[e];
    }
}

static ktg_status faces_at_marks(ktg_context *context, const ktg_mesh *mesh, uint32_t *faces) {
    ktg_adjacency *adjacency = NULL;
    mark_key *keys = ktg_new(context, mesh->marked_count, mark_key);
    ktg_status status = keys ? ktg_adjacency_new(context, mesh, &adjacency) : KTG_MEMORY;
    for (uint32_t i = 0; status == KTG_OK && i < mesh->marked_count; i++) {
        const uint32_t *ends = mesh->marked_edges + 2 * (size_t)i;
        keys[i] = (mark_key){ends_of(ends[0], ends[1]), i};
    }
    if (status == KTG_OK) {
        qsort(keys, mesh->marked_count, sizeof *keys, compare_keys);
        count_faces(mesh, adjacency, keys, faces);
    }
    ktg_adjacency_free(&adjacency);
    ktg_free(keys);
    return status;
}

/* The edge with that number as a rule, but for its vertices in the surface. */
static ktg_edge_rule rule_of(const ktg_hand *hand, uint32_t number) {
    size_t list = 0;
    while (number >= hand->lists[list].count)
        number -= hand->lists[list++].count;
    const ktg_edge_list *from = &hand->lists[list];
    return (ktg_edge_rule){.cut = list >= hand->kept_lists,
                           .numbers = {from->vertices[2 * (size_t)number] + 1,
                                       from->vertices[2 * (size_t)number + 1] + 1},
                           .file = from->file,
                           .line = from->lines[number]};
}

/* An edge whose marks are all gone or lie on borders. */
static ktg_status explain_edge(ktg_context *context, const ktg_pipeline_options *options,
                               const ktg_hand *hand, uint32_t number, bool marked) {
    ktg_edge_rule rule = rule_of(hand, number);
    if (hand->left_out[number] || (rule.cut && marked && options->omit_count > 0))
        return KTG_OK; /* what was left out is cut off */
    if (marked)
        return ktg_fail(context, KTG_FORMAT,
                        "%s:%llu: edge %u-%u lies on a border: where only one face is, nothing "
                        "can be %s",
                        rule.file, (unsigned long long)rule.line, rule.numbers[0], rule.numbers[1],
                        rule.cut ? "cut" : "kept");
    return ktg_fail(
        context, KTG_FORMAT,
        "%s:%llu: edge %u-%u is gone: faces there were without area or there twice, and "
        "were removed or cut by the repair; repair the model first (katagami simplify "
        "--faces all) and name edges of what comes out",
        rule.file, (unsigned long long)rule.line, rule.numbers[0], rule.numbers[1]);
}

static void add_rules(const ktg_mesh *mesh, const uint32_t *faces, ktg_hand *hand, uint8_t *seen) {
    for (uint32_t i = 0; i < mesh->marked_count; i++) {
        uint32_t number = mesh->marked_numbers[i];
        seen[number] |= faces[i] > 1 ? 2 : 1;
        if (faces[i] < 2)
            continue;
        ktg_edge_rule *rule = &hand->rules[hand->rule_count++];
        *rule = rule_of(hand, number);
        rule->vertices[0] = mesh->marked_edges[2 * (size_t)i];
        rule->vertices[1] = mesh->marked_edges[2 * (size_t)i + 1];
    }
}

static void tell_rules(ktg_context *context, const ktg_hand *hand) {
    uint32_t cut = 0;
    for (uint32_t i = 0; i < hand->rule_count; i++)
        cut += hand->rules[i].cut;
    ktg_log(context, KTG_LOG_NOTE, "by hand: %u edges stay folds, %u are cut",
            hand->rule_count - cut, cut);
}

ktg_status ktg_hand_make_rules(ktg_context *context, const ktg_pipeline_options *options,
                               const ktg_mesh *mesh, ktg_hand *hand) {
    if (hand->edge_count == 0)
        return KTG_OK;
    uint32_t *faces = ktg_new(context, mesh->marked_count, uint32_t);
    uint8_t *seen = ktg_new(context, hand->edge_count, uint8_t);
    hand->rules = ktg_new(context, mesh->marked_count, ktg_edge_rule);
    ktg_status status = faces && seen && hand->rules ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK)
        status = faces_at_marks(context, mesh, faces);
    if (status == KTG_OK)
        add_rules(mesh, faces, hand, seen);
    for (uint32_t i = 0; status == KTG_OK && i < hand->edge_count; i++)
        if (seen[i] < 2)
            status = explain_edge(context, options, hand, i, seen[i] > 0);
    ktg_free(faces);
    ktg_free(seen);
    if (status == KTG_OK)
        tell_rules(context, hand);
    return status;
}
