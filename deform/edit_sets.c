/* deform/edit_sets.c - the named sets of an edit file: statements in order, sets made of sets. */
#include "core/memory.h"
#include "deform/edit_make.h"

#include <string.h>

#define DEEPEST    64
#define MOST_RINGS 1000000

uint32_t *ktg_sets_vertices(ktg_context *context, const bool *chosen, uint32_t vertex_count,
                            uint32_t *count) {
    *count = 0;
    for (uint32_t v = 0; v < vertex_count; v++)
        *count += chosen[v];
    uint32_t *vertices = ktg_new(context, *count, uint32_t), at = 0;
    for (uint32_t v = 0; vertices && v < vertex_count; v++)
        if (chosen[v])
            vertices[at++] = v;
    return vertices;
}

/* ---- listing -------------------------------------------------------------------------------- */

static size_t find_set(const ktg_edit_maker *m, const char *name, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (strcmp(m->edit->sets[i].name, name) == 0)
            return i;
    return SIZE_MAX;
}

static ktg_status list_set(ktg_edit_maker *m, const ktg_edit_section *section) {
    size_t number = m->edit->set_count, other = find_set(m, section->name, number);
    if (!*section->name)
        return ktg_edit_text_fail(&m->text, section->line, "a set wants a name: [set NAME]");
    if (ktg_choose_knows(section->name) || strcmp(section->name, "set") == 0)
        return ktg_edit_text_fail(&m->text, section->line,
                                  "a set cannot be called \"%s\", which means a selection",
                                  section->name);
    if (other != SIZE_MAX)
        return ktg_edit_text_fail(&m->text, section->line,
                                  "there is a set \"%.100s\" already, in line %llu", section->name,
                                  (unsigned long long)m->edit->sets[other].line);
    ktg_edit_set *set = &m->edit->sets[number];
    set->name = ktg_copy_text(m->context, section->name, SIZE_MAX);
    set->line = section->line;
    m->set_sections[number] = (size_t)(section - m->text.sections);
    m->edit->set_count++;
    return set->name ? KTG_OK : KTG_MEMORY;
}

ktg_status ktg_sets_list(ktg_edit_maker *m) {
    size_t count = m->text.section_count;
    m->edit->sets = ktg_new(m->context, count, ktg_edit_set);
    m->set_sections = ktg_new(m->context, count, size_t);
    m->set_states = ktg_new(m->context, count, uint8_t);
    if (!m->edit->sets || !m->set_sections || !m->set_states)
        return KTG_MEMORY;
    for (size_t i = 0; i < count; i++)
        if (strcmp(m->text.sections[i].kind, "set") == 0)
            KTG_TRY(list_set(m, &m->text.sections[i]));
    return KTG_OK;
}

/* ---- selections ----------------------------------------------------------------------------- */

static ktg_status make_set(ktg_edit_maker *m, size_t number, const ktg_edit_line *asked);

static ktg_status select_set(ktg_edit_maker *m, const ktg_edit_line *line, const char *name,
                             bool *chosen) {
    size_t number = find_set(m, name, m->edit->set_count);
    if (number == SIZE_MAX)
        return ktg_edit_text_fail(&m->text, line->line, "there is no set \"%.100s\"", name);
    KTG_TRY(make_set(m, number, line));
    const ktg_edit_set *set = &m->edit->sets[number];
    for (uint32_t i = 0; i < set->vertex_count; i++)
        chosen[set->vertices[i]] = true;
    return KTG_OK;
}

static ktg_status select_kind(ktg_edit_maker *m, const ktg_edit_line *line, bool *chosen) {
    uint32_t count = m->chooser.mesh->vertex_count;
    bool *more = ktg_new(m->context, count, bool);
    ktg_status status = more ? ktg_choose(&m->chooser, line, more) : KTG_MEMORY;
    for (uint32_t v = 0; status == KTG_OK && v < count; v++)
        chosen[v] |= more[v];
    ktg_free(more);
    return status;
}

ktg_status ktg_sets_select(ktg_edit_maker *m, const ktg_edit_line *line, bool *chosen) {
    const ktg_edit_word *words = ktg_edit_words(&m->text, line);
    if (!words[0].quoted && ktg_choose_knows(words[0].text))
        return select_kind(m, line, chosen);
    if (!words[0].quoted && line->word_count == 2 && strcmp(words[0].text, "set") == 0)
        return select_set(m, line, words[1].text, chosen);
    if (line->word_count == 1)
        return select_set(m, line, words[0].text, chosen);
    return ktg_edit_text_fail(&m->text, line->line,
                              "\"%.60s\" selects nothing: here stands the name of a set, or all, "
                              "group, object, material, component, boundary, box, sphere, "
                              "cylinder, halfspace, vertex and what belongs to it",
                              words[0].text);
}

/* ---- making --------------------------------------------------------------------------------- */

/* Combines what the line selects with what there is. */
static ktg_status combine(ktg_edit_maker *m, const ktg_edit_line *line, char how, bool *chosen) {
    uint32_t count = m->chooser.mesh->vertex_count;
    bool *other = ktg_new(m->context, count, bool);
    ktg_status status = other ? ktg_sets_select(m, line, other) : KTG_MEMORY;
    for (uint32_t v = 0; status == KTG_OK && v < count; v++) {
        if (how == '+')
            chosen[v] |= other[v];
        else
            chosen[v] &= how == '&' ? other[v] : !other[v];
    }
    ktg_free(other);
    return status;
}

static ktg_status obey(ktg_edit_maker *m, const ktg_edit_line *line, bool *chosen) {
    static const char *const keys[] = {"add", "and", "sub", "grow", "shrink"};
    int key = 0;
    while (key < 5 && strcmp(line->key, keys[key]) != 0)
        key++;
    if (key == 5)
        return ktg_edit_text_fail(&m->text, line->line,
                                  "a set has no \"%.60s\": it has add, and, sub, grow, shrink",
                                  line->key);
    if (key < 3)
        return combine(m, line, "+&-"[key], chosen);
    uint32_t rings;
    KTG_TRY(ktg_edit_want_words(&m->text, line, 1, key == 3 ? "grow = RINGS" : "shrink = RINGS"));
    KTG_TRY(ktg_edit_whole(&m->text, line, 0, 0, MOST_RINGS, &rings));
    return key == 3 ? ktg_choose_grow(&m->chooser, rings, chosen)
                    : ktg_choose_shrink(&m->chooser, rings, chosen);
}

static ktg_status obey_all(ktg_edit_maker *m, size_t number, bool *chosen) {
    const ktg_edit_section *section = &m->text.sections[m->set_sections[number]];
    ktg_edit_set *set = &m->edit->sets[number];
    for (size_t i = 0; i < section->line_count; i++)
        KTG_TRY(obey(m, &m->text.lines[section->first_line + i], chosen));
    set->vertices =
        ktg_sets_vertices(m->context, chosen, m->chooser.mesh->vertex_count, &set->vertex_count);
    if (!set->vertices)
        return KTG_MEMORY;
    if (set->vertex_count == 0)
        return ktg_edit_text_fail(&m->text, set->line, "the set \"%.100s\" is empty", set->name);
    return KTG_OK;
}

static ktg_status make_set(ktg_edit_maker *m, size_t number, const ktg_edit_line *asked) {
    const ktg_edit_set *set = &m->edit->sets[number];
    if (m->set_states[number] == KTG_SET_MADE)
        return KTG_OK;
    uint64_t line = asked ? asked->line : set->line;
    if (m->set_states[number] == KTG_SET_BEGUN)
        return ktg_edit_text_fail(&m->text, line,
                                  "the set \"%.100s\" (line %llu) is made of itself", set->name,
                                  (unsigned long long)set->line);
    if (m->depth == DEEPEST)
        return ktg_edit_text_fail(&m->text, line, "sets are made of sets more than %d deep",
                                  DEEPEST);
    bool *chosen = ktg_new(m->context, m->chooser.mesh->vertex_count, bool);
    m->set_states[number] = KTG_SET_BEGUN;
    m->depth++;
    ktg_status status = chosen ? obey_all(m, number, chosen) : KTG_MEMORY;
    m->depth--;
    m->set_states[number] = KTG_SET_MADE;
    ktg_free(chosen);
    return status;
}

ktg_status ktg_sets_make(ktg_edit_maker *m) {
    for (size_t i = 0; i < m->edit->set_count; i++)
        KTG_TRY(make_set(m, i, NULL));
    return KTG_OK;
}
