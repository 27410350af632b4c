/* Sound patterns pass; each kind of damage to faces, components and edges is refused with its
 * reason. */
#include "damage.h"

#include "core/memory.h"
#include "core/vec.h"

#include <stdio.h>

/* ---- sound ones --------------------------------------------------------------------------- */

static void sound_nets_pass(void **state) {
    fixture *f = *state;
    const net *nets[] = {&tetrahedron, &cube, &box_and_lid, &open_box, &slit, &two_parts};
    static const uint32_t pieces[] = {1, 1, 2, 1, 1, 2}, components[] = {1, 1, 1, 1, 1, 2};
    for (size_t i = 0; i < 6; i++) {
        take(state, nets[i]);
        accept(state);
        assert_int_equal(f->report.pieces, pieces[i]);
        assert_int_equal(f->report.components, components[i]);
        assert_int_equal(f->report.most_pieces, pieces[i] / components[i]);
        assert_int_equal(f->report.sheets, pieces[i]);
        assert_true(f->report.length_error < 1e-13);
        assert_true(f->report.refold_error < 1e-13);
        assert_true(f->report.deepest_overlap_mm < 1e-9);
        assert_false(f->report.model_compared);
    }
}

static void a_pattern_straight_from_unfolding_passes(void **state) {
    net bare = cube;
    bare.bare = true;
    take(state, &bare);
    accept(state);
}

static void a_seam_of_two_edges_passes_in_its_order_only(void **state) {
    ktg_pattern *p = take(state, &slit);
    uint32_t outer = net_edge_index(p, 0, 5), inner = net_edge_index(p, 5, 4);
    ktg_pattern_seam *seam = &p->seams[0];
    assert_int_equal(p->seam_count, 2);
    seam->edges = realloc(seam->edges, 2 * sizeof *seam->edges);
    seam->first_side = realloc(seam->first_side, 2);
    seam->edge_count = 2;
    /* Side 0 is the side whose half-edges run from 0 over 5 to 4. */
    seam->edges[0] = outer;
    seam->edges[1] = inner;
    seam->first_side[0] = p->edges[outer].vertices[0] != 0;
    seam->first_side[1] = p->edges[inner].vertices[0] != 5;
    for (int s = 0; s < 2; s++)
        seam->lengths_mm[s] = p->seams[0].lengths_mm[s] + p->seams[1].lengths_mm[s];
    p->edges[outer].seam = p->edges[inner].seam = 0;
    ktg_free(p->seams[1].edges);
    ktg_free(p->seams[1].first_side);
    p->seam_count = 1;
    accept(state);
    seam->edges[0] = inner;
    seam->edges[1] = outer;
    uint8_t first = seam->first_side[0];
    seam->first_side[0] = seam->first_side[1];
    seam->first_side[1] = first;
    refuse(state, "do not follow each other on both sides");
}

/* ---- faces and components ----------------------------------------------------------------- */

static void a_missing_face_is_named(void **state) {
    ktg_pattern *p = take(state, &cube);
    uint32_t lost = p->pieces[0].faces[11];
    char says[64];
    p->pieces[0].face_count--;
    snprintf(says, sizeof says, "Face %u is in no piece", lost);
    refuse(state, says);
}

static void a_face_in_two_pieces_is_named(void **state) {
    ktg_pattern *p = take(state, &box_and_lid);
    p->pieces[1].faces[0] = 3;
    refuse(state, "Face 3 is in piece 1 and again in piece 2");
}

static void a_mirrored_piece_is_refused(void **state) {
    ktg_pattern *p = take(state, &tetrahedron);
    for (size_t i = 0; i < p->pieces[0].vertex_count; i++)
        p->pieces[0].vertices[i].x *= -1;
    refuse(state, "Piece 1 is mirrored");
}

static void a_face_turned_over_is_named(void **state) {
    ktg_pattern *p = take(state, &tetrahedron);
    ktg_pattern_piece *piece = &p->pieces[0];
    /* Mirrors the free corner of the last face about the fold it hangs on. */
    uint32_t *c = piece->corners + 3 * (piece->face_count - 1), tip = 0;
    for (uint32_t k = 0; k < 3; k++)
        if (c[k] > 2)
            tip = k;
    ktg_vec2 a = piece->vertices[c[(tip + 1) % 3]], b = piece->vertices[c[(tip + 2) % 3]];
    ktg_vec2 n = ktg_perp2(ktg_unit2(ktg_sub2(b, a))), *v = &piece->vertices[c[tip]];
    *v = ktg_madd2(*v, -2 * ktg_dot2(n, ktg_sub2(*v, a)), n);
    refuse(state, "is turned over: it runs clockwise");
}

static void corners_must_differ_and_stand_for_one_vertex(void **state) {
    ktg_pattern *p = take(state, &cube);
    p->pieces[0].corners[4] = p->pieces[0].corners[3];
    refuse(state, "uses one vertex of the piece twice");
    p = take(state, &cube);
    uint32_t *c = p->pieces[0].corners + 6, first = c[0];
    c[0] = c[1];
    c[1] = c[2];
    c[2] = first;
    refuse(state, "stands for vertex");
}

static void a_piece_that_falls_apart_is_refused(void **state) {
    ktg_pattern *p = take(state, &cube);
    ktg_pattern_piece *piece = &p->pieces[0];
    /* The last face gets vertices of its own: nothing joins it any more. */
    piece->vertices = realloc(piece->vertices, (piece->vertex_count + 3) * sizeof *piece->vertices);
    for (size_t k = 0; k < 3; k++) {
        uint32_t *c = &piece->corners[3 * (piece->face_count - 1) + k];
        piece->vertices[piece->vertex_count] = piece->vertices[*c];
        *c = (uint32_t)piece->vertex_count++;
    }
    refuse(state, "Piece 1 falls apart: folds join 11 of its 12 faces");
}

static void components_are_those_of_the_surface(void **state) {
    ktg_pattern *p = take(state, &two_parts);
    p->pieces[1].component = 0;
    refuse(state, "Piece 2 is listed under component 1, but its faces do not hang together");
    p = take(state, &box_and_lid);
    p->components[1].name = NULL;
    p->component_count = 2;
    p->pieces[1].component = 1;
    refuse(state, "Piece 2 is listed under component 2, but its faces belong to component 1");
    p = take(state, &cube);
    p->component_count = 2;
    refuse(state, "Component 2 has no pieces");
}

static void a_surface_that_is_no_manifold_is_refused(void **state) {
    ktg_pattern *p = take(state, &cube);
    uint32_t swap = p->faces[0];
    p->faces[0] = p->faces[1];
    p->faces[1] = swap;
    refuse(state, "are not oriented alike");
    p = take(state, &two_parts);
    memcpy(p->faces + 12, p->faces, 3 * sizeof *p->faces);
    refuse(state, "faces of the surface meet at the edge between its vertices");
    p = take(state, &cube);
    p->faces[0] = p->faces[1];
    refuse(state, "Face 0 of the surface has vertex 2 twice");
}

/* ---- edges -------------------------------------------------------------------------------- */

static void every_edge_is_listed_once(void **state) {
    ktg_pattern *p = take(state, &cube);
    p->edge_count--;
    p->pieces[0].label_count = 0;
    refuse(state, "is missing from the list of edges");
    p = take(state, &cube);
    p->edges[1] = p->edges[0];
    refuse(state, "Edge 2: corner 0 of face 0 belongs to edge 1 already");
}

static void sides_are_where_they_say(void **state) {
    ktg_pattern *p = take(state, &box_and_lid);
    ktg_pattern_edge *edge = net_edge(p, 4, 5);
    edge->sides[1].piece = 0;
    refuse(state, "is said to be in piece 1, but that face is in piece 2");
    p = take(state, &cube);
    edge = net_edge(p, 0, 4);
    edge->sides[1].corner = (edge->sides[1].corner + 1) % 3;
    refuse(state, "do not meet there on the surface");
    p = take(state, &cube);
    edge = net_edge(p, 0, 4);
    edge->vertices[0] = edge->vertices[1];
    refuse(state, "but its first side runs from");
}

static void a_cut_called_a_border_is_refused(void **state) {
    ktg_pattern *p = take(state, &cube);
    net_edge(p, 5, 6)->kind = KTG_EDGE_BORDER;
    refuse(state, "is called a border, but the surface has faces");
    p = take(state, &cube);
    ktg_pattern_edge *edge = net_edge(p, 5, 6);
    edge->kind = KTG_EDGE_BORDER;
    edge->side_count = 1;
    refuse(state, "has one side (face");
}

static void kinds_are_what_the_surface_says(void **state) {
    ktg_pattern *p = take(state, &cube);
    net_edge(p, 0, 1)->kind = KTG_EDGE_CUT;
    refuse(state, "share both vertices of piece 1: a fold");
    p = take(state, &cube);
    net_edge(p, 0, 4)->kind = KTG_EDGE_MOUNTAIN;
    refuse(state, "is called a mountain fold, but its sides do not lie in one piece");
    p = take(state, &cube);
    net_edge(p, 0, 1)->kind = KTG_EDGE_VALLEY;
    refuse(state, "is called a valley fold, but it turns by 90 degrees: a mountain fold");
    p = take(state, &cube);
    net_edge(p, 0, 2)->kind = KTG_EDGE_MOUNTAIN;
    refuse(state, "is called a mountain fold, but it turns by 0 degrees: a flat fold");
    p = take(state, &cube);
    net_edge(p, 0, 1)->kind = KTG_EDGE_FLAT;
    refuse(state, "is called a flat fold, but it turns by 90 degrees: a mountain fold");
    p = take(state, &open_box);
    net_edge(p, 4, 5)->kind = KTG_EDGE_CUT;
    refuse(state, "is called a cut, but the surface has one face there: a border");
    p = take(state, &open_box);
    net_edge(p, 4, 5)->angle = 0.5;
    refuse(state, "is a border, but it is said to turn");
}

static void a_cut_that_is_none_is_refused(void **state) {
    take(state, &useless_slit);
    refuse(state, "coincide along their whole length: it should be a fold");
}

static void a_ring_needs_its_cut(void **state) {
    take(state, &opened_ring); /* both copies coincide, but they keep the outline one walk */
    accept(state);
    take(state, &ring);
    refuse(state, "Piece 1 has a hole: its border is not one closed walk");
}

static void a_wrong_angle_is_refused_and_does_not_refold(void **state) {
    ktg_pattern *p = take(state, &cube);
    net_edge(p, 0, 1)->angle += 1e-5;
    refuse(state, "is said to turn by 90.00");
    refuse(state, "folded by its angles, misses the surface");
    p = take(state, &cube);
    net_edge(p, 0, 4)->angle += 1e-5; /* a cut's angle is checked as well */
    refuse(state, "is said to turn by 90.00");
    p = take(state, &cube);
    net_edge(p, 0, 1)->angle *= -1;
    refuse(state, "is said to turn by -90 degrees, but it turns by 90");
}

static void a_length_off_by_a_millionth_is_refused(void **state) {
    ktg_pattern *p = take(state, &tetrahedron);
    p->pieces[0].vertices[0].x += 1e-6;
    refuse(state, "on the surface");
    p = take(state, &tetrahedron);
    for (size_t i = 0; i < p->pieces[0].vertex_count; i++) {
        p->pieces[0].vertices[i].x *= 1 + 1e-8;
        p->pieces[0].vertices[i].y *= 1 + 1e-8;
    }
    refuse(state, "long, but");
}

static void overlapping_faces_are_named(void **state) {
    fixture *f = *state;
    take(state, &saddle);
    refuse(state, "overlap in piece 1 by");
    assert_true(f->report.deepest_overlap_mm > 1);
    assert_true(f->report.refold_error < 1e-12); /* nothing else is wrong with it */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        CASE(sound_nets_pass),
        CASE(a_pattern_straight_from_unfolding_passes),
        CASE(a_seam_of_two_edges_passes_in_its_order_only),
        CASE(a_missing_face_is_named),
        CASE(a_face_in_two_pieces_is_named),
        CASE(a_mirrored_piece_is_refused),
        CASE(a_face_turned_over_is_named),
        CASE(corners_must_differ_and_stand_for_one_vertex),
        CASE(a_piece_that_falls_apart_is_refused),
        CASE(components_are_those_of_the_surface),
        CASE(a_surface_that_is_no_manifold_is_refused),
        CASE(every_edge_is_listed_once),
        CASE(sides_are_where_they_say),
        CASE(a_cut_called_a_border_is_refused),
        CASE(kinds_are_what_the_surface_says),
        CASE(a_cut_that_is_none_is_refused),
        CASE(a_ring_needs_its_cut),
        CASE(a_wrong_angle_is_refused_and_does_not_refold),
        CASE(a_length_off_by_a_millionth_is_refused),
        CASE(overlapping_faces_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
