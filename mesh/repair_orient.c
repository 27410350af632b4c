/* mesh/repair_orient.c - turning faces so that neighbours agree and solids show their outside.
 *
 * Breadth first over the joins, first those that are edges of the file, then those made between
 * coincident vertices, so that a repaired mesh is repaired to itself. A join whose two sides are
 * reached with different turns is cut (a Moebius strip has one such front). Then each component is
 * turned the way most of its area was, and a closed one whose volume comes out negative is turned
 * over. */
#include "core/memory.h"
#include "core/vec.h"
#include "mesh/repair.h"

#include <string.h>

typedef struct orient_work {
    uint32_t *queue;  /* faces in the order they are reached; a component is a run of it */
    uint32_t *stitch; /* half-edges of reached faces, joined by coincidence only */
    bool *reached, *turned;
} orient_work;

/* The two sides of a join run against each other when neither face is turned. */
static bool agrees(const ktg_repair *repair, uint32_t h, uint32_t g) {
    const uint32_t *faces = repair->mesh->faces;
    return repair->weld[faces[h]] != repair->weld[faces[g]];
}

/* The join was an edge of the file, not only of coincident vertices. */
static bool was_edge(const ktg_mesh *mesh, uint32_t h, uint32_t g) {
    uint32_t a = mesh->faces[h], b = mesh->faces[ktg_halfedge_next(h)];
    uint32_t c = mesh->faces[g], d = mesh->faces[ktg_halfedge_next(g)];
    return (a == c && b == d) || (a == d && b == c);
}

static void cut_join(ktg_repair *repair, uint32_t h, uint32_t g) {
    repair->mate[h] = repair->mate[g] = KTG_NONE;
    repair->unsettled = true;
    repair->report.seams_opened += was_edge(repair->mesh, h, g);
}

/* Goes from a reached face across half-edge h, whose mate is g. */
static void cross(ktg_repair *repair, orient_work *w, uint32_t h, uint32_t g, uint32_t *end) {
    bool turn = w->turned[h / 3] != !agrees(repair, h, g);
    if (!w->reached[g / 3]) {
        w->reached[g / 3] = true;
        w->turned[g / 3] = turn;
        w->queue[(*end)++] = g / 3;
    } else if (w->turned[g / 3] != turn) {
        cut_join(repair, h, g);
    }
}

/* Reaches everything joined with `seed`; returns the end of its run in the queue. */
static uint32_t spread(ktg_repair *repair, orient_work *w, uint32_t seed, uint32_t begin) {
    uint32_t end = begin, at = begin, stitch_count = 0, stitch_at = 0;
    w->queue[end++] = seed;
    w->reached[seed] = true;
    while (at < end || stitch_at < stitch_count) {
        if (at == end) {
            uint32_t h = w->stitch[stitch_at++];
            if (repair->mate[h] != KTG_NONE)
                cross(repair, w, h, repair->mate[h], &end);
            continue;
        }
        uint32_t f = w->queue[at++];
        for (uint32_t h = 3 * f; h < 3 * f + 3; h++) {
            uint32_t g = repair->mate[h];
            if (g != KTG_NONE && was_edge(repair->mesh, h, g))
                cross(repair, w, h, g, &end);
            else if (g != KTG_NONE)
                w->stitch[stitch_count++] = h;
        }
    }
    return end;
}

/* Whether a component is to be turned over as a whole. Its volume is measured from one of its own
 * vertices, so that a far origin costs no digits. */
static bool to_turn_over(const ktg_repair *repair, const orient_work *w, uint32_t begin,
                         uint32_t end) {
    const ktg_mesh *mesh = repair->mesh;
    double kept = 0, turned = 0, volume = 0;
    bool closed = true;
    ktg_vec3 origin = mesh->positions[mesh->faces[3 * (size_t)w->queue[begin]]];
    for (uint32_t i = begin; i < end; i++) {
        uint32_t f = w->queue[i];
        ktg_vec3 a = ktg_sub3(mesh->positions[mesh->faces[3 * (size_t)f]], origin);
        ktg_vec3 b = ktg_sub3(mesh->positions[mesh->faces[3 * (size_t)f + 1]], origin);
        ktg_vec3 c = ktg_sub3(mesh->positions[mesh->faces[3 * (size_t)f + 2]], origin);
        double area = ktg_length3(ktg_cross3(ktg_sub3(b, a), ktg_sub3(c, a)));
        double cone = ktg_dot3(a, ktg_cross3(b, c));
        *(w->turned[f] ? &turned : &kept) += area;
        volume += w->turned[f] ? -cone : cone;
        for (uint32_t h = 3 * f; h < 3 * f + 3; h++)
            closed = closed && repair->mate[h] != KTG_NONE;
    }
    if (closed && volume != 0)
        return volume < 0;
    return turned > kept;
}

static void swap_items(uint32_t *items, size_t i, size_t j) {
    uint32_t swap = items[i];
    items[i] = items[j];
    items[j] = swap;
}

/* Corners 1 and 2 change places, so half-edges 0 and 2 do (and run the other way). */
static void turn_faces(ktg_repair *repair, const bool *turned) {
    ktg_mesh *mesh = repair->mesh;
    size_t halfedges = 3 * (size_t)mesh->face_count;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        if (!turned[f])
            continue;
        size_t at = 3 * (size_t)f;
        swap_items(mesh->faces, at + 1, at + 2);
        if (mesh->face_uv)
            swap_items(mesh->face_uv, at + 1, at + 2);
        swap_items(repair->mate, at, at + 2);
        repair->report.faces_turned++;
    }
    for (size_t h = 0; h < halfedges; h++) {
        uint32_t g = repair->mate[h];
        if (g != KTG_NONE && turned[g / 3])
            repair->mate[h] = 3 * (g / 3) + 2 - g % 3;
    }
}

ktg_status ktg_repair_orient(ktg_repair *repair) {
    uint32_t faces = repair->mesh->face_count, begin = 0;
    orient_work w = {.queue = ktg_new(repair->context, faces, uint32_t),
                     .stitch = ktg_new(repair->context, 3 * (size_t)faces, uint32_t),
                     .reached = ktg_new(repair->context, faces, bool),
                     .turned = ktg_new(repair->context, faces, bool)};
    ktg_status status = w.queue && w.stitch && w.reached && w.turned ? KTG_OK : KTG_MEMORY;
    for (uint32_t seed = 0; status == KTG_OK && seed < faces; seed++) {
        if (w.reached[seed])
            continue;
        uint32_t end = spread(repair, &w, seed, begin);
        bool over = to_turn_over(repair, &w, begin, end);
        for (uint32_t i = begin; i < end; i++)
            w.turned[w.queue[i]] ^= over;
        begin = end;
    }
    if (status == KTG_OK)
        turn_faces(repair, w.turned);
    ktg_free(w.queue);
    ktg_free(w.stitch);
    ktg_free(w.reached);
    ktg_free(w.turned);
    return status;
}
