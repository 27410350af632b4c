/* Each kind of damage to what is printed is refused with its reason: tabs, outlines, seams, labels,
 * sheets. */
#include "damage.h"

#include "core/memory.h"
#include "core/vec.h"

#include <stdio.h>

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

int main(void) {
    const struct CMUnitTest tests[] = {
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
