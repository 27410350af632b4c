/* verify/refold.c - folding each piece by its stated angles and comparing where it lands.
 *
 * The widest face of a piece is put on its place on the surface; from there, breadth first, each
 * further face is turned about the fold it hangs on. Only the flat coordinates and the angles are
 * used on the way; the surface's vertices are what is compared with. */
#include "core/memory.h"
#include "verify/check.h"

/* Where the plane of a face lies in space: p -> at + p.x x + p.y y, with normal n = x cross y. */
typedef struct frame {
    ktg_vec3 at, x, y, n;
} frame;

static ktg_vec3 lift(const frame *f, ktg_vec2 p) {
    return ktg_madd3(ktg_madd3(f->at, p.x, f->x), p.y, f->y);
}

/* Makes x, y, n orthonormal again after rounding, and puts flat point p on P. */
static void settle(frame *f, ktg_vec2 p, ktg_vec3 P) {
    f->x = ktg_unit3(f->x);
    f->y = ktg_unit3(ktg_madd3(f->y, -ktg_dot3(f->x, f->y), f->x));
    f->n = ktg_cross3(f->x, f->y);
    f->at = ktg_madd3(ktg_madd3(P, -p.x, f->x), -p.y, f->y);
}

/* Unit vectors U along a direction u of the plane and V to its left, as x and y. */
static void from_direction(frame *f, ktg_vec2 u, ktg_vec3 U, ktg_vec3 V) {
    f->x = ktg_madd3(ktg_mul3(U, u.x), -u.y, V);
    f->y = ktg_madd3(ktg_mul3(U, u.y), u.x, V);
}

/* Puts a face on its place by its longest edge and its normal. */
static frame place(const ktg_check *check, uint32_t face) {
    frame f;
    double longest = -1;
    uint32_t best = 3 * face;
    for (uint32_t h = 3 * face; h < 3 * face + 3; h++) {
        double length = ktg_check_distance3(ktg_check_start3(check, h), ktg_check_end3(check, h));
        if (length > longest) {
            longest = length;
            best = h;
        }
    }
    ktg_vec2 start = ktg_check_start2(check, best);
    ktg_vec2 u = ktg_unit2(ktg_sub2(ktg_check_end2(check, best), start));
    ktg_vec3 U = ktg_unit3(ktg_sub3(ktg_check_end3(check, best), ktg_check_start3(check, best)));
    from_direction(&f, u, U, ktg_cross3(ktg_check_normal(check, face), U));
    settle(&f, start, ktg_check_start3(check, best));
    return f;
}

/* The frame of the face across fold h: turned about the fold by `angle`, away from the normal for a
 * mountain. */
static frame turn(const ktg_check *check, const frame *f, uint32_t h, double angle) {
    frame g;
    ktg_vec2 start = ktg_check_start2(check, h);
    ktg_vec2 u = ktg_unit2(ktg_sub2(ktg_check_end2(check, h), start));
    ktg_vec3 U = ktg_madd3(ktg_mul3(f->x, u.x), u.y, f->y);
    ktg_vec3 V = ktg_madd3(ktg_mul3(f->x, -u.y), u.x, f->y);
    from_direction(&g, u, U, ktg_madd3(ktg_mul3(V, cos(angle)), sin(angle), f->n));
    settle(&g, start, lift(f, start));
    return g;
}

/* Largest distance of the three corners to their places. */
static double miss(const ktg_check *check, const frame *f, uint32_t face) {
    double most = 0;
    for (uint32_t h = 3 * face; h < 3 * face + 3; h++) {
        double distance =
            ktg_check_distance3(lift(f, ktg_check_start2(check, h)), ktg_check_start3(check, h));
        most = distance <= most ? most : distance; /* a NaN stays */
    }
    return most;
}

static uint32_t widest_face(const ktg_check *check, const ktg_pattern_piece *piece) {
    uint32_t best = piece->faces[0];
    for (size_t i = 1; i < piece->face_count; i++)
        if (check->width[piece->faces[i]] > check->width[best])
            best = piece->faces[i];
    return best;
}

/* frames, queue, seen: one item for each face of the surface. Reports the worst face only. */
static void refold_piece(ktg_check *check, uint32_t id, frame *frames, uint32_t *queue,
                         uint8_t *seen) {
    uint32_t root = widest_face(check, &check->pattern->pieces[id]), worst = root;
    size_t first = 0, last = 0;
    double most = 0;
    frames[root] = place(check, root);
    seen[root] = 1;
    queue[last++] = root;
    while (first < last) {
        uint32_t face = queue[first++];
        double distance = miss(check, &frames[face], face);
        if (!(distance <= most)) {
            most = distance;
            worst = face;
        }
        for (uint32_t h = 3 * face; h < 3 * face + 3; h++) {
            uint32_t other = check->fold[h] ? check->twin[h] / 3 : KTG_NONE;
            if (other == KTG_NONE || seen[other] || check->edge_at[h] == KTG_NONE)
                continue;
            seen[other] = 1;
            frames[other] =
                turn(check, &frames[face], h, check->pattern->edges[check->edge_at[h]].angle);
            queue[last++] = other;
        }
    }
    double error = most / check->diagonal;
    check->report->refold_error = fmax(check->report->refold_error, error);
    if (!(error <= KTG_VERIFY_REFOLD))
        ktg_check_problem(check,
                          "Piece %u, folded by its angles, misses the surface: face %u ends "
                          "up %.3g of the diagonal from its place.",
                          id + 1, worst, error);
}

ktg_status ktg_check_refold(ktg_check *check) {
    const ktg_pattern *p = check->pattern;
    frame *frames = ktg_new(check->context, p->face_count, frame);
    uint32_t *queue = ktg_new(check->context, p->face_count, uint32_t);
    uint8_t *seen = ktg_new(check->context, p->face_count, uint8_t);
    ktg_status status = frames && queue && seen ? KTG_OK : KTG_MEMORY;
    for (uint32_t i = 0; status == KTG_OK && i < p->piece_count; i++)
        refold_piece(check, i, frames, queue, seen);
    ktg_free(frames);
    ktg_free(queue);
    ktg_free(seen);
    return status;
}
