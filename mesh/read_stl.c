/* mesh/read_stl.c - STL, ASCII and binary. Facets bring their own corners; corners that coincide
 * exactly, as floats, become one vertex. Facet normals are passed over: the order of the corners
 * says which side is out. */
#include "core/memory.h"
#include "mesh/read.h"

#include <math.h>
#include <string.h>

/* Binary: 80 bytes of text, the number of facets, then 50 bytes each: normal, three corners
 * (floats, little-endian), 2 bytes of no meaning. */
#define HEADER 84
#define FACET  50

/* ---- welding ------------------------------------------------------------------------------ */

/* Open addressing over the soup's vertices; slots hold vertex numbers or KTG_NONE. */
typedef struct weld {
    uint32_t *slots;
    size_t slot_count; /* a power of two */
} weld;

/* A corner as floats, by which corners are compared; + 0.0f makes -0 a 0, which it equals. */
typedef struct key {
    float x, y, z;
} key;

static key key_of(ktg_vec3 p) {
    return (key){(float)p.x + 0.0f, (float)p.y + 0.0f, (float)p.z + 0.0f};
}

static size_t hash_key(key k) {
    uint32_t bits[3];
    memcpy(bits, &k, sizeof bits);
    uint64_t hash = bits[0] | (uint64_t)bits[1] << 32;
    hash = (hash ^ (hash >> 29)) * 0xbf58476d1ce4e5b9u + bits[2];
    hash = (hash ^ (hash >> 30)) * 0x94d049bb133111ebu;
    return (size_t)(hash ^ (hash >> 31));
}

static size_t find_slot(const weld *w, const ktg_soup *soup, ktg_vec3 p) {
    key wanted = key_of(p);
    size_t slot = hash_key(wanted) & (w->slot_count - 1);
    for (; w->slots[slot] != KTG_NONE; slot = (slot + 1) & (w->slot_count - 1)) {
        key there = key_of(soup->positions[w->slots[slot]]);
        if (wanted.x == there.x && wanted.y == there.y && wanted.z == there.z)
            break;
    }
    return slot;
}

/* Keeps at least half of the slots free. */
static ktg_status grow_slots(ktg_context *context, weld *w, const ktg_soup *soup) {
    if (2 * (soup->vertex_count + 1) <= w->slot_count)
        return KTG_OK;
    size_t grown = w->slot_count ? 2 * w->slot_count : 1024;
    uint32_t *slots = ktg_new(context, grown, uint32_t);
    if (!slots)
        return KTG_MEMORY;
    memset(slots, 0xff, grown * sizeof *slots);
    ktg_free(w->slots);
    *w = (weld){slots, grown};
    for (size_t i = 0; i < soup->vertex_count; i++)
        slots[find_slot(w, soup, soup->positions[i])] = (uint32_t)i;
    return KTG_OK;
}

/* Appends a corner at `p` to the open polygon. */
static ktg_status add_corner(ktg_context *context, weld *w, ktg_soup *soup, ktg_vec3 p) {
    KTG_TRY(grow_slots(context, w, soup));
    size_t slot = find_slot(w, soup, p);
    if (w->slots[slot] == KTG_NONE) {
        KTG_TRY(ktg_soup_vertex(context, soup, p));
        w->slots[slot] = (uint32_t)(soup->vertex_count - 1);
    }
    return ktg_soup_corner(context, soup, w->slots[slot], KTG_NONE);
}

/* ---- binary ------------------------------------------------------------------------------- */

static uint32_t little_endian(const char *at) {
    const unsigned char *b = (const unsigned char *)at;
    return b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

bool ktg_stl_fits(const char *bytes, size_t size) {
    if (size <= HEADER)
        return false;
    uint64_t facets = little_endian(bytes + 80);
    return facets > 0 && size == HEADER + FACET * facets;
}

static ktg_status read_binary_facet(ktg_scan *scan, weld *w, ktg_soup *soup, uint32_t facet) {
    for (int corner = 0; corner < 3; corner++) {
        float p[3];
        for (int k = 0; k < 3; k++) {
            uint32_t bits = little_endian(scan->at + 12 + 12 * corner + 4 * k);
            memcpy(&p[k], &bits, sizeof bits);
            if (!isfinite(p[k]))
                return ktg_scan_fail(scan, KTG_FORMAT,
                                     "facet %u has a coordinate that is not a finite number",
                                     facet + 1);
        }
        KTG_TRY(add_corner(scan->context, w, soup, (ktg_vec3){p[0], p[1], p[2]}));
    }
    return ktg_soup_close_polygon(scan->context, soup);
}

static ktg_status read_binary(ktg_scan *scan, weld *w, ktg_soup *soup) {
    size_t size = (size_t)(scan->end - scan->start);
    scan->line = 0;
    if (size < HEADER)
        return ktg_scan_fail(scan, KTG_FORMAT,
                             "is too short for an STL file: %zu bytes, its head alone is %d", size,
                             HEADER);
    uint32_t facets = little_endian(scan->start + 80);
    uint64_t wanted = HEADER + FACET * (uint64_t)facets;
    if (wanted > size)
        return ktg_scan_fail(scan, KTG_FORMAT,
                             "is truncated, or not an STL file: its head announces %u facets, "
                             "there is room for %zu",
                             facets, (size - HEADER) / FACET);
    scan->at = scan->start + HEADER;
    for (uint32_t i = 0; i < facets; i++, scan->at += FACET) {
        KTG_TRY(ktg_scan_row(scan));
        KTG_TRY(read_binary_facet(scan, w, soup, i));
    }
    if (wanted < size)
        ktg_log(scan->context, KTG_LOG_WARNING, "%s: %llu bytes behind the last facet were ignored",
                scan->name, (unsigned long long)(size - wanted));
    return KTG_OK;
}

/* ---- ASCII -------------------------------------------------------------------------------- */

static ktg_status fail_word(ktg_scan *scan, ktg_word word, const char *wanted) {
    char shown[KTG_SHOWN_SIZE];
    if (word.length == 0)
        return ktg_scan_fail(scan, KTG_FORMAT, "the file is truncated: %s is wanted here", wanted);
    return ktg_scan_fail(scan, KTG_FORMAT, "\"%s\" stands where %s is wanted",
                         ktg_word_show(word, shown), wanted);
}

static ktg_word next_word(ktg_scan *scan) {
    (void)ktg_scan_content(scan);
    return ktg_scan_word(scan);
}

static ktg_status expect(ktg_scan *scan, const char *wanted) {
    ktg_word word = next_word(scan);
    return ktg_word_means(word, wanted) ? KTG_OK : fail_word(scan, word, wanted);
}

/* From behind "facet" to "endfacet". */
static ktg_status read_ascii_facet(ktg_scan *scan, weld *w, ktg_soup *soup) {
    ktg_scan_next_line(scan); /* the normal */
    KTG_TRY(expect(scan, "outer"));
    KTG_TRY(expect(scan, "loop"));
    ktg_word word = next_word(scan);
    for (; ktg_word_means(word, "vertex"); word = next_word(scan)) {
        ktg_vec3 p;
        KTG_TRY(ktg_scan_number(scan, "the x of a vertex", &p.x));
        KTG_TRY(ktg_scan_number(scan, "the y of a vertex", &p.y));
        KTG_TRY(ktg_scan_number(scan, "the z of a vertex", &p.z));
        if (!isfinite((float)p.x) || !isfinite((float)p.y) || !isfinite((float)p.z))
            return ktg_scan_fail(scan, KTG_FORMAT,
                                 "a coordinate is too large for STL, which holds floats");
        KTG_TRY(add_corner(scan->context, w, soup, p));
    }
    if (!ktg_word_means(word, "endloop"))
        return fail_word(scan, word, "vertex or endloop");
    if (ktg_soup_open_corners(soup) < 3)
        return ktg_scan_fail(scan, KTG_FORMAT, "a facet needs three corners, this one has %zu",
                             ktg_soup_open_corners(soup));
    KTG_TRY(expect(scan, "endfacet"));
    return ktg_soup_close_polygon(scan->context, soup);
}

/* The facets of one solid, from behind its first line to "endsolid". */
static ktg_status read_solid(ktg_scan *scan, weld *w, ktg_soup *soup) {
    ktg_word word = next_word(scan);
    for (; ktg_word_means(word, "facet"); word = next_word(scan)) {
        KTG_TRY(ktg_scan_row(scan));
        KTG_TRY(read_ascii_facet(scan, w, soup));
    }
    if (!ktg_word_means(word, "endsolid"))
        return fail_word(scan, word, "facet or endsolid");
    ktg_scan_next_line(scan);
    return KTG_OK;
}

/* A file may hold several solids; then their names become objects. (The name of a single one is
 * mostly that of the program that wrote it.) */
static ktg_status read_ascii(ktg_scan *scan, weld *w, ktg_soup *soup) {
    size_t solids = 0;
    for (; ktg_scan_content(scan); solids++) {
        KTG_TRY(expect(scan, "solid"));
        KTG_TRY(ktg_name_number(scan->context, &soup->objects, ktg_scan_rest(scan), &soup->object));
        KTG_TRY(read_solid(scan, w, soup));
    }
    if (solids == 1)
        ktg_name_table_free(&soup->objects);
    return KTG_OK;
}

static bool is_ascii(const ktg_scan *scan) {
    ktg_scan copy = *scan;
    size_t size = (size_t)(scan->end - scan->start);
    return !ktg_stl_fits(scan->start, size) && !memchr(scan->start, 0, size) &&
           ktg_scan_content(&copy) && ktg_word_means(ktg_scan_word(&copy), "solid");
}

ktg_status ktg_read_stl(ktg_scan *scan, ktg_soup *soup) {
    weld w = {0};
    ktg_status status = is_ascii(scan) ? read_ascii(scan, &w, soup) : read_binary(scan, &w, soup);
    ktg_free(w.slots);
    return status;
}
