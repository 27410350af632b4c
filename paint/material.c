/* paint/material.c - what an MTL file says of colours and images (Wavefront's format of 1995). */
#include "paint/material.h"

#include "core/file.h"
#include "core/memory.h"
#include "mesh/mesh.h"

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MOST_BYTES ((size_t)1 << 26)

typedef struct mtl {
    ktg_context *context;
    locale_t plain; /* numbers have a point everywhere */
    ktg_materials *materials;
} mtl;

static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

static char *skip_blanks(char *at) {
    while (is_blank(*at))
        at++;
    return at;
}

/* The next word, cut off with a 0; NULL at the end. *at moves behind it. */
static char *next_word(char **at) {
    char *word = skip_blanks(*at);
    if (!*word)
        return NULL;
    char *end = word;
    while (*end && !is_blank(*end))
        end++;
    *at = *end ? end + 1 : end;
    *end = 0;
    return word;
}

static void cut_end(char *text) {
    size_t length = strlen(text);
    while (length > 0 && is_blank(text[length - 1]))
        text[--length] = 0;
}

/* A finite number at `at`; *end behind it. */
static bool number_at(const mtl *m, char *at, char **end, double *number) {
    double value = strtod_l(at, end, m->plain);
    if (*end == at || (**end && !is_blank(**end)) || !isfinite(value))
        return false;
    *number = value;
    return true;
}

/* Up to `most` numbers; returns how many there were. */
static size_t numbers(const mtl *m, char **at, size_t most, double *values) {
    size_t count = 0;
    char *end;
    while (count < most && number_at(m, skip_blanks(*at), &end, &values[count])) {
        *at = end;
        count++;
    }
    return count;
}

/* ---- lines --------------------------------------------------------------------------------- */

static ktg_status begin(mtl *m, char *name) {
    ktg_materials *all = m->materials;
    KTG_TRY(ktg_reserve(m->context, &all->items, &all->capacity, all->count + 1));
    cut_end(name);
    ktg_material *made = &all->items[all->count];
    *made = (ktg_material){.wrap = KTG_WRAP_REPEAT, .scale = {1, 1}};
    made->name = ktg_mesh_clean_name(m->context, name);
    if (!made->name)
        return KTG_MEMORY;
    all->count++;
    return KTG_OK;
}

/* "r g b", or one number for all three; spectral curves are passed over. */
static void read_colour(const mtl *m, ktg_material *material, char *rest) {
    double rgb[3];
    size_t count = numbers(m, &rest, 3, rgb);
    if (count != 1 && count != 3)
        return;
    material->has_colour = true;
    for (size_t k = 0; k < 3; k++)
        material->rgb[k] = (uint8_t)lround(255 * fmax(0, fmin(1, rgb[count == 3 ? k : 0])));
}

/* One option of an image with its values; false when it is none. */
static bool read_option(const mtl *m, ktg_material *material, const char *option, char **at) {
    static const struct {
        const char *name;
        int values; /* negative: so many numbers at most, one at least */
    } known[] = {{"-s", -3},     {"-o", -3}, {"-t", -3},      {"-clamp", 1}, {"-blendu", 1},
                 {"-blendv", 1}, {"-cc", 1}, {"-imfchan", 1}, {"-bm", 1},    {"-boost", 1},
                 {"-texres", 1}, {"-mm", 2}, {"-type", 1}};
    double values[3] = {1, 1, 1};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (strcmp(option, known[i].name) != 0)
            continue;
        size_t count = known[i].values < 0 ? numbers(m, at, 3, values) : 0;
        for (int k = 0; k < known[i].values; k++) {
            char *word = next_word(at);
            if (i == 3 && word && strcmp(word, "on") == 0)
                material->wrap = KTG_WRAP_CLAMP;
        }
        if (i == 0 && count > 0)
            material->scale = (ktg_vec2){values[0], values[count > 1 ? 1 : 0]};
        if (i == 1 && count > 0)
            material->offset = (ktg_vec2){values[0], count > 1 ? values[1] : 0};
        return true;
    }
    return false;
}

/* "-option value ... name"; the name may have blanks. */
static ktg_status read_image(const mtl *m, ktg_material *material, char *rest) {
    material->wrap = KTG_WRAP_REPEAT;
    material->scale = (ktg_vec2){1, 1};
    material->offset = (ktg_vec2){0, 0};
    for (;;) {
        char *at = skip_blanks(rest), *behind = at;
        if (*at != '-')
            break;
        char *end = at;
        while (*end && !is_blank(*end))
            end++;
        char kept = *end;
        *end = 0;
        behind = kept ? end + 1 : end;
        bool known = read_option(m, material, at, &behind);
        if (!known) {
            *end = kept;
            break;
        }
        rest = behind;
    }
    char *name = skip_blanks(rest);
    cut_end(name);
    ktg_free(material->image);
    material->image = *name ? ktg_copy_text(m->context, name, SIZE_MAX) : NULL;
    return *name && !material->image ? KTG_MEMORY : KTG_OK;
}

static ktg_status read_line(mtl *m, char *line) {
    char *keyword = next_word(&line);
    ktg_materials *all = m->materials;
    if (!keyword || *keyword == '#')
        return KTG_OK;
    char *rest = skip_blanks(line);
    if (strcmp(keyword, "newmtl") == 0)
        return begin(m, rest);
    if (all->count == 0)
        return KTG_OK;
    ktg_material *last = &all->items[all->count - 1];
    if (strcmp(keyword, "Kd") == 0)
        read_colour(m, last, rest);
    if (strcmp(keyword, "map_Kd") == 0)
        return read_image(m, last, rest);
    return KTG_OK;
}

/* ---- the file ------------------------------------------------------------------------------ */

static ktg_status read_lines(mtl *m, char *bytes, size_t size) {
    for (size_t at = 0; at < size;) {
        char *end = memchr(bytes + at, '\n', size - at);
        size_t next = end ? (size_t)(end + 1 - bytes) : size;
        bytes[end ? (size_t)(end - bytes) : size] = 0;
        KTG_TRY(read_line(m, bytes + at));
        at = next;
    }
    return KTG_OK;
}

ktg_status ktg_materials_read(ktg_context *context, const char *path, ktg_materials *materials) {
    char *bytes = NULL;
    size_t size = 0;
    KTG_TRY(ktg_file_read(context, path, MOST_BYTES, &bytes, &size));
    mtl m = {context, newlocale(LC_ALL_MASK, "C", (locale_t)0), materials};
    ktg_status status =
        m.plain ? read_lines(&m, bytes, size) : ktg_fail(context, KTG_MEMORY, "not enough memory");
    if (m.plain)
        freelocale(m.plain);
    ktg_free(bytes);
    return status;
}

void ktg_materials_free(ktg_materials *materials) {
    for (size_t i = 0; i < materials->count; i++) {
        ktg_free(materials->items[i].name);
        ktg_free(materials->items[i].image);
    }
    ktg_free(materials->items);
    *materials = (ktg_materials){0};
}
