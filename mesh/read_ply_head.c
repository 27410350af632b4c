/* mesh/read_ply_head.c - the head of a PLY file: which elements there are and what they hold. */
#include "core/memory.h"
#include "mesh/read_ply.h"

#include <string.h>

size_t ktg_ply_size(ply_type type) {
    static const size_t sizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[type];
}

static ply_type type_of(ktg_word word) {
    static const struct {
        const char *name;
        ply_type type;
    } names[] = {{"char", PLY_INT8},     {"int8", PLY_INT8},     {"uchar", PLY_UINT8},
                 {"uint8", PLY_UINT8},   {"short", PLY_INT16},   {"int16", PLY_INT16},
                 {"ushort", PLY_UINT16}, {"uint16", PLY_UINT16}, {"int", PLY_INT32},
                 {"int32", PLY_INT32},   {"uint", PLY_UINT32},   {"uint32", PLY_UINT32},
                 {"float", PLY_FLOAT},   {"float32", PLY_FLOAT}, {"double", PLY_DOUBLE},
                 {"float64", PLY_DOUBLE}};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (ktg_word_is(word, names[i].name))
            return names[i].type;
    return PLY_NONE;
}

static ktg_status fail_word(ktg_scan *scan, ktg_word word, const char *wanted) {
    char shown[KTG_SHOWN_SIZE];
    return ktg_scan_fail(scan, KTG_FORMAT, "\"%s\" stands where %s is wanted",
                         ktg_word_show(word, shown), wanted);
}

static ktg_status read_format(ktg_scan *scan, ply_head *head) {
    ktg_word word = ktg_scan_word(scan);
    head->has_format = true;
    head->ascii = ktg_word_is(word, "ascii");
    head->big_endian = ktg_word_is(word, "binary_big_endian");
    if (head->ascii || head->big_endian || ktg_word_is(word, "binary_little_endian"))
        return KTG_OK;
    return fail_word(scan, word, "ascii, binary_little_endian or binary_big_endian");
}

static ktg_status read_element(ktg_scan *scan, ply_head *head) {
    KTG_TRY(ktg_reserve(scan->context, &head->elements, &head->element_capacity,
                        head->element_count + 1));
    ply_element *element = &head->elements[head->element_count];
    ktg_word name = ktg_scan_word(scan);
    element->kind = ktg_word_is(name, "vertex") ? PLY_VERTEX
                    : ktg_word_is(name, "face") ? PLY_FACE
                                                : PLY_UNKNOWN;
    element->first = element->end = head->property_count;
    KTG_TRY(ktg_scan_integer(scan, "the number of elements", &element->count));
    if (element->count < 0)
        return ktg_scan_fail(scan, KTG_FORMAT, "%lld elements are announced, fewer than none",
                             (long long)element->count);
    element->name =
        ktg_name_clean(scan->context, (ktg_word){name.text, name.length < 40 ? name.length : 40});
    if (!element->name)
        return KTG_MEMORY;
    head->element_count++;
    return KTG_OK;
}

/* What a property's name says it is, where it stands in this element and is a list or not. Programs
 * differ in what they call a texture coordinate. */
static ply_role role_of(const ply_element *element, const ply_property *property, ktg_word name) {
    static const struct {
        ply_kind kind;
        bool list;
        const char *name;
        ply_role role;
    } roles[] = {{PLY_VERTEX, false, "x", PLY_X},
                 {PLY_VERTEX, false, "y", PLY_Y},
                 {PLY_VERTEX, false, "z", PLY_Z},
                 {PLY_VERTEX, false, "s", PLY_U},
                 {PLY_VERTEX, false, "t", PLY_V},
                 {PLY_VERTEX, false, "u", PLY_U},
                 {PLY_VERTEX, false, "v", PLY_V},
                 {PLY_VERTEX, false, "texture_u", PLY_U},
                 {PLY_VERTEX, false, "texture_v", PLY_V},
                 {PLY_FACE, true, "vertex_indices", PLY_CORNERS},
                 {PLY_FACE, true, "vertex_index", PLY_CORNERS},
                 {PLY_FACE, true, "texcoord", PLY_CORNER_UVS},
                 {PLY_FACE, false, "texnumber", PLY_TEXTURE},
                 {PLY_UNKNOWN, false, "red", PLY_RED}, /* of a vertex or a face */
                 {PLY_UNKNOWN, false, "green", PLY_GREEN},
                 {PLY_UNKNOWN, false, "blue", PLY_BLUE},
                 {PLY_UNKNOWN, false, "diffuse_red", PLY_RED},
                 {PLY_UNKNOWN, false, "diffuse_green", PLY_GREEN},
                 {PLY_UNKNOWN, false, "diffuse_blue", PLY_BLUE}};
    bool list = property->count_type != PLY_NONE;
    for (size_t i = 0; i < sizeof roles / sizeof *roles && element->kind != PLY_UNKNOWN; i++)
        if ((roles[i].kind == element->kind || roles[i].kind == PLY_UNKNOWN) &&
            roles[i].list == list && ktg_word_is(name, roles[i].name))
            return roles[i].role;
    return PLY_OTHER;
}

static ktg_status read_list_count_type(ktg_scan *scan, ply_property *property) {
    ktg_word word = ktg_scan_word(scan);
    property->count_type = type_of(word);
    if (property->count_type == PLY_NONE || property->count_type >= PLY_FLOAT)
        return fail_word(scan, word, "the whole number type of a list's length");
    return KTG_OK;
}

static ktg_status read_property(ktg_scan *scan, ply_head *head) {
    if (head->element_count == 0)
        return ktg_scan_fail(scan, KTG_FORMAT, "a property stands before the first element");
    ply_element *element = &head->elements[head->element_count - 1];
    KTG_TRY(ktg_reserve(scan->context, &head->properties, &head->property_capacity,
                        head->property_count + 1));
    ply_property *property = &head->properties[head->property_count];
    ktg_word word = ktg_scan_word(scan);
    if (ktg_word_is(word, "list")) {
        KTG_TRY(read_list_count_type(scan, property));
        word = ktg_scan_word(scan);
    }
    property->type = type_of(word);
    if (property->type == PLY_NONE)
        return fail_word(scan, word,
                         "a type (char, uchar, short, ushort, int, uint, float, double)");
    ktg_word name = ktg_scan_word(scan);
    if (name.length == 0)
        return ktg_scan_fail(scan, KTG_FORMAT, "a property has no name");
    property->role = role_of(element, property, name);
    if (property->role == PLY_CORNERS && property->type >= PLY_FLOAT)
        return ktg_scan_fail(scan, KTG_FORMAT, "vertex numbers of a fractional type make no sense");
    bool twice = property->role != PLY_OTHER && element->roles & 1u << property->role;
    if (twice && property->role <= PLY_CORNERS)
        return ktg_scan_fail(scan, KTG_FORMAT, "a property appears twice in one element");
    if (twice) /* "red" and "diffuse_red", say: the first one counts */
        property->role = PLY_OTHER;
    element->roles |= 1u << property->role;
    element->end = ++head->property_count;
    /* In ASCII a value is a digit and a blank at least. */
    ply_type fixed = property->count_type != PLY_NONE ? property->count_type : property->type;
    element->least_bytes += head->ascii ? 2 : ktg_ply_size(fixed);
    return KTG_OK;
}

/* MeshLab names the textures in comments, in the order of their numbers. */
static ktg_status read_comment(ktg_scan *scan, ply_head *head) {
    if (!ktg_word_is(ktg_scan_word(scan), "TextureFile"))
        return KTG_OK;
    ktg_word name = ktg_scan_rest(scan);
    if (name.length == 0)
        return KTG_OK;
    KTG_TRY(ktg_reserve(scan->context, &head->textures, &head->texture_capacity,
                        head->texture_count + 1));
    head->textures[head->texture_count++] = name;
    return KTG_OK;
}

/* One line of the head; *done at its end. */
static ktg_status read_line(ktg_scan *scan, ply_head *head, bool *done) {
    ktg_word word = ktg_scan_word(scan);
    *done = ktg_word_is(word, "end_header") && head->has_format;
    if (ktg_word_is(word, "comment"))
        return read_comment(scan, head);
    if (*done || ktg_word_is(word, "obj_info"))
        return KTG_OK;
    if (!head->has_format)
        return ktg_word_is(word, "format") ? read_format(scan, head)
                                           : fail_word(scan, word, "format");
    if (ktg_word_is(word, "element"))
        return read_element(scan, head);
    if (ktg_word_is(word, "property"))
        return read_property(scan, head);
    return fail_word(scan, word, "element, property or end_header");
}

/* The body begins behind the line end, which may be \r alone: then a \n is the body's. */
static void finish_head(ktg_scan *scan, bool carriage_returns) {
    const char *line_end =
        carriage_returns ? memchr(scan->at, '\r', (size_t)(scan->end - scan->at)) : NULL;
    if (line_end)
        scan->at = line_end + 1;
    else
        ktg_scan_next_line(scan);
}

static ktg_status check_rows(ktg_scan *scan, const ply_head *head) {
    uint64_t left = (uint64_t)(scan->end - scan->at) + 1;
    for (size_t i = 0; i < head->element_count; i++) {
        const ply_element *element = &head->elements[i];
        uint64_t count = (uint64_t)element->count;
        if (element->least_bytes && count > left / element->least_bytes)
            return ktg_fail(scan->context, KTG_FORMAT,
                            "%s: is truncated: its head announces %llu elements \"%s\", more than "
                            "the %llu bytes behind it can hold",
                            scan->name, (unsigned long long)count, element->name,
                            (unsigned long long)left - 1);
        left -= count * element->least_bytes;
    }
    return KTG_OK;
}

static ktg_status check_kinds(ktg_scan *scan, const ply_head *head) {
    const unsigned wanted[] = {0, PLY_ROLES_XYZ, 1u << PLY_CORNERS};
    size_t found[3] = {0};
    for (size_t i = 0; i < head->element_count; i++) {
        const ply_element *element = &head->elements[i];
        found[element->kind]++;
        if ((element->roles & wanted[element->kind]) != wanted[element->kind])
            return ktg_fail(scan->context, KTG_FORMAT, "%s: its head gives a %s no %s", scan->name,
                            element->name,
                            element->kind == PLY_VERTEX ? "x, y and z" : "list vertex_indices");
    }
    for (int kind = PLY_VERTEX; kind <= PLY_FACE; kind++)
        if (found[kind] != 1)
            return ktg_fail(scan->context, KTG_FORMAT,
                            "%s: its head names %zu elements \"%s\", where one is wanted",
                            scan->name, found[kind], kind == PLY_VERTEX ? "vertex" : "face");
    return KTG_OK;
}

ktg_status ktg_ply_read_head(ktg_scan *scan, ply_head *head) {
    ktg_word word = ktg_scan_word(scan);
    if (!ktg_word_is(word, "ply"))
        return fail_word(scan, word, "ply");
    bool carriage_returns = scan->at[0] == '\r' && scan->at[1] != '\n', done = false;
    while (!done) {
        ktg_scan_next_line(scan);
        if (!ktg_scan_content(scan))
            return ktg_scan_fail(scan, KTG_FORMAT, "the file is truncated: end_header is missing");
        KTG_TRY(read_line(scan, head, &done));
    }
    finish_head(scan, carriage_returns);
    KTG_TRY(check_kinds(scan, head));
    return check_rows(scan, head);
}

void ktg_ply_free_head(ply_head *head) {
    for (size_t i = 0; i < head->element_count; i++)
        ktg_free(head->elements[i].name);
    ktg_free(head->elements);
    ktg_free(head->properties);
    ktg_free(head->textures);
    *head = (ply_head){0};
}
