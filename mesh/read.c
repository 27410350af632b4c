/* mesh/read.c - reading a model file: which format it is, and who parses it.
 *
 * The whole file is in memory before anything is looked at. All four formats are parsed by small C
 * parsers of our own, though OpenMesh is at hand. Tried with OpenMesh 9.0, through an importer that
 * collects plain faces:
 * - OBJ: no groups, objects or `l` elements; vertices that cannot be parsed are dropped.
 * - STL: facets with two equal corners are dropped without a word; a truncated file is taken.
 * - PLY: positions come as floats only, also from `double`.
 * - OFF: likewise; and a comment behind the word OFF is its undoing.
 * - All: the readers are single objects that keep the state of the file being read, so two contexts
 *   on two threads would disturb each other; and to bound counts, indices and numbers beforehand
 *   takes a walk over the whole body, which is a parser. */
#include "mesh/read.h"
#include "core/memory.h"

#include <string.h>
#include <strings.h>

#define FORMATS "OBJ, STL, PLY and OFF"

/* ---- which format ------------------------------------------------------------------------- */

ktg_mesh_format ktg_mesh_format_of(const char *path) {
    const char *dot = strrchr(path, '.');
    if (!dot || strchr(dot, '/'))
        return KTG_MESH_BY_ENDING;
    if (strcasecmp(dot, ".obj") == 0)
        return KTG_MESH_OBJ;
    if (strcasecmp(dot, ".stl") == 0)
        return KTG_MESH_STL;
    if (strcasecmp(dot, ".ply") == 0)
        return KTG_MESH_PLY;
    return strcasecmp(dot, ".off") == 0 ? KTG_MESH_OFF : KTG_MESH_BY_ENDING;
}

static bool is_off_word(ktg_word word) {
    static const char *const words[] = {"OFF",    "COFF",   "NOFF",    "CNOFF", "STOFF",
                                        "STCOFF", "STNOFF", "STCNOFF", "4OFF",  "nOFF"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (ktg_word_is(word, words[i]))
            return true;
    return false;
}

static bool is_obj_word(ktg_word word) {
    static const char *const words[] = {"v", "vt", "vn", "f", "o", "g", "s", "mtllib", "usemtl"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (ktg_word_is(word, words[i]))
            return true;
    return false;
}

/* What the content clearly is, or KTG_MESH_BY_ENDING. `scan` is a copy. */
static ktg_mesh_format format_of_content(ktg_scan scan) {
    if (ktg_stl_fits(scan.start, (size_t)(scan.end - scan.start)))
        return KTG_MESH_STL;
    if (!ktg_scan_content(&scan))
        return KTG_MESH_BY_ENDING;
    ktg_word word = ktg_scan_word(&scan);
    if (ktg_word_is(word, "ply") && ktg_scan_line_ends(&scan))
        return KTG_MESH_PLY;
    if (is_off_word(word))
        return KTG_MESH_OFF;
    if (ktg_word_means(word, "solid")) {
        ktg_scan_next_line(&scan);
        if (ktg_scan_content(&scan) && ktg_word_means(ktg_scan_word(&scan), "facet"))
            return KTG_MESH_STL;
    }
    return is_obj_word(word) && !ktg_scan_line_ends(&scan) ? KTG_MESH_OBJ : KTG_MESH_BY_ENDING;
}

static ktg_status choose_format(const ktg_scan *scan, const char *path, ktg_mesh_format *format) {
    if (scan->end == scan->start)
        return ktg_fail(scan->context, KTG_FORMAT, "%s: is empty", scan->name);
    if (*format != KTG_MESH_BY_ENDING)
        return KTG_OK;
    *format = format_of_content(*scan);
    if (*format == KTG_MESH_BY_ENDING)
        *format = ktg_mesh_format_of(path);
    if (*format == KTG_MESH_BY_ENDING)
        return ktg_fail(scan->context, KTG_FORMAT,
                        "%s: is not a model of a known format; " FORMATS " can be read",
                        scan->name);
    return KTG_OK;
}

/* ---- reading ------------------------------------------------------------------------------ */

static ktg_status parse(ktg_scan *scan, ktg_mesh_format format, ktg_soup *soup) {
    switch (format) {
    case KTG_MESH_OBJ:
        return ktg_read_obj(scan, soup);
    case KTG_MESH_STL:
        return ktg_read_stl(scan, soup);
    case KTG_MESH_PLY:
        return ktg_read_ply(scan, soup);
    case KTG_MESH_OFF:
        return ktg_read_off(scan, soup);
    default:
        return ktg_fail(scan->context, KTG_ARGUMENT, "there is no model format number %d",
                        (int)format);
    }
}

static ktg_status read_mesh(ktg_scan *scan, const char *path, ktg_mesh_format format,
                            ktg_mesh **mesh) {
    ktg_soup soup = {.object = KTG_NONE, .group = KTG_NONE, .material = KTG_NONE};
    ktg_status status = choose_format(scan, path, &format);
    if (status == KTG_OK)
        status = parse(scan, format, &soup);
    if (status == KTG_OK && soup.polygon_count == 0)
        status = ktg_fail(scan->context, KTG_FORMAT, "%s: holds no faces (%zu vertices)",
                          scan->name, soup.vertex_count);
    if (status == KTG_OK)
        status = ktg_soup_mesh(scan->context, scan->name, &soup, mesh);
    ktg_soup_free(&soup);
    return status;
}

ktg_status ktg_mesh_read(ktg_context *context, const char *path, ktg_mesh_format format,
                         ktg_mesh **mesh) {
    ktg_scan_file file;
    ktg_scan scan;
    *mesh = NULL;
    ktg_status status = ktg_scan_open(context, path, &file, &scan);
    if (status == KTG_OK)
        status = read_mesh(&scan, path, format, mesh);
    ktg_scan_close(&file, &scan);
    return status;
}
