/* mesh/read_soup.c - the polygons of a file, collected and then made into a mesh. */
#include "core/memory.h"
#include "mesh/read.h"
#include "mesh/triangulate.h"

#include <string.h>

/* Half-edges are numbered 3 f + k, in 32 bits. */
#define MOST_FACES ((UINT32_MAX - 1) / 3)

ktg_status ktg_soup_vertex(ktg_context *context, ktg_soup *soup, ktg_vec3 position) {
    KTG_TRY(ktg_reserve(context, &soup->positions, &soup->vertex_capacity, soup->vertex_count + 1));
    soup->positions[soup->vertex_count++] = position;
    return KTG_OK;
}

ktg_status ktg_soup_corner(ktg_context *context, ktg_soup *soup, uint32_t vertex, uint32_t uv) {
    size_t count = soup->corner_count + 1;
    KTG_TRY(ktg_reserve(context, &soup->corners, &soup->corner_capacity, count));
    KTG_TRY(ktg_reserve(context, &soup->corner_uvs, &soup->corner_uv_capacity, count));
    soup->corners[soup->corner_count] = vertex;
    soup->corner_uvs[soup->corner_count++] = uv;
    return KTG_OK;
}

/* polygons[polygon_count] is the open polygon; it always exists once a corner was closed. */
size_t ktg_soup_open_corners(const ktg_soup *soup) {
    return soup->corner_count -
           (soup->polygon_count ? soup->polygons[soup->polygon_count].first : 0);
}

ktg_status ktg_soup_close_polygon(ktg_context *context, ktg_soup *soup) {
    KTG_TRY(
        ktg_reserve(context, &soup->polygons, &soup->polygon_capacity, soup->polygon_count + 2));
    ktg_soup_polygon *polygon = &soup->polygons[soup->polygon_count++];
    polygon->object = soup->object;
    polygon->group = soup->group;
    polygon->material = soup->material;
    polygon[1].first = soup->corner_count;
    return KTG_OK;
}

void ktg_soup_free(ktg_soup *soup) {
    ktg_free(soup->positions);
    ktg_free(soup->uvs);
    ktg_free(soup->corners);
    ktg_free(soup->corner_uvs);
    ktg_free(soup->polygons);
    ktg_free(soup->marked);
    ktg_name_table_free(&soup->objects);
    ktg_name_table_free(&soup->groups);
    ktg_name_table_free(&soup->materials);
    ktg_free(soup->material_library);
    ktg_free(soup->texture_file);
    ktg_free(soup->vertex_colours.values);
    ktg_free(soup->polygon_colours.values);
    ktg_free(soup->polygon_bytes);
    *soup = (ktg_soup){0};
}

/* ---- the mesh ----------------------------------------------------------------------------- */

/* Scratch for one polygon: its corners without consecutive repeats, and their triangles. */
typedef struct cutter {
    size_t *corners; /* numbers of soup corners */
    ktg_vec3 *points;
    uint32_t *triangles;
    size_t corner_capacity, point_capacity, triangle_capacity;
} cutter;

static void cutter_free(cutter *cut) {
    ktg_free(cut->corners);
    ktg_free(cut->points);
    ktg_free(cut->triangles);
}

/* Gathers a polygon's corners, dropping those that repeat the one before (the last corner's
 * successor is the first). A polygon of fewer than three different ones stays as a triangle without
 * area, its last corner repeated: the checker reports it. */
static ktg_status gather(ktg_context *context, const ktg_soup *soup, size_t polygon, cutter *cut,
                         uint32_t *count) {
    size_t first = soup->polygons[polygon].first, last = soup->polygons[polygon + 1].first;
    size_t room = last - first > 3 ? last - first : 3, n = 0;
    KTG_TRY(ktg_reserve(context, &cut->corners, &cut->corner_capacity, room));
    KTG_TRY(ktg_reserve(context, &cut->points, &cut->point_capacity, room));
    KTG_TRY(ktg_reserve(context, &cut->triangles, &cut->triangle_capacity, 3 * room));
    for (size_t i = first; i < last; i++)
        if (n == 0 || soup->corners[i] != soup->corners[cut->corners[n - 1]])
            cut->corners[n++] = i;
    while (n > 1 && soup->corners[cut->corners[n - 1]] == soup->corners[cut->corners[0]])
        n--;
    for (; n < 3; n++)
        cut->corners[n] = cut->corners[n - 1];
    for (size_t i = 0; i < n; i++)
        cut->points[i] = soup->positions[soup->corners[cut->corners[i]]];
    *count = (uint32_t)n;
    return KTG_OK;
}

/* An upper bound of the triangles that come out. */
static uint64_t triangle_bound(const ktg_soup *soup) {
    uint64_t bound = 0;
    for (size_t i = 0; i < soup->polygon_count; i++) {
        size_t corners = soup->polygons[i + 1].first - soup->polygons[i].first;
        bound += corners > 3 ? corners - 2 : 1;
    }
    return bound;
}

static ktg_status allocate_faces(ktg_context *context, const ktg_soup *soup, uint64_t faces,
                                 ktg_mesh *mesh) {
    size_t n = (size_t)faces;
    bool failed = !(mesh->faces = ktg_new(context, 3 * n, uint32_t));
    if (faces > soup->polygon_count)
        failed |= !(mesh->face_polygon = ktg_new(context, n, uint32_t));
    if (soup->objects.names.count)
        failed |= !(mesh->face_object = ktg_new(context, n, uint32_t));
    if (soup->groups.names.count)
        failed |= !(mesh->face_group = ktg_new(context, n, uint32_t));
    if (soup->materials.names.count)
        failed |= !(mesh->face_material = ktg_new(context, n, uint32_t));
    if (soup->uv_count)
        failed |= !(mesh->face_uv = ktg_new(context, 3 * n, uint32_t));
    if (soup->polygon_colours.count)
        failed |= !(mesh->face_colours = ktg_new(context, 3 * n, uint8_t));
    return failed ? KTG_MEMORY : KTG_OK;
}

/* The corners of a triangle. A polygon that comes by a vertex twice may give one that has it twice:
 * it becomes what it would be if it were read by itself, its last corner repeated. */
static void corners_of(const ktg_soup *soup, const cutter *cut, const uint32_t *triangle,
                       size_t corner[3]) {
    for (size_t k = 0; k < 3; k++)
        corner[k] = cut->corners[triangle[k]];
    if (soup->corners[corner[0]] == soup->corners[corner[1]])
        corner[1] = corner[2];
    if (soup->corners[corner[2]] == soup->corners[corner[0]] ||
        soup->corners[corner[2]] == soup->corners[corner[1]])
        corner[2] = corner[1];
}

static void append_face(const ktg_soup *soup, size_t polygon, const cutter *cut,
                        const uint32_t *triangle, ktg_mesh *mesh) {
    const ktg_soup_polygon *from = &soup->polygons[polygon];
    size_t face = mesh->face_count++, corner[3];
    corners_of(soup, cut, triangle, corner);
    for (size_t k = 0; k < 3; k++) {
        mesh->faces[3 * face + k] = soup->corners[corner[k]];
        if (mesh->face_uv)
            mesh->face_uv[3 * face + k] = soup->corner_uvs[corner[k]];
    }
    if (mesh->face_polygon)
        mesh->face_polygon[face] = (uint32_t)polygon;
    if (mesh->face_object)
        mesh->face_object[face] = from->object;
    if (mesh->face_group)
        mesh->face_group[face] = from->group;
    if (mesh->face_material)
        mesh->face_material[face] = from->material;
    if (mesh->face_colours)
        memcpy(mesh->face_colours + 3 * face, soup->polygon_bytes + 3 * polygon, 3);
}

static ktg_status cut_polygons(ktg_context *context, const ktg_soup *soup, ktg_mesh *mesh) {
    cutter cut = {0};
    ktg_status status = KTG_OK;
    for (size_t i = 0; i < soup->polygon_count && status == KTG_OK; i++) {
        uint32_t corners = 0;
        if (i % 4096 == 0)
            status = ktg_check_cancel(context);
        if (status == KTG_OK)
            status = gather(context, soup, i, &cut, &corners);
        if (status == KTG_OK)
            status = ktg_triangulate(context, cut.points, corners, cut.triangles);
        for (uint32_t k = 0; status == KTG_OK && k + 2 < corners; k++)
            append_face(soup, i, &cut, cut.triangles + 3 * (size_t)k, mesh);
    }
    cutter_free(&cut);
    return status;
}

static void take_names(ktg_name_table *table, ktg_names *names) {
    *names = table->names;
    table->names = (ktg_names){0};
    if (names->count == 0) {
        ktg_free(names->text);
        names->text = NULL;
    }
}

/* Moves whatever is used as it is from the soup to the mesh. */
static void take_arrays(ktg_soup *soup, ktg_mesh *mesh) {
    mesh->vertex_count = (uint32_t)soup->vertex_count;
    mesh->positions = soup->positions;
    soup->positions = NULL;
    mesh->material_library = soup->material_library;
    soup->material_library = NULL;
    mesh->texture_file = soup->texture_file;
    soup->texture_file = NULL;
    take_names(&soup->objects, &mesh->objects);
    take_names(&soup->groups, &mesh->groups);
    take_names(&soup->materials, &mesh->materials);
    if (soup->uv_count) {
        mesh->uv_count = (uint32_t)soup->uv_count;
        mesh->uvs = soup->uvs;
        soup->uvs = NULL;
    }
    if (soup->marked_count) {
        mesh->marked_count = (uint32_t)soup->marked_count;
        mesh->marked_edges = soup->marked;
        soup->marked = NULL;
    }
}

/* A file may hold texture coordinates that no face uses. */
static void drop_unused_uvs(ktg_soup *soup) {
    for (size_t i = 0; i < soup->corner_count; i++)
        if (soup->corner_uvs[i] != KTG_NONE)
            return;
    soup->uv_count = 0;
}

static ktg_status make_colours(ktg_context *context, ktg_soup *soup, ktg_mesh *mesh) {
    KTG_TRY(ktg_colours_bytes(context, &soup->vertex_colours, soup->vertex_count,
                              &mesh->vertex_colours));
    return ktg_colours_bytes(context, &soup->polygon_colours, soup->polygon_count,
                             &soup->polygon_bytes);
}

ktg_status ktg_soup_mesh(ktg_context *context, const char *name, ktg_soup *soup, ktg_mesh **mesh) {
    uint64_t faces = triangle_bound(soup);
    if (faces > MOST_FACES || soup->vertex_count >= KTG_NONE || soup->uv_count >= KTG_NONE)
        return ktg_fail(context, KTG_LIMIT, "%s: more faces or vertices than can be numbered",
                        name);
    ktg_mesh *made = ktg_new(context, 1, ktg_mesh);
    if (!made)
        return KTG_MEMORY;
    drop_unused_uvs(soup);
    ktg_status status = make_colours(context, soup, made);
    if (status == KTG_OK)
        status = allocate_faces(context, soup, faces, made);
    if (status == KTG_OK)
        status = cut_polygons(context, soup, made);
    if (status == KTG_OK)
        take_arrays(soup, made);
    if (status != KTG_OK)
        ktg_mesh_free(&made);
    *mesh = made;
    return status;
}
