/* tests/fuzz/edges_file.c - any bytes as a file of edges (--keep, --cut, --seams edges:). */
#include "tests/fuzz/fixed.h"
#include "tests/fuzz/model.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const ktg_mesh *boxes = fuzz_boxes();
    ktg_context *context = fuzz_context();
    const char *path = fuzz_file("/edges.txt", data, size);
    ktg_edge_list list;
    ktg_mesh *mesh;
    if (fuzz_succeeded(context, ktg_mesh_read_edges(context, path, boxes, &list))) {
        fuzz_expect(list.count > 0, "a file without edges is read");
        fuzz_must(context, ktg_mesh_copy(context, boxes, &mesh));
        fuzz_must(context, ktg_mesh_mark(context, mesh, list.vertices, list.count));
        fuzz_check_mesh(mesh);
        fuzz_expect(mesh->marked_count > 0, "edges that were read are not marked");
        ktg_mesh_free(&mesh);
    }
    ktg_edge_list_free(&list);
    ktg_context_free(&context);
    return 0;
}
