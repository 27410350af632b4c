/* mesh/weld.c - vertices at exactly the same position, faces twice there, faces without area. */
#include "mesh/weld.h"
#include "core/memory.h"
#include "core/vec.h"

#include <string.h>

static uint64_t mix(uint64_t key, uint64_t more) {
    key = (key ^ more) * 0x9e3779b97f4a7c15u;
    return key ^ (key >> 29);
}

static uint64_t position_hash(ktg_vec3 p) {
    double coordinates[3] = {p.x + 0.0, p.y + 0.0, p.z + 0.0}; /* -0 becomes 0 */
    uint64_t bits[3];
    memcpy(bits, coordinates, sizeof bits);
    return mix(mix(mix(0, bits[0]), bits[1]), bits[2]);
}

static bool same_position(ktg_vec3 a, ktg_vec3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* An open-addressing table for `count` items, all slots KTG_NONE, *mask its size less one. */
static uint32_t *table_new(ktg_context *context, size_t count, size_t *mask) {
    *mask = 15;
    while (*mask < 2 * count)
        *mask = 2 * *mask + 1;
    uint32_t *slots = ktg_new(context, *mask + 1, uint32_t);
    if (slots)
        memset(slots, 0xff, (*mask + 1) * sizeof *slots);
    return slots;
}

ktg_status ktg_mesh_weld(ktg_context *context, const ktg_vec3 *positions, uint32_t count,
                         uint32_t **first) {
    size_t mask;
    uint32_t *slots = table_new(context, count, &mask);
    *first = slots ? ktg_new(context, count, uint32_t) : NULL;
    for (uint32_t v = 0; *first && v < count; v++) {
        size_t slot = position_hash(positions[v]) & mask;
        while (slots[slot] != KTG_NONE && !same_position(positions[slots[slot]], positions[v]))
            slot = (slot + 1) & mask;
        if (slots[slot] == KTG_NONE)
            slots[slot] = v;
        (*first)[v] = slots[slot];
    }
    ktg_free(slots);
    return *first ? KTG_OK : KTG_MEMORY;
}

static void sorted_corners(const uint32_t *face, const uint32_t *weld, uint32_t sorted[3]) {
    uint32_t a = weld[face[0]], b = weld[face[1]], c = weld[face[2]], swap;
    if (a > b)
        swap = a, a = b, b = swap;
    if (b > c)
        swap = b, b = c, c = swap;
    if (a > b)
        swap = a, a = b, b = swap;
    sorted[0] = a, sorted[1] = b, sorted[2] = c;
}

ktg_status ktg_mesh_duplicates(ktg_context *context, const uint32_t *faces, uint32_t face_count,
                               const uint32_t *weld, bool *duplicate) {
    size_t mask;
    uint32_t *slots = table_new(context, face_count, &mask);
    if (!slots)
        return KTG_MEMORY;
    for (uint32_t f = 0; f < face_count; f++) {
        uint32_t key[3], other[3];
        sorted_corners(faces + 3 * (size_t)f, weld, key);
        duplicate[f] = false;
        if (key[0] == key[1] || key[1] == key[2])
            continue;
        size_t slot = mix(mix(mix(0, key[0]), key[1]), key[2]) & mask;
        for (; slots[slot] != KTG_NONE && !duplicate[f]; slot = (slot + 1) & mask) {
            sorted_corners(faces + 3 * (size_t)slots[slot], weld, other);
            duplicate[f] = memcmp(key, other, sizeof key) == 0;
        }
        if (!duplicate[f])
            slots[slot] = f;
    }
    ktg_free(slots);
    return KTG_OK;
}

static double largest(ktg_vec3 v, double before) {
    return fmax(fmax(fabs(v.x), fabs(v.y)), fmax(fabs(v.z), before));
}

double ktg_mesh_flatness(const ktg_vec3 corners[3], int *longest) {
    ktg_vec3 edge[3];
    double length[3], scale = 0;
    for (int k = 0; k < 3; k++) {
        edge[k] = ktg_sub3(corners[(k + 1) % 3], corners[k]);
        scale = largest(edge[k], scale);
    }
    *longest = 0;
    if (!(scale > 0))
        return 0;
    for (int k = 0; k < 3; k++) { /* so that nothing overflows, whatever the unit of the file */
        edge[k] = (ktg_vec3){edge[k].x / scale, edge[k].y / scale, edge[k].z / scale};
        length[k] = ktg_length3(edge[k]);
        if (length[k] > length[*longest])
            *longest = k;
    }
    double longest_length = length[*longest];
    return ktg_length3(ktg_cross3(edge[0], edge[1])) / (longest_length * longest_length);
}

bool ktg_mesh_is_degenerate(const ktg_mesh *mesh, uint32_t face, const uint32_t *weld) {
    const uint32_t *corner = mesh->faces + 3 * (size_t)face;
    uint32_t a = weld[corner[0]], b = weld[corner[1]], c = weld[corner[2]];
    if (a == b || b == c || c == a)
        return true;
    ktg_vec3 points[3] = {mesh->positions[a], mesh->positions[b], mesh->positions[c]};
    int longest;
    return ktg_mesh_flatness(points, &longest) < KTG_MESH_FLAT;
}
