/* mesh/read_ply.c - the body of a PLY file, ASCII or binary of either byte order. Positions and
 * corners are taken, every other property and element is passed over. */
#include "mesh/read_ply.h"
#include "core/memory.h"

#include <math.h>
#include <string.h>

typedef struct ply {
    ktg_scan *scan;
    ktg_soup *soup;
    ply_head head;
    const ply_element *element; /* the one whose rows are being read */
    int64_t row;                /* from 0 */
    int64_t vertex_count;       /* announced */
    ktg_vec3 position;          /* of the vertex being read */
} ply;

/* Fails at the row being read: in ASCII the line is known, in binary data the row. */
#define fail_row(p, text, ...)                                                                     \
    ktg_scan_fail((p)->scan, KTG_FORMAT, "%s %lld: " text, (p)->element->name,                     \
                  (long long)(p)->row + 1, __VA_ARGS__)

/* ---- values ------------------------------------------------------------------------------- */

static uint64_t load_bits(const ply *p, size_t size) {
    const unsigned char *at = (const unsigned char *)p->scan->at;
    uint64_t bits = 0;
    for (size_t i = 0; i < size; i++)
        bits = bits << 8 | at[p->head.big_endian ? i : size - 1 - i];
    return bits;
}

static double decode(uint64_t bits, ply_type type) {
    uint32_t low = (uint32_t)bits;
    float single;
    double value;
    switch (type) {
    case PLY_INT8:
        return (int8_t)bits;
    case PLY_INT16:
        return (int16_t)bits;
    case PLY_INT32:
        return (int32_t)bits;
    case PLY_FLOAT:
        memcpy(&single, &low, sizeof single);
        return single;
    case PLY_DOUBLE:
        memcpy(&value, &bits, sizeof value);
        return value;
    default:
        return (double)bits;
    }
}

static ktg_status read_value(ply *p, ply_type type, const char *what, double *value) {
    if (p->head.ascii && type >= PLY_FLOAT)
        return ktg_scan_number(p->scan, what, value);
    if (p->head.ascii) {
        int64_t number = 0;
        KTG_TRY(ktg_scan_integer(p->scan, what, &number));
        *value = (double)number;
        return KTG_OK;
    }
    size_t size = ktg_ply_size(type);
    if ((size_t)(p->scan->end - p->scan->at) < size)
        return fail_row(p, "the file is truncated in %s", what);
    *value = decode(load_bits(p, size), type);
    p->scan->at += size;
    return KTG_OK;
}

static ktg_status skip_value(ply *p, ply_type type) {
    double ignored;
    if (!p->head.ascii)
        return read_value(p, type, "a property", &ignored);
    if (ktg_scan_word(p->scan).length == 0)
        return fail_row(p, "the line ends before its %s", "last property");
    return KTG_OK;
}

/* ---- properties --------------------------------------------------------------------------- */

/* The length of a list, of which the rest of the file can hold the items. */
static ktg_status read_length(ply *p, const ply_property *property, int64_t *length) {
    double value = 0;
    KTG_TRY(read_value(p, property->count_type, "the length of a list", &value));
    size_t size = p->head.ascii ? 1 : ktg_ply_size(property->type);
    double most = (double)((size_t)(p->scan->end - p->scan->at) / size);
    if (value < 0 || value > most)
        return fail_row(p, "a list of length %.0f, which the file cannot hold", value);
    *length = (int64_t)value;
    return KTG_OK;
}

static ktg_status read_corners(ply *p, const ply_property *property, int64_t length) {
    if (length < 3)
        return fail_row(p, "a face needs three corners, this one has %lld", (long long)length);
    for (int64_t i = 0; i < length; i++) {
        double vertex = 0;
        KTG_TRY(read_value(p, property->type, "the number of a vertex", &vertex));
        if (vertex < 0 || vertex >= (double)p->vertex_count)
            return fail_row(p, "vertex number %.0f, but there are only %lld, counted from 0",
                            vertex, (long long)p->vertex_count);
        KTG_TRY(ktg_soup_corner(p->scan->context, p->soup, (uint32_t)vertex, KTG_NONE));
    }
    return ktg_soup_close_polygon(p->scan->context, p->soup);
}

static ktg_status read_list(ply *p, const ply_property *property) {
    int64_t length = 0;
    KTG_TRY(read_length(p, property, &length));
    if (property->role == PLY_CORNERS)
        return read_corners(p, property, length);
    for (int64_t i = 0; i < length; i++)
        KTG_TRY(skip_value(p, property->type));
    return KTG_OK;
}

static ktg_status read_property(ply *p, const ply_property *property) {
    if (property->count_type != PLY_NONE)
        return read_list(p, property);
    if (property->role == PLY_OTHER)
        return skip_value(p, property->type);
    double value = 0;
    KTG_TRY(read_value(p, property->type, "a coordinate", &value));
    if (!isfinite(value))
        return fail_row(p, "%s is not a finite number", "a coordinate");
    KTG_TRY(ktg_scan_check_number(p->scan, "a coordinate", value));
    *(property->role == PLY_X   ? &p->position.x
      : property->role == PLY_Y ? &p->position.y
                                : &p->position.z) = value;
    return KTG_OK;
}

/* ---- rows --------------------------------------------------------------------------------- */

static ktg_status read_row(ply *p) {
    KTG_TRY(ktg_scan_row(p->scan));
    if (p->head.ascii && !ktg_scan_content(p->scan))
        return fail_row(p, "the file is truncated: %lld of these are announced",
                        (long long)p->element->count);
    for (size_t i = p->element->first; i < p->element->end; i++)
        KTG_TRY(read_property(p, &p->head.properties[i]));
    if (p->element->kind == PLY_VERTEX)
        KTG_TRY(ktg_soup_vertex(p->scan->context, p->soup, p->position));
    if (!p->head.ascii)
        return KTG_OK;
    if (!ktg_scan_line_ends(p->scan))
        return fail_row(p, "the line has more values than the %zu properties of the head take",
                        p->element->end - p->element->first);
    ktg_scan_next_line(p->scan);
    return KTG_OK;
}

static ktg_status read_body(ply *p) {
    for (size_t i = 0; i < p->head.element_count; i++) {
        p->element = &p->head.elements[i];
        if (p->element->first == p->element->end)
            continue;
        for (p->row = 0; p->row < p->element->count; p->row++)
            KTG_TRY(read_row(p));
    }
    if (p->head.ascii ? ktg_scan_content(p->scan) : p->scan->at < p->scan->end)
        ktg_log(p->scan->context, KTG_LOG_WARNING, "%s: what follows the last element was ignored",
                p->scan->name);
    return KTG_OK;
}

ktg_status ktg_read_ply(ktg_scan *scan, ktg_soup *soup) {
    ply p = {.scan = scan, .soup = soup};
    ktg_status status = ktg_ply_read_head(scan, &p.head);
    for (size_t i = 0; status == KTG_OK && i < p.head.element_count; i++)
        if (p.head.elements[i].kind == PLY_VERTEX)
            p.vertex_count = p.head.elements[i].count;
    if (status == KTG_OK && !p.head.ascii)
        scan->line = 0;
    if (status == KTG_OK)
        status = read_body(&p);
    ktg_ply_free_head(&p.head);
    return status;
}
