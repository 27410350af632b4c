/* mesh/read_ply.h - the head of a PLY file (mesh only). */
#ifndef KTG_MESH_READ_PLY_H
#define KTG_MESH_READ_PLY_H

#include "mesh/read.h"

typedef enum ply_type {
    PLY_NONE, /* of a list's count: not a list */
    PLY_INT8,
    PLY_UINT8,
    PLY_INT16,
    PLY_UINT16,
    PLY_INT32,
    PLY_UINT32,
    PLY_FLOAT,
    PLY_DOUBLE
} ply_type;

/* What a property or element is to us. */
typedef enum ply_role {
    PLY_OTHER,
    PLY_X,
    PLY_Y,
    PLY_Z,
    PLY_CORNERS,
    PLY_RED,
    PLY_GREEN,
    PLY_BLUE,
    PLY_U,
    PLY_V,
    PLY_CORNER_UVS, /* a list: u and v of each corner */
    PLY_TEXTURE,    /* the number of the face's texture */
    PLY_ROLE_COUNT
} ply_role;
#define PLY_ROLES_XYZ    (1u << PLY_X | 1u << PLY_Y | 1u << PLY_Z)
#define PLY_ROLES_COLOUR (1u << PLY_RED | 1u << PLY_GREEN | 1u << PLY_BLUE)
#define PLY_ROLES_UV     (1u << PLY_U | 1u << PLY_V)

typedef enum ply_kind { PLY_UNKNOWN, PLY_VERTEX, PLY_FACE } ply_kind;

typedef struct ply_property {
    ply_type count_type; /* of a list, or PLY_NONE */
    ply_type type;
    ply_role role;
} ply_property;

typedef struct ply_element {
    ply_kind kind;
    int64_t count;
    size_t first, end;    /* its properties */
    uint64_t least_bytes; /* of one row in the body */
    unsigned roles;       /* bits 1 << role of those that its properties play */
    char *name;
} ply_element;

typedef struct ply_head {
    bool has_format, ascii, big_endian;
    ply_element *elements;
    size_t element_count, element_capacity;
    ply_property *properties;
    size_t property_count, property_capacity;
    ktg_word *textures; /* texture_count names of "comment TextureFile", in the file's bytes */
    size_t texture_count, texture_capacity;
} ply_head;

size_t ktg_ply_size(ply_type type);

/* Reads the head and leaves the scan at the body's first byte. Afterwards there is one vertex
 * element with x, y, z and one face element with a list of corners, and no element announces more
 * rows than the file can hold. */
KTG_NODISCARD ktg_status ktg_ply_read_head(ktg_scan *scan, ply_head *head);
void ktg_ply_free_head(ply_head *head);

#endif
