/* tests/fuzz/reading.c - what must hold of a model file that is read. */
#include "tests/fuzz/reading.h"
#include "tests/fuzz/trouble.h"

#include <string.h>

#define MOST_FACES 300 /* what is repaired; reading has no limit */

/* OBJ holds everything, so a second writing gives the same bytes; the other formats lose names and
 * marks (STL: all but floats, which may overflow). */
static void check_round_trip(ktg_context *context, const ktg_mesh *mesh) {
    ktg_mesh *again;
    const char *path = fuzz_write_mesh(context, mesh, "/once.obj");
    fuzz_must(context, ktg_mesh_read(context, path, KTG_MESH_OBJ, &again));
    fuzz_expect(again->vertex_count == mesh->vertex_count &&
                    memcmp(again->positions, mesh->positions,
                           mesh->vertex_count * sizeof *mesh->positions) == 0,
                "vertices do not read back as they were written");
    fuzz_expect(again->face_count == mesh->face_count &&
                    memcmp(again->faces, mesh->faces, 3 * mesh->face_count * sizeof *mesh->faces) ==
                        0,
                "faces do not read back as they were written");
    fuzz_expect(fuzz_same(path, fuzz_write_mesh(context, again, "/twice.obj")),
                "a model that is written, read and written again has changed");
    ktg_mesh_free(&again);
    fuzz_write_mesh(context, mesh, "/once.ply");
    fuzz_write_mesh(context, mesh, "/once.off");
}

static void check_repair(ktg_context *context, ktg_mesh *mesh) {
    ktg_mesh_report report;
    ktg_repair_report repair;
    fuzz_must(context, ktg_mesh_check(context, mesh, true, &report));
    if (!fuzz_succeeded(context, ktg_mesh_repair(context, mesh, &repair)))
        return;
    fuzz_check_mesh(mesh);
    fuzz_must(context, ktg_mesh_check(context, mesh, false, &report));
    fuzz_expect(report.manifold && report.oriented, "a repaired mesh is no oriented manifold");
    fuzz_expect(report.duplicate_faces == 0, "a repaired mesh has double faces");
    fuzz_must(context, ktg_mesh_repair(context, mesh, &repair));
    fuzz_expect(!repair.changed, "a repaired mesh is repaired again");
}

static void read_with_little_memory(ktg_context *context, const char *path,
                                    ktg_mesh_format format) {
    ktg_mesh *mesh;
    if (fuzz_trouble_over(context, ktg_mesh_read(context, path, format, &mesh)))
        fuzz_check_mesh(mesh);
    else
        fuzz_expect(!mesh, "a model comes with a failure");
    ktg_mesh_free(&mesh);
}

void fuzz_reading(const uint8_t *data, size_t size, ktg_mesh_format format, const char *name) {
    ktg_context *context = fuzz_context();
    ktg_mesh *mesh = NULL;
    const char *path = fuzz_file(name, data, size);
    if (fuzz_trouble_memory(context, data, size))
        read_with_little_memory(context, path, format);
    if (fuzz_succeeded(context, ktg_mesh_read(context, path, format, &mesh))) {
        fuzz_expect(mesh->face_count > 0, "a model without faces is read");
        fuzz_check_mesh(mesh);
        check_round_trip(context, mesh);
        if (mesh->face_count <= MOST_FACES)
            check_repair(context, mesh);
    }
    ktg_mesh_free(&mesh);
    ktg_context_free(&context);
}
