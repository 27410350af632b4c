/* mesh/read_off.c - OFF (ASCII): a word, three counts, a line per vertex, a line per face. Of the
 * variants with normals, colours and texture coordinates (NOFF, COFF, STOFF) positions, corners and
 * colours are taken. */
#include "core/memory.h"
#include "mesh/read.h"

#include <string.h>

typedef struct counts {
    int64_t vertices, faces;
} counts;

/* What stands behind the position of a vertex. */
typedef struct off_columns {
    bool colours;
    int before; /* numbers between position and colour: a normal's */
} off_columns;

/* The word at the top, which may be left out. */
static ktg_status read_word(ktg_scan *scan, off_columns *columns) {
    ktg_scan ahead = *scan;
    ktg_word word = ktg_scan_word(&ahead);
    char shown[KTG_SHOWN_SIZE];
    if (word.length && word.text[0] >= '0' && word.text[0] <= '9' &&
        word.text[word.length - 1] != 'F')
        return KTG_OK;
    if (word.length < 3 || memcmp(word.text + word.length - 3, "OFF", 3) != 0)
        return ktg_scan_fail(scan, KTG_FORMAT, "\"%s\" stands where OFF is wanted",
                             ktg_word_show(word, shown));
    if (memchr(word.text, '4', word.length) || memchr(word.text, 'n', word.length))
        return ktg_scan_fail(scan, KTG_FORMAT,
                             "is an OFF file in more than three dimensions, which cannot be used");
    const char *colour = memchr(word.text, 'C', word.length);
    const char *normal = memchr(word.text, 'N', word.length);
    /* Geomview's word is CNOFF, with normals first; MeshLab's NCOFF, with colours first. */
    *columns = (off_columns){colour != NULL, colour && normal && normal > colour ? 3 : 0};
    *scan = ahead;
    if (ktg_word_means(ktg_scan_word(&ahead), "BINARY"))
        return ktg_scan_fail(scan, KTG_FORMAT,
                             "is a binary OFF file; save it as ASCII OFF, PLY or OBJ");
    return KTG_OK;
}

/* Counts are checked against the bytes that are left: a vertex takes 6 at least ("0 0 0\n"), a face
 * of whatever kind 4 ("1 0\n"), the last line end apart. */
static ktg_status read_counts(ktg_scan *scan, counts *n) {
    (void)ktg_scan_content(scan);
    KTG_TRY(ktg_scan_integer(scan, "the number of vertices", &n->vertices));
    KTG_TRY(ktg_scan_integer(scan, "the number of faces", &n->faces));
    if (n->vertices < 0 || n->faces < 0)
        return ktg_scan_fail(scan, KTG_FORMAT, "the number of vertices or faces is negative");
    ktg_scan_next_line(scan);
    int64_t left = scan->end - scan->at + 1;
    if (n->vertices > left / 6 || n->faces > (left - 6 * n->vertices) / 4)
        return ktg_scan_fail(scan, KTG_FORMAT,
                             "is truncated: its head announces %lld vertices and %lld faces, more "
                             "than the %lld bytes behind it can hold",
                             (long long)n->vertices, (long long)n->faces, (long long)(left - 1));
    return KTG_OK;
}

static ktg_status read_vertex_colour(ktg_scan *scan, const off_columns *columns, ktg_soup *soup) {
    double ignored;
    ktg_vec3 c;
    for (int i = 0; i < columns->before; i++)
        KTG_TRY(ktg_scan_number(scan, "a part of a normal", &ignored));
    KTG_TRY(ktg_scan_number(scan, "the red of a vertex", &c.x));
    KTG_TRY(ktg_scan_number(scan, "the green of a vertex", &c.y));
    KTG_TRY(ktg_scan_number(scan, "the blue of a vertex", &c.z));
    return ktg_colours_set(scan->context, &soup->vertex_colours, soup->vertex_count - 1, c);
}

/* What is left of a face's line is its colour if it is three numbers or more; one is the index of a
 * table that is not there. */
static ktg_status read_face_colour(ktg_scan *scan, ktg_soup *soup) {
    ktg_vec3 c;
    if (ktg_scan_words_left(*scan) < 3)
        return KTG_OK;
    KTG_TRY(ktg_scan_number(scan, "the red of a face", &c.x));
    KTG_TRY(ktg_scan_number(scan, "the green of a face", &c.y));
    KTG_TRY(ktg_scan_number(scan, "the blue of a face", &c.z));
    return ktg_colours_set(scan->context, &soup->polygon_colours, soup->polygon_count - 1, c);
}

static ktg_status read_vertex(ktg_scan *scan, const off_columns *columns, ktg_soup *soup) {
    ktg_vec3 p;
    KTG_TRY(ktg_scan_number(scan, "the x of a vertex", &p.x));
    KTG_TRY(ktg_scan_number(scan, "the y of a vertex", &p.y));
    KTG_TRY(ktg_scan_number(scan, "the z of a vertex", &p.z));
    KTG_TRY(ktg_soup_vertex(scan->context, soup, p));
    return columns->colours ? read_vertex_colour(scan, columns, soup) : KTG_OK;
}

static ktg_status read_face(ktg_scan *scan, ktg_soup *soup) {
    int64_t corners, vertex;
    KTG_TRY(ktg_scan_integer(scan, "the number of corners", &corners));
    if (corners < 3)
        return ktg_scan_fail(scan, KTG_FORMAT, "a face needs three corners, this one has %lld",
                             (long long)corners);
    for (int64_t i = 0; i < corners; i++) {
        KTG_TRY(ktg_scan_integer(scan, "the number of a vertex", &vertex));
        if (vertex < 0 || (uint64_t)vertex >= soup->vertex_count)
            return ktg_scan_fail(scan, KTG_FORMAT,
                                 "vertex number %lld, but there are only %zu, counted from 0",
                                 (long long)vertex, soup->vertex_count);
        KTG_TRY(ktg_soup_corner(scan->context, soup, (uint32_t)vertex, KTG_NONE));
    }
    KTG_TRY(ktg_soup_close_polygon(scan->context, soup));
    return ktg_scan_line_ends(scan) ? KTG_OK : read_face_colour(scan, soup);
}

static ktg_status fail_truncated(const ktg_scan *scan, const char *what, int64_t got,
                                 int64_t wanted) {
    return ktg_scan_fail(scan, KTG_FORMAT, "the file is truncated: %lld of %lld %s are there",
                         (long long)got, (long long)wanted, what);
}

ktg_status ktg_read_off(ktg_scan *scan, ktg_soup *soup) {
    counts n = {0, 0};
    off_columns columns = {false, 0};
    if (!ktg_scan_content(scan))
        return ktg_scan_fail(scan, KTG_FORMAT, "the file is truncated: it has only comments");
    KTG_TRY(read_word(scan, &columns));
    if (memchr(scan->at, 0, (size_t)(scan->end - scan->at)))
        return ktg_fail(scan->context, KTG_FORMAT,
                        "%s: holds binary data, so it is not an OFF file", scan->name);
    KTG_TRY(read_counts(scan, &n));
    for (int64_t i = 0; i < n.vertices; i++, ktg_scan_next_line(scan)) {
        if (!ktg_scan_content(scan))
            return fail_truncated(scan, "vertices", i, n.vertices);
        KTG_TRY(ktg_scan_row(scan));
        KTG_TRY(read_vertex(scan, &columns, soup));
    }
    for (int64_t i = 0; i < n.faces; i++, ktg_scan_next_line(scan)) {
        if (!ktg_scan_content(scan))
            return fail_truncated(scan, "faces", i, n.faces);
        KTG_TRY(ktg_scan_row(scan));
        KTG_TRY(read_face(scan, soup));
    }
    if (ktg_scan_content(scan))
        ktg_log(scan->context, KTG_LOG_WARNING, "%s:%llu: what follows the last face was ignored",
                scan->name, (unsigned long long)scan->line);
    return KTG_OK;
}
