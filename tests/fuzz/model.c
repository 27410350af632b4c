/* tests/fuzz/model.c - tiny models on an integer grid, made from bytes. */
#include "tests/fuzz/model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct maker {
    fuzz_bytes *bytes;
    FILE *file;
    unsigned vertices, style; /* style: which extras are written */
} maker;

enum { WITH_GROUPS = 1, WITH_MARKS = 2, WITH_UVS = 4, WITH_MATERIALS = 8, WITH_COLOURS = 48 };

static void put_vertex(maker *m, int x, int y, int z) {
    fprintf(m->file, "v %d %d %d", x, y, z);
    if ((m->style & WITH_COLOURS) == WITH_COLOURS)
        fprintf(m->file, " %d.%d 0 1", x % 2, y % 10);
    fputs("\n", m->file);
    m->vertices++;
}

/* Before a face: what it belongs to. */
static void put_names(maker *m) {
    if (m->style & WITH_GROUPS)
        fprintf(m->file, "g %c\n", 'a' + (char)fuzz_below(m->bytes, 3));
    if (m->style & WITH_MATERIALS)
        fprintf(m->file, "usemtl m%u\n", fuzz_below(m->bytes, 2));
}

static void put_face(maker *m, const unsigned *corners, unsigned count) {
    put_names(m);
    fputs("f", m->file);
    for (unsigned i = 0; i < count; i++)
        if (m->style & WITH_UVS)
            fprintf(m->file, " %u/%u", corners[i], 1 + fuzz_below(m->bytes, 4));
        else
            fprintf(m->file, " %u", corners[i]);
    fputs("\n", m->file);
}

static void put_marks(maker *m) {
    for (unsigned i = 0; (m->style & WITH_MARKS) && i < 4; i++) {
        unsigned a = 1 + fuzz_below(m->bytes, m->vertices);
        fprintf(m->file, "l %u %u\n", a, 1 + fuzz_below(m->bytes, m->vertices));
    }
}

/* Any vertices, any faces. */
static void make_soup(maker *m) {
    int side = 2 + (int)fuzz_below(m->bytes, 3);
    unsigned vertices = 3 + fuzz_below(m->bytes, 10), faces = 1 + fuzz_below(m->bytes, 24);
    for (unsigned i = 0; i < vertices; i++) {
        int place = fuzz_byte(m->bytes) % (side * side * side);
        put_vertex(m, place % side, place / side % side, place / side / side);
    }
    for (unsigned f = 0; f < faces; f++) {
        unsigned corners[3];
        for (unsigned k = 0; k < 3; k++)
            corners[k] = 1 + fuzz_below(m->bytes, vertices);
        put_face(m, corners, 3);
    }
}

/* A grid of vertices, its cells as quadrangles, triangles or not at all; `flat`: moved in the plane
 * instead of upwards. */
static void make_sheet(maker *m, bool flat) {
    int columns = 2 + (int)fuzz_below(m->bytes, 4), rows = 2 + (int)fuzz_below(m->bytes, 3);
    for (int y = 0; y < rows; y++)
        for (int x = 0; x < columns; x++) {
            unsigned byte = fuzz_byte(m->bytes);
            if (flat)
                put_vertex(m, 4 * x + (int)(byte % 5), 4 * y + (int)(byte / 5 % 5), 0);
            else
                put_vertex(m, x, y, (int)(byte % 4));
        }
    for (int y = 0; y + 1 < rows; y++)
        for (int x = 0; x + 1 < columns; x++) {
            unsigned a = (unsigned)(y * columns + x) + 1, c = a + (unsigned)columns;
            unsigned how = fuzz_byte(m->bytes);
            if (how % 4 == 0)
                put_face(m, (unsigned[]){a, a + 1, c + 1, c}, 4);
            if (how % 4 == 1 || how % 16 == 3)
                put_face(m, (unsigned[]){a, a + 1, c}, 3);
            if (how % 4 == 1 || how % 16 == 7)
                put_face(m, (unsigned[]){a + 1, c + 1, c}, 3);
            if (how % 4 == 2)
                put_face(m, (unsigned[]){a, c, c + 1, a + 1}, 4);
        }
}

/* A ring of vertices on levels, open, closed by a point or a polygon, twisted to one side or not.
 */
static void make_ring(maker *m) {
    static const int places[8][2] = {{2, 0},  {2, 1},  {1, 2},   {0, 2},
                                     {-2, 1}, {-2, 0}, {-1, -2}, {1, -2}};
    unsigned around = 3 + fuzz_below(m->bytes, 6), levels = 1 + fuzz_below(m->bytes, 3);
    unsigned close = fuzz_byte(m->bytes);
    for (unsigned level = 0; level < levels; level++) {
        int grown = 1 + (int)fuzz_below(m->bytes, 3), height = (int)fuzz_below(m->bytes, 5);
        for (unsigned i = 0; i < around; i++)
            put_vertex(m, grown * places[i][0], height, grown * places[i][1]);
    }
    put_vertex(m, (int)fuzz_below(m->bytes, 3), (int)fuzz_below(m->bytes, 6), 0);
    unsigned top = m->vertices, polygon[8];
    for (unsigned level = 0; level + 1 < levels; level++)
        for (unsigned i = 0; i < around; i++) {
            unsigned a = level * around + i + 1, b = level * around + (i + 1) % around + 1;
            put_face(m, (unsigned[]){a, a + around, b + around, b}, 4);
        }
    for (unsigned i = 0; i < around && close % 2; i++) {
        unsigned first = (levels - 1) * around + 1;
        put_face(m, (unsigned[]){first + i, top, first + (i + 1) % around}, 3);
    }
    for (unsigned i = 0; i < around; i++)
        polygon[i] = i + 1;
    if (close % 4 > 1 || !(close % 2))
        put_face(m, polygon, around);
}

static bool is_solid(unsigned long cells, int x, int y, int z) {
    return x >= 0 && y >= 0 && z >= 0 && x < 3 && y < 3 && z < 3 &&
           (cells >> (9 * z + 3 * y + x) & 1);
}

/* The vertex of a corner of the 4 x 4 x 4 lattice. */
static unsigned lattice(int x, int y, int z) {
    return (unsigned)(16 * z + 4 * y + x) + 1;
}

/* The side of cell (x, y, z) that looks along an axis, or against it. */
static void put_side(maker *m, const int *cell, int axis, int ahead) {
    int u = (axis + 1) % 3, v = (axis + 2) % 3, at[3] = {cell[0], cell[1], cell[2]};
    unsigned corners[4];
    static const int steps[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    at[axis] += ahead;
    for (int k = 0; k < 4; k++) {
        int step = ahead ? k : 3 - k;
        at[u] = cell[u] + steps[step][0];
        at[v] = cell[v] + steps[step][1];
        corners[k] = lattice(at[0], at[1], at[2]);
    }
    put_face(m, corners, 4);
}

/* The surface of some cells of a 3 x 3 x 3 block: coplanar faces, tunnels, edges of four. */
static void make_cells(maker *m) {
    unsigned long cells = 0;
    for (int i = 0; i < 4; i++)
        cells = cells << 8 | fuzz_byte(m->bytes);
    for (int i = 0; i < 64; i++)
        put_vertex(m, i % 4, i / 4 % 4, i / 16);
    for (int i = 0; i < 27; i++) {
        int cell[3] = {i % 3, i / 3 % 3, i / 9};
        for (int side = 0; side < 6 && is_solid(cells, cell[0], cell[1], cell[2]); side++) {
            int next[3] = {cell[0], cell[1], cell[2]};
            next[side / 2] += side % 2 ? 1 : -1;
            if (!is_solid(cells, next[0], next[1], next[2]))
                put_side(m, cell, side / 2, side % 2);
        }
    }
}

/* m0 is red, m1 has an image that is not there. */
static const char *materials(void) {
    static const char text[] = "newmtl m0\nKd 1 0 0\nnewmtl m1\nKd 0.5 0.5 1\nmap_Kd none.png\n";
    return fuzz_file("/model.mtl", text, strlen(text));
}

static const char *make(fuzz_bytes *bytes, bool flat) {
    const char *path = fuzz_path("/model.obj");
    unsigned kind = fuzz_byte(bytes);
    maker m = {bytes, fopen(path, "w"), 0, kind / 4};
    fuzz_expect(m.file != NULL, "the model cannot be written");
    if (m.style & WITH_UVS)
        fputs("vt 0 0\nvt 1 0\nvt 1 1\nvt 0.5 0.5\n", m.file);
    if (m.style & WITH_MATERIALS)
        fprintf(m.file, "mtllib %s\n", strrchr(materials(), '/') + 1);
    if (flat)
        make_sheet(&m, true);
    else if (kind % 4 == 0)
        make_soup(&m);
    else if (kind % 4 == 1)
        make_sheet(&m, false);
    else if (kind % 4 == 2)
        make_ring(&m);
    else
        make_cells(&m);
    put_marks(&m);
    fuzz_expect(fclose(m.file) == 0, "the model cannot be written");
    return path;
}

const char *fuzz_model(fuzz_bytes *bytes) {
    return make(bytes, false);
}

const char *fuzz_flat_model(fuzz_bytes *bytes) {
    return make(bytes, true);
}

ktg_mesh *fuzz_read_model(ktg_context *context, const char *path) {
    ktg_mesh *mesh = NULL;
    if (!fuzz_succeeded(context, ktg_mesh_read(context, path, KTG_MESH_BY_ENDING, &mesh))) {
        fuzz_expect(!mesh, "a mesh comes with a failure");
        return NULL;
    }
    fuzz_check_mesh(mesh);
    return mesh;
}

void fuzz_check_mesh(const ktg_mesh *mesh) {
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        fuzz_expect(isfinite(mesh->positions[v].x) && isfinite(mesh->positions[v].y) &&
                        isfinite(mesh->positions[v].z),
                    "a coordinate is not finite");
    for (size_t c = 0; c < 3 * (size_t)mesh->face_count; c++) {
        fuzz_expect(mesh->faces[c] < mesh->vertex_count, "a corner is out of range");
        fuzz_expect(!mesh->face_uv || mesh->face_uv[c] == KTG_NONE ||
                        mesh->face_uv[c] < mesh->uv_count,
                    "a texture coordinate is out of range");
    }
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        fuzz_expect(!mesh->face_group || mesh->face_group[f] == KTG_NONE ||
                        mesh->face_group[f] < mesh->groups.count,
                    "a group is out of range");
        fuzz_expect(!mesh->face_object || mesh->face_object[f] == KTG_NONE ||
                        mesh->face_object[f] < mesh->objects.count,
                    "an object is out of range");
        fuzz_expect(!mesh->face_material || mesh->face_material[f] == KTG_NONE ||
                        mesh->face_material[f] < mesh->materials.count,
                    "a material is out of range");
    }
    for (size_t i = 0; i < 2 * (size_t)mesh->marked_count; i++)
        fuzz_expect(mesh->marked_edges[i] < mesh->vertex_count, "a mark is out of range");
}

const char *fuzz_write_mesh(ktg_context *context, const ktg_mesh *mesh, const char *name) {
    const char *path = fuzz_path(name);
    ktg_output *output;
    fuzz_must(context, ktg_output_open(context, path, &output));
    fuzz_must(context, ktg_mesh_write(context, mesh, KTG_MESH_BY_ENDING, output));
    fuzz_must(context, ktg_output_commit(context, &output));
    return path;
}
