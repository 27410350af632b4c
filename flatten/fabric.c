/* flatten/fabric.c - what cloth bears along its grain, across it, and in between. */
#include "core/file.h"
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/kernel.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

enum { most_bytes = 65536 };

/* Threads of woven cloth hardly stretch, but turn against each other; some fullness can be eased in
 * along a seam. A stable knit gives 18 to 25 % across its courses, less along. */
static const struct {
    const char *name;
    ktg_fabric fabric;
} fabrics[] = {
    {"woven", {0.02, 0.03, 0.03, 0.03, 12 * KTG_PI / 180}},
    {"knit", {0.12, 0.20, 0.08, 0.12, 25 * KTG_PI / 180}},
};

ktg_status ktg_fabric_named(ktg_context *context, const char *name, ktg_fabric *fabric) {
    for (size_t k = 0; k < sizeof fabrics / sizeof *fabrics; k++)
        if (strcmp(name, fabrics[k].name) == 0) {
            *fabric = fabrics[k].fabric;
            return KTG_OK;
        }
    return ktg_fail(context, KTG_ARGUMENT,
                    "\"%s\" is no fabric that is known: woven or knit, or a file", name);
}

/* How much of what is borne is asked for; what is not borne at all counts as a millionth. */
static double load_of(double amount, double most) {
    return fmax(0, amount) / fmax(most, 1e-6);
}

/* The inverse of the map takes the grain, +y, and what crosses it, +x, back to the face in space.
 */
double ktg_fabric_load(const ktg_fabric *fabric, const ktg_face_map *map) {
    ktg_vec2 a = map->columns[0], b = map->columns[1];
    double determinant = ktg_cross2(a, b);
    if (!(determinant > 0))
        return INFINITY;
    ktg_vec2 across = ktg_mul2((ktg_vec2){b.y, -a.y}, 1 / determinant);
    ktg_vec2 along = ktg_mul2((ktg_vec2){-b.x, a.x}, 1 / determinant);
    double by_along = ktg_length2(along) - 1, by_across = ktg_length2(across) - 1;
    double shear = fabs(atan2(ktg_dot2(along, across), ktg_cross2(across, along)));
    double stretch =
        fmax(load_of(by_along, fabric->stretch_along), load_of(by_across, fabric->stretch_across));
    double shrink =
        fmax(load_of(-by_along, fabric->shrink_along), load_of(-by_across, fabric->shrink_across));
    return fmax(fmax(stretch, shrink), load_of(shear, fabric->shear));
}

bool ktg_fabric_bears(const ktg_fabric *fabric, const ktg_face_map *map) {
    return ktg_fabric_load(fabric, map) <= 1;
}

/* ---- files -------------------------------------------------------------------------------- */

typedef struct key {
    const char *name;
    size_t offset;
} key;

static const key keys[] = {{"stretch_along", offsetof(ktg_fabric, stretch_along)},
                           {"stretch_across", offsetof(ktg_fabric, stretch_across)},
                           {"shrink_along", offsetof(ktg_fabric, shrink_along)},
                           {"shrink_across", offsetof(ktg_fabric, shrink_across)},
                           {"shear", offsetof(ktg_fabric, shear)}};

static char *trim(char *text) {
    while (*text == ' ' || *text == '\t')
        text++;
    size_t length = strlen(text);
    while (length > 0 && strchr(" \t\r", text[length - 1]))
        text[--length] = 0;
    return text;
}

/* Digits with a point, whatever the locale; *text moves behind them. */
static bool read_decimal(char **text, double *value) {
    char *start = *text;
    double unit = 0;
    *value = 0;
    for (; (**text >= '0' && **text <= '9') || (**text == '.' && unit == 0); ++*text) {
        if (**text == '.') {
            unit = 1;
            continue;
        }
        *value = 10 * *value + (**text - '0');
        unit *= 10;
    }
    *value /= unit > 0 ? unit : 1;
    return *text > start && (*text)[-1] != '.';
}

/* "3%", "0.03", "10deg"; false where it is none of them. */
static bool read_amount(char *text, bool angle, double *amount) {
    char *end = text;
    double value;
    if (!read_decimal(&end, &value))
        return false;
    const char *unit = angle ? "deg" : "%";
    end = trim(end);
    bool with_unit = strcmp(end, unit) == 0;
    if ((*end && !with_unit) || (angle && !with_unit))
        return false;
    *amount = angle ? value * KTG_PI / 180 : with_unit ? value / 100 : value;
    return *amount <= (angle ? KTG_PI / 2 : 10);
}

static ktg_status read_line(ktg_context *context, const char *path, unsigned line, char *text,
                            ktg_fabric *fabric) {
    char *comment = strchr(text, '#');
    if (comment)
        *comment = 0;
    char *name = trim(text), *equals = strchr(name, '=');
    if (!*name)
        return KTG_OK;
    if (!equals)
        return ktg_fail(context, KTG_FORMAT, "%s:%u: is no \"key = amount\"", path, line);
    *equals = 0;
    name = trim(name);
    for (size_t k = 0; k < sizeof keys / sizeof *keys; k++) {
        if (strcmp(name, keys[k].name) != 0)
            continue;
        double *amount = (double *)((char *)fabric + keys[k].offset);
        bool angle = keys[k].offset == offsetof(ktg_fabric, shear);
        if (read_amount(trim(equals + 1), angle, amount))
            return KTG_OK;
        return ktg_fail(context, KTG_FORMAT, "%s:%u: %s wants %s, not \"%s\"", path, line, name,
                        angle ? "an angle up to 90deg" : "an amount like 3% or 0.03",
                        trim(equals + 1));
    }
    return ktg_fail(context, KTG_FORMAT,
                    "%s:%u: \"%s\" is not known of a fabric: stretch_along, stretch_across, "
                    "shrink_along, shrink_across, shear",
                    path, line, name);
}

ktg_status ktg_fabric_read(ktg_context *context, const char *path, ktg_fabric *fabric) {
    char *text = NULL;
    size_t length;
    *fabric = fabrics[0].fabric;
    KTG_TRY(ktg_file_read(context, path, most_bytes, &text, &length));
    ktg_status status = KTG_OK;
    unsigned line = 1;
    for (char *at = text; status == KTG_OK && at; line++) {
        char *end = strchr(at, '\n');
        if (end)
            *end = 0;
        status = read_line(context, path, line, at, fabric);
        at = end ? end + 1 : NULL;
    }
    ktg_free(text);
    return status;
}
