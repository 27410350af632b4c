/* mesh/write.h - what the writers of the formats share (mesh only). */
#ifndef KTG_MESH_WRITE_H
#define KTG_MESH_WRITE_H

#include "mesh/mesh.h"

#define KTG_WRITER_SIZE 65536

/* Collects bytes and hands them to the output in large pieces. The first failure stays in `status`
 * and makes the rest do nothing. Numbers are made in the C locale, which is set while a writer
 * works. */
typedef struct ktg_writer {
    ktg_context *context;
    ktg_output *output;
    ktg_status status;
    size_t used;
    char buffer[KTG_WRITER_SIZE];
} ktg_writer;

void ktg_put_bytes(ktg_writer *writer, const void *bytes, size_t size);
void ktg_put_text(ktg_writer *writer, const char *text);
/* A name of `length` bytes on a line of its own: control characters and a backslash at its end
 * become _. */
void ktg_put_name(ktg_writer *writer, const char *keyword, const char *name, size_t length);
/* The same for each line of `names` (NULL: none). */
void ktg_put_names(ktg_writer *writer, const char *keyword, const char *names);
void ktg_put_integer(ktg_writer *writer, uint64_t number);
/* The shortest decimal (15 to 17 digits) that reads back as the same double. */
void ktg_put_number(ktg_writer *writer, double number);
/* "x y z" */
void ktg_put_point(ktg_writer *writer, ktg_vec3 point);
/* "3 a b c", counted from 0 */
void ktg_put_triangle(ktg_writer *writer, const ktg_mesh *mesh, size_t face);

void ktg_write_obj(ktg_writer *writer, const ktg_mesh *mesh);
void ktg_write_stl(ktg_writer *writer, const ktg_mesh *mesh);
void ktg_write_ply(ktg_writer *writer, const ktg_mesh *mesh);
void ktg_write_off(ktg_writer *writer, const ktg_mesh *mesh);

#endif
