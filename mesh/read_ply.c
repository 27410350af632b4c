/* mesh/read_ply.c - the body of a PLY file, ASCII or binary of either byte order. Positions,
 * corners, colours and texture coordinates are taken, every other property and element is passed
 * over. */
#include "mesh/read_ply.h"
#include "core/memory.h"

#include <math.h>
#include <string.h>

typedef struct ply {
    ktg_scan *scan;
    ktg_soup *soup;
    ply_head head;
    const ply_element *element;    /* the one whose rows are being read */
    int64_t row;                   /* from 0 */
    int64_t vertex_count;          /* announced */
    bool vertex_uvs;               /* texture coordinate v is vertex v's */
    double values[PLY_ROLE_COUNT]; /* of the row being read */
    double *corner_uvs;            /* corner_uv_count, of the row being read */
    size_t corner_uv_count, corner_uv_capacity;
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
        KTG_TRY(ktg_soup_corner(p->scan->context, p->soup, (uint32_t)vertex,
                                p->vertex_uvs ? (uint32_t)vertex : KTG_NONE));
    }
    return ktg_soup_close_polygon(p->scan->context, p->soup);
}

/* What need not be whole in ASCII, whatever its type says: 1.0 as a uchar, for instance. */
static ktg_status read_number(ply *p, ply_type type, const char *what, double *value) {
    KTG_TRY(read_value(p, p->head.ascii ? PLY_DOUBLE : type, what, value));
    if (!isfinite(*value))
        return fail_row(p, "%s is not a finite number", what);
    return ktg_scan_check_number(p->scan, what, *value);
}

static ktg_status read_corner_uvs(ply *p, const ply_property *property, int64_t length) {
    KTG_TRY(ktg_reserve(p->scan->context, &p->corner_uvs, &p->corner_uv_capacity, (size_t)length));
    p->corner_uv_count = (size_t)length;
    for (int64_t i = 0; i < length; i++)
        KTG_TRY(read_number(p, property->type, "a texture coordinate", &p->corner_uvs[i]));
    return KTG_OK;
}

static ktg_status read_list(ply *p, const ply_property *property) {
    int64_t length = 0;
    KTG_TRY(read_length(p, property, &length));
    if (property->role == PLY_CORNERS)
        return read_corners(p, property, length);
    if (property->role == PLY_CORNER_UVS)
        return read_corner_uvs(p, property, length);
    for (int64_t i = 0; i < length; i++)
        KTG_TRY(skip_value(p, property->type));
    return KTG_OK;
}

static ktg_status read_property(ply *p, const ply_property *property) {
    if (property->count_type != PLY_NONE)
        return read_list(p, property);
    if (property->role == PLY_OTHER)
        return skip_value(p, property->type);
    double *value = &p->values[property->role];
    if (property->role >= PLY_RED)
        return read_number(p, property->type,
                           property->role <= PLY_BLUE ? "a part of a colour"
                           : property->role <= PLY_V  ? "a texture coordinate"
                                                      : "the number of a texture",
                           value);
    KTG_TRY(read_value(p, property->type, "a coordinate", value));
    if (!isfinite(*value))
        return fail_row(p, "%s is not a finite number", "a coordinate");
    return ktg_scan_check_number(p->scan, "a coordinate", *value);
}

/* ---- rows --------------------------------------------------------------------------------- */

static bool has_roles(const ply *p, unsigned roles) {
    return (p->element->roles & roles) == roles;
}

/* The row's colour. Numbers of one or two bytes have their own range; what other types mean, the
 * largest of all tells. */
static ktg_status take_colour(ply *p, ktg_colour_list *list, size_t index) {
    double part[3] = {0, 0, 0};
    if (!has_roles(p, PLY_ROLES_COLOUR))
        return KTG_OK;
    for (size_t i = p->element->first; i < p->element->end; i++) {
        const ply_property *property = &p->head.properties[i];
        double most = property->type == PLY_UINT8 ? 255 : property->type == PLY_UINT16 ? 65535 : 1;
        if (property->role >= PLY_RED && property->role <= PLY_BLUE)
            part[property->role - PLY_RED] = p->values[property->role] / most;
    }
    return ktg_colours_set(p->scan->context, list, index, (ktg_vec3){part[0], part[1], part[2]});
}

static ktg_status add_uv(ply *p, double u, double v) {
    ktg_soup *soup = p->soup;
    KTG_TRY(ktg_reserve(p->scan->context, &soup->uvs, &soup->uv_capacity, soup->uv_count + 1));
    soup->uvs[soup->uv_count++] = (ktg_vec2){u, v};
    return KTG_OK;
}

static ktg_status take_vertex(ply *p) {
    const double *value = p->values;
    ktg_vec3 position = {value[PLY_X], value[PLY_Y], value[PLY_Z]};
    KTG_TRY(take_colour(p, &p->soup->vertex_colours, p->soup->vertex_count));
    if (p->vertex_uvs)
        KTG_TRY(add_uv(p, value[PLY_U], value[PLY_V]));
    return ktg_soup_vertex(p->scan->context, p->soup, position);
}

/* The corners' texture coordinates, where there are two numbers for each. */
static ktg_status take_corner_uvs(ply *p, const ktg_soup_polygon *polygon) {
    ktg_soup *soup = p->soup;
    if (p->corner_uv_count != 2 * (soup->corner_count - polygon->first))
        return KTG_OK;
    for (size_t i = polygon->first; i < soup->corner_count; i++) {
        const double *uv = p->corner_uvs + 2 * (i - polygon->first);
        soup->corner_uvs[i] = (uint32_t)soup->uv_count;
        KTG_TRY(add_uv(p, uv[0], uv[1]));
    }
    return KTG_OK;
}

/* Where there is more than one texture, materials stand for them. */
static ktg_status take_texture(ply *p, ktg_soup_polygon *polygon) {
    double number = has_roles(p, 1u << PLY_TEXTURE) ? p->values[PLY_TEXTURE] : 0;
    if (p->head.texture_count < 2 || !(number >= 0 && number < (double)p->head.texture_count))
        return KTG_OK;
    return ktg_name_number(p->scan->context, &p->soup->materials, p->head.textures[(size_t)number],
                           &polygon->material);
}

static ktg_status take_face(ply *p) {
    size_t last = p->soup->polygon_count - 1;
    KTG_TRY(take_colour(p, &p->soup->polygon_colours, last));
    if (has_roles(p, 1u << PLY_CORNER_UVS))
        KTG_TRY(take_corner_uvs(p, &p->soup->polygons[last]));
    return take_texture(p, &p->soup->polygons[last]);
}

static ktg_status read_row(ply *p) {
    KTG_TRY(ktg_scan_row(p->scan));
    if (p->head.ascii && !ktg_scan_content(p->scan))
        return fail_row(p, "the file is truncated: %lld of these are announced",
                        (long long)p->element->count);
    for (size_t i = p->element->first; i < p->element->end; i++)
        KTG_TRY(read_property(p, &p->head.properties[i]));
    if (p->element->kind == PLY_VERTEX)
        KTG_TRY(take_vertex(p));
    if (p->element->kind == PLY_FACE)
        KTG_TRY(take_face(p));
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

static void note_vertices(ply *p) {
    bool corner_uvs = false;
    for (size_t i = 0; i < p->head.element_count; i++)
        corner_uvs |= (p->head.elements[i].roles & 1u << PLY_CORNER_UVS) != 0;
    for (size_t i = 0; i < p->head.element_count; i++)
        if (p->head.elements[i].kind == PLY_VERTEX) {
            p->vertex_count = p->head.elements[i].count;
            p->vertex_uvs =
                !corner_uvs && (p->head.elements[i].roles & PLY_ROLES_UV) == PLY_ROLES_UV;
        }
}

static ktg_status name_textures(ply *p) {
    for (size_t i = 0; i < p->head.texture_count; i++)
        KTG_TRY(ktg_name_line(p->scan->context, &p->soup->texture_file, p->head.textures[i]));
    return KTG_OK;
}

ktg_status ktg_read_ply(ktg_scan *scan, ktg_soup *soup) {
    ply p = {.scan = scan, .soup = soup};
    ktg_status status = ktg_ply_read_head(scan, &p.head);
    if (status == KTG_OK)
        status = name_textures(&p);
    if (status == KTG_OK) {
        note_vertices(&p);
        scan->line = p.head.ascii ? scan->line : 0;
        status = read_body(&p);
    }
    ktg_free(p.corner_uvs);
    ktg_ply_free_head(&p.head);
    return status;
}
