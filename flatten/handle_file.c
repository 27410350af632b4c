/* flatten/handle_file.c - files of handles: where points of a shape are to go. */
#include "core/file.h"
#include "core/memory.h"
#include "flatten/shape.h"

#include <locale.h>
#include <stdlib.h>
#include <string.h>

enum { most_bytes = 1 << 24, most_words = 12 };

/* Further away than so many sizes of the shape nobody wants a point. */
static const double farthest = 1e6;

/* A line being read. */
typedef struct handle_line {
    ktg_context *context;
    const char *path;
    const ktg_shape *shape;
    locale_t plain;
    uint32_t number;
    char *words[most_words];
    int count, at; /* words, and the next one */
    ktg_handle_list *list;
    size_t handle_capacity, target_capacity, line_capacity;
} handle_line;

static const char *next_word(const handle_line *l) {
    return l->at < l->count ? l->words[l->at] : "the end of the line";
}

static ktg_status wants(const handle_line *l, const char *what) {
    return ktg_fail(l->context, KTG_FORMAT, "%s:%u: wants %s, not \"%.60s\"", l->path, l->number,
                    what, next_word(l));
}

static bool take_word(handle_line *l, const char *word) {
    if (l->at >= l->count || strcmp(l->words[l->at], word) != 0)
        return false;
    l->at++;
    return true;
}

static ktg_status take_number(handle_line *l, const char *what, double *value) {
    char *end;
    if (l->at >= l->count)
        return wants(l, what);
    *value = strtod_l(l->words[l->at], &end, l->plain);
    if (end == l->words[l->at] || *end)
        return wants(l, what);
    if (!isfinite(*value))
        return ktg_fail(l->context, KTG_FORMAT, "%s:%u: %.60s is not a finite number", l->path,
                        l->number, next_word(l));
    l->at++;
    return KTG_OK;
}

static ktg_status take_coordinate(handle_line *l, double *value) {
    const char *word = next_word(l);
    KTG_TRY(take_number(l, "a coordinate", value));
    if (fabs(*value) >
        farthest * (l->shape->scale + fmax(fabs(l->shape->origin.x), fabs(l->shape->origin.y))))
        return ktg_fail(l->context, KTG_FORMAT,
                        "%s:%u: %.60s is more than a million times as far as the shape is large",
                        l->path, l->number, word);
    return KTG_OK;
}

static ktg_status take_point(handle_line *l, ktg_vec2 *p) {
    KTG_TRY(take_coordinate(l, &p->x));
    return take_coordinate(l, &p->y);
}

/* Numbered from 1, as model files do. */
static ktg_status take_vertex(handle_line *l, ktg_handle *handle, ktg_vec2 *rest) {
    const ktg_shape *s = l->shape;
    double value;
    KTG_TRY(take_number(l, "the number of a vertex", &value));
    if (value != floor(value) || value < 1 || value > s->mesh->vertex_count)
        return ktg_fail(l->context, KTG_FORMAT,
                        "%s:%u: there is no vertex %.60s; the shape's are 1 to %u", l->path,
                        l->number, l->words[l->at - 1], s->mesh->vertex_count);
    uint32_t v = (uint32_t)value - 1;
    if (s->panel->leaving[v] == KTG_NONE)
        return ktg_fail(l->context, KTG_FORMAT, "%s:%u: vertex %u belongs to no face", l->path,
                        l->number, v + 1);
    *handle = ktg_handle_at_vertex(v);
    *rest = s->given[v];
    return KTG_OK;
}

/* "vertex N" or "at X Y". */
static ktg_status take_place(handle_line *l, ktg_handle *handle, ktg_vec2 *rest) {
    if (take_word(l, "vertex"))
        return take_vertex(l, handle, rest);
    if (!take_word(l, "at"))
        return wants(l, "\"vertex N\" or \"at X Y\"");
    KTG_TRY(take_point(l, rest));
    ktg_status status = ktg_shape_handle_at(l->context, l->shape, *rest, handle);
    if (status != KTG_GEOMETRY)
        return status;
    return ktg_fail(l->context, KTG_FORMAT, "%s:%u: (%g, %g) is outside the shape", l->path,
                    l->number, rest->x, rest->y);
}

static ktg_status take_weight(handle_line *l, double *weight) {
    if (!take_word(l, "weight"))
        return KTG_OK;
    KTG_TRY(take_number(l, "a weight", weight));
    if (*weight > 0 && *weight <= 1e12)
        return KTG_OK;
    return ktg_fail(l->context, KTG_FORMAT,
                    "%s:%u: a weight is above 0 (1000, say; without one, the point is exactly "
                    "there), not %.60s",
                    l->path, l->number, l->words[l->at - 1]);
}

/* A whole line. */
static ktg_status take_handle(handle_line *l, ktg_handle *handle, ktg_vec2 *target) {
    bool hold = take_word(l, "hold");
    ktg_vec2 rest, by;
    KTG_TRY(take_place(l, handle, &rest));
    *target = rest;
    if (!hold && take_word(l, "->")) {
        KTG_TRY(take_point(l, target));
    } else if (!hold && take_word(l, "by")) {
        KTG_TRY(take_point(l, &by));
        *target = ktg_add2(rest, by);
    } else if (!hold) {
        return wants(l, "\"-> X Y\" or \"by X Y\"");
    }
    KTG_TRY(take_weight(l, &handle->weight));
    return l->at == l->count ? KTG_OK : wants(l, "nothing more");
}

static ktg_status keep(handle_line *l, const ktg_handle *handle, ktg_vec2 target) {
    ktg_handle_list *list = l->list;
    size_t needed = (size_t)list->count + 1;
    KTG_TRY(ktg_reserve(l->context, &list->handles, &l->handle_capacity, needed));
    KTG_TRY(ktg_reserve(l->context, &list->targets, &l->target_capacity, needed));
    KTG_TRY(ktg_reserve(l->context, &list->lines, &l->line_capacity, needed));
    list->handles[list->count] = *handle;
    list->targets[list->count] = target;
    list->lines[list->count++] = l->number;
    return KTG_OK;
}

/* Splits at blanks; what follows # is none. */
static ktg_status split_line(handle_line *l, char *text) {
    char *comment = strchr(text, '#'), *rest = NULL;
    if (comment)
        *comment = 0;
    l->count = l->at = 0;
    for (char *word = strtok_r(text, " \t\r", &rest); word; word = strtok_r(NULL, " \t\r", &rest)) {
        if (l->count == most_words)
            return ktg_fail(l->context, KTG_FORMAT, "%s:%u: has too many words", l->path,
                            l->number);
        l->words[l->count++] = word;
    }
    return KTG_OK;
}

static ktg_status read_line(handle_line *l, char *text) {
    ktg_handle handle;
    ktg_vec2 target;
    KTG_TRY(split_line(l, text));
    if (l->count == 0)
        return KTG_OK;
    KTG_TRY(take_handle(l, &handle, &target));
    return keep(l, &handle, target);
}

/* ---- the file ----------------------------------------------------------------------------- */

static ktg_status check_list(const handle_line *l) {
    if (l->list->count == 0)
        return ktg_fail(l->context, KTG_FORMAT,
                        "%s: names no handle; \"vertex 17 -> 120 40\" is one", l->path);
    uint32_t twice[2];
    KTG_TRY(ktg_handles_find_twice(l->context, l->shape, l->list->handles, l->list->count, twice));
    if (twice[0] == KTG_NONE)
        return KTG_OK;
    return ktg_fail(l->context, KTG_FORMAT, "%s:%u: is the same point as line %u", l->path,
                    l->list->lines[twice[1]], l->list->lines[twice[0]]);
}

static ktg_status read_lines(handle_line *l, char *text, size_t size) {
    if (memchr(text, 0, size))
        return ktg_fail(l->context, KTG_FORMAT, "%s: is no text: it has a byte of 0", l->path);
    for (char *at = text; at;) {
        char *end = strchr(at, '\n');
        if (end)
            *end = 0;
        l->number++;
        KTG_TRY(read_line(l, at));
        at = end ? end + 1 : NULL;
    }
    return check_list(l);
}

ktg_status ktg_handles_read(ktg_context *context, const char *path, const ktg_shape *shape,
                            ktg_handle_list *list) {
    char *text = NULL;
    size_t size;
    *list = (ktg_handle_list){0};
    KTG_TRY(ktg_file_read(context, path, most_bytes, &text, &size));
    handle_line line = {.context = context,
                        .path = path,
                        .shape = shape,
                        .list = list,
                        .plain = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0)};
    ktg_status status =
        line.plain ? read_lines(&line, text, size) : ktg_fail(context, KTG_MEMORY, "out of memory");
    if (line.plain)
        freelocale(line.plain);
    ktg_free(text);
    return status;
}

void ktg_handle_list_free(ktg_handle_list *list) {
    if (!list)
        return;
    ktg_free(list->handles);
    ktg_free(list->targets);
    ktg_free(list->lines);
    *list = (ktg_handle_list){0};
}
