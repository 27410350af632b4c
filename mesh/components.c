/* mesh/components.c - connected components and what they are called. */
#include "core/memory.h"
#include "mesh/mesh.h"

#include <stdio.h>
#include <string.h>

ktg_status ktg_mesh_components(ktg_context *context, const ktg_mesh *mesh,
                               const ktg_adjacency *adjacency, uint32_t **face_component,
                               uint32_t *count) {
    uint32_t *component = ktg_new(context, mesh->face_count, uint32_t);
    uint32_t *stack = ktg_new(context, mesh->face_count, uint32_t);
    *face_component = NULL;
    *count = 0;
    if (!component || !stack) {
        ktg_free(component);
        ktg_free(stack);
        return KTG_MEMORY;
    }
    memset(component, 0xff, mesh->face_count * sizeof *component);
    for (uint32_t seed = 0; seed < mesh->face_count; seed++) {
        if (component[seed] != KTG_NONE)
            continue;
        size_t depth = 0;
        component[seed] = *count;
        stack[depth++] = seed;
        while (depth > 0) {
            uint32_t face = stack[--depth];
            for (uint32_t h = 3 * face; h < 3 * face + 3; h++) {
                uint32_t twin = adjacency->twin[h];
                if (twin == KTG_NONE || component[twin / 3] != KTG_NONE)
                    continue;
                component[twin / 3] = *count;
                stack[depth++] = twin / 3;
            }
        }
        ++*count;
    }
    ktg_free(stack);
    *face_component = component;
    return KTG_OK;
}

/* For each component the entry of `table` that most of its faces have (KTG_NONE: none). `index` is
 * the per-face array; `votes` is scratch for table->count numbers per component in turn. */
static ktg_status vote(ktg_context *context, const ktg_mesh *mesh, const ktg_names *table,
                       const uint32_t *index, const uint32_t *face_component,
                       uint32_t component_count, uint32_t *winner) {
    if (!index || table->count == 0)
        return KTG_OK;
    /* faces sorted by component, so that the votes of one component are counted and wiped in its
     * size */
    uint32_t *first = ktg_new(context, (size_t)component_count + 1, uint32_t);
    uint32_t *faces = ktg_new(context, mesh->face_count, uint32_t);
    uint32_t *votes = ktg_new(context, table->count, uint32_t);
    ktg_status status = first && faces && votes ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        for (uint32_t f = 0; f < mesh->face_count; f++)
            first[face_component[f] + 1]++;
        for (uint32_t c = 0; c < component_count; c++)
            first[c + 1] += first[c];
        for (uint32_t f = mesh->face_count; f-- > 0;)
            faces[--first[face_component[f] + 1]] = f;
        /* every entry moved one place: first[c + 1] is now where c starts */
        for (uint32_t c = 0; c < component_count; c++) {
            uint32_t begin = first[c + 1];
            uint32_t end = c + 1 < component_count ? first[c + 2] : mesh->face_count;
            uint32_t most = 0;
            for (uint32_t i = begin; i < end; i++) {
                uint32_t name = index[faces[i]];
                if (name != KTG_NONE && ++votes[name] > most) {
                    most = votes[name];
                    winner[c] = name;
                }
            }
            for (uint32_t i = begin; i < end; i++)
                if (index[faces[i]] != KTG_NONE)
                    votes[index[faces[i]]] = 0;
        }
    }
    ktg_free(first);
    ktg_free(faces);
    ktg_free(votes);
    return status;
}

/* The names given so far, hashed; for each the number that a further component of that name gets.
 */
typedef struct name_table {
    size_t mask;
    struct {
        const char *text; /* NULL: empty */
        uint32_t next;
    } * slots;
} name_table;

/* The slot of `text`: its own, or the empty one where it would go. */
static size_t name_slot(const name_table *table, const char *text) {
    uint64_t hash = 0xcbf29ce484222325u; /* FNV-1a */
    for (const char *c = text; *c; c++)
        hash = (hash ^ (unsigned char)*c) * 0x100000001b3u;
    size_t slot = (size_t)hash & table->mask;
    while (table->slots[slot].text && strcmp(table->slots[slot].text, text) != 0)
        slot = (slot + 1) & table->mask;
    return slot;
}

/* Sets name c to `base`, with a number behind it where the name is taken already. */
static ktg_status set_name(ktg_context *context, name_table *table, ktg_names *names, uint32_t c,
                           const char *base) {
    size_t length = strlen(base) + 16;
    char *text = ktg_alloc(context, length, 1);
    if (!text)
        return KTG_MEMORY;
    snprintf(text, length, "%s", base);
    size_t slot = name_slot(table, base), first = slot;
    while (table->slots[slot].text) {
        snprintf(text, length, "%s %u", base, table->slots[first].next++);
        slot = name_slot(table, text);
    }
    table->slots[slot].text = names->text[c] = text;
    table->slots[slot].next = 2;
    return KTG_OK;
}

static ktg_status set_names(ktg_context *context, const ktg_mesh *mesh, const uint32_t *by_object,
                            const uint32_t *by_group, const char *fallback, name_table *table,
                            ktg_names *names) {
    for (uint32_t c = 0; c < names->count; c++) {
        char part[32];
        snprintf(part, sizeof part, "part %u", c + 1);
        const char *base = part;
        if (by_object[c] != KTG_NONE)
            base = mesh->objects.text[by_object[c]];
        else if (by_group[c] != KTG_NONE)
            base = mesh->groups.text[by_group[c]];
        else if (names->count == 1 && fallback)
            base = fallback;
        KTG_TRY(set_name(context, table, names, c, *base ? base : part));
    }
    return KTG_OK;
}

ktg_status ktg_mesh_component_names(ktg_context *context, const ktg_mesh *mesh,
                                    const uint32_t *face_component, uint32_t component_count,
                                    const char *fallback, ktg_names *names) {
    *names =
        (ktg_names){.count = component_count, .text = ktg_new(context, component_count, char *)};
    uint32_t *by_object = ktg_new(context, component_count, uint32_t);
    uint32_t *by_group = ktg_new(context, component_count, uint32_t);
    name_table table = {.mask = 15};
    while (table.mask < 2 * (size_t)component_count)
        table.mask = 2 * table.mask + 1;
    table.slots = ktg_alloc(context, table.mask + 1, sizeof *table.slots);
    ktg_status status = names->text && by_object && by_group && table.slots ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) {
        memset(by_object, 0xff, component_count * sizeof *by_object);
        memset(by_group, 0xff, component_count * sizeof *by_group);
        status = vote(context, mesh, &mesh->objects, mesh->face_object, face_component,
                      component_count, by_object);
    }
    if (status == KTG_OK)
        status = vote(context, mesh, &mesh->groups, mesh->face_group, face_component,
                      component_count, by_group);
    if (status == KTG_OK)
        status = set_names(context, mesh, by_object, by_group, fallback, &table, names);
    ktg_free(table.slots);
    ktg_free(by_object);
    ktg_free(by_group);
    if (status != KTG_OK)
        ktg_names_free(names);
    return status;
}

ktg_status ktg_mesh_group_components(ktg_context *context, ktg_mesh *mesh, const char *fallback) {
    ktg_adjacency *adjacency = NULL;
    ktg_names names = {0};
    uint32_t *component = NULL, count = 0;
    ktg_status status = ktg_adjacency_new(context, mesh, &adjacency);
    if (status == KTG_OK)
        status = ktg_mesh_components(context, mesh, adjacency, &component, &count);
    if (status == KTG_OK)
        status = ktg_mesh_component_names(context, mesh, component, count, fallback, &names);
    ktg_adjacency_free(&adjacency);
    if (status != KTG_OK) {
        ktg_free(component);
        return status;
    }
    ktg_names_free(&mesh->groups);
    ktg_free(mesh->face_group);
    mesh->groups = names;
    mesh->face_group = component;
    return KTG_OK;
}
