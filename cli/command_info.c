/* cli/command_info.c - katagami info: what is in a model, and what is wrong with it. */
#include "cli/cli.h"

#include <string.h>

static const char usage[] = "usage: katagami info MODEL\n\n"
                            "Tells what a model file holds, how large it is, what is wrong with it "
                            "and what unfold would repair.\n\n";

/* Components and materials by name are listed up to this many. */
#define MOST_LISTED 20

static void print_size(const ktg_mesh_report *r) {
    static const struct {
        const char *unit;
        double mm;
    } units[] = {{"mm", 1}, {"cm", 10}, {"m", 1000}, {"in", 25.4}};
    double x = r->high.x - r->low.x, y = r->high.y - r->low.y, z = r->high.z - r->low.z;
    printf("size          %.6g x %.6g x %.6g units (x, y, z)\n", x, y, z);
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        printf("  if in %-2s    %.4g x %.4g x %.4g mm\n", units[i].unit, x * units[i].mm,
               y * units[i].mm, z * units[i].mm);
}

static void print_shape(const ktg_mesh_report *r) {
    printf("vertices      %u\nfaces         %u (triangles)\nedges         %u\ncomponents    %u\n",
           r->vertices, r->faces, r->edges, r->components);
    if (r->closed)
        printf("closed        yes");
    else
        printf("closed        no, %u border edges in %u loop%s", r->border_edges, r->border_loops,
               r->border_loops == 1 ? "" : "s");
    if (r->genus >= 0)
        printf(", genus %d", r->genus);
    printf("\narea          %.6g square units\n", r->area);
    if (r->volume != 0)
        printf("volume        %.6g cubic units\n", r->volume);
}

static void print_safely(const char *before, const char *text, const char *behind) {
    fputs(before, stdout);
    cli_print_safe(stdout, text);
    fputs(behind, stdout);
}

/* Each line of `names`, with commas between them. */
static void print_lines(const char *names) {
    for (const char *at = names; *at;) {
        size_t length = strcspn(at, "\n");
        char line[256];
        snprintf(line, sizeof line, "%.*s", (int)length, at);
        print_safely(at == names ? "" : ", ", line, "");
        at += length + (at[length] == '\n');
    }
    fputs("\n", stdout);
}

static void print_texture(const ktg_mesh *mesh) {
    uint32_t faces = 0;
    for (size_t f = 0; mesh->face_uv && f < mesh->face_count; f++) {
        const uint32_t *uv = mesh->face_uv + 3 * f;
        faces += uv[0] != KTG_NONE && uv[1] != KTG_NONE && uv[2] != KTG_NONE;
    }
    if (faces > 0)
        printf("texture       coordinates at %u of %u faces\n", faces, mesh->face_count);
    if (mesh->texture_file) {
        fputs("  image       ", stdout);
        print_lines(mesh->texture_file);
    }
}

/* What a model brings to be printed in colour. */
static void print_paint(const ktg_mesh *mesh) {
    if (mesh->vertex_colours || mesh->face_colours)
        printf("colours       of %s%s%s\n", mesh->vertex_colours ? "vertices" : "",
               mesh->vertex_colours && mesh->face_colours ? " and " : "",
               mesh->face_colours ? "faces" : "");
    print_texture(mesh);
    if (mesh->materials.count > 0)
        printf("materials     %u", mesh->materials.count);
    for (uint32_t m = 0; m < mesh->materials.count && m < MOST_LISTED; m++)
        print_safely(m == 0 ? ": " : ", ", mesh->materials.text[m], "");
    if (mesh->materials.count > 0)
        fputs(mesh->materials.count > MOST_LISTED ? ", ...\n" : "\n", stdout);
    if (mesh->material_library) {
        fputs("  described in ", stdout);
        print_lines(mesh->material_library);
    }
}

static bool print_problem(uint32_t count, const char *one, const char *many) {
    if (count > 0)
        printf("  %u %s\n", count, count == 1 ? one : many);
    return count > 0;
}

static void print_problems(const ktg_mesh_report *r) {
    printf("problems\n");
    const struct {
        uint32_t count;
        const char *one, *many;
    } found[] = {
        {r->duplicate_faces, "duplicate face", "duplicate faces"},
        {r->degenerate_faces, "face without area", "faces without area"},
        {r->unreferenced_vertices, "unused vertex", "unused vertices"},
        {r->misoriented_edges, "edge whose faces run the same way round",
         "edges whose faces run the same way round"},
        {r->unstitched_edges, "open edge that coincides with another",
         "open edges that coincide with others"},
        {r->nonmanifold_edges, "edge with more than two faces", "edges with more than two faces"},
        {r->nonmanifold_vertices, "vertex where sheets touch in a point",
         "vertices where sheets touch in a point"},
        {r->inward_components, "closed part that is inside out",
         "closed parts that are inside out"},
        {r->self_intersections, "pair of faces that pass through each other",
         "pairs of faces that pass through each other"}};
    bool any = false;
    for (size_t i = 0; i < sizeof found / sizeof *found; i++)
        any |= print_problem(found[i].count, found[i].one, found[i].many);
    if (!any)
        printf("  none\n");
}

static void print_repair(const ktg_repair_report *repair, const ktg_mesh *mesh) {
    if (repair->changed)
        printf("unfold would repair this and work with %u faces and %u vertices\n",
               mesh->face_count, mesh->vertex_count);
}

/* Names and sizes of the parts that would get nets of their own. */
static ktg_status print_components(ktg_context *context, const ktg_mesh *mesh) {
    ktg_adjacency *adjacency = NULL;
    uint32_t *face_component = NULL, count = 0;
    ktg_names names = {0};
    ktg_status status = ktg_adjacency_new(context, mesh, &adjacency);
    if (status == KTG_OK)
        status = ktg_mesh_components(context, mesh, adjacency, &face_component, &count);
    if (status == KTG_OK)
        status = ktg_mesh_component_names(context, mesh, face_component, count, NULL, &names);
    for (uint32_t c = 0; status == KTG_OK && count > 1 && c < count && c < MOST_LISTED; c++) {
        uint32_t faces = 0;
        for (uint32_t f = 0; f < mesh->face_count; f++)
            faces += face_component[f] == c;
        fputs("  part ", stdout);
        cli_print_safe(stdout, names.text[c]);
        printf(": %u face%s\n", faces, faces == 1 ? "" : "s");
    }
    if (status == KTG_OK && count > MOST_LISTED)
        printf("  and %u more part%s\n", count - MOST_LISTED, count - MOST_LISTED == 1 ? "" : "s");
    ktg_names_free(&names);
    ktg_free(face_component);
    ktg_adjacency_free(&adjacency);
    return status;
}

static ktg_status run(ktg_context *context, settings *s) {
    ktg_mesh *mesh = NULL;
    ktg_mesh_report report;
    ktg_repair_report repair;
    ktg_status status = ktg_mesh_read(context, s->arguments[0], KTG_MESH_BY_ENDING, &mesh);
    if (status == KTG_OK)
        status =
            ktg_about_file(context, s->arguments[0], ktg_mesh_check(context, mesh, true, &report));
    cli_end_progress();
    if (status == KTG_OK) {
        print_shape(&report);
        print_size(&report);
        print_paint(mesh);
        print_problems(&report);
        status = ktg_about_file(context, s->arguments[0], ktg_mesh_repair(context, mesh, &repair));
    }
    if (status == KTG_OK) {
        print_repair(&repair, mesh);
        status = print_components(context, mesh);
    }
    ktg_mesh_free(&mesh);
    return status;
}

exit_code command_info(int argc, char **argv) {
    return cli_run(argc, argv, CMD_INFO, 1, usage, run);
}
