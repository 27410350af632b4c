/* pattern/json_words.h - the words of the JSON form, in the order of their enums, and its angles
 * (pattern only). */
#ifndef KTG_PATTERN_JSON_WORDS_H
#define KTG_PATTERN_JSON_WORDS_H

#include "core/vec.h"

/* Each ends with NULL. */
static const char *const ktg_json_modes[] = {"paper", "cloth", NULL};
static const char *const ktg_json_edge_kinds[] = {"cut",  "mountain", "valley",
                                                  "flat", "border",   NULL};
static const char *const ktg_json_tab_sizes[] = {"none", "reduced", "full", NULL};
static const char *const ktg_json_line_kinds[] = {"sew",   "grain",    "fold", "dart",
                                                  "notch", "internal", NULL};
static const char *const ktg_json_sheet_kinds[] = {"sheet", "roll", "tile", NULL};

#define KTG_JSON_PI 3.14159265358979323846264338327950288L

/* In extended precision where there is one, so that there and back is one rounding each. */
static inline double ktg_json_degrees(double radians) {
    return (double)((long double)radians * 180.0L / KTG_JSON_PI);
}
static inline double ktg_json_radians(double degrees) {
    return (double)((long double)degrees * KTG_JSON_PI / 180.0L);
}

#endif
