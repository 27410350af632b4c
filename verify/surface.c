/* verify/surface.c - the surface's own adjacency, computed anew, and its connected parts. */
#include "core/memory.h"
#include "verify/check.h"

#include <stdlib.h>
#include <string.h>

/* A half-edge under the two vertices it joins. */
typedef struct key {
    uint32_t low, high, halfedge;
} key;

static int by_vertices(const void *a, const void *b) {
    const key *p = a, *q = b;
    if (p->low != q->low)
        return p->low < q->low ? -1 : 1;
    if (p->high != q->high)
        return p->high < q->high ? -1 : 1;
    return p->halfedge < q->halfedge ? -1 : p->halfedge > q->halfedge;
}

/* `count` half-edges join the same two vertices. */
static void join(ktg_check *check, const key *keys, size_t count) {
    uint32_t a = keys[0].halfedge, b = keys[count - 1].halfedge;
    if (count > 2) {
        ktg_check_problem(check,
                          "%zu faces of the surface meet at the edge between its vertices "
                          "%u and %u.",
                          count, keys[0].low, keys[0].high);
    } else if (count == 2 && ktg_check_start(check, a) == ktg_check_start(check, b)) {
        ktg_check_problem(check, "Faces %u and %u of the surface are not oriented alike.", a / 3,
                          b / 3);
    } else if (count == 2) {
        check->twin[a] = b;
        check->twin[b] = a;
    }
}

static ktg_status find_twins(ktg_check *check) {
    uint32_t count = 3 * check->pattern->face_count;
    key *keys = ktg_new(check->context, count, key);
    if (!keys)
        return KTG_MEMORY;
    for (uint32_t h = 0; h < count; h++) {
        uint32_t a = ktg_check_start(check, h), b = ktg_check_start(check, ktg_check_next(h));
        keys[h] = (key){a < b ? a : b, a < b ? b : a, h};
        if (a == b)
            ktg_check_problem(check, "Face %u of the surface has vertex %u twice.", h / 3, a);
    }
    qsort(keys, count, sizeof *keys, by_vertices);
    memset(check->twin, 0xff, count * sizeof *check->twin);
    for (size_t first = 0, i = 1; i <= count; i++)
        if (i == count || keys[i].low != keys[first].low || keys[i].high != keys[first].high) {
            join(check, keys + first, i - first);
            first = i;
        }
    ktg_free(keys);
    return KTG_OK;
}

/* Numbers the parts of the surface that hang together through edges with two faces. */
static ktg_status find_components(ktg_check *check) {
    uint32_t count = check->pattern->face_count, depth = 0;
    uint32_t *stack = ktg_new(check->context, count, uint32_t);
    if (!stack)
        return KTG_MEMORY;
    memset(check->face_component, 0xff, count * sizeof *check->face_component);
    for (uint32_t seed = 0; seed < count; seed++) {
        if (check->face_component[seed] != KTG_NONE)
            continue;
        check->face_component[seed] = check->component_count;
        stack[depth++] = seed;
        while (depth > 0) {
            uint32_t face = stack[--depth];
            for (uint32_t h = 3 * face; h < 3 * face + 3; h++) {
                uint32_t other = check->twin[h] == KTG_NONE ? KTG_NONE : check->twin[h] / 3;
                if (other == KTG_NONE || check->face_component[other] != KTG_NONE)
                    continue;
                check->face_component[other] = check->component_count;
                stack[depth++] = other;
            }
        }
        check->component_count++;
    }
    ktg_free(stack);
    return KTG_OK;
}

/* The corner from which the two shorter edges of a face leave. */
static uint32_t sharp_corner(const ktg_check *check, uint32_t face) {
    double longest = -1;
    uint32_t best = 3 * face;
    for (uint32_t h = 3 * face; h < 3 * face + 3; h++) {
        double length = ktg_check_distance3(ktg_check_start3(check, h), ktg_check_end3(check, h));
        if (length > longest) {
            longest = length;
            best = ktg_check_next(ktg_check_next(h));
        }
    }
    return best;
}

/* From the two shorter edges, whose cross product loses the fewest digits on a needle. */
static ktg_vec3 area_vector(const ktg_check *check, uint32_t face) {
    uint32_t h = sharp_corner(check, face), before = ktg_check_next(ktg_check_next(h));
    ktg_vec3 at = ktg_check_start3(check, h);
    return ktg_cross3(ktg_sub3(ktg_check_end3(check, h), at),
                      ktg_sub3(ktg_check_start3(check, before), at));
}

ktg_vec3 ktg_check_normal(const ktg_check *check, uint32_t face) {
    return ktg_unit3(area_vector(check, face));
}

static void measure_widths(ktg_check *check) {
    for (uint32_t face = 0; face < check->pattern->face_count; face++) {
        double longest = 0;
        for (uint32_t h = 3 * face; h < 3 * face + 3; h++)
            longest = fmax(
                longest, ktg_check_distance3(ktg_check_start3(check, h), ktg_check_end3(check, h)));
        check->width[face] = longest > 0 ? ktg_length3(area_vector(check, face)) / longest : 0;
    }
}

ktg_status ktg_check_surface(ktg_check *check) {
    KTG_TRY(find_twins(check));
    if (check->report->problem_count > 0)
        return KTG_OK;
    KTG_TRY(find_components(check));
    measure_widths(check);
    return KTG_OK;
}
