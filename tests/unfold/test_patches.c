/* Joining rigid patches (section 5). */
#include "core/vec.h"
#include "tests/unfold/help.h"
#include "tests/unfold/reference.h"
#include "unfold/patches.h"

#include <stdlib.h>
#include <string.h>

/* A run of joins beside a plain record of it. */
typedef struct trial {
    ktg_context *context;
    ktg_mesh *mesh;
    ktg_adjacency *adjacency;
    ktg_dual *dual;
    ktg_patches *patches;
    bool *is_fold; /* per edge of the adjacency */
    ktg_vec2 *corners, *packed;
    bool *reached;
    uint32_t counts[4]; /* of each ktg_join */
} trial;

static trial trial_new(ktg_context *context, ktg_mesh *mesh) {
    trial t = {.context = context, .mesh = mesh, .dual = dual_of(context, mesh)};
    assert_int_equal(ktg_adjacency_new(context, mesh, &t.adjacency), KTG_OK);
    assert_int_equal(ktg_patches_new(context, t.dual, &t.patches), KTG_OK);
    t.is_fold = ktg_new(context, t.adjacency->edge_count, bool);
    t.corners = ktg_new(context, 3 * mesh->face_count, ktg_vec2);
    t.packed = ktg_new(context, 3 * mesh->face_count, ktg_vec2);
    t.reached = ktg_new(context, mesh->face_count, bool);
    return t;
}

static void trial_free(trial *t) {
    ktg_patches_free(&t->patches);
    ktg_dual_free(&t->dual);
    ktg_adjacency_free(&t->adjacency);
    ktg_mesh_free(&t->mesh);
    ktg_free(t->is_fold);
    ktg_free(t->corners);
    ktg_free(t->packed);
    ktg_free(t->reached);
}

/* The deepest overlap, laid flat from the surface, of the patch around `face`. */
static double deepest_around(trial *t, uint32_t face, uint32_t *count) {
    reference_lay(t->mesh, t->adjacency, t->is_fold, face, t->corners, t->reached);
    *count = 0;
    for (uint32_t f = 0; f < t->mesh->face_count; f++)
        if (t->reached[f])
            memcpy(t->packed + 3 * (*count)++, t->corners + 3 * f, 3 * sizeof *t->packed);
    return reference_deepest(t->packed, *count);
}

/* Joins at one end and the other still leave what the vertex needs. */
static bool is_mergeable(trial *t, const ktg_dual_edge *edge) {
    for (int i = 0; i < 2; i++) {
        uint32_t v = edge->vertices[i], cuts = 0;
        for (uint32_t e = 0; e < t->adjacency->edge_count; e++) {
            uint32_t h = t->adjacency->edge_halfedges[t->adjacency->edge_first[e]];
            uint32_t next = h % 3 == 2 ? h - 2 : h + 1;
            bool inner = t->adjacency->twin[h] != KTG_NONE;
            if (t->is_fold[e] || (t->mesh->faces[h] != v && t->mesh->faces[next] != v))
                continue;
            cuts += inner ? 2 : 1; /* two border edges make one sector more */
        }
        if (cuts / 2 < 1u + t->patches->table.needed[v])
            return false;
    }
    return true;
}

/* Tries one join and checks the answer against the record. */
static void try_edge(trial *t, uint32_t e) {
    const ktg_dual_edge *edge = &t->dual->edges[e];
    uint32_t a = edge->halfedge[0] / 3, b = edge->halfedge[1] / 3, before, after;
    uint32_t number = t->adjacency->halfedge_edge[edge->halfedge[0]];
    bool mergeable = is_mergeable(t, edge);
    assert_true(deepest_around(t, a, &before) <= 1.001 * KTG_OVERLAP_DEPTH);
    bool together = t->reached[b];
    bool was_fold = t->is_fold[number];
    t->is_fold[number] = true;
    ktg_join result;
    assert_int_equal(ktg_patches_join(t->context, t->patches, e, &result), KTG_OK);
    t->counts[result]++;
    assert_true(together == (result == KTG_SAME_PATCH));
    if (!together)
        assert_true(mergeable == (result != KTG_NOT_MERGEABLE));
    double deepest = together ? 0 : deepest_around(t, a, &after);
    if (result == KTG_JOINED) {
        assert_true(deepest <= 1.001 * KTG_OVERLAP_DEPTH);
        assert_int_equal(t->patches->patches[t->patches->face_patch[a]].count, after);
        assert_true(t->patches->largest >= after);
    } else {
        assert_true(result != KTG_OVERLAPS || deepest > 0.999 * KTG_OVERLAP_DEPTH);
        t->is_fold[number] = was_fold;
    }
}

/* What the patches say of themselves. */
static void assert_consistent(const trial *t) {
    const ktg_patches *p = t->patches;
    uint32_t alive = 0, largest = 0, faces = 0;
    for (uint32_t i = 0; i < t->dual->face_count; i++) {
        const ktg_patch *patch = &p->patches[i];
        alive += patch->count > 0;
        faces += patch->count;
        largest = patch->count > largest ? patch->count : largest;
        for (uint32_t s = patch->first; s < patch->first + patch->count; s++) {
            uint32_t face = p->slot_face[s];
            assert_int_equal(p->face_patch[face], i);
            assert_int_equal(p->face_slot[face], s);
            assert_true(ktg_flat_boxes_meet(&patch->box, &p->slot_box[s]));
            for (uint32_t k = 0; k < 3; k++) {
                ktg_vec2 from = p->slot_corners[3 * s + k];
                ktg_vec2 to = p->slot_corners[3 * s + (k + 1) % 3];
                assert_float_equal(ktg_length2(ktg_sub2(to, from)), t->dual->lengths[3 * face + k],
                                   1e-13);
                assert_true(from.x >= p->slot_box[s].x0 && from.x <= p->slot_box[s].x1);
                assert_true(from.y >= p->slot_box[s].y0 && from.y <= p->slot_box[s].y1);
                assert_true(from.x >= patch->box.x0 && from.x <= patch->box.x1);
                assert_true(from.y >= patch->box.y0 && from.y <= patch->box.y1);
            }
        }
    }
    assert_int_equal(alive, p->patch_count);
    assert_int_equal(largest, p->largest);
    assert_int_equal(faces, t->dual->face_count);
}

static uint32_t *random_order(ktg_context *context, uint32_t count, uint64_t seed) {
    uint32_t *order = ktg_new(context, count, uint32_t);
    ktg_random random;
    ktg_random_seed(&random, seed);
    for (uint32_t i = 0; i < count; i++) {
        size_t j = ktg_random_below(&random, i + 1);
        order[i] = order[j];
        order[j] = i;
    }
    return order;
}

/* Joins edges in a random order, each twice: what failed once fails ever after. */
static void join_all(ktg_context *context, ktg_mesh *mesh, uint64_t seed, uint32_t counts[4]) {
    trial t = trial_new(context, mesh);
    assert_consistent(&t);
    uint32_t *order = random_order(context, t.dual->edge_count, seed);
    for (uint32_t i = 0; i < t.dual->edge_count; i++)
        try_edge(&t, order[i]);
    uint32_t joined = t.counts[KTG_JOINED];
    for (uint32_t i = 0; i < t.dual->edge_count; i++)
        try_edge(&t, order[i]);
    assert_int_equal(t.counts[KTG_JOINED], joined);
    assert_int_equal(t.patches->patch_count, t.dual->face_count - joined);
    assert_consistent(&t);
    for (int i = 0; i < 4; i++)
        counts[i] += t.counts[i];
    ktg_free(order);
    trial_free(&t);
}

static void joins_never_overlap_and_rejected_ones_do(void **state) {
    uint32_t counts[4] = {0};
    for (uint64_t seed = 1; seed <= 3; seed++) {
        join_all(*state, shape_icosphere(*state, 1), seed, counts);
        join_all(*state, shape_star(*state, 0.5), seed, counts);
        join_all(*state, shape_torus(*state, 9, 5), seed, counts);
        join_all(*state, shape_knot(*state, 20, 3), seed, counts);
    }
    for (int i = 0; i < 4; i++)
        assert_true(counts[i] > 20);
}

static void joins_on_open_meshes_keep_to_the_rule(void **state) {
    uint32_t counts[4] = {0};
    for (uint64_t seed = 1; seed <= 3; seed++) {
        join_all(*state, shape_saddle(*state, 6), seed, counts);
        join_all(*state, shape_cylinder(*state, 9, 4), seed, counts);
        join_all(*state, shape_flat(*state, 5), seed, counts);
        join_all(*state, shape_triangle(*state), seed, counts);
        join_all(*state, shape_two_triangles(*state), seed, counts);
    }
    for (int i = 0; i < 3; i++)
        assert_true(counts[i] > 20);
}

static void thin_faces_are_joined_like_others(void **state) {
    uint32_t counts[4] = {0};
    join_all(*state, shape_needle(*state, 12, 1e-3), 1, counts);
    join_all(*state, shape_needle(*state, 12, 1e-6), 2, counts);
    assert_true(counts[KTG_JOINED] > 20);
}

static void assert_same_state(const trial *t, const ktg_patches *a, const ktg_patches *b) {
    uint32_t n = t->dual->face_count;
    assert_int_equal(a->patch_count, b->patch_count);
    assert_int_equal(a->largest, b->largest);
    assert_memory_equal(a->face_patch, b->face_patch, n * sizeof *a->face_patch);
    assert_memory_equal(a->table.sectors, b->table.sectors,
                        t->dual->vertex_count * sizeof *a->table.sectors);
    for (uint32_t f = 0; f < n; f++)
        assert_memory_equal(a->slot_corners + 3 * a->face_slot[f],
                            b->slot_corners + 3 * b->face_slot[f], 3 * sizeof(ktg_vec2));
}

static void an_assigned_state_goes_on_like_the_one_it_came_from(void **state) {
    trial t = trial_new(*state, shape_bumpy_sphere(*state));
    uint32_t n = t.dual->edge_count;
    uint32_t *order = random_order(*state, n, 5), *other = random_order(*state, n, 6);
    ktg_patches *copy, *start;
    assert_int_equal(ktg_patches_new(*state, t.dual, &copy), KTG_OK);
    assert_int_equal(ktg_patches_new(*state, t.dual, &start), KTG_OK);
    ktg_join one, two;
    for (uint32_t i = 0; i < n / 2; i++) /* the copy has a past of its own */
        assert_int_equal(ktg_patches_join(*state, copy, other[i], &one), KTG_OK);
    for (uint32_t i = 0; i < n / 2; i++)
        assert_int_equal(ktg_patches_join(*state, t.patches, order[i], &one), KTG_OK);
    assert_int_equal(ktg_patches_assign(*state, copy, t.patches), KTG_OK);
    assert_same_state(&t, copy, t.patches);
    for (uint32_t i = n / 2; i < n; i++) {
        assert_int_equal(ktg_patches_join(*state, t.patches, order[i], &one), KTG_OK);
        assert_int_equal(ktg_patches_join(*state, copy, order[i], &two), KTG_OK);
        assert_int_equal(one, two);
    }
    assert_same_state(&t, copy, t.patches);
    assert_consistent(&t);
    assert_true(start->patch_count == t.dual->face_count);
    ktg_patches_free(&copy);
    ktg_patches_free(&start);
    ktg_free(order);
    ktg_free(other);
    trial_free(&t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(joins_never_overlap_and_rejected_ones_do),
        cmocka_unit_test(joins_on_open_meshes_keep_to_the_rule),
        cmocka_unit_test(thin_faces_are_joined_like_others),
        cmocka_unit_test(an_assigned_state_goes_on_like_the_one_it_came_from),
    };
    return cmocka_run_group_tests(tests, make_context, drop_context);
}
