/* mesh/read.h - what the readers of the formats share: a scanner over the file in memory and the
 * polygons they fill (mesh only). */
#ifndef KTG_MESH_READ_H
#define KTG_MESH_READ_H

#include "mesh/mesh.h"

#include <locale.h>

/* ---- scanning (read_scan.c) --------------------------------------------------------------- */

/* A walk over the bytes of a file. */
typedef struct ktg_scan {
    ktg_context *context;
    const char *name;     /* of the file, for messages */
    const char *start;    /* of the file */
    const char *at, *end; /* what is left; *end is a 0 byte */
    uint64_t line;        /* from 1; 0 in binary data */
    bool continued;       /* a backslash before the line's end continues the line (OBJ) */
    locale_t plain;       /* the C locale: numbers are read with a point everywhere */
    uint64_t rows_to_cancel_check;
} ktg_scan;

/* A scan over a file ("-": standard input), which is read as a whole, and what it holds. */
typedef struct ktg_scan_file {
    char *bytes, *name;
    size_t size;
} ktg_scan_file;
KTG_NODISCARD ktg_status ktg_scan_open(ktg_context *context, const char *path, ktg_scan_file *file,
                                       ktg_scan *scan);
void ktg_scan_close(ktg_scan_file *file, ktg_scan *scan);

/* Fails with "file:line: " before the text (without the line in binary data). */
ktg_status ktg_scan_fail(const ktg_scan *scan, ktg_status status, const char *format, ...)
    KTG_PRINTF(3, 4);

/* Skips blanks; true when the line ends here, in a comment too. */
bool ktg_scan_line_ends(ktg_scan *scan);
/* Goes to the start of the next line, over whatever is left of this one. */
void ktg_scan_next_line(ktg_scan *scan);
/* Skips blank lines and comments; false at the end of the file. */
bool ktg_scan_content(ktg_scan *scan);

/* The next run of characters without blanks, "" at the line's end. */
typedef struct ktg_word {
    const char *text;
    size_t length;
} ktg_word;
ktg_word ktg_scan_word(ktg_scan *scan);
/* How many are left on the line. */
size_t ktg_scan_words_left(ktg_scan scan);
bool ktg_word_is(ktg_word word, const char *text);
/* The same, capitals or not. */
bool ktg_word_means(ktg_word word, const char *text);
/* The word in a form fit for a message: printable, at most 40 characters, in `text`. */
#define KTG_SHOWN_SIZE 48
const char *ktg_word_show(ktg_word word, char text[KTG_SHOWN_SIZE]);

/* What is left of the line, without blanks around it. */
ktg_word ktg_scan_rest(ktg_scan *scan);

/* A finite decimal number, small enough that its fourth power is one too; fails with what stands
 * there instead. `what` is named in the message ("a coordinate"). */
KTG_NODISCARD ktg_status ktg_scan_number(ktg_scan *scan, const char *what, double *value);
/* A whole number of at most 18 digits. In OBJ a slash may follow. */
KTG_NODISCARD ktg_status ktg_scan_integer(ktg_scan *scan, const char *what, int64_t *value);
/* Checks a coordinate that came in binary form. */
KTG_NODISCARD ktg_status ktg_scan_check_number(const ktg_scan *scan, const char *what,
                                               double value);
/* To be called for each row: shows progress and asks now and then whether to stop. */
KTG_NODISCARD ktg_status ktg_scan_row(ktg_scan *scan);

/* ---- names (read_names.c) ----------------------------------------------------------------- */

/* Names with an index to find them by; zeroed to begin with. */
typedef struct ktg_name_table {
    ktg_names names;
    size_t capacity;
    uint32_t *slots; /* slot_count, a power of two: name number or KTG_NONE */
    size_t slot_count;
} ktg_name_table;

/* The number of the name `text`, added when it is new; KTG_NONE for an empty one. Control
 * characters become _, and bytes that are not UTF-8 are taken as Latin-1. */
KTG_NODISCARD ktg_status ktg_name_number(ktg_context *context, ktg_name_table *table, ktg_word text,
                                         uint32_t *number);
void ktg_name_table_free(ktg_name_table *table);
/* A clean copy of a name, as above; NULL when memory is short. */
char *ktg_name_clean(ktg_context *context, ktg_word text);

/* Appends a clean name to *text as a line of its own. */
KTG_NODISCARD ktg_status ktg_name_line(ktg_context *context, char **text, ktg_word name);

/* ---- colours (read_colours.c) ------------------------------------------------------------- */

/* Colours of vertices or polygons as a file gives them: red, green and blue from 0 to 1, or to 255
 * where one is larger than 1. */
typedef struct ktg_colour_list {
    ktg_vec3 *values; /* count; NaN where none was given */
    size_t count, capacity;
} ktg_colour_list;

/* The colour of item `index`, which is the last one so far. */
KTG_NODISCARD ktg_status ktg_colours_set(ktg_context *context, ktg_colour_list *list, size_t index,
                                         ktg_vec3 colour);
/* Red, green and blue as bytes for `count` items, white where none was given; *bytes is NULL when
 * none was given at all. */
KTG_NODISCARD ktg_status ktg_colours_bytes(ktg_context *context, const ktg_colour_list *list,
                                           size_t count, uint8_t **bytes);

/* ---- polygons (read_soup.c) --------------------------------------------------------------- */

typedef struct ktg_soup_polygon {
    size_t first; /* its first corner; the next polygon's first is its end */
    uint32_t object, group, material;
} ktg_soup_polygon;

/* What a file holds, before its polygons are cut into triangles; zeroed to begin with. */
typedef struct ktg_soup {
    ktg_vec3 *positions;
    size_t vertex_count, vertex_capacity;
    ktg_vec2 *uvs;
    size_t uv_count, uv_capacity;
    uint32_t *corners; /* corner_count vertex indices */
    size_t corner_count, corner_capacity;
    uint32_t *corner_uvs; /* corner_count uv indices or KTG_NONE */
    size_t corner_uv_capacity;
    ktg_soup_polygon *polygons;
    size_t polygon_count, polygon_capacity;
    ktg_colour_list vertex_colours, polygon_colours;
    uint8_t *polygon_bytes; /* of polygon_colours, when all are read */
    uint32_t *marked;       /* 2 marked_count vertex indices */
    size_t marked_count, marked_capacity;
    ktg_name_table objects, groups, materials;
    uint32_t object, group, material; /* of the polygons to come */
    char *material_library, *texture_file;
} ktg_soup;

KTG_NODISCARD ktg_status ktg_soup_vertex(ktg_context *context, ktg_soup *soup, ktg_vec3 position);
/* Appends a corner to the open polygon. */
KTG_NODISCARD ktg_status ktg_soup_corner(ktg_context *context, ktg_soup *soup, uint32_t vertex,
                                         uint32_t uv);
/* Corners of the polygon that is open. */
size_t ktg_soup_open_corners(const ktg_soup *soup);
KTG_NODISCARD ktg_status ktg_soup_close_polygon(ktg_context *context, ktg_soup *soup);
void ktg_soup_free(ktg_soup *soup);

/* Cuts the polygons into triangles and makes a mesh; takes what it needs out of the soup. */
KTG_NODISCARD ktg_status ktg_soup_mesh(ktg_context *context, const char *name, ktg_soup *soup,
                                       ktg_mesh **mesh);

/* ---- the formats (read_obj.c, ...) -------------------------------------------------------- */

KTG_NODISCARD ktg_status ktg_read_obj(ktg_scan *scan, ktg_soup *soup);
KTG_NODISCARD ktg_status ktg_read_stl(ktg_scan *scan, ktg_soup *soup);
KTG_NODISCARD ktg_status ktg_read_ply(ktg_scan *scan, ktg_soup *soup);
KTG_NODISCARD ktg_status ktg_read_off(ktg_scan *scan, ktg_soup *soup);

/* True when the size is exactly that of the binary STL its header announces (with any facets). */
bool ktg_stl_fits(const char *bytes, size_t size);

#endif
