/* deform/choose.c - which vertices a selection means: names, parts, borders, regions of space. */
#include "deform/choose.h"
#include "core/memory.h"
#include "core/sets.h"
#include "deform/solver.h"

#include <stdio.h>
#include <string.h>

ktg_status ktg_chooser_new(const ktg_edit_text *text, const ktg_mesh *mesh, ktg_chooser *chooser) {
    *chooser = (ktg_chooser){.text = text, .mesh = mesh};
    return ktg_adjacency_new(text->context, mesh, &chooser->adjacency);
}

void ktg_chooser_free(ktg_chooser *chooser) {
    ktg_adjacency_free(&chooser->adjacency);
    ktg_free(chooser->loops);
    ktg_free(chooser->parts);
    ktg_names_free(&chooser->part_names);
    *chooser = (ktg_chooser){0};
}

/* ---- names ---------------------------------------------------------------------------------- */

/* The names there are, as many as a message bears. */
static void list_names(const ktg_names *names, char *said, size_t size) {
    size_t length = 0;
    said[0] = 0;
    for (uint32_t n = 0; n < names->count; n++) {
        if (length + 80 > size) {
            snprintf(said + length, size - length, ", ...");
            return;
        }
        length += (size_t)snprintf(said + length, size - length, "%s%.60s", n > 0 ? ", " : "",
                                   names->text[n]);
    }
}

static ktg_status no_such_name(const ktg_chooser *c, const ktg_edit_line *line, const char *kind,
                               const char *wanted, const ktg_names *names) {
    char said[600];
    list_names(names, said, sizeof said);
    if (names->count == 0)
        return ktg_edit_text_fail(c->text, line->line,
                                  "no %s is called \"%.100s\": the model has none", kind, wanted);
    return ktg_edit_text_fail(c->text, line->line, "no %s is called \"%.100s\"; there are: %s",
                              kind, wanted, said);
}

static ktg_status choose_named(ktg_chooser *c, const ktg_edit_line *line, const char *kind,
                               const ktg_names *names, const uint32_t *face_name, bool *chosen) {
    KTG_TRY(ktg_edit_want_words(c->text, line, 2, "group|object|material NAME"));
    const char *wanted = ktg_edit_words(c->text, line)[1].text;
    bool any = false;
    for (uint32_t n = 0; face_name && n < names->count; n++) {
        if (!ktg_name_has(names->text[n], wanted))
            continue;
        any = true;
        for (size_t h = 0; h < 3 * (size_t)c->mesh->face_count; h++)
            if (face_name[h / 3] == n)
                chosen[c->mesh->faces[h]] = true;
    }
    return any ? KTG_OK : no_such_name(c, line, kind, wanted, names);
}

static ktg_status choose_group(ktg_chooser *c, const ktg_edit_line *line, bool *chosen) {
    return choose_named(c, line, "group", &c->mesh->groups, c->mesh->face_group, chosen);
}

static ktg_status choose_object(ktg_chooser *c, const ktg_edit_line *line, bool *chosen) {
    return choose_named(c, line, "object", &c->mesh->objects, c->mesh->face_object, chosen);
}

static ktg_status choose_material(ktg_chooser *c, const ktg_edit_line *line, bool *chosen) {
    return choose_named(c, line, "material", &c->mesh->materials, c->mesh->face_material, chosen);
}

/* ---- near a point --------------------------------------------------------------------------- */

static ktg_vec3 point_at(const double *n) {
    return (ktg_vec3){n[0], n[1], n[2]};
}

/* The label of the nearest vertex that has one. */
static uint32_t nearest_label(const ktg_mesh *mesh, const uint32_t *labels, ktg_vec3 at) {
    uint32_t label = KTG_NONE;
    double least = INFINITY;
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        double distance = ktg_length3(ktg_sub3(mesh->positions[v], at));
        if (labels[v] == KTG_NONE || !(distance < least))
            continue;
        least = distance;
        label = labels[v];
    }
    return label;
}

static void choose_label(const ktg_mesh *mesh, const uint32_t *labels, uint32_t label,
                         bool *chosen) {
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        chosen[v] |= labels[v] == label;
}

static bool says_near(const ktg_edit_text *text, const ktg_edit_line *line) {
    const ktg_edit_word *words = ktg_edit_words(text, line);
    return line->word_count > 1 && !words[1].quoted && strcmp(words[1].text, "near") == 0;
}

static ktg_status find_loops(ktg_chooser *c) {
    uint32_t count = c->mesh->vertex_count;
    if (c->loops)
        return KTG_OK;
    uint32_t *parent = ktg_new(c->text->context, count, uint32_t);
    c->loops = ktg_new(c->text->context, count, uint32_t);
    if (!parent || !c->loops) {
        ktg_free(parent);
        return KTG_MEMORY;
    }
    for (uint32_t v = 0; v < count; v++) {
        parent[v] = v;
        c->loops[v] = KTG_NONE;
    }
    for (int pass = 0; pass < 2; pass++)
        for (uint32_t e = 0; e < c->adjacency->edge_count; e++) {
            uint32_t ends[2];
            ktg_edge_ends(c->mesh, c->adjacency, e, ends);
            if (c->adjacency->edge_first[e + 1] - c->adjacency->edge_first[e] != 1)
                continue;
            if (pass == 0)
                ktg_set_join(parent, ends[0], ends[1]);
            else
                c->loops[ends[0]] = c->loops[ends[1]] = ktg_set_of(parent, ends[0]);
        }
    ktg_free(parent);
    return KTG_OK;
}

static ktg_status choose_boundary(ktg_chooser *c, const ktg_edit_line *line, bool *chosen) {
    double at[3];
    KTG_TRY(find_loops(c));
    if (line->word_count == 1) {
        for (uint32_t v = 0; v < c->mesh->vertex_count; v++)
            chosen[v] = c->loops[v] != KTG_NONE;
        return KTG_OK;
    }
    if (!says_near(c->text, line))
        return ktg_edit_text_fail(c->text, line->line,
                                  "here stands \"boundary\", or \"boundary near X Y Z\"");
    KTG_TRY(ktg_edit_numbers(c->text, line, 2, 3, at));
    uint32_t loop = nearest_label(c->mesh, c->loops, point_at(at));
    if (loop == KTG_NONE)
        return ktg_edit_text_fail(c->text, line->line, "the model has no border");
    choose_label(c->mesh, c->loops, loop, chosen);
    return KTG_OK;
}

static ktg_status find_parts(ktg_chooser *c) {
    if (c->parts)
        return KTG_OK;
    KTG_TRY(ktg_find_parts(c->text->context, c->mesh, &c->parts, &c->part_count));
    return ktg_name_parts(c->text->context, c->mesh, c->parts, c->part_count, &c->part_names);
}

static ktg_status choose_component(ktg_chooser *c, const ktg_edit_line *line, bool *chosen) {
    double at[3];
    KTG_TRY(find_parts(c));
    if (says_near(c->text, line)) {
        KTG_TRY(ktg_edit_numbers(c->text, line, 2, 3, at));
        choose_label(c->mesh, c->parts, nearest_label(c->mesh, c->parts, point_at(at)), chosen);
        return KTG_OK;
    }
    KTG_TRY(ktg_edit_want_words(c->text, line, 2, "component NAME, or component near X Y Z"));
    const char *wanted = ktg_edit_words(c->text, line)[1].text;
    for (uint32_t n = 0; n < c->part_names.count; n++)
        if (strcmp(c->part_names.text[n], wanted) == 0) {
            choose_label(c->mesh, c->parts, n, chosen);
            return KTG_OK;
        }
    return no_such_name(c, line, "component", wanted, &c->part_names);
}

/* ---- regions of space ----------------------------------------------------------------------- */

static ktg_status choose_box(ktg_chooser *c, const ktg_edit_line *line, bool *chosen) {
    double n[6];
    KTG_TRY(ktg_edit_numbers(c->text, line, 1, 6, n));
    for (int k = 0; k < 3; k++)
        if (n[k] > n[k + 3])
            return ktg_edit_text_fail(c->text, line->line,
                                      "a box is its lower corner, then its upper one");
    for (uint32_t v = 0; v < c->mesh->vertex_count; v++) {
        ktg_vec3 p = c->mesh->positions[v];
        chosen[v] =
            p.x >= n[0] && p.y >= n[1] && p.z >= n[2] && p.x <= n[3] && p.y <= n[4] && p.z <= n[5];
    }
    return KTG_OK;
}

static ktg_status choose_sphere(ktg_chooser *c, const ktg_edit_line *line, bool *chosen) {
    double n[4];
    KTG_TRY(ktg_edit_numbers(c->text, line, 1, 4, n));
    for (uint32_t v = 0; v < c->mesh->vertex_count; v++)
        chosen[v] = ktg_length3(ktg_sub3(c->mesh->positions[v], point_at(n))) <= n[3];
    return KTG_OK;
}

static ktg_status choose_cylinder(ktg_chooser *c, const ktg_edit_line *line, bool *chosen) {
    double n[7];
    KTG_TRY(ktg_edit_numbers(c->text, line, 1, 7, n));
    ktg_vec3 start = point_at(n), axis = ktg_sub3(point_at(n + 3), start);
    double length = ktg_length3(axis);
    if (!(length > 0))
        return ktg_edit_text_fail(c->text, line->line, "the cylinder's two ends are one point");
    ktg_vec3 along = ktg_unit3(axis);
    for (uint32_t v = 0; v < c->mesh->vertex_count; v++) {
        ktg_vec3 d = ktg_sub3(c->mesh->positions[v], start);
        double t = ktg_dot3(d, along);
        chosen[v] = t >= 0 && t <= length && ktg_length3(ktg_madd3(d, -t, along)) <= n[6];
    }
    return KTG_OK;
}

static ktg_status choose_halfspace(ktg_chooser *c, const ktg_edit_line *line, bool *chosen) {
    double n[6];
    KTG_TRY(ktg_edit_numbers(c->text, line, 1, 6, n));
    ktg_vec3 normal = point_at(n + 3);
    if (!(ktg_length3(normal) > 0))
        return ktg_edit_text_fail(c->text, line->line, "the halfspace's direction is 0 0 0");
    normal = ktg_unit3(normal);
    for (uint32_t v = 0; v < c->mesh->vertex_count; v++)
        chosen[v] = ktg_dot3(ktg_sub3(c->mesh->positions[v], point_at(n)), normal) >= 0;
    return KTG_OK;
}

static ktg_status choose_all(ktg_chooser *c, const ktg_edit_line *line, bool *chosen) {
    KTG_TRY(ktg_edit_want_words(c->text, line, 1, "all"));
    memset(chosen, true, c->mesh->vertex_count * sizeof *chosen);
    return KTG_OK;
}

static ktg_status choose_vertex(ktg_chooser *c, const ktg_edit_line *line, bool *chosen) {
    if (line->word_count < 2)
        return ktg_edit_text_fail(c->text, line->line,
                                  "the numbers of vertices are missing, from 1 on");
    for (size_t i = 1; i < line->word_count; i++) {
        uint32_t number;
        KTG_TRY(ktg_edit_whole(c->text, line, i, 1, c->mesh->vertex_count, &number));
        chosen[number - 1] = true;
    }
    return KTG_OK;
}

/* ---- the whole ------------------------------------------------------------------------------ */

typedef ktg_status choose_function(ktg_chooser *c, const ktg_edit_line *line, bool *chosen);

static const struct {
    const char *word;
    choose_function *choose;
} kinds[] = {{"all", choose_all},
             {"group", choose_group},
             {"object", choose_object},
             {"material", choose_material},
             {"component", choose_component},
             {"boundary", choose_boundary},
             {"box", choose_box},
             {"sphere", choose_sphere},
             {"cylinder", choose_cylinder},
             {"halfspace", choose_halfspace},
             {"vertex", choose_vertex}};

static choose_function *function_of(const char *word) {
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (strcmp(word, kinds[i].word) == 0)
            return kinds[i].choose;
    return NULL;
}

bool ktg_choose_knows(const char *word) {
    return function_of(word) != NULL;
}

ktg_status ktg_choose(ktg_chooser *c, const ktg_edit_line *line, bool *chosen) {
    memset(chosen, false, c->mesh->vertex_count * sizeof *chosen);
    return function_of(ktg_edit_words(c->text, line)[0].text)(c, line, chosen);
}

/* Vertices beside one whose mark is `state` get that mark. */
static ktg_status spread(ktg_chooser *c, uint32_t rings, bool state, bool *chosen) {
    uint32_t count = c->mesh->vertex_count;
    bool *next = ktg_new(c->text->context, count, bool);
    if (!next)
        return KTG_MEMORY;
    for (uint32_t ring = 0; ring < rings; ring++) {
        memcpy(next, chosen, count * sizeof *next);
        for (uint32_t e = 0; e < c->adjacency->edge_count; e++) {
            uint32_t ends[2];
            ktg_edge_ends(c->mesh, c->adjacency, e, ends);
            if (chosen[ends[0]] == state || chosen[ends[1]] == state)
                next[ends[0]] = next[ends[1]] = state;
        }
        if (memcmp(next, chosen, count * sizeof *next) == 0)
            break;
        memcpy(chosen, next, count * sizeof *next);
    }
    ktg_free(next);
    return KTG_OK;
}

ktg_status ktg_choose_grow(ktg_chooser *c, uint32_t rings, bool *chosen) {
    return spread(c, rings, true, chosen);
}

ktg_status ktg_choose_shrink(ktg_chooser *c, uint32_t rings, bool *chosen) {
    return spread(c, rings, false, chosen);
}
