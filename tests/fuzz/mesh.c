/* tests/fuzz/mesh.c - tiny models through everything that mesh/ does. */
#include "tests/fuzz/model.h"

static void look_at_parts(ktg_context *context, const ktg_mesh *mesh) {
    ktg_adjacency *adjacency;
    uint32_t *component, count;
    ktg_names names;
    fuzz_must(context, ktg_adjacency_new(context, mesh, &adjacency));
    fuzz_must(context, ktg_mesh_components(context, mesh, adjacency, &component, &count));
    fuzz_must(context, ktg_mesh_component_names(context, mesh, component, count, "fuzz", &names));
    fuzz_expect(names.count == count, "a component has no name");
    ktg_names_free(&names);
    ktg_free(component);
    ktg_adjacency_free(&adjacency);
}

static void repair(ktg_context *context, ktg_mesh *mesh) {
    ktg_repair_report repair;
    ktg_mesh_report report;
    if (!fuzz_succeeded(context, ktg_mesh_repair(context, mesh, &repair)))
        return;
    fuzz_check_mesh(mesh);
    fuzz_must(context, ktg_mesh_check(context, mesh, true, &report));
    fuzz_expect(report.manifold && report.oriented, "a repaired mesh is no oriented manifold");
    fuzz_expect(report.duplicate_faces == 0 && report.degenerate_faces == 0,
                "a repaired mesh has double faces, or some without area");
    fuzz_must(context, ktg_mesh_repair(context, mesh, &repair));
    fuzz_expect(!repair.changed, "a repaired mesh is repaired again");
}

/* Topology stays, and nothing passes through anything that did not before. */
static void simplify(ktg_context *context, ktg_mesh *mesh, uint32_t target) {
    ktg_mesh_report before, after;
    ktg_simplify_report simplified;
    ktg_mesh *old;
    double distance;
    fuzz_must(context, ktg_mesh_check(context, mesh, true, &before));
    if (!before.manifold || !before.oriented || before.degenerate_faces > 0)
        return;
    fuzz_must(context, ktg_mesh_copy(context, mesh, &old));
    fuzz_must(context, ktg_mesh_simplify(context, mesh, target, &simplified));
    fuzz_check_mesh(mesh);
    fuzz_expect(simplified.target_reached == (mesh->face_count <= target),
                "simplification says it arrived where it did not");
    fuzz_must(context, ktg_mesh_check(context, mesh, true, &after));
    fuzz_expect(after.manifold && after.oriented && after.euler == before.euler &&
                    after.components == before.components &&
                    after.border_loops == before.border_loops,
                "simplification changed the topology");
    fuzz_expect(after.degenerate_faces == 0, "simplification made a face without area");
    fuzz_expect(after.self_intersections == 0 || before.self_intersections > 0,
                "simplification made faces pass through each other");
    /* coarsely: the models are a few units large, and the usual spacing takes all the time */
    fuzz_must(context, ktg_mesh_hausdorff(context, old, mesh, 0.5, &distance));
    fuzz_expect(distance >= 0, "a distance is no number");
    ktg_mesh_free(&old);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes bytes = {data, size};
    ktg_context *context = fuzz_context();
    uint32_t how = fuzz_byte(&bytes), target = fuzz_byte(&bytes) % 32;
    ktg_mesh *mesh = fuzz_read_model(context, fuzz_model(&bytes));
    ktg_mesh_report report;
    if (mesh) {
        fuzz_must(context, ktg_mesh_check(context, mesh, true, &report));
        look_at_parts(context, mesh);
        if (how & 1)
            fuzz_must(context, ktg_mesh_group_components(context, mesh, "part"));
        const char *const names[] = {how & 2 ? "a" : "m0", "b"};
        if (!(how & 4) || fuzz_succeeded(context, ktg_mesh_omit(context, mesh, names, 1 + how % 2)))
            repair(context, mesh);
        fuzz_check_mesh(mesh);
        if (how & 8)
            simplify(context, mesh, target);
    }
    ktg_mesh_free(&mesh);
    ktg_context_free(&context);
    return 0;
}
