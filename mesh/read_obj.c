/* mesh/read_obj.c - Wavefront OBJ: polygons, groups, objects, materials, texture coordinates,
 * colours of vertices, marked edges. Normals, curves, surfaces, points and unknown keywords are
 * passed over. */
#include "core/memory.h"
#include "mesh/read.h"

#include <string.h>

/* An index may name what only follows later in the file; so the largest one is remembered with its
 * line and checked at the end. */
typedef struct farthest {
    int64_t index;
    uint64_t line;
} farthest;

typedef struct obj {
    ktg_scan *scan;
    ktg_soup *soup;
    farthest vertex, uv;
} obj;

/* The colour of the last vertex, which stands behind its position: "v x y z r g b". A single
 * number there is a weight, and is passed over. */
static ktg_status read_vertex_colour(obj *o) {
    ktg_vec3 c;
    if (ktg_scan_words_left(*o->scan) < 3)
        return KTG_OK;
    KTG_TRY(ktg_scan_number(o->scan, "the red of a vertex", &c.x));
    KTG_TRY(ktg_scan_number(o->scan, "the green of a vertex", &c.y));
    KTG_TRY(ktg_scan_number(o->scan, "the blue of a vertex", &c.z));
    return ktg_colours_set(o->scan->context, &o->soup->vertex_colours, o->soup->vertex_count - 1,
                           c);
}

static ktg_status read_vertex(obj *o) {
    ktg_vec3 p;
    KTG_TRY(ktg_scan_number(o->scan, "the x of a vertex", &p.x));
    KTG_TRY(ktg_scan_number(o->scan, "the y of a vertex", &p.y));
    KTG_TRY(ktg_scan_number(o->scan, "the z of a vertex", &p.z));
    KTG_TRY(ktg_soup_vertex(o->scan->context, o->soup, p));
    return ktg_scan_line_ends(o->scan) ? KTG_OK : read_vertex_colour(o);
}

static ktg_status read_uv(obj *o) {
    ktg_soup *soup = o->soup;
    ktg_vec2 uv = {0, 0};
    KTG_TRY(ktg_scan_number(o->scan, "a texture coordinate", &uv.x));
    if (!ktg_scan_line_ends(o->scan))
        KTG_TRY(ktg_scan_number(o->scan, "a texture coordinate", &uv.y));
    KTG_TRY(ktg_reserve(o->scan->context, &soup->uvs, &soup->uv_capacity, soup->uv_count + 1));
    soup->uvs[soup->uv_count++] = uv;
    return KTG_OK;
}

/* An index from the file, 1-based or counted back from the last one, made 0-based. */
static ktg_status resolve(obj *o, const char *what, int64_t index, size_t count, farthest *largest,
                          uint32_t *number) {
    if (index == 0)
        return ktg_scan_fail(o->scan, KTG_FORMAT, "%s number 0; they count from 1", what);
    if (index < 0 && (uint64_t)-index > count)
        return ktg_scan_fail(o->scan, KTG_FORMAT,
                             "%s number %lld counts back, but only %zu were given before", what,
                             (long long)index, count);
    if (index < 0)
        index += (int64_t)count + 1;
    if (index >= KTG_NONE)
        return ktg_scan_fail(o->scan, KTG_FORMAT, "%s number %lld; the file cannot hold so many",
                             what, (long long)index);
    if (index > largest->index)
        *largest = (farthest){index, o->scan->line};
    *number = (uint32_t)(index - 1);
    return KTG_OK;
}

/* v, v/vt, v//vn, v/vt/vn */
static ktg_status read_corner(obj *o, uint32_t *vertex, uint32_t *uv) {
    ktg_scan *scan = o->scan;
    int64_t index;
    *uv = KTG_NONE;
    KTG_TRY(ktg_scan_integer(scan, "the number of a vertex", &index));
    KTG_TRY(resolve(o, "vertex", index, o->soup->vertex_count, &o->vertex, vertex));
    for (int part = 1; part < 3 && *scan->at == '/'; part++) {
        scan->at++;
        if (*scan->at == '/' || ktg_scan_line_ends(scan) || scan->at[-1] != '/')
            continue;
        KTG_TRY(ktg_scan_integer(scan, "a number behind the slash", &index));
        if (part == 1)
            KTG_TRY(resolve(o, "texture coordinate", index, o->soup->uv_count, &o->uv, uv));
    }
    return KTG_OK;
}

static ktg_status read_face(obj *o) {
    uint32_t vertex, uv;
    while (!ktg_scan_line_ends(o->scan)) {
        KTG_TRY(read_corner(o, &vertex, &uv));
        KTG_TRY(ktg_soup_corner(o->scan->context, o->soup, vertex, uv));
    }
    if (ktg_soup_open_corners(o->soup) < 3)
        return ktg_scan_fail(o->scan, KTG_FORMAT, "a face needs three corners, this one has %zu",
                             ktg_soup_open_corners(o->soup));
    return ktg_soup_close_polygon(o->scan->context, o->soup);
}

static ktg_status mark_edge(obj *o, uint32_t from, uint32_t to) {
    ktg_soup *soup = o->soup;
    if (from == to)
        return KTG_OK;
    KTG_TRY(ktg_reserve(o->scan->context, &soup->marked, &soup->marked_capacity,
                        2 * soup->marked_count + 2));
    soup->marked[2 * soup->marked_count] = from;
    soup->marked[2 * soup->marked_count++ + 1] = to;
    return KTG_OK;
}

static ktg_status read_line_element(obj *o) {
    uint32_t before, vertex, uv;
    KTG_TRY(read_corner(o, &before, &uv));
    do {
        KTG_TRY(read_corner(o, &vertex, &uv));
        KTG_TRY(mark_edge(o, before, vertex));
        before = vertex;
    } while (!ktg_scan_line_ends(o->scan));
    return KTG_OK;
}

static ktg_status read_library(obj *o) {
    ktg_word rest = ktg_scan_rest(o->scan);
    if (rest.length == 0)
        return KTG_OK;
    return ktg_name_line(o->scan->context, &o->soup->material_library, rest);
}

static ktg_status read_statement(obj *o) {
    ktg_context *context = o->scan->context;
    ktg_soup *soup = o->soup;
    ktg_word keyword = ktg_scan_word(o->scan);
    if (ktg_word_is(keyword, "v"))
        return read_vertex(o);
    if (ktg_word_is(keyword, "f") || ktg_word_is(keyword, "fo"))
        return read_face(o);
    if (ktg_word_is(keyword, "vt"))
        return read_uv(o);
    if (ktg_word_is(keyword, "l"))
        return read_line_element(o);
    if (ktg_word_is(keyword, "g"))
        return ktg_name_number(context, &soup->groups, ktg_scan_rest(o->scan), &soup->group);
    if (ktg_word_is(keyword, "o"))
        return ktg_name_number(context, &soup->objects, ktg_scan_rest(o->scan), &soup->object);
    if (ktg_word_is(keyword, "usemtl"))
        return ktg_name_number(context, &soup->materials, ktg_scan_rest(o->scan), &soup->material);
    return ktg_word_is(keyword, "mtllib") ? read_library(o) : KTG_OK;
}

static ktg_status check_farthest(obj *o, const farthest *largest, const char *what, size_t count) {
    if (largest->index <= (int64_t)count)
        return KTG_OK;
    o->scan->line = largest->line;
    return ktg_scan_fail(o->scan, KTG_FORMAT, "%s number %lld, but the file has only %zu", what,
                         (long long)largest->index, count);
}

ktg_status ktg_read_obj(ktg_scan *scan, ktg_soup *soup) {
    obj o = {.scan = scan, .soup = soup};
    if (memchr(scan->at, 0, (size_t)(scan->end - scan->at)))
        return ktg_fail(scan->context, KTG_FORMAT,
                        "%s: holds binary data, so it is not an OBJ file", scan->name);
    scan->continued = true;
    for (; ktg_scan_content(scan); ktg_scan_next_line(scan)) {
        KTG_TRY(ktg_scan_row(scan));
        KTG_TRY(read_statement(&o));
    }
    KTG_TRY(check_farthest(&o, &o.vertex, "vertex", soup->vertex_count));
    return check_farthest(&o, &o.uv, "texture coordinate", soup->uv_count);
}
