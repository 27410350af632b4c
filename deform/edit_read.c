/* deform/edit_read.c - the sections of an edit file that hold, link and solve. */
#include "core/memory.h"
#include "core/vec.h"
#include "deform/edit_make.h"

#include <string.h>

#define MOST_STEPS   1000
#define MOST_REFINE  100
#define MOST_DEGREES (30.0 * MOST_STEPS)
#define MOST_SCALE   1000.0

/* A section that is being read: what its keys write to. */
typedef struct reader {
    ktg_edit_maker *maker;
    const ktg_edit_section *section;
    ktg_hold *hold;
    ktg_edit_link *link;
    bool *chosen[2]; /* vertex_count each: set or from, and to */
    bool turns, centred;
} reader;

typedef ktg_status key_function(reader *r, const ktg_edit_line *line);

static const ktg_edit_text *text_of(const reader *r) {
    return &r->maker->text;
}

static const char *first_word(const reader *r, const ktg_edit_line *line) {
    return ktg_edit_words(text_of(r), line)[0].text;
}

static ktg_status read_point(const reader *r, const ktg_edit_line *line, ktg_vec3 *point) {
    double n[3];
    KTG_TRY(ktg_edit_numbers(text_of(r), line, 0, 3, n));
    *point = (ktg_vec3){n[0], n[1], n[2]};
    return KTG_OK;
}

/* The place of the line's only word in a list that ends with NULL. */
static ktg_status read_choice(const reader *r, const ktg_edit_line *line,
                              const char *const *choices, const char *form, int *choice) {
    KTG_TRY(ktg_edit_want_words(text_of(r), line, 1, form));
    for (*choice = 0; choices[*choice]; ++*choice)
        if (strcmp(first_word(r, line), choices[*choice]) == 0)
            return KTG_OK;
    return ktg_edit_text_fail(text_of(r), line->line, "\"%.60s\" is not one of \"%s\"",
                              first_word(r, line), form);
}

/* ---- keys ----------------------------------------------------------------------------------- */

static ktg_status key_set(reader *r, const ktg_edit_line *line) {
    return ktg_sets_select(r->maker, line, r->chosen[0]);
}

static ktg_status key_to(reader *r, const ktg_edit_line *line) {
    return ktg_sets_select(r->maker, line, r->chosen[1]);
}

static ktg_status key_move(reader *r, const ktg_edit_line *line) {
    return read_point(r, line, &r->hold->motion.move);
}

static ktg_status key_about(reader *r, const ktg_edit_line *line) {
    r->centred = true;
    return read_point(r, line, &r->hold->motion.centre);
}

static ktg_status key_turn(reader *r, const ktg_edit_line *line) {
    double n[4];
    KTG_TRY(ktg_edit_numbers(text_of(r), line, 0, 4, n));
    if (n[0] == 0 && n[1] == 0 && n[2] == 0)
        return ktg_edit_text_fail(text_of(r), line->line, "the axis of a turn is not 0 0 0");
    if (fabs(n[3]) > MOST_DEGREES)
        return ktg_edit_text_fail(text_of(r), line->line, "a turn has at most %g degrees",
                                  MOST_DEGREES);
    r->turns = true;
    r->hold->motion.axis = (ktg_vec3){n[0], n[1], n[2]};
    r->hold->motion.angle = n[3] * KTG_PI / 180;
    return KTG_OK;
}

static ktg_status key_together(reader *r, const ktg_edit_line *line) {
    static const char *const choices[] = {"no", "yes", NULL};
    int choice;
    KTG_TRY(read_choice(r, line, choices, "yes|no", &choice));
    r->hold->together = choice == 1;
    return KTG_OK;
}

static ktg_status key_scale(reader *r, const ktg_edit_line *line) {
    r->hold->scale = 0;
    if (line->word_count == 1 && strcmp(first_word(r, line), "free") == 0)
        return KTG_OK;
    KTG_TRY(ktg_edit_numbers(text_of(r), line, 0, 1, &r->hold->scale));
    if (r->hold->scale < 1 / MOST_SCALE || r->hold->scale > MOST_SCALE)
        return ktg_edit_text_fail(text_of(r), line->line, "a scale is \"free\" or from %g to %g",
                                  1 / MOST_SCALE, MOST_SCALE);
    return KTG_OK;
}

static ktg_status key_max(reader *r, const ktg_edit_line *line) {
    KTG_TRY(ktg_edit_numbers(text_of(r), line, 0, 1, &r->link->most));
    if (r->link->most < 0)
        return ktg_edit_text_fail(text_of(r), line->line, "a length is not below 0");
    return KTG_OK;
}

static ktg_status key_kind(reader *r, const ktg_edit_line *line) {
    static const char *const choices[] = {"auto", "vertex", "edge", "face", NULL};
    int choice;
    KTG_TRY(read_choice(r, line, choices, "auto|vertex|edge|face", &choice));
    r->link->kind = (ktg_link_kind)choice;
    return KTG_OK;
}

static ktg_status key_steps(reader *r, const ktg_edit_line *line) {
    KTG_TRY(ktg_edit_want_words(text_of(r), line, 1, "steps = auto|N"));
    if (strcmp(first_word(r, line), "auto") == 0)
        return KTG_OK;
    return ktg_edit_whole(text_of(r), line, 0, 1, MOST_STEPS, &r->maker->edit->steps);
}

static ktg_status key_refine(reader *r, const ktg_edit_line *line) {
    KTG_TRY(ktg_edit_want_words(text_of(r), line, 1, "refine = PASSES"));
    return ktg_edit_whole(text_of(r), line, 0, 0, MOST_REFINE, &r->maker->edit->refine);
}

/* ---- sections ------------------------------------------------------------------------------- */

typedef struct key {
    const char *name;
    key_function *read;
    bool wanted, often;
} key;

#define MOST_KEYS 5
typedef struct kind {
    const char *name;
    key keys[MOST_KEYS]; /* NULL behind the last one */
} kind;

/* The first four are ktg_hold_kind. */
static const kind kinds[] = {
    {"fixed", {{"set", key_set, true, true}}},
    {"handle",
     {{"set", key_set, true, true}, {"move", key_move}, {"turn", key_turn}, {"about", key_about}}},
    {"rigid", {{"set", key_set, true, true}, {"together", key_together}}},
    {"resize",
     {{"set", key_set, true, true}, {"scale", key_scale, true}, {"together", key_together}}},
    {"link",
     {{"from", key_set, true, true},
      {"to", key_to, true, true},
      {"max", key_max, true},
      {"kind", key_kind}}},
    {"solve", {{"steps", key_steps}, {"refine", key_refine}}}};
enum { HOLD_KINDS = 4, KIND_LINK = 4, KIND_SOLVE = 5, KIND_COUNT = 6, KIND_SET = KIND_COUNT };

static int kind_of(const char *name) {
    int k = 0;
    while (k < KIND_COUNT && strcmp(kinds[k].name, name) != 0)
        k++;
    return k < KIND_COUNT ? k : strcmp(name, "set") == 0 ? KIND_SET : -1;
}

static ktg_status no_such_key(const reader *r, const kind *k, const ktg_edit_line *line) {
    char known[80] = "";
    for (int i = 0; i < MOST_KEYS && k->keys[i].name; i++) {
        strcat(known, i > 0 ? ", " : "");
        strcat(known, k->keys[i].name);
    }
    return ktg_edit_text_fail(text_of(r), line->line, "[%s] has no \"%.60s\": it has %s", k->name,
                              line->key, known);
}

static ktg_status read_key(reader *r, const kind *k, const ktg_edit_line *line, bool *seen) {
    for (int i = 0; i < MOST_KEYS && k->keys[i].name; i++) {
        if (strcmp(k->keys[i].name, line->key) != 0)
            continue;
        if (seen[i] && !k->keys[i].often)
            return ktg_edit_text_fail(text_of(r), line->line, "\"%s\" stands twice in [%s %.80s]",
                                      line->key, k->name, r->section->name);
        seen[i] = true;
        return k->keys[i].read(r, line);
    }
    return no_such_key(r, k, line);
}

static ktg_status read_keys(reader *r, const kind *k) {
    bool seen[MOST_KEYS] = {false};
    for (size_t i = 0; i < r->section->line_count; i++)
        KTG_TRY(read_key(r, k, &text_of(r)->lines[r->section->first_line + i], seen));
    for (int i = 0; i < MOST_KEYS && k->keys[i].name; i++)
        if (k->keys[i].wanted && !seen[i])
            return ktg_edit_text_fail(text_of(r), r->section->line, "[%s %.80s] has no \"%s\"",
                                      k->name, r->section->name, k->keys[i].name);
    return KTG_OK;
}

/* The vertices marked in chosen[which]; there are some. */
static ktg_status take_vertices(reader *r, int which, uint32_t **vertices, uint32_t *count) {
    *vertices = ktg_sets_vertices(r->maker->context, r->chosen[which],
                                  r->maker->chooser.mesh->vertex_count, count);
    if (!*vertices)
        return KTG_MEMORY;
    if (*count == 0)
        return ktg_edit_text_fail(text_of(r), r->section->line,
                                  "[%s %.80s] takes hold of no vertex: its selection is empty",
                                  r->section->kind, r->section->name);
    return KTG_OK;
}

/* A turn without `about` is one about the middle of the handle's vertices. */
static void centre_turn(const reader *r) {
    const ktg_vec3 *positions = r->maker->chooser.mesh->positions;
    ktg_vec3 sum = {0, 0, 0};
    if (!r->turns || r->centred)
        return;
    for (uint32_t i = 0; i < r->hold->vertex_count; i++)
        sum = ktg_madd3(sum, 1.0 / r->hold->vertex_count, positions[r->hold->vertices[i]]);
    r->hold->motion.centre = sum;
}

static ktg_status read_hold(reader *r, int k) {
    ktg_edit *edit = r->maker->edit;
    r->hold = &edit->holds[edit->hold_count++];
    *r->hold = (ktg_hold){.kind = (ktg_hold_kind)k, .line = r->section->line, .scale = 1};
    r->hold->name = ktg_copy_text(r->maker->context, r->section->name, SIZE_MAX);
    if (!r->hold->name)
        return KTG_MEMORY;
    KTG_TRY(read_keys(r, &kinds[k]));
    KTG_TRY(take_vertices(r, 0, &r->hold->vertices, &r->hold->vertex_count));
    centre_turn(r);
    return KTG_OK;
}

static ktg_status read_link(reader *r) {
    ktg_edit *edit = r->maker->edit;
    r->link = &edit->links[edit->link_count++];
    *r->link = (ktg_edit_link){.line = r->section->line};
    r->link->name = ktg_copy_text(r->maker->context, r->section->name, SIZE_MAX);
    if (!r->link->name)
        return KTG_MEMORY;
    KTG_TRY(read_keys(r, &kinds[KIND_LINK]));
    KTG_TRY(take_vertices(r, 0, &r->link->from, &r->link->from_count));
    return take_vertices(r, 1, &r->link->to, &r->link->to_count);
}

/* A name stands once in its kind; no name may stand often. */
static ktg_status check_section(const ktg_edit_maker *m, size_t number) {
    const ktg_edit_section *section = &m->text.sections[number];
    int k = kind_of(section->kind);
    if (k < 0)
        return ktg_edit_text_fail(&m->text, section->line,
                                  "there is no section [%.60s]: there are set, fixed, handle, "
                                  "rigid, resize, link, solve",
                                  section->kind);
    if (k == KIND_SOLVE && *section->name)
        return ktg_edit_text_fail(&m->text, section->line, "[solve] has no name");
    for (size_t i = 0; k != KIND_SET && i < number; i++)
        if (strcmp(m->text.sections[i].kind, section->kind) == 0 &&
            strcmp(m->text.sections[i].name, section->name) == 0 &&
            (*section->name || k == KIND_SOLVE))
            return ktg_edit_text_fail(&m->text, section->line,
                                      "[%s%s%.80s] stands in line %llu already", section->kind,
                                      *section->name ? " " : "", section->name,
                                      (unsigned long long)m->text.sections[i].line);
    return KTG_OK;
}

static ktg_status read_section(reader *r) {
    int k = kind_of(r->section->kind);
    size_t size = r->maker->chooser.mesh->vertex_count * sizeof(bool);
    memset(r->chosen[0], false, size);
    memset(r->chosen[1], false, size);
    r->turns = r->centred = false;
    if (k < HOLD_KINDS)
        return read_hold(r, k);
    if (k == KIND_LINK)
        return read_link(r);
    return k == KIND_SOLVE ? read_keys(r, &kinds[KIND_SOLVE]) : KTG_OK;
}

static ktg_status read_sections(ktg_edit_maker *m) {
    reader r = {.maker = m};
    size_t count = m->text.section_count, vertices = m->chooser.mesh->vertex_count;
    m->edit->holds = ktg_new(m->context, count, ktg_hold);
    m->edit->links = ktg_new(m->context, count, ktg_edit_link);
    r.chosen[0] = ktg_new(m->context, vertices, bool);
    r.chosen[1] = ktg_new(m->context, vertices, bool);
    ktg_status status =
        m->edit->holds && m->edit->links && r.chosen[0] && r.chosen[1] ? KTG_OK : KTG_MEMORY;
    for (size_t i = 0; status == KTG_OK && i < count; i++) {
        r.section = &m->text.sections[i];
        status = read_section(&r);
    }
    ktg_free(r.chosen[0]);
    ktg_free(r.chosen[1]);
    return status;
}

/* ---- the whole ------------------------------------------------------------------------------ */

static ktg_status make(ktg_edit_maker *m, const char *path, const ktg_mesh *mesh) {
    KTG_TRY(ktg_edit_text_read(m->context, path, &m->text));
    m->edit->file = ktg_copy_text(m->context, m->text.file, SIZE_MAX);
    if (!m->edit->file)
        return KTG_MEMORY;
    KTG_TRY(ktg_chooser_new(&m->text, mesh, &m->chooser));
    for (size_t i = 0; i < m->text.section_count; i++)
        KTG_TRY(check_section(m, i));
    KTG_TRY(ktg_sets_list(m));
    KTG_TRY(ktg_sets_make(m));
    KTG_TRY(read_sections(m));
    for (size_t i = 0; i < m->edit->hold_count; i++)
        if (m->edit->holds[i].kind <= KTG_HOLD_HANDLE)
            return KTG_OK;
    return ktg_fail(m->context, KTG_FORMAT,
                    "%s: nothing is [fixed] and nothing is a [handle], so nothing has a place",
                    m->text.file);
}

ktg_status ktg_edit_read(ktg_context *context, const char *path, const ktg_mesh *mesh,
                         ktg_edit **edit) {
    ktg_edit_maker m = {.context = context};
    *edit = m.edit = ktg_new(context, 1, ktg_edit);
    ktg_status status = *edit ? make(&m, path, mesh) : KTG_MEMORY;
    ktg_chooser_free(&m.chooser);
    ktg_edit_text_free(&m.text);
    ktg_free(m.set_sections);
    ktg_free(m.set_states);
    if (status != KTG_OK)
        ktg_edit_free(edit);
    return status;
}

void ktg_edit_free(ktg_edit **edit) {
    if (!edit || !*edit)
        return;
    ktg_edit *old = *edit;
    for (size_t i = 0; i < old->set_count; i++) {
        ktg_free(old->sets[i].name);
        ktg_free(old->sets[i].vertices);
    }
    for (size_t i = 0; i < old->hold_count; i++) {
        ktg_free(old->holds[i].name);
        ktg_free(old->holds[i].vertices);
    }
    for (size_t i = 0; i < old->link_count; i++) {
        ktg_free(old->links[i].name);
        ktg_free(old->links[i].from);
        ktg_free(old->links[i].to);
    }
    ktg_free(old->sets);
    ktg_free(old->holds);
    ktg_free(old->links);
    ktg_free(old->file);
    ktg_free(old);
    *edit = NULL;
}
