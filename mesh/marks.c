/* mesh/marks.c - marking edges, and leaving out faces together with their marks. */
#include "core/memory.h"
#include "mesh/edge_index.h"
#include "mesh/repair.h"
#include "mesh/weld.h"

#include <stdio.h>
#include <string.h>

/* ---- marking -------------------------------------------------------------------------------- */

typedef struct marking {
    uint32_t *edges, *numbers;
    uint32_t count;
    size_t edge_capacity, number_capacity;
} marking;

static ktg_status add_mark(ktg_context *context, marking *m, uint32_t a, uint32_t b,
                           uint32_t number) {
    size_t n = m->count;
    if (m->count == KTG_NONE - 1)
        return ktg_fail(context, KTG_LIMIT, "more edges are named than can be numbered");
    KTG_TRY(ktg_reserve(context, &m->edges, &m->edge_capacity, 2 * n + 2));
    KTG_TRY(ktg_reserve(context, &m->numbers, &m->number_capacity, n + 1));
    m->edges[2 * n] = a;
    m->edges[2 * n + 1] = b;
    m->numbers[m->count++] = number;
    return KTG_OK;
}

/* The same pair of vertices is met on both sides of an edge; marks from `first` on are of this one.
 */
static bool met_before(const marking *m, uint32_t first, uint32_t a, uint32_t b) {
    for (size_t i = first; i < m->count; i++)
        if (m->edges[2 * i] == a && m->edges[2 * i + 1] == b)
            return true;
    return false;
}

/* Marks the edge wherever its two places in space are joined, whichever of several coincident
 * vertices the faces there have. */
static ktg_status mark_edge(ktg_context *context, const ktg_mesh *mesh, const uint32_t *weld,
                            const ktg_edge_index *index, const uint32_t *pair, uint32_t number,
                            marking *m) {
    const ktg_edge_entry *entry;
    uint32_t first = m->count;
    bool good = pair[0] < mesh->vertex_count && pair[1] < mesh->vertex_count;
    size_t count = good ? ktg_edge_index_find(index, weld[pair[0]], weld[pair[1]], &entry) : 0;
    if (count == 0)
        return ktg_fail(context, KTG_ARGUMENT, "vertices %u and %u have no edge between them",
                        pair[0], pair[1]);
    for (size_t i = 0; i < count; i++) {
        uint32_t h = entry[i].halfedge, a = mesh->faces[h], b = mesh->faces[ktg_halfedge_next(h)];
        uint32_t from = weld[a] == weld[pair[0]] ? a : b, to = from == a ? b : a;
        if (!met_before(m, first, from, to))
            KTG_TRY(add_mark(context, m, from, to, number));
    }
    return KTG_OK;
}

ktg_status ktg_mesh_mark(ktg_context *context, ktg_mesh *mesh, const uint32_t *edges,
                         uint32_t count) {
    ktg_edge_index index = {0};
    marking m = {0};
    uint32_t *weld = NULL;
    ktg_status status = KTG_OK;
    if (count > 0)
        status = ktg_mesh_weld(context, mesh->positions, mesh->vertex_count, &weld);
    if (status == KTG_OK && count > 0)
        status = ktg_edge_index_new(context, mesh->faces, mesh->face_count, weld, &index);
    for (uint32_t i = 0; status == KTG_OK && i < count; i++)
        status = mark_edge(context, mesh, weld, &index, edges + 2 * (size_t)i, i, &m);
    ktg_edge_index_free(&index);
    ktg_free(weld);
    if (status != KTG_OK) {
        ktg_free(m.edges);
        ktg_free(m.numbers);
        return status;
    }
    ktg_free(mesh->marked_edges);
    ktg_free(mesh->marked_numbers);
    mesh->marked_edges = m.edges;
    mesh->marked_numbers = m.numbers;
    mesh->marked_count = m.count;
    return KTG_OK;
}

/* ---- leaving out ---------------------------------------------------------------------------- */

bool ktg_name_has(const char *name, const char *wanted) {
    size_t length = strlen(wanted);
    if (strcmp(name, wanted) == 0)
        return true;
    for (const char *at = strstr(name, wanted); at && length > 0; at = strstr(at + 1, wanted))
        if ((at == name || at[-1] == ' ') && (at[length] == 0 || at[length] == ' '))
            return true;
    return false;
}

/* Clears keep[f] where the face's name is wanted; true when some name is. */
static bool clear_faces(const ktg_names *names, const uint32_t *face_name, uint32_t face_count,
                        const char *wanted, bool *chosen, bool *keep) {
    bool any = false;
    if (!face_name)
        return false;
    for (uint32_t n = 0; n < names->count; n++)
        any |= chosen[n] = ktg_name_has(names->text[n], wanted);
    for (uint32_t f = 0; any && f < face_count; f++)
        if (face_name[f] != KTG_NONE && chosen[face_name[f]])
            keep[f] = false;
    return any;
}

/* The model's names, as many as a message bears: "groups: base, roof; materials: red". */
static void list_names(const ktg_mesh *mesh, char *text, size_t size) {
    const ktg_names *tables[] = {&mesh->objects, &mesh->groups, &mesh->materials};
    static const char *const kinds[] = {"objects: ", "groups: ", "materials: "};
    size_t length = 0;
    text[0] = 0;
    for (int t = 0; t < 3; t++)
        for (uint32_t n = 0; n < tables[t]->count; n++) {
            if (length + 96 > size) {
                snprintf(text + length, size - length, ", ...");
                return;
            }
            length += (size_t)snprintf(text + length, size - length, "%s%s%.60s",
                                       n > 0        ? ", "
                                       : length > 0 ? "; "
                                                    : "",
                                       n > 0 ? "" : kinds[t], tables[t]->text[n]);
        }
}

static ktg_status choose_faces(ktg_context *context, const ktg_mesh *mesh, const char *wanted,
                               bool *chosen, bool *keep) {
    uint32_t n = mesh->face_count;
    char known[1024];
    bool any = clear_faces(&mesh->objects, mesh->face_object, n, wanted, chosen, keep);
    any |= clear_faces(&mesh->groups, mesh->face_group, n, wanted, chosen, keep);
    any |= clear_faces(&mesh->materials, mesh->face_material, n, wanted, chosen, keep);
    if (any)
        return KTG_OK;
    list_names(mesh, known, sizeof known);
    if (known[0] == 0)
        return ktg_fail(context, KTG_ARGUMENT,
                        "nothing is called \"%.100s\": the model names no group, object or "
                        "material",
                        wanted);
    return ktg_fail(context, KTG_ARGUMENT,
                    "no group, object or material is called \"%.100s\"; there are %s", wanted,
                    known);
}

/* Marks whose edge has no face any more go. */
static ktg_status drop_marks(ktg_context *context, ktg_mesh *mesh) {
    ktg_edge_index index;
    uint32_t kept = 0;
    if (mesh->marked_count == 0)
        return KTG_OK;
    KTG_TRY(ktg_edge_index_new(context, mesh->faces, mesh->face_count, NULL, &index));
    for (size_t i = 0; i < mesh->marked_count; i++) {
        const uint32_t *pair = mesh->marked_edges + 2 * i;
        const ktg_edge_entry *entry;
        if (ktg_edge_index_find(&index, pair[0], pair[1], &entry) == 0)
            continue;
        memmove(mesh->marked_edges + 2 * (size_t)kept, pair, 2 * sizeof *pair);
        if (mesh->marked_numbers)
            mesh->marked_numbers[kept] = mesh->marked_numbers[i];
        kept++;
    }
    mesh->marked_count = kept;
    ktg_edge_index_free(&index);
    return KTG_OK;
}

/* Vertices that only the faces left out had go with them; renamed[v] is 1 where v was used. */
static void drop_vertices(ktg_mesh *mesh, uint32_t *renamed) {
    uint32_t kept = 0;
    for (size_t c = 0; c < 3 * (size_t)mesh->face_count; c++)
        renamed[mesh->faces[c]] = 0;
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        if (renamed[v])
            continue;
        ktg_repair_copy_vertex(mesh, v, kept);
        renamed[v] = kept++;
    }
    mesh->vertex_count = kept;
    for (size_t c = 0; c < 3 * (size_t)mesh->face_count; c++)
        mesh->faces[c] = renamed[mesh->faces[c]];
    for (size_t i = 0; i < 2 * (size_t)mesh->marked_count; i++)
        mesh->marked_edges[i] = renamed[mesh->marked_edges[i]];
}

static ktg_status leave_out(ktg_context *context, ktg_mesh *mesh, const bool *keep) {
    uint32_t *used = ktg_new(context, mesh->vertex_count, uint32_t), left = 0;
    for (uint32_t f = 0; f < mesh->face_count; f++)
        left += keep[f];
    ktg_status status = used ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK && left == 0)
        status = ktg_fail(context, KTG_GEOMETRY,
                          "nothing is left of the model: all its faces are "
                          "to be left out");
    if (status == KTG_OK && left < mesh->face_count) {
        for (size_t c = 0; c < 3 * (size_t)mesh->face_count; c++)
            used[mesh->faces[c]] = 1;
        ktg_repair_keep_faces(mesh, keep);
        status = drop_marks(context, mesh);
        if (status == KTG_OK)
            drop_vertices(mesh, used);
    }
    ktg_free(used);
    return status;
}

ktg_status ktg_mesh_omit(ktg_context *context, ktg_mesh *mesh, const char *const *names,
                         size_t count) {
    uint32_t most = mesh->objects.count;
    most = mesh->groups.count > most ? mesh->groups.count : most;
    most = mesh->materials.count > most ? mesh->materials.count : most;
    bool *keep = ktg_new(context, mesh->face_count, bool), *chosen = ktg_new(context, most, bool);
    ktg_status status = keep && chosen ? KTG_OK : KTG_MEMORY;
    if (keep)
        memset(keep, true, mesh->face_count);
    for (size_t i = 0; status == KTG_OK && i < count; i++)
        status = choose_faces(context, mesh, names[i], chosen, keep);
    if (status == KTG_OK && count > 0)
        status = leave_out(context, mesh, keep);
    ktg_free(keep);
    ktg_free(chosen);
    return status;
}
