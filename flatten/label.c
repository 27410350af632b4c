/* flatten/label.c - a sheet in two by a value of each face: which side, without islands, and the
 * edges between. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/sheet.h"

#include <stdlib.h>

/* An island smaller than this part of the sheet joins what surrounds it. */
static const double least_island = 0.04;
enum { most_majority_rounds = 10 };

/* The neighbour across corner k's edge, or KTG_NONE. */
static uint32_t neighbour(const ktg_sheet *sheet, uint32_t face, uint32_t k) {
    uint32_t twin = sheet->adjacency->twin[3 * (size_t)face + k];
    return twin == KTG_NONE ? KTG_NONE : twin / 3;
}

/* A face with two neighbours on the other side goes over: no teeth. */
static bool take_majority(const ktg_sheet *sheet, bool *side) {
    bool changed = false;
    for (uint32_t f = 0; f < sheet->mesh->face_count; f++) {
        int other = 0;
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t g = neighbour(sheet, f, k);
            other += g != KTG_NONE && side[g] != side[f];
        }
        if (other < 2)
            continue;
        side[f] = !side[f];
        changed = true;
    }
    return changed;
}

/* Gathers the faces of the island that holds `first` in `island`; seen faces are marked. */
static uint32_t gather(const ktg_sheet *sheet, const bool *side, uint32_t first, bool *seen,
                       uint32_t *island, double *area) {
    uint32_t count = 0;
    seen[first] = true;
    island[count++] = first;
    *area = 0;
    for (uint32_t i = 0; i < count; i++) {
        *area += ktg_length3(ktg_sheet_area(sheet->mesh, island[i]));
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t g = neighbour(sheet, island[i], k);
            if (g == KTG_NONE || seen[g] || side[g] != side[first])
                continue;
            seen[g] = true;
            island[count++] = g;
        }
    }
    return count;
}

static void drop_islands(const ktg_sheet *sheet, bool *side, bool *seen, uint32_t *island) {
    for (uint32_t f = 0; f < sheet->mesh->face_count; f++) {
        double area;
        if (seen[f])
            continue;
        uint32_t count = gather(sheet, side, f, seen, island, &area);
        if (area < least_island * sheet->area)
            for (uint32_t i = 0; i < count; i++)
                side[island[i]] = !side[island[i]];
    }
}

void ktg_label_edges(const ktg_sheet *sheet, const bool *side, bool *cut) {
    for (uint32_t h = 0; h < sheet->adjacency->halfedge_count; h++) {
        uint32_t twin = sheet->adjacency->twin[h];
        if (twin != KTG_NONE && side[h / 3] != side[twin / 3])
            cut[sheet->adjacency->halfedge_edge[h]] = true;
    }
}

ktg_status ktg_label_clean(ktg_context *context, const ktg_sheet *sheet, bool *side) {
    bool *seen = ktg_new(context, sheet->mesh->face_count, bool);
    uint32_t *island = ktg_new(context, sheet->mesh->face_count, uint32_t);
    ktg_status status = seen && island ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        for (int k = 0; k < most_majority_rounds && take_majority(sheet, side);)
            k++;
        drop_islands(sheet, side, seen, island);
    }
    ktg_free(seen);
    ktg_free(island);
    return status;
}

typedef struct valued_face {
    double value;
    uint32_t face;
} valued_face;

static int by_value(const void *a, const void *b) {
    const valued_face *x = a, *y = b;
    if (x->value != y->value)
        return x->value < y->value ? -1 : 1;
    return (x->face > y->face) - (x->face < y->face);
}

/* Of all thresholds the one after which both sides together vary least (two means of one
 * dimension), or `part` of the area lies below it. */
static double threshold(const ktg_sheet *sheet, const valued_face *sorted, double part) {
    double total = 0, sum = 0, below = 0, sum_below = 0, best = -1, at = sorted[0].value;
    for (uint32_t i = 0; i < sheet->mesh->face_count; i++) {
        double area = ktg_length3(ktg_sheet_area(sheet->mesh, sorted[i].face));
        total += area;
        sum += area * sorted[i].value;
    }
    for (uint32_t i = 0; i + 1 < sheet->mesh->face_count; i++) {
        double area = ktg_length3(ktg_sheet_area(sheet->mesh, sorted[i].face));
        below += area;
        sum_below += area * sorted[i].value;
        double above = ktg_max(total - below, 1e-300),
               apart = sum_below / below - (sum - sum_below) / above;
        double score =
            part > 0 ? total - fabs(below - part * total) : below * above * apart * apart;
        if (score > best) {
            best = score;
            at = (sorted[i].value + sorted[i + 1].value) / 2;
        }
    }
    return at;
}

ktg_status ktg_label_by_value(ktg_context *context, const ktg_sheet *sheet, const double *value,
                              double part, bool *side, double *at) {
    valued_face *sorted = ktg_new(context, sheet->mesh->face_count, valued_face);
    if (!sorted)
        return KTG_MEMORY;
    for (uint32_t f = 0; f < sheet->mesh->face_count; f++)
        sorted[f] = (valued_face){value[f], f};
    qsort(sorted, sheet->mesh->face_count, sizeof *sorted, by_value);
    *at = threshold(sheet, sorted, part);
    for (uint32_t f = 0; f < sheet->mesh->face_count; f++)
        side[f] = value[f] > *at;
    ktg_free(sorted);
    return ktg_label_clean(context, sheet, side);
}

void ktg_plane_cost(const ktg_sheet *sheet, ktg_vec3 normal, double offset, double *cost) {
    for (uint32_t e = 0; e < sheet->edge_count; e++) {
        double away = 0;
        for (int k = 0; k < 2; k++) {
            ktg_vec3 p = sheet->mesh->positions[sheet->ends[2 * (size_t)e + k]];
            away += fabs(ktg_dot3(normal, p) - offset) / (2 * sheet->mean_edge);
        }
        cost[e] = sheet->length[e] * (1 + 4 * away * away);
    }
}
