/* mesh/repair_clean.c - duplicate faces and faces without area go, without opening a hole.
 *
 * A needle (two corners all but equal) is closed by making them equal. A cap (three corners on a
 * line) goes, and the faces across its longest edge are cut at its middle corner, so that its two
 * short edges find partners. Both may make new faces of the kind, so this goes in rounds. */
#include "core/memory.h"
#include "core/vec.h"
#include "mesh/repair.h"
#include "mesh/weld.h"

#include <string.h>

/* Rounds are needed only as long as flat faces hide behind flat faces; what is left after so many
 * is removed as it is. */
enum { MOST_ROUNDS = 100 };

typedef struct cut {
    uint32_t halfedge, vertex;
} cut;

typedef struct clean_work {
    bool *keep;       /* per face */
    bool *touched;    /* per face: something about it is decided in this round */
    uint32_t *target; /* per welded vertex: where it moves, KTG_NONE for nowhere */
    cut *cuts;
    size_t cut_count, cut_capacity;
    ktg_adjacency *adjacency;
} clean_work;

static ktg_vec3 corner_position(const ktg_mesh *mesh, uint32_t h) {
    return mesh->positions[mesh->faces[h]];
}

/* Drops duplicates and faces with equal corners. */
static ktg_status drop_plain(ktg_repair *repair, clean_work *w) {
    ktg_mesh *mesh = repair->mesh;
    ktg_free(repair->weld);
    KTG_TRY(ktg_mesh_weld(repair->context, mesh->positions, mesh->vertex_count, &repair->weld));
    KTG_TRY(
        ktg_mesh_duplicates(repair->context, mesh->faces, mesh->face_count, repair->weld, w->keep));
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *c = mesh->faces + 3 * (size_t)f;
        uint32_t a = repair->weld[c[0]], b = repair->weld[c[1]], d = repair->weld[c[2]];
        bool collapsed = a == b || b == d || d == a;
        repair->report.duplicate_faces_removed += w->keep[f];
        repair->report.degenerate_faces_removed += collapsed;
        w->keep[f] = !w->keep[f] && !collapsed;
    }
    ktg_repair_keep_faces(mesh, w->keep);
    return KTG_OK;
}

static bool is_flat(const ktg_mesh *mesh, uint32_t f, uint32_t *longest) {
    ktg_vec3 points[3];
    int k;
    for (uint32_t i = 0; i < 3; i++)
        points[i] = corner_position(mesh, 3 * f + i);
    double flatness = ktg_mesh_flatness(points, &k);
    *longest = 3 * f + (uint32_t)k;
    return flatness < KTG_MESH_FLAT;
}

/* The shortest edge of a flat face, where it is so short that its ends may as well be one. */
static bool is_needle(const ktg_mesh *mesh, uint32_t longest, uint32_t *shortest) {
    uint32_t b = ktg_halfedge_next(longest), c = ktg_halfedge_next(b);
    ktg_vec3 at = corner_position(mesh, longest), bt = corner_position(mesh, b),
             ct = corner_position(mesh, c);
    double lb = ktg_length3(ktg_sub3(ct, bt)), lc = ktg_length3(ktg_sub3(at, ct));
    *shortest = lb < lc ? b : c;
    return fmin(lb, lc) < KTG_MESH_FLAT * ktg_length3(ktg_sub3(bt, at));
}

/* The two ends of the edge are to become one, unless one of them is to move already. */
static void close_needle(ktg_repair *repair, clean_work *w, uint32_t shortest) {
    const uint32_t *faces = repair->mesh->faces;
    uint32_t a = repair->weld[faces[shortest]];
    uint32_t b = repair->weld[faces[ktg_halfedge_next(shortest)]];
    if (w->target[a] == KTG_NONE && w->target[b] == KTG_NONE)
        w->target[a] = w->target[b] = a < b ? a : b;
}

static void move_vertices(ktg_repair *repair, const clean_work *w) {
    ktg_mesh *mesh = repair->mesh;
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        uint32_t target = w->target[repair->weld[v]];
        if (target != KTG_NONE && target != v)
            ktg_repair_copy_vertex(mesh, target, v);
    }
}

static ktg_status plan_cuts(ktg_repair *repair, clean_work *w, uint32_t longest) {
    const ktg_adjacency *a = w->adjacency;
    uint32_t e = a->halfedge_edge[longest];
    uint32_t middle = repair->mesh->faces[ktg_halfedge_next(ktg_halfedge_next(longest))];
    const uint32_t *halfedges = a->edge_halfedges + a->edge_first[e];
    uint32_t count = a->edge_first[e + 1] - a->edge_first[e];
    for (uint32_t i = 0; i < count; i++)
        if (w->touched[halfedges[i] / 3])
            return KTG_OK; /* the next round */
    KTG_TRY(ktg_reserve(repair->context, &w->cuts, &w->cut_capacity, w->cut_count + count));
    for (uint32_t i = 0; i < count; i++) {
        w->touched[halfedges[i] / 3] = true;
        if (halfedges[i] != longest)
            w->cuts[w->cut_count++] = (cut){halfedges[i], middle};
    }
    w->keep[longest / 3] = false;
    repair->report.degenerate_faces_removed++;
    return KTG_OK;
}

static ktg_status cut_marks(ktg_repair *repair, const clean_work *w) {
    const uint32_t *faces = repair->mesh->faces;
    ktg_mark_cut *cuts = ktg_new(repair->context, w->cut_count, ktg_mark_cut);
    if (!cuts)
        return KTG_MEMORY;
    for (size_t i = 0; i < w->cut_count; i++) {
        uint32_t h = w->cuts[i].halfedge;
        cuts[i] = (ktg_mark_cut){{faces[h], faces[ktg_halfedge_next(h)]}, w->cuts[i].vertex};
    }
    ktg_status status = ktg_repair_cut_marks(repair, cuts, w->cut_count);
    ktg_free(cuts);
    return status;
}

static ktg_status carry_out_cuts(ktg_repair *repair, clean_work *w) {
    ktg_mesh *mesh = repair->mesh;
    uint32_t added = mesh->face_count;
    KTG_TRY(cut_marks(repair, w));
    KTG_TRY(ktg_repair_grow(repair->context, mesh, (uint32_t)w->cut_count, 0));
    for (size_t i = 0; i < w->cut_count; i++) {
        uint32_t h = w->cuts[i].halfedge, m = w->cuts[i].vertex;
        ktg_vec3 u = corner_position(mesh, h);
        ktg_vec3 edge = ktg_sub3(corner_position(mesh, ktg_halfedge_next(h)), u);
        double t = ktg_length3(ktg_sub3(mesh->positions[m], u)) / ktg_length3(edge);
        KTG_TRY(ktg_repair_cut_face(repair->context, mesh, h / 3, h % 3, m, t, added++));
    }
    bool *keep = ktg_new(repair->context, mesh->face_count, bool);
    if (!keep)
        return KTG_MEMORY;
    for (uint32_t f = 0; f < mesh->face_count; f++)
        keep[f] = f + w->cut_count >= mesh->face_count || w->keep[f];
    ktg_repair_keep_faces(mesh, keep);
    ktg_free(keep);
    return KTG_OK;
}

/* Decides about each flat face: closed, cut away, or left to the next round. */
static ktg_status plan(ktg_repair *repair, clean_work *w, bool last, bool *any) {
    ktg_mesh *mesh = repair->mesh;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        uint32_t longest, shortest;
        if (w->touched[f] || !is_flat(mesh, f, &longest))
            continue;
        *any = true;
        if (last) {
            w->keep[f] = false;
            repair->report.degenerate_faces_removed++;
        } else if (is_needle(mesh, longest, &shortest)) {
            close_needle(repair, w, shortest);
        } else {
            KTG_TRY(plan_cuts(repair, w, longest));
        }
    }
    return KTG_OK;
}

static bool has_flat_face(const ktg_mesh *mesh) {
    uint32_t longest;
    for (uint32_t f = 0; f < mesh->face_count; f++)
        if (is_flat(mesh, f, &longest))
            return true;
    return false;
}

static ktg_status clean_round(ktg_repair *repair, bool last, bool *again) {
    ktg_mesh *mesh = repair->mesh;
    clean_work w = {.keep = ktg_new(repair->context, mesh->face_count, bool)};
    ktg_status status = w.keep ? drop_plain(repair, &w) : KTG_MEMORY;
    *again = status == KTG_OK && has_flat_face(mesh);
    if (*again) {
        w.target = ktg_new(repair->context, mesh->vertex_count, uint32_t);
        w.touched = ktg_new(repair->context, mesh->face_count, bool);
        status = w.target && w.touched ? KTG_OK : KTG_MEMORY;
        memset(w.keep, true, mesh->face_count);
        if (w.target)
            memset(w.target, 0xff, mesh->vertex_count * sizeof *w.target);
        if (status == KTG_OK)
            status = ktg_repair_welded(repair, &w.adjacency);
        if (status == KTG_OK)
            status = plan(repair, &w, last, again);
        if (status == KTG_OK)
            status = carry_out_cuts(repair, &w);
        if (status == KTG_OK)
            move_vertices(repair, &w);
    }
    ktg_free(w.keep);
    ktg_free(w.touched);
    ktg_free(w.cuts);
    ktg_free(w.target);
    ktg_adjacency_free(&w.adjacency);
    return status;
}

ktg_status ktg_repair_clean(ktg_repair *repair) {
    bool again = true;
    for (int round = 0; again && round <= MOST_ROUNDS; round++) {
        KTG_TRY(ktg_check_cancel(repair->context));
        KTG_TRY(clean_round(repair, round == MOST_ROUNDS, &again));
    }
    if (repair->mesh->face_count == 0)
        return ktg_fail(repair->context, KTG_GEOMETRY,
                        "nothing is left of the model: all its faces are without area");
    return KTG_OK;
}
