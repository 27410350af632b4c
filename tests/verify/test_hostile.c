/* Patterns whose numbers make no sense: refused, whatever they hold. */
#include "core/memory.h"
#include "core/random.h"
#include "nets.h"
#include "proof.h"

#include <math.h>

static void nothing_at_all_is_refused(void **state) {
    ktg_context *context = *state;
    ktg_pattern empty = {0};
    refuse(context, &empty, NULL, "The surface has no faces");
    assert_int_equal(ktg_verify(context, NULL, NULL, NULL), KTG_ARGUMENT);
    empty.face_count = 1000;
    empty.piece_count = 3;
    refuse(context, &empty, NULL, "no arrays");
    ktg_pattern *p = net_make(context, &cube);
    ktg_vec3 same[8] = {{0, 0, 0}};
    memcpy(p->vertices, same, sizeof same);
    refuse(context, p, NULL, "The surface has no size");
    ktg_pattern_free(&p);
}

static void indices_out_of_range_are_refused(void **state) {
    ktg_context *context = *state;
    ktg_pattern *p = net_make(context, &cube);
    ktg_pattern_piece *piece = &p->pieces[0];
    struct {
        uint32_t *at;
        const char *says;
    } cases[] = {
        {&p->faces[4], "Face 1 refers to vertex 4000000000"},
        {&piece->faces[2], "Piece 1 holds face 4000000000"},
        {&piece->corners[7], "refers to vertex 4000000000, but the piece has"},
        {&piece->component, "Piece 1 is of a component that does not exist"},
        {&piece->tabs[1].edge, "is on an edge that does not exist"},
        {&piece->tabs[1].corner_count, "has 4000000000 corners"},
        {&piece->labels[0].edge, "belongs to an edge that does not exist"},
        {&p->edges[3].vertices[1], "Edge 4 refers to something that does not exist"},
        {&p->edges[3].side_count, "Edge 4 refers to something that does not exist"},
        {&p->edges[3].seam, "Edge 4 refers to something that does not exist"},
        {&p->edges[3].sides[0].piece, "Edge 4 refers to something that does not exist"},
        {&p->edges[3].sides[0].face, "Edge 4 refers to something that does not exist"},
        {&p->edges[3].sides[0].corner, "Edge 4 refers to something that does not exist"},
        {&p->seams[1].edges[0], "Seam 2 refers to something that does not exist"},
        {&p->seams[1].pieces[1], "Seam 2 refers to something that does not exist"},
        {&p->sheets[0].placements[0].piece, "Sheet 1 refers to something that does not exist"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        uint32_t old = *cases[i].at;
        *cases[i].at = 4000000000u;
        refuse(context, p, NULL, cases[i].says);
        *cases[i].at = old;
    }
    p->edges[0].kind = (ktg_edge_kind)9;
    refuse(context, p, NULL, "Edge 1 refers to something that does not exist");
    ktg_pattern_free(&p);
}

static void numbers_that_are_none_are_refused(void **state) {
    ktg_context *context = *state;
    static const double bad[] = {NAN, INFINITY, -1e200};
    for (size_t i = 0; i < 3; i++) {
        ktg_pattern *p = net_make(context, &cube);
        ktg_pattern_piece *piece = &p->pieces[0];
        double *at[] = {&p->vertices[3].y,          &piece->vertices[2].x,
                        &piece->outline[1].y,       &piece->tabs[0].corners[2].x,
                        &piece->labels[0].at.x,     &p->edges[1].angle,
                        &p->seams[0].lengths_mm[0], &p->sheets[0].placements[0].rotation,
                        &p->sheets[0].printable[1], &p->mm_per_unit};
        for (size_t k = 0; k < sizeof at / sizeof *at; k++) {
            double old = *at[k];
            *at[k] = bad[i];
            refuse(context, p, NULL, "");
            *at[k] = old;
        }
        ktg_pattern_free(&p);
    }
}

/* Small wrong values everywhere, many at once: the verdict is of no interest, the walk is. */
static void a_shuffled_pattern_ends_with_a_verdict(void **state) {
    ktg_context *context = *state;
    ktg_random random;
    ktg_random_seed(&random, 7);
    for (int round = 0; round < 3000; round++) {
        const net *nets[] = {&cube, &box_and_lid, &slit, &saddle, &open_box};
        ktg_pattern *p = net_make(context, nets[round % 5]);
        for (size_t k = 0; k < 1 + ktg_random_below(&random, 4); k++) {
            ktg_pattern_piece *piece = &p->pieces[ktg_random_below(&random, p->piece_count)];
            ktg_pattern_edge *edge = &p->edges[ktg_random_below(&random, p->edge_count)];
            uint32_t small = (uint32_t)ktg_random_below(&random, 8);
            ktg_vec2 *v = &piece->vertices[ktg_random_below(&random, piece->vertex_count)];
            switch (ktg_random_below(&random, 12)) {
            case 0:
                p->faces[ktg_random_below(&random, 3 * (size_t)p->face_count)] = small;
                break;
            case 1:
                piece->faces[ktg_random_below(&random, piece->face_count)] = small;
                break;
            case 2:
                piece->corners[ktg_random_below(&random, 3 * piece->face_count)] = small;
                break;
            case 3:
                edge->sides[small % 2].face = small;
                break;
            case 4:
                edge->sides[small % 2].corner = small;
                break;
            case 5:
                edge->kind = (ktg_edge_kind)(small % 5);
                break;
            case 6:
                edge->side_count = 1 + small % 2;
                break;
            case 7:
                edge->tab_on = (int)(small % 3) - 1;
                break;
            case 8:
                *v = piece->vertices[0];
                break;
            case 9:
                v->x = v->y = 0;
                break;
            case 10:
                if (piece->tab_count)
                    piece->tabs[0].edge = small;
                break;
            default:
                p->seams[0].edges[0] = small;
            }
        }
        ktg_verify_report report;
        ktg_status status = ktg_verify(context, p, NULL, &report);
        assert_true(status == KTG_OK || status == KTG_UNSOUND);
        assert_int_equal(status == KTG_OK, report.problem_count == 0);
        ktg_pattern_free(&p);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        CASE(nothing_at_all_is_refused),
        CASE(indices_out_of_range_are_refused),
        CASE(numbers_that_are_none_are_refused),
        CASE(a_shuffled_pattern_ends_with_a_verdict),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
