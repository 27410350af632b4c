/* mesh/write.c - writing a model file: which format, numbers, STL and OFF. */
#include "mesh/write.h"
#include "core/memory.h"
#include "core/vec.h"

#include <float.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- the buffer --------------------------------------------------------------------------- */

static void flush(ktg_writer *writer) {
    if (writer->status == KTG_OK)
        writer->status =
            ktg_output_write(writer->context, writer->output, writer->buffer, writer->used);
    writer->used = 0;
    if (writer->status == KTG_OK)
        writer->status = ktg_check_cancel(writer->context);
}

void ktg_put_bytes(ktg_writer *writer, const void *bytes, size_t size) {
    while (size > 0 && writer->status == KTG_OK) {
        size_t room = KTG_WRITER_SIZE - writer->used, part = size < room ? size : room;
        memcpy(writer->buffer + writer->used, bytes, part);
        bytes = (const char *)bytes + part;
        size -= part;
        writer->used += part;
        if (writer->used == KTG_WRITER_SIZE)
            flush(writer);
    }
}

void ktg_put_text(ktg_writer *writer, const char *text) {
    ktg_put_bytes(writer, text, strlen(text));
}

void ktg_put_name(ktg_writer *writer, const char *keyword, const char *name, size_t length) {
    ktg_put_text(writer, keyword);
    ktg_put_text(writer, " ");
    for (size_t i = 0; i < length; i++) {
        bool bad = (unsigned char)name[i] < 0x20 || (i + 1 == length && name[i] == '\\');
        ktg_put_bytes(writer, bad ? "_" : name + i, 1);
    }
    ktg_put_text(writer, "\n");
}

void ktg_put_names(ktg_writer *writer, const char *keyword, const char *names) {
    for (const char *at = names; at && *at;) {
        size_t length = strcspn(at, "\n");
        ktg_put_name(writer, keyword, at, length);
        at += length + (at[length] == '\n');
    }
}

void ktg_put_integer(ktg_writer *writer, uint64_t number) {
    char text[24], *at = text + sizeof text;
    do
        *--at = (char)('0' + number % 10);
    while (number /= 10);
    ktg_put_bytes(writer, at, (size_t)(text + sizeof text - at));
}

void ktg_put_number(ktg_writer *writer, double number) {
    char text[32];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, number);
        if (digits == 17 || strtod(text, NULL) == number)
            break;
    }
    ktg_put_text(writer, text);
}

void ktg_put_point(ktg_writer *writer, ktg_vec3 point) {
    ktg_put_number(writer, point.x);
    ktg_put_text(writer, " ");
    ktg_put_number(writer, point.y);
    ktg_put_text(writer, " ");
    ktg_put_number(writer, point.z);
}

void ktg_put_triangle(ktg_writer *writer, const ktg_mesh *mesh, size_t face) {
    ktg_put_text(writer, "3");
    for (size_t k = 0; k < 3; k++) {
        ktg_put_text(writer, " ");
        ktg_put_integer(writer, mesh->faces[3 * face + k]);
    }
}

/* ---- OFF ---------------------------------------------------------------------------------- */

void ktg_write_off(ktg_writer *writer, const ktg_mesh *mesh) {
    ktg_put_text(writer, "OFF\n");
    ktg_put_integer(writer, mesh->vertex_count);
    ktg_put_text(writer, " ");
    ktg_put_integer(writer, mesh->face_count);
    ktg_put_text(writer, " 0\n");
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        ktg_put_point(writer, mesh->positions[i]);
        ktg_put_text(writer, "\n");
    }
    for (size_t f = 0; f < mesh->face_count; f++) {
        ktg_put_triangle(writer, mesh, f);
        ktg_put_text(writer, "\n");
    }
}

/* ---- STL ---------------------------------------------------------------------------------- */

static void put_little_endian(ktg_writer *writer, uint32_t bits) {
    unsigned char bytes[4] = {bits & 255, bits >> 8 & 255, bits >> 16 & 255, bits >> 24};
    ktg_put_bytes(writer, bytes, 4);
}

static void put_floats(ktg_writer *writer, ktg_vec3 v) {
    float numbers[3] = {(float)v.x, (float)v.y, (float)v.z};
    uint32_t bits[3];
    memcpy(bits, numbers, sizeof bits);
    for (int k = 0; k < 3; k++)
        put_little_endian(writer, bits[k]);
}

/* The unit normal; (0, 0, 0) where there is no area. Scaled first, so that nothing overflows. */
static ktg_vec3 face_normal(ktg_vec3 a, ktg_vec3 b, ktg_vec3 c) {
    ktg_vec3 u = ktg_sub3(b, a), v = ktg_sub3(c, a);
    return ktg_unit3(ktg_cross3(ktg_unit3(u), ktg_unit3(v)));
}

static bool fits_floats(const ktg_mesh *mesh) {
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        ktg_vec3 p = mesh->positions[i];
        if (!(fabs(p.x) <= FLT_MAX && fabs(p.y) <= FLT_MAX && fabs(p.z) <= FLT_MAX))
            return false;
    }
    return true;
}

void ktg_write_stl(ktg_writer *writer, const ktg_mesh *mesh) {
    /* The text must not begin with "solid". */
    char head[80] = "binary STL written by Katagami";
    if (!fits_floats(mesh)) {
        writer->status = ktg_fail(writer->context, KTG_LIMIT,
                                  "%s: a coordinate is too large for STL; write OBJ, PLY or OFF",
                                  ktg_output_path(writer->output));
        return;
    }
    ktg_put_bytes(writer, head, sizeof head);
    put_little_endian(writer, mesh->face_count);
    for (size_t f = 0; f < mesh->face_count; f++) {
        const uint32_t *face = mesh->faces + 3 * f;
        const ktg_vec3 *p = mesh->positions;
        put_floats(writer, face_normal(p[face[0]], p[face[1]], p[face[2]]));
        for (int k = 0; k < 3; k++)
            put_floats(writer, p[face[k]]);
        ktg_put_bytes(writer, "\0", 2);
    }
}

/* ---- the call ----------------------------------------------------------------------------- */

static void write_format(ktg_writer *writer, const ktg_mesh *mesh, ktg_mesh_format format) {
    if (format == KTG_MESH_OBJ)
        ktg_write_obj(writer, mesh);
    else if (format == KTG_MESH_STL)
        ktg_write_stl(writer, mesh);
    else if (format == KTG_MESH_PLY)
        ktg_write_ply(writer, mesh);
    else
        ktg_write_off(writer, mesh);
    flush(writer);
}

ktg_status ktg_mesh_write(ktg_context *context, const ktg_mesh *mesh, ktg_mesh_format format,
                          ktg_output *output) {
    if (format == KTG_MESH_BY_ENDING)
        format = ktg_mesh_format_of(ktg_output_path(output));
    if (format < KTG_MESH_OBJ || format > KTG_MESH_OFF)
        return ktg_fail(context, KTG_ARGUMENT,
                        "%s: the ending names no model format; .obj, .stl, .ply and .off can be "
                        "written",
                        ktg_output_path(output));
    ktg_writer *writer = ktg_new(context, 1, ktg_writer);
    if (!writer)
        return KTG_MEMORY;
    writer->context = context;
    writer->output = output;
    locale_t plain = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
    if (plain == (locale_t)0) {
        ktg_free(writer);
        return ktg_fail(context, KTG_MEMORY, "out of memory (locale)");
    }
    locale_t before = uselocale(plain);
    write_format(writer, mesh, format);
    uselocale(before);
    freelocale(plain);
    ktg_status status = writer->status;
    ktg_free(writer);
    return status;
}
