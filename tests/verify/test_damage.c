/* Sound patterns pass; each kind of damage is refused with its reason. */
#include "core/memory.h"
#include "core/vec.h"
#include "nets.h"
#include "verify/verify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* A fresh pattern for each test, and the context. */
typedef struct fixture {
    ktg_context *context;
    ktg_pattern *p;
    ktg_verify_report report;
} fixture;

static int setup(void **state) {
    fixture *f = calloc(1, sizeof *f);
    *state = f;
    return !f || ktg_context_new(&f->context) != KTG_OK;
}

static int teardown(void **state) {
    fixture *f = *state;
    ktg_pattern_free(&f->p);
    ktg_context_free(&f->context);
    free(f);
    return 0;
}

static ktg_pattern *take(void **state, const net *n) {
    fixture *f = *state;
    ktg_pattern_free(&f->p);
    f->p = net_make(f->context, n);
    return f->p;
}

static void accept(void **state) {
    fixture *f = *state;
    if (ktg_verify(f->context, f->p, NULL, &f->report) != KTG_OK)
        fail_msg("%s", ktg_context_message(f->context));
    assert_int_equal(f->report.problem_count, 0);
}

static void refuse(void **state, const char *reason) {
    fixture *f = *state;
    ktg_status status = ktg_verify(f->context, f->p, NULL, &f->report);
    const char *message = ktg_context_message(f->context);
    if (status != KTG_UNSOUND || !strstr(message, reason))
        fail_msg("status %s, \"%s\" instead of \"%s\"", ktg_status_name(status), message, reason);
    assert_true(f->report.problem_count > 0);
}

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

/* ---- tabs --------------------------------------------------------------------------------- */

static ktg_pattern_tab *tab_on(ktg_pattern *p, uint32_t a, uint32_t b) {
    uint32_t edge = net_edge_index(p, a, b);
    for (size_t i = 0; i < p->piece_count; i++)
        for (size_t k = 0; k < p->pieces[i].tab_count; k++)
            if (p->pieces[i].tabs[k].edge == edge)
                return &p->pieces[i].tabs[k];
    abort();
}

/* Pulls the outer corners of a tab out to `height`, and in by `in` along its edge. */
static void reshape(ktg_pattern_tab *tab, double height, double in) {
    ktg_vec2 a = tab->corners[0], b = tab->corners[3], x = ktg_unit2(ktg_sub2(b, a));
    ktg_vec2 out = ktg_mul2(ktg_perp2(x), -height);
    tab->corners[1] = ktg_add2(ktg_madd2(a, in, x), out);
    tab->corners[2] = ktg_add2(ktg_madd2(b, -in, x), out);
}

static void a_tab_over_a_face_is_refused(void **state) {
    fixture *f = *state;
    ktg_pattern *p = take(state, &box_and_lid);
    ktg_pattern_tab *tab = tab_on(p, 0, 4);
    reshape(tab, 8, -3); /* it leans over the corner, onto the next wall */
    net_outlines(f->context, p);
    refuse(state, "overlaps face");
}

static void two_tabs_of_a_piece_that_overlap_are_refused(void **state) {
    fixture *f = *state;
    ktg_pattern *p = take(state, &box_and_lid);
    reshape(tab_on(p, 4, 5), 4, -8);
    reshape(tab_on(p, 1, 5), 4, -8);
    net_outlines(f->context, p);
    refuse(state, "of piece 1 overlap by");
}

static void a_tab_is_convex_and_counter_clockwise(void **state) {
    ktg_pattern *p = take(state, &cube);
    ktg_pattern_tab *tab = tab_on(p, 0, 4), old = *tab;
    for (int k = 0; k < 4; k++)
        tab->corners[k] = old.corners[3 - k];
    refuse(state, "is not convex and counter-clockwise");
    *tab = old;
    tab->corners[1] = ktg_mul2(
        ktg_add2(ktg_add2(old.corners[0], old.corners[3]), ktg_mul2(old.corners[2], 2)), 0.25);
    tab->corners[1] = ktg_madd2(old.corners[3], 0.1, ktg_sub2(tab->corners[1], old.corners[3]));
    refuse(state, "is not convex and counter-clockwise");
}

static void a_tab_is_on_its_edge_and_outside(void **state) {
    ktg_pattern *p = take(state, &cube);
    ktg_pattern_tab *tab = tab_on(p, 0, 4);
    for (int k = 0; k < 4; k++)
        tab->corners[k].x += 1e-4, tab->corners[k].y += 1e-4;
    refuse(state, "does not start and end on that edge");
    p = take(state, &cube);
    tab = tab_on(p, 0, 4);
    ktg_pattern_tab old = *tab;
    ktg_vec2 middle = ktg_mul2(ktg_add2(old.corners[0], old.corners[3]), 0.5);
    for (int k = 0; k < 4; k++)
        tab->corners[k] = ktg_sub2(ktg_mul2(middle, 2), old.corners[k]);
    refuse(state, "is not outside its own face");
}

static void a_tab_that_sticks_out_under_its_mate_is_refused(void **state) {
    fixture *f = *state;
    ktg_pattern *p = take(state, &box_and_lid);
    uint32_t e = net_edge_index(p, 4, 5);
    ktg_pattern_tab *tab = tab_on(p, 4, 5);
    reshape(tab, 29.9, 12); /* the lid is 30 deep: across its flat diagonal and just inside */
    net_outlines(f->context, p);
    assert_int_equal(ktg_verify(f->context, p, NULL, &f->report), KTG_UNSOUND);
    assert_null(strstr(ktg_context_message(f->context), "does not fit under"));
    reshape(tab, 30.001, 12);
    net_outlines(f->context, p);
    char says[64];
    snprintf(says, sizeof says, "The tab on edge %u does not fit under face", e + 1);
    refuse(state, says);
}

static void tabs_that_collide_where_they_are_glued_are_refused(void **state) {
    fixture *f = *state;
    ktg_pattern *p = take(state, &box_and_lid);
    reshape(tab_on(p, 4, 5), 16, 10);
    net_outlines(f->context, p);
    accept(state);
    reshape(tab_on(p, 6, 7), 16, 10);
    net_outlines(f->context, p);
    refuse(state, "collide where they are glued, under piece 2, by 2 mm");
}

static void edges_and_tabs_agree(void **state) {
    ktg_pattern *p = take(state, &cube);
    net_edge(p, 0, 4)->tab_on = -1;
    refuse(state, "but the edge says that the tab is on no side");
    p = take(state, &box_and_lid);
    net_edge(p, 4, 5)->tab_on = 1;
    refuse(state, "but the edge says that the tab is in another piece");
    p = take(state, &cube);
    p->pieces[0].tab_count--;
    refuse(state, "is said to carry a tab, but piece 1 has none for it");
    p = take(state, &cube);
    p->pieces[0].tabs[1] = p->pieces[0].tabs[0];
    refuse(state, "has more than one tab");
    p = take(state, &cube);
    p->pieces[0].tabs[0].edge = net_edge_index(p, 0, 1);
    refuse(state, "which is not a cut");
}

/* ---- outlines, seams, labels -------------------------------------------------------------- */

static void an_outline_may_start_anywhere(void **state) {
    ktg_pattern *p = take(state, &slit);
    ktg_pattern_piece *piece = &p->pieces[0];
    for (size_t i = 0; i < piece->outline_count; i++) {
        ktg_vec2 first = piece->outline[0];
        memmove(piece->outline, piece->outline + 1,
                (piece->outline_count - 1) * sizeof *piece->outline);
        piece->outline[piece->outline_count - 1] = first;
        accept(state);
    }
}

static void drop_outline_point(ktg_pattern_piece *piece, ktg_vec2 point) {
    size_t kept = 0;
    for (size_t i = 0; i < piece->outline_count; i++)
        if (piece->outline[i].x != point.x || piece->outline[i].y != point.y)
            piece->outline[kept++] = piece->outline[i];
    assert_int_equal(kept + 1, piece->outline_count);
    piece->outline_count = kept;
}

static void an_outline_keeps_to_faces_and_tabs(void **state) {
    ktg_pattern *p = take(state, &cube);
    ktg_pattern_piece *piece = &p->pieces[0];
    piece->outline[3].x += 1e-4;
    refuse(state, "The outline of piece 1 leaves the border of its faces and tabs near");
    p = take(state, &cube);
    piece = &p->pieces[0];
    drop_outline_point(piece, piece->tabs[0].corners[1]);
    refuse(state, "The outline of piece 1 leaves the border");
    p = take(state, &cube);
    piece = &p->pieces[0];
    for (size_t i = 0; i < piece->outline_count / 2; i++) {
        ktg_vec2 swap = piece->outline[i];
        piece->outline[i] = piece->outline[piece->outline_count - 1 - i];
        piece->outline[piece->outline_count - 1 - i] = swap;
    }
    refuse(state, "square mm, but its faces and tabs have");
    p = take(state, &cube);
    p->pieces[0].outline_count = 0;
    refuse(state, "Piece 1 has no outline");
}

static void a_tab_left_out_of_the_outline_is_refused(void **state) {
    fixture *f = *state;
    ktg_pattern *p = take(state, &cube);
    ktg_pattern_edge *edge = net_edge(p, 0, 4);
    edge->tab_on = -1;
    net_outlines(f->context, p);
    edge->tab_on = 0;
    refuse(state, "The outline of piece 1 leaves the border");
}

static void seams_are_complete(void **state) {
    ktg_pattern *p = take(state, &cube);
    ktg_free(p->seams[6].edges);
    ktg_free(p->seams[6].first_side);
    for (size_t e = 0; e < p->edge_count; e++)
        if (p->edges[e].seam == 6)
            p->edges[e].seam = KTG_NONE;
    p->seam_count = 6;
    refuse(state, "is a cut, but it is in no seam");
    p = take(state, &cube);
    p->seams[1].edges[0] = p->seams[0].edges[0];
    refuse(state, "is in seam 1 and again in seam 2");
    p = take(state, &cube);
    p->seams[0].edges[0] = net_edge_index(p, 0, 1);
    refuse(state, "which is not a cut");
    p = take(state, &box_and_lid);
    net_edge(p, 4, 5)->seam = 0;
    refuse(state, "but the edge says otherwise");
    p = take(state, &box_and_lid);
    uint32_t seam = net_edge(p, 4, 5)->seam;
    p->seams[seam].first_side[0] = 1;
    refuse(state, "is not in piece 1");
    p = take(state, &cube);
    net_edge(p, 0, 1)->seam = 2;
    refuse(state, "names seam 3, but that seam does not have it");
}

static void a_seam_of_cuts_that_are_apart_is_refused(void **state) {
    ktg_pattern *p = take(state, &cube);
    ktg_pattern_seam *seam = &p->seams[0], *last = &p->seams[6];
    seam->edges = realloc(seam->edges, 2 * sizeof *seam->edges);
    seam->first_side = realloc(seam->first_side, 2);
    seam->edges[1] = last->edges[0];
    seam->first_side[1] = 0;
    seam->edge_count = 2;
    seam->lengths_mm[0] *= 2;
    seam->lengths_mm[1] *= 2;
    p->edges[last->edges[0]].seam = 0;
    ktg_free(last->edges);
    ktg_free(last->first_side);
    p->seam_count = 6;
    refuse(state, "do not follow each other on both sides");
}

static void seam_lengths_are_right(void **state) {
    ktg_pattern *p = take(state, &cube);
    p->seams[2].lengths_mm[1] += 1e-6;
    refuse(state, "Seam 3 is said to be 30.000001 mm long in piece 1, but it is 30");
}

static void labels_are_on_their_piece(void **state) {
    ktg_pattern *p = take(state, &cube);
    p->pieces[0].labels[0].text[0] = 0;
    refuse(state, "A label of piece 1 is empty");
    p = take(state, &cube);
    p->pieces[0].labels[0].at.x = 500;
    refuse(state, "Label \"1\" of piece 1 is far from the piece");
    p = take(state, &cube);
    p->pieces[0].labels[0].height_mm = 0;
    refuse(state, "Label \"1\" of piece 1 has no height");
}

/* ---- sheets ------------------------------------------------------------------------------- */

static void each_piece_is_placed_once(void **state) {
    ktg_pattern *p = take(state, &box_and_lid);
    p->sheets[1].placements[0].piece = 0;
    refuse(state, "Piece 1 is placed 2 times");
    refuse(state, "Piece 2 is on no sheet");
}

static void pieces_stay_inside_what_can_be_printed(void **state) {
    ktg_pattern *p = take(state, &cube);
    p->sheets[0].placements[0].x = 20;
    refuse(state, "Piece 1 leaves the printable area of sheet 1 by");
    p = take(state, &cube);
    p->sheets[0].printable[2] = 401;
    refuse(state, "The printable area of sheet 1 is not within its paper");
    p = take(state, &cube);
    p->sheets[0].printable[2] = 5;
    refuse(state, "The printable area of sheet 1 is not within its paper");
}

static void pieces_on_a_sheet_are_apart(void **state) {
    ktg_pattern *p = take(state, &two_parts);
    ktg_pattern_placement *both = realloc(p->sheets[0].placements, 2 * sizeof *both);
    p->sheets[0].placements = both;
    both[1] = both[0];
    both[1].piece = 1;
    both[1].x -= 150;
    p->sheets[0].placement_count = 2;
    p->sheets[1].placement_count = 0;
    accept(state);
    both[1].x += 140;
    refuse(state, "Pieces 1 and 2 overlap on sheet 1 by");
}

/* Makes two tiles of the only sheet, which share a strip at `cut` mm from the left, 10 mm wide. */
static void split_sheet(ktg_pattern *p, double cut) {
    ktg_pattern_sheet *tiles = realloc(p->sheets, 2 * sizeof *tiles);
    ktg_pattern_placement *at = calloc(1, sizeof *at);
    p->sheets = tiles;
    p->sheet_count = 2;
    *at = tiles[0].placements[0];
    tiles[0].kind = KTG_TILE;
    tiles[1] = tiles[0];
    tiles[1].placements = at;
    tiles[0].printable[2] = cut + 10;
    tiles[1].printable[0] = cut;
}

static void tiles_show_all_of_their_piece(void **state) {
    ktg_pattern *p = take(state, &cube);
    split_sheet(p, 200);
    accept(state);
    p->sheets[1].printable[0] += 9.9;
    accept(state);
    p->sheets[1].printable[0] += 0.2;
    refuse(state, "of piece 1 are on none of its tiles");
    p->sheets[1].printable[0] -= 1;
    p->sheets[1].placements[0].y += 200;
    refuse(state, "of piece 1 are on none of its tiles");
    p->sheets[1].placements[0].y -= 200;
    p->sheets[1].placements[0].rotation += 1e-3;
    refuse(state, "The tiles of piece 1 hold it in different turns");
    p = take(state, &cube);
    split_sheet(p, 200);
    p->sheets[0].kind = KTG_SHEET;
    refuse(state, "Piece 1 is on a sheet and on tiles");
}

#define CASE(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

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
        CASE(a_tab_over_a_face_is_refused),
        CASE(two_tabs_of_a_piece_that_overlap_are_refused),
        CASE(a_tab_is_convex_and_counter_clockwise),
        CASE(a_tab_is_on_its_edge_and_outside),
        CASE(a_tab_that_sticks_out_under_its_mate_is_refused),
        CASE(tabs_that_collide_where_they_are_glued_are_refused),
        CASE(edges_and_tabs_agree),
        CASE(an_outline_may_start_anywhere),
        CASE(an_outline_keeps_to_faces_and_tabs),
        CASE(a_tab_left_out_of_the_outline_is_refused),
        CASE(seams_are_complete),
        CASE(a_seam_of_cuts_that_are_apart_is_refused),
        CASE(seam_lengths_are_right),
        CASE(labels_are_on_their_piece),
        CASE(each_piece_is_placed_once),
        CASE(pieces_stay_inside_what_can_be_printed),
        CASE(pieces_on_a_sheet_are_apart),
        CASE(tiles_show_all_of_their_piece),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
