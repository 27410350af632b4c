/* verify/seams.c - every cut in exactly one seam, runs that are consecutive on both sides, and
 * their lengths. */
#include "core/memory.h"
#include "verify/check.h"

/* The half-edge of edge k of a seam along the seam's side `s`; KTG_NONE on a border. */
static uint32_t along(const ktg_check *check, const ktg_pattern_seam *seam, uint32_t k, int s) {
    const ktg_pattern_edge *edge = &check->pattern->edges[seam->edges[k]];
    return edge->side_count < 2 ? KTG_NONE
                                : ktg_check_halfedge(&edge->sides[seam->first_side[k] ^ s]);
}

static bool check_edges_of(ktg_check *check, uint32_t i, uint32_t *seam_of) {
    const ktg_pattern_seam *seam = &check->pattern->seams[i];
    uint32_t before = check->report->problem_count;
    for (uint32_t k = 0; k < seam->edge_count; k++) {
        uint32_t e = seam->edges[k];
        const ktg_pattern_edge *edge = &check->pattern->edges[e];
        if (seam_of[e] != KTG_NONE)
            ktg_check_problem(check, "Edge %u is in seam %u and again in seam %u.", e + 1,
                              seam_of[e] + 1, i + 1);
        seam_of[e] = i;
        if (edge->kind != KTG_EDGE_CUT || edge->side_count < 2)
            ktg_check_problem(check, "Seam %u has edge %u, which is not a cut.", i + 1, e + 1);
        else if (edge->seam != i)
            ktg_check_problem(check, "Seam %u has edge %u, but the edge says otherwise.", i + 1,
                              e + 1);
        for (int s = 0; edge->side_count == 2 && s < 2; s++)
            if (check->face_piece[along(check, seam, k, s) / 3] != seam->pieces[s])
                ktg_check_problem(check, "Seam %u: side %d of edge %u is not in piece %u.", i + 1,
                                  s + 1, e + 1, seam->pieces[s] + 1);
    }
    return check->report->problem_count == before;
}

/* On side 0 the run goes counter-clockwise; its mates follow each other the other way. */
static void check_run(ktg_check *check, uint32_t i) {
    const ktg_pattern_seam *seam = &check->pattern->seams[i];
    for (uint32_t k = 0; k + 1 < seam->edge_count; k++) {
        uint32_t here = along(check, seam, k, 0), next = along(check, seam, k + 1, 0);
        uint32_t mate = along(check, seam, k, 1), before = along(check, seam, k + 1, 1);
        if (check->fold[here] || check->fold[before])
            continue; /* named already: a fold that is called a cut */
        if (ktg_check_next_border(check, here) != next ||
            ktg_check_next_border(check, before) != mate)
            ktg_check_problem(check,
                              "Seam %u: edges %u and %u do not follow each other on both "
                              "sides.",
                              i + 1, seam->edges[k] + 1, seam->edges[k + 1] + 1);
    }
}

static void check_lengths_of(ktg_check *check, uint32_t i) {
    const ktg_pattern_seam *seam = &check->pattern->seams[i];
    double sum[2] = {0, 0};
    for (int s = 0; s < 2; s++)
        for (uint32_t k = 0; k < seam->edge_count; k++) {
            uint32_t h = along(check, seam, k, s);
            sum[s] += ktg_check_distance2(ktg_check_start2(check, h), ktg_check_end2(check, h));
        }
    bool paper = check->pattern->mode == KTG_PAPER;
    double least = (paper ? KTG_VERIFY_SHORT : KTG_VERIFY_SEWN) * check->reach3;
    for (int s = 0; s < 2; s++)
        if (!(fabs(seam->lengths_mm[s] - sum[s]) <= KTG_VERIFY_LENGTH * fmax(sum[s], least)))
            ktg_check_problem(check,
                              "Seam %u is said to be %.9g mm long in piece %u, but it is "
                              "%.9g.",
                              i + 1, seam->lengths_mm[s], seam->pieces[s] + 1, sum[s]);
    double ease = paper ? 2 * KTG_VERIFY_LENGTH : KTG_VERIFY_EASE;
    if (!(fabs(sum[0] - sum[1]) <= ease * fmax(fmax(sum[0], sum[1]), least)))
        ktg_check_problem(check, "The two sides of seam %u differ: %.9g and %.9g mm.", i + 1,
                          sum[0], sum[1]);
}

ktg_status ktg_check_seams(ktg_check *check) {
    const ktg_pattern *p = check->pattern;
    uint32_t *seam_of = ktg_new(check->context, p->edge_count, uint32_t);
    if (!seam_of)
        return KTG_MEMORY;
    for (size_t i = 0; i < p->edge_count; i++)
        seam_of[i] = KTG_NONE;
    for (uint32_t i = 0; i < p->seam_count; i++)
        if (check_edges_of(check, i, seam_of)) {
            check_run(check, i);
            check_lengths_of(check, i);
        }
    for (size_t i = 0; i < p->edge_count; i++) {
        if (p->edges[i].kind == KTG_EDGE_CUT && seam_of[i] == KTG_NONE)
            ktg_check_problem(check, "Edge %zu is a cut, but it is in no seam.", i + 1);
        if (p->edges[i].seam != KTG_NONE && seam_of[i] == KTG_NONE)
            ktg_check_problem(check, "Edge %zu names seam %u, but that seam does not have it.",
                              i + 1, p->edges[i].seam + 1);
    }
    ktg_free(seam_of);
    return KTG_OK;
}
