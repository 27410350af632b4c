/* A surface falls apart along its seams, and only there. */
#include "core/memory.h"
#include "flatten/cut.h"
#include "tests/flatten/panels.h"

#include <string.h>

typedef struct sheet {
    ktg_mesh *mesh;
    ktg_adjacency *adjacency;
    bool *cut;
} sheet;

static sheet sheet_new(ktg_context *context) {
    sheet s = {.mesh = grid_panel(context, plane, 4)};
    assert_int_equal(ktg_adjacency_new(context, s.mesh, &s.adjacency), KTG_OK);
    s.cut = calloc(s.adjacency->edge_count, sizeof *s.cut);
    assert_non_null(s.cut);
    return s;
}

static void sheet_drop(sheet *s) {
    ktg_mesh_free(&s->mesh);
    ktg_adjacency_free(&s->adjacency);
    free(s->cut);
}

/* Cuts the edges between the vertices in the middle of the first `end` + 1 rows. */
static void cut_line(sheet *s, uint32_t end) {
    for (uint32_t h = 0; h < s->adjacency->halfedge_count; h++) {
        uint32_t a = s->mesh->faces[h], b = s->mesh->faces[h % 3 == 2 ? h - 2 : h + 1];
        if (a % 5 == 2 && b % 5 == 2 && a / 5 <= end && b / 5 <= end)
            s->cut[s->adjacency->halfedge_edge[h]] = true;
    }
}

static void assert_faithful(const sheet *s, const ktg_cut_surface *apart) {
    for (uint32_t f = 0; f < s->mesh->face_count; f++) {
        const ktg_cut_panel *panel = &apart->panels[apart->face_panel[f]];
        uint32_t index = apart->face_index[f];
        assert_int_equal(panel->face[index], f);
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t v = panel->mesh->faces[3 * index + k];
            assert_int_equal(panel->vertex[v], s->mesh->faces[3 * f + k]);
            assert_memory_equal(&panel->mesh->positions[v],
                                &s->mesh->positions[s->mesh->faces[3 * f + k]], sizeof(ktg_vec3));
        }
    }
}

static void check(ktg_context *context, uint32_t end, uint32_t panels, uint32_t vertices) {
    sheet s = sheet_new(context);
    ktg_cut_surface apart;
    uint32_t total = 0;
    cut_line(&s, end);
    assert_int_equal(ktg_cut_apart(context, s.mesh, s.adjacency, s.cut, &apart), KTG_OK);
    assert_int_equal(apart.count, panels);
    for (uint32_t p = 0; p < apart.count; p++)
        total += apart.panels[p].mesh->vertex_count;
    assert_int_equal(total, vertices);
    assert_faithful(&s, &apart);
    ktg_cut_surface_free(&apart);
    sheet_drop(&s);
}

static void without_seams_it_stays_whole(void **state) {
    check(*state, 0, 1, 25);
}

static void a_slit_doubles_its_vertices_but_the_last(void **state) {
    check(*state, 3, 1, 28);
}

static void a_seam_across_parts_it(void **state) {
    check(*state, 4, 2, 30);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, make_context, drop_context)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(without_seams_it_stays_whole),
        TEST(a_slit_doubles_its_vertices_but_the_last),
        TEST(a_seam_across_parts_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
