/* pattern/build_closing.c - where a paper model is closed at last: along a large, nearly flat patch
 * of faces, which one can press onto its tabs from outside, and low rather than high. */
#include "pattern/build_order.h"

#include "core/memory.h"

#include <stdlib.h>

#define PATCH_COS  0.978 /* of 12 degrees: faces turned less count as one patch */
#define LOW_GAIN   0.5   /* a patch that looks down counts as so much larger */
#define ALONG      0.8   /* so much of a seam has to lie along the patch */
#define OPEN_SHARE 0.5   /* a border longer than this times the root of the area lets a hand in */

typedef struct sized_face {
    double area;
    uint32_t face;
} sized_face;

static int larger_first(const void *left, const void *right) {
    const sized_face *a = left, *b = right;
    if (a->area != b->area)
        return a->area > b->area ? -1 : 1;
    return (a->face > b->face) - (a->face < b->face);
}

static ktg_vec3 normal_of(const ktg_pattern *pattern, uint32_t face) {
    const uint32_t *c = &pattern->faces[3 * (size_t)face];
    ktg_vec3 a = pattern->vertices[c[0]];
    return ktg_cross3(ktg_sub3(pattern->vertices[c[1]], a), ktg_sub3(pattern->vertices[c[2]], a));
}

/* Grows a patch from `seed` through folds, as long as faces look the way it does; `queue` has room
 * for all faces. */
static void grow_patch(ktg_build *b, uint32_t seed, uint32_t *queue) {
    const ktg_topology *t = b->topology;
    ktg_vec3 normal = ktg_unit3(normal_of(b->pattern, seed));
    uint32_t count = 0;
    double down = b->up == 0 ? -normal.x : b->up == 1 ? -normal.y : -normal.z;
    b->patches[seed] = (ktg_patch){0, fmax(0, down)};
    b->patch_of[seed] = seed;
    queue[count++] = seed;
    for (uint32_t i = 0; i < count; i++) {
        b->patches[seed].area += ktg_length3(normal_of(b->pattern, queue[i])) / 2;
        for (uint32_t h = 3 * queue[i]; h < 3 * queue[i] + 3; h++) {
            if (!ktg_kind_is_fold(ktg_edge_at(t, h)->kind))
                continue;
            uint32_t face = ktg_mate(t, h) / 3;
            if (b->patch_of[face] != KTG_NONE ||
                ktg_dot3(ktg_unit3(normal_of(b->pattern, face)), normal) < PATCH_COS)
                continue;
            b->patch_of[face] = seed;
            queue[count++] = face;
        }
    }
}

ktg_status ktg_build_find_patches(ktg_build *b) {
    uint32_t count = b->pattern->face_count;
    sized_face *faces = ktg_new(b->context, count, sized_face);
    uint32_t *queue = ktg_new(b->context, count, uint32_t);
    ktg_status status = faces && queue ? KTG_OK : KTG_MEMORY;
    for (uint32_t f = 0; status == KTG_OK && f < count; f++) {
        faces[f] = (sized_face){ktg_length3(normal_of(b->pattern, f)), f};
        b->patch_of[f] = KTG_NONE;
    }
    if (status == KTG_OK)
        qsort(faces, count, sizeof *faces, larger_first);
    for (uint32_t i = 0; status == KTG_OK && i < count; i++)
        if (b->patch_of[faces[i].face] == KTG_NONE &&
            b->topology->piece_of[faces[i].face] != KTG_NONE)
            grow_patch(b, faces[i].face, queue);
    ktg_free(faces);
    ktg_free(queue);
    return status;
}

/* ---- the best seam ------------------------------------------------------------------------ */

static double worth(const ktg_patch *patch) {
    return patch->area * (1 + LOW_GAIN * patch->low);
}

static double edge_length(const ktg_pattern *pattern, uint32_t edge) {
    const uint32_t *v = pattern->edges[edge].vertices;
    return ktg_length3(ktg_sub3(pattern->vertices[v[1]], pattern->vertices[v[0]]));
}

/* The larger one of the patches on both sides of a cut edge. */
static uint32_t patch_at(const ktg_build *b, uint32_t edge) {
    const ktg_pattern_edge *e = &b->pattern->edges[edge];
    uint32_t p = b->patch_of[e->sides[0].face], q = b->patch_of[e->sides[1].face];
    return worth(&b->patches[q]) > worth(&b->patches[p]) ? q : p;
}

/* How good it is to close the model with this seam: the mean size of the patches along it, less
 * where it is shorter than those are wide. */
static double goodness(const ktg_build *b, uint32_t seam) {
    const ktg_pattern_seam *s = &b->pattern->seams[seam];
    double length = 0, sum = 0;
    for (uint32_t k = 0; k < s->edge_count; k++) {
        double l = edge_length(b->pattern, s->edges[k]);
        length += l;
        sum += l * worth(&b->patches[patch_at(b, s->edges[k])]);
    }
    if (!(length > 0) || !(sum > 0))
        return 0;
    return sum / length * fmin(1, length / sqrt(sum / length));
}

/* The seam a part is best closed with; KTG_NONE when it has none. Where there are several pieces
 * the last one is joined by it. */
static uint32_t best_seam(const ktg_build *b, uint32_t part) {
    bool several = b->pieces.first[part + 1] - b->pieces.first[part] > 1;
    uint32_t best = KTG_NONE;
    double best_goodness = -1;
    for (int obvious = 0; obvious < 2 && best == KTG_NONE; obvious++)
        for (uint32_t i = b->seams.first[part]; i < b->seams.first[part + 1]; i++) {
            uint32_t seam = b->seams.items[i];
            const ktg_pattern_seam *s = &b->pattern->seams[seam];
            if (s->obvious != obvious || (several && s->pieces[0] == s->pieces[1]))
                continue;
            double good = goodness(b, seam);
            if (good > best_goodness * (1 + 1e-9)) {
                best = seam;
                best_goodness = good;
            }
        }
    return best;
}

/* ---- the lid ------------------------------------------------------------------------------ */

/* The patch along which most of the seam lies, weighed by its size. */
static uint32_t lid_of(const ktg_build *b, uint32_t seam) {
    const ktg_pattern_seam *s = &b->pattern->seams[seam];
    uint32_t best = KTG_NONE;
    double most = -1;
    for (uint32_t k = 0; k < s->edge_count; k++) {
        uint32_t patch = patch_at(b, s->edges[k]);
        double sum = 0;
        for (uint32_t i = 0; i < s->edge_count; i++)
            if (patch_at(b, s->edges[i]) == patch)
                sum += edge_length(b->pattern, s->edges[i]);
        sum *= worth(&b->patches[patch]);
        if (sum > most * (1 + 1e-9)) {
            most = sum;
            best = patch;
        }
    }
    return best;
}

static bool lies_along(const ktg_build *b, uint32_t seam, uint32_t patch) {
    const ktg_pattern_seam *s = &b->pattern->seams[seam];
    double length = 0, along = 0;
    for (uint32_t k = 0; k < s->edge_count; k++) {
        const ktg_pattern_edge *e = &b->pattern->edges[s->edges[k]];
        double l = edge_length(b->pattern, s->edges[k]);
        length += l;
        along += b->patch_of[e->sides[0].face] == patch || b->patch_of[e->sides[1].face] == patch
                     ? l
                     : 0;
    }
    return along >= ALONG * length;
}

/* The seams that follow `best` along the border of the patch, up to the most there may be, itself
 * last; all join what it joins. */
static void gather_lid(ktg_build *b, uint32_t best, uint32_t patch) {
    const ktg_topology *t = b->topology;
    uint32_t piece = t->piece_of[patch], count = 0;
    uint32_t from = t->border_first[piece], size = t->border_first[piece + 1] - from, start = 0;
    bool several = b->pattern->seams[best].pieces[0] != b->pattern->seams[best].pieces[1];
    for (uint32_t i = 0; i < size; i++)
        if (ktg_edge_at(t, t->border[from + i])->seam == best &&
            b->patch_of[t->border[from + i] / 3] == patch)
            start = i;
    for (uint32_t i = 1; i <= size && count + 1 < KTG_CLOSING_MOST; i++) {
        uint32_t h = t->border[from + (start + i) % size], seam = ktg_edge_at(t, h)->seam;
        if (b->patch_of[h / 3] != patch || seam == KTG_NONE || seam == best)
            continue;
        const ktg_pattern_seam *s = &b->pattern->seams[seam];
        bool known =
            s->obvious || (s->pieces[0] != s->pieces[1]) != several || !lies_along(b, seam, patch);
        for (uint32_t k = 0; k < count; k++)
            known = known || b->closing[k] == seam;
        if (!known)
            b->closing[count++] = seam;
    }
    b->closing[count++] = best;
    b->closing_count = count;
}

bool ktg_build_is_closing(const ktg_build *b, uint32_t seam) {
    for (uint32_t k = 0; k < b->closing_count; k++)
        if (b->closing[k] == seam)
            return true;
    return false;
}

/* A part with a border, not just a hole, needs no lid. */
static bool is_open(const ktg_build *b, uint32_t part) {
    double border = 0, area = 0;
    for (uint32_t i = b->edges.first[part]; i < b->edges.first[part + 1]; i++)
        if (b->pattern->edges[b->edges.items[i]].kind == KTG_EDGE_BORDER)
            border += edge_length(b->pattern, b->edges.items[i]);
    for (uint32_t i = b->pieces.first[part]; i < b->pieces.first[part + 1]; i++) {
        const ktg_pattern_piece *piece = &b->pattern->pieces[b->pieces.items[i]];
        for (size_t f = 0; f < piece->face_count; f++)
            area += ktg_length3(normal_of(b->pattern, piece->faces[f])) / 2;
    }
    return border > OPEN_SHARE * sqrt(area);
}

void ktg_build_find_closing(ktg_build *b, uint32_t part) {
    uint32_t best = best_seam(b, part);
    b->closing_count = 0;
    b->is_open = is_open(b, part);
    b->last_piece = b->pieces.items[b->pieces.first[part]];
    if (best == KTG_NONE)
        return;
    uint32_t lid = lid_of(b, best);
    b->last_piece = b->topology->piece_of[lid];
    gather_lid(b, best, lid);
}
