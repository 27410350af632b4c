/* unfold/cut_table.c - discrete Gaussian curvature and the cut-count table. */
#include "unfold/cut_table.h"
#include "core/memory.h"
#include "core/vec.h"

/* Angle sums within this of 2 pi count as flat. */
#define FLAT_ANGLE 1e-7

/* The angle at corner k of a face. */
static double corner_angle(const ktg_dual *dual, uint32_t face, int k) {
    ktg_vec3 out = dual->edge_vectors[3 * face + k];
    ktg_vec3 in = dual->edge_vectors[3 * face + (k + 2) % 3];
    return atan2(ktg_length3(ktg_cross3(in, out)), -ktg_dot3(in, out));
}

/* needed = 2 where the curvature 2 pi - sum of angles is negative. */
static ktg_status find_saddles(ktg_context *context, const ktg_dual *dual, uint8_t *needed) {
    double *sum = ktg_new(context, dual->vertex_count, double);
    if (!sum)
        return KTG_MEMORY;
    for (uint32_t f = 0; f < dual->face_count; f++)
        for (int k = 0; k < 3; k++)
            sum[dual->faces[3 * f + k]] += corner_angle(dual, f, k);
    for (uint32_t v = 0; v < dual->vertex_count; v++)
        needed[v] = sum[v] > 2 * KTG_PI + FLAT_ANGLE ? 2 : 1;
    ktg_free(sum);
    return KTG_OK;
}

/* A border vertex of an oriented manifold starts one border half-edge: it has one sector more. */
static void count_sectors(const ktg_dual *dual, const bool *joined, uint32_t *sectors) {
    for (uint32_t e = 0; e < dual->edge_count; e++) {
        if (joined[e])
            continue;
        sectors[dual->edges[e].vertices[0]]++;
        sectors[dual->edges[e].vertices[1]]++;
    }
    for (uint32_t h = 0; h < 3 * dual->face_count; h++)
        if (dual->halfedge_edge[h] == KTG_NONE)
            sectors[dual->faces[h]]++;
}

ktg_status ktg_cut_table_new(ktg_context *context, const ktg_dual *dual, const bool *joined,
                             ktg_cut_table *table) {
    *table = (ktg_cut_table){.vertex_count = dual->vertex_count,
                             .sectors = ktg_new(context, dual->vertex_count, uint32_t),
                             .needed = ktg_new(context, dual->vertex_count, uint8_t)};
    ktg_status status =
        table->sectors && table->needed ? find_saddles(context, dual, table->needed) : KTG_MEMORY;
    if (status == KTG_OK)
        count_sectors(dual, joined, table->sectors);
    else
        ktg_cut_table_free(table);
    return status;
}

void ktg_cut_table_free(ktg_cut_table *table) {
    ktg_free(table->sectors);
    ktg_free(table->needed);
    *table = (ktg_cut_table){0};
}
