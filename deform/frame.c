/* deform/frame.c - the mesh as the deformation sees it: normalised by powers of two, which is
 * exact, with its adjacency and its parts. */
#include "core/memory.h"
#include "core/sets.h"
#include "core/text.h"
#include "deform/solver.h"

#include <stdarg.h>
#include <stdio.h>

ktg_status ktg_edit_fail(ktg_context *context, const char *file, uint64_t line, const char *format,
                         ...) {
    char text[1024], number[24] = "";
    va_list arguments;
    va_start(arguments, format);
    ktg_vformat(text, sizeof text, format, arguments);
    va_end(arguments);
    if (line > 0)
        snprintf(number, sizeof number, ":%llu", (unsigned long long)line);
    if (!file)
        return ktg_fail(context, KTG_FORMAT, "%s", text);
    return ktg_fail(context, KTG_FORMAT, "%s%s: %s", file, number, text);
}

static ktg_vec3 lower(ktg_vec3 a, ktg_vec3 b) {
    return (ktg_vec3){fmin(a.x, b.x), fmin(a.y, b.y), fmin(a.z, b.z)};
}

/* Scales first, so that differences cannot overflow, then moves, then scales to size. */
static void normalise(const ktg_mesh *mesh, ktg_frame *frame) {
    double largest = 0, extent = 0;
    int first, second;
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        largest = fmax(largest, ktg_largest3(mesh->positions[v]));
    (void)frexp(largest, &first);
    ktg_vec3 low = {1, 1, 1};
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        frame->rest[v] = ktg_ldexp3(mesh->positions[v], -first);
        low = lower(low, frame->rest[v]);
    }
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        extent = fmax(extent, ktg_largest3(ktg_sub3(frame->rest[v], low)));
    (void)frexp(extent, &second);
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        frame->rest[v] = ktg_ldexp3(ktg_sub3(frame->rest[v], low), -second);
    frame->low = ktg_ldexp3(low, -second);
    frame->exponent = first + second;
}

/* ---- parts ---------------------------------------------------------------------------------- */

static void join_faces(const ktg_mesh *mesh, uint32_t *parent, uint32_t *number) {
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        parent[v] = v;
        number[v] = KTG_NONE;
    }
    for (size_t h = 0; h < 3 * (size_t)mesh->face_count; h++)
        ktg_set_join(parent, mesh->faces[h], mesh->faces[h % 3 == 2 ? h - 2 : h + 1]);
}

ktg_status ktg_find_parts(ktg_context *context, const ktg_mesh *mesh, uint32_t **component,
                          uint32_t *count) {
    uint32_t *parent = ktg_new(context, mesh->vertex_count, uint32_t);
    uint32_t *number = ktg_new(context, mesh->vertex_count, uint32_t);
    *count = 0;
    *component = NULL;
    if (!parent || !number) {
        ktg_free(parent);
        ktg_free(number);
        return KTG_MEMORY;
    }
    join_faces(mesh, parent, number);
    for (size_t h = 0; h < 3 * (size_t)mesh->face_count; h++) /* those with faces are in one */
        number[mesh->faces[h]] = 0;
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        uint32_t root = ktg_set_of(parent, v); /* not above v, so it has its number */
        if (number[v] != KTG_NONE)
            number[v] = root == v ? (*count)++ : number[root];
    }
    ktg_free(parent);
    *component = number;
    return KTG_OK;
}

ktg_status ktg_name_parts(ktg_context *context, const ktg_mesh *mesh, const uint32_t *component,
                          uint32_t count, ktg_names *names) {
    *names = (ktg_names){0};
    uint32_t *of_face = ktg_new(context, mesh->face_count, uint32_t);
    if (!of_face)
        return KTG_MEMORY;
    for (uint32_t f = 0; f < mesh->face_count; f++)
        of_face[f] = component[mesh->faces[3 * (size_t)f]];
    ktg_status status = ktg_mesh_component_names(context, mesh, of_face, count, "the model", names);
    ktg_free(of_face);
    return status;
}

void ktg_edge_ends(const ktg_mesh *mesh, const ktg_adjacency *adjacency, uint32_t edge,
                   uint32_t ends[2]) {
    uint32_t h = adjacency->edge_halfedges[adjacency->edge_first[edge]];
    ends[0] = mesh->faces[h];
    ends[1] = mesh->faces[h % 3 == 2 ? h - 2 : h + 1];
}

/* ---- the whole ------------------------------------------------------------------------------ */

static ktg_status fill(ktg_context *context, const ktg_mesh *mesh, ktg_frame *frame) {
    if (mesh->face_count == 0)
        return ktg_fail(context, KTG_GEOMETRY, "there is nothing to deform: no faces");
    frame->rest = ktg_new(context, mesh->vertex_count, ktg_vec3);
    if (!frame->rest)
        return KTG_MEMORY;
    normalise(mesh, frame);
    KTG_TRY(ktg_adjacency_new(context, mesh, &frame->adjacency));
    return ktg_find_parts(context, mesh, &frame->component, &frame->component_count);
}

ktg_status ktg_frame_new(ktg_context *context, const ktg_mesh *mesh, const ktg_edit *edit,
                         ktg_frame **frame) {
    *frame = ktg_new(context, 1, ktg_frame);
    if (!*frame)
        return KTG_MEMORY;
    (*frame)->mesh = mesh;
    (*frame)->edit = edit;
    ktg_status status = fill(context, mesh, *frame);
    if (status != KTG_OK)
        ktg_frame_free(frame);
    return status;
}

void ktg_frame_free(ktg_frame **frame) {
    if (!frame || !*frame)
        return;
    ktg_adjacency_free(&(*frame)->adjacency);
    ktg_free((*frame)->rest);
    ktg_free((*frame)->component);
    ktg_free(*frame);
    *frame = NULL;
}
