/* deform/edit_write.c - the selections of an edit as groups of an OBJ, for a look in any viewer. */
#include "core/memory.h"
#include "deform/solver.h"

#include <stdio.h>
#include <string.h>

typedef struct writer {
    ktg_context *context;
    const ktg_mesh *mesh;
    const ktg_adjacency *adjacency;
    ktg_output *output;
    bool *chosen; /* vertex_count */
    bool *shown;  /* vertex_count: part of a face or edge of the group */
} writer;

static bool has_face(const writer *w, size_t face) {
    const uint32_t *c = w->mesh->faces + 3 * face;
    return w->chosen[c[0]] && w->chosen[c[1]] && w->chosen[c[2]];
}

static ktg_status write_faces(const writer *w) {
    for (size_t f = 0; f < w->mesh->face_count; f++) {
        const uint32_t *c = w->mesh->faces + 3 * f;
        if (!has_face(w, f))
            continue;
        KTG_TRY(
            ktg_output_print(w->context, w->output, "f %u %u %u\n", c[0] + 1, c[1] + 1, c[2] + 1));
        w->shown[c[0]] = w->shown[c[1]] = w->shown[c[2]] = true;
    }
    return KTG_OK;
}

/* Edges whose faces are not in the group. */
static ktg_status write_edges(const writer *w) {
    const ktg_adjacency *a = w->adjacency;
    for (uint32_t e = 0; e < a->edge_count; e++) {
        uint32_t ends[2];
        bool faced = false;
        ktg_edge_ends(w->mesh, a, e, ends);
        for (uint32_t i = a->edge_first[e]; i < a->edge_first[e + 1]; i++)
            faced |= has_face(w, a->edge_halfedges[i] / 3);
        if (faced || !w->chosen[ends[0]] || !w->chosen[ends[1]])
            continue;
        KTG_TRY(ktg_output_print(w->context, w->output, "l %u %u\n", ends[0] + 1, ends[1] + 1));
        w->shown[ends[0]] = w->shown[ends[1]] = true;
    }
    return KTG_OK;
}

static ktg_status write_points(const writer *w) {
    for (uint32_t v = 0; v < w->mesh->vertex_count; v++)
        if (w->chosen[v] && !w->shown[v])
            KTG_TRY(ktg_output_print(w->context, w->output, "p %u\n", v + 1));
    return KTG_OK;
}

/* A group "kind-name": one word. */
static ktg_status write_group(const writer *w, const char *kind, const char *name, const char *tail,
                              const uint32_t *vertices, uint32_t count) {
    char title[200];
    snprintf(title, sizeof title, "%s-%.100s%s", kind, name ? name : "", tail);
    for (char *c = title; *c; c++)
        if ((unsigned char)*c <= ' ' || *c == '\\')
            *c = '_';
    memset(w->chosen, false, w->mesh->vertex_count * sizeof *w->chosen);
    memset(w->shown, false, w->mesh->vertex_count * sizeof *w->shown);
    for (uint32_t i = 0; i < count; i++)
        w->chosen[vertices[i]] = true;
    KTG_TRY(ktg_output_print(w->context, w->output, "g %s\n", title));
    KTG_TRY(write_faces(w));
    KTG_TRY(write_edges(w));
    return write_points(w);
}

/* The faces that are in no set and in no section. */
static ktg_status write_rest(const writer *w, const ktg_edit *edit) {
    memset(w->chosen, true, w->mesh->vertex_count * sizeof *w->chosen);
    for (size_t i = 0; i < edit->set_count; i++)
        for (uint32_t k = 0; k < edit->sets[i].vertex_count; k++)
            w->chosen[edit->sets[i].vertices[k]] = false;
    for (size_t i = 0; i < edit->hold_count; i++)
        for (uint32_t k = 0; k < edit->holds[i].vertex_count; k++)
            w->chosen[edit->holds[i].vertices[k]] = false;
    KTG_TRY(ktg_output_print(w->context, w->output, "g rest\n"));
    for (size_t f = 0; f < w->mesh->face_count; f++) {
        const uint32_t *c = w->mesh->faces + 3 * f;
        if (w->chosen[c[0]] || w->chosen[c[1]] || w->chosen[c[2]])
            KTG_TRY(ktg_output_print(w->context, w->output, "f %u %u %u\n", c[0] + 1, c[1] + 1,
                                     c[2] + 1));
    }
    return KTG_OK;
}

static ktg_status write_all(const writer *w, const ktg_edit *edit) {
    static const char *const kinds[] = {"fixed", "handle", "rigid", "resize"};
    KTG_TRY(ktg_output_print(w->context, w->output, "# selections of an edit, by Katagami\n"));
    for (uint32_t v = 0; v < w->mesh->vertex_count; v++)
        KTG_TRY(ktg_output_print(w->context, w->output, "v %.17g %.17g %.17g\n",
                                 w->mesh->positions[v].x, w->mesh->positions[v].y,
                                 w->mesh->positions[v].z));
    KTG_TRY(write_rest(w, edit));
    for (size_t i = 0; i < edit->set_count; i++)
        KTG_TRY(write_group(w, "set", edit->sets[i].name, "", edit->sets[i].vertices,
                            edit->sets[i].vertex_count));
    for (size_t i = 0; i < edit->hold_count; i++)
        KTG_TRY(write_group(w, kinds[edit->holds[i].kind], edit->holds[i].name, "",
                            edit->holds[i].vertices, edit->holds[i].vertex_count));
    for (size_t i = 0; i < edit->link_count; i++) {
        const ktg_edit_link *link = &edit->links[i];
        KTG_TRY(write_group(w, "link", link->name, "-from", link->from, link->from_count));
        KTG_TRY(write_group(w, "link", link->name, "-to", link->to, link->to_count));
    }
    return KTG_OK;
}

ktg_status ktg_edit_write_sets(ktg_context *context, const ktg_edit *edit, const ktg_mesh *mesh,
                               ktg_output *output) {
    ktg_adjacency *adjacency = NULL;
    writer w = {.context = context, .mesh = mesh, .output = output};
    w.chosen = ktg_new(context, mesh->vertex_count, bool);
    w.shown = ktg_new(context, mesh->vertex_count, bool);
    ktg_status status =
        w.chosen && w.shown ? ktg_adjacency_new(context, mesh, &adjacency) : KTG_MEMORY;
    w.adjacency = adjacency;
    if (status == KTG_OK)
        status = write_all(&w, edit);
    ktg_adjacency_free(&adjacency);
    ktg_free(w.chosen);
    ktg_free(w.shown);
    return status;
}
