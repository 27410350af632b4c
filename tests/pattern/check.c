/* tests/pattern/check.c - proves the tabs of a finished pattern by looking at all pairs. */
#include "check.h"

#include "core/vec.h"

#include <stdlib.h>
#include <string.h>

typedef struct polygon {
    ktg_vec2 p[16];
    size_t count;
} polygon;

double area_of_polygon(const ktg_vec2 *p, size_t count) {
    double twice = 0;
    for (size_t i = 0; i < count; i++)
        twice += ktg_cross2(p[i], p[(i + 1) % count]);
    return twice / 2;
}

static polygon face_of(const ktg_pattern_piece *piece, size_t slot) {
    polygon q = {.count = 3};
    for (int k = 0; k < 3; k++)
        q.p[k] = piece->vertices[piece->corners[3 * slot + k]];
    return q;
}

static polygon tab_polygon(const ktg_pattern_tab *tab) {
    polygon q = {.count = tab->corner_count};
    memcpy(q.p, tab->corners, sizeof tab->corners);
    return q;
}

/* The shortest translation that separates two convex polygons; 0 when they are apart. */
static double overlap(const polygon *a, const polygon *b) {
    double least = INFINITY;
    for (int which = 0; which < 2; which++) {
        const polygon *q = which ? b : a;
        for (size_t i = 0; i < q->count; i++) {
            ktg_vec2 n = ktg_unit2(ktg_perp2(ktg_sub2(q->p[(i + 1) % q->count], q->p[i])));
            double a0 = INFINITY, a1 = -INFINITY, b0 = INFINITY, b1 = -INFINITY;
            for (size_t k = 0; k < a->count; k++) {
                a0 = fmin(a0, ktg_dot2(n, a->p[k]));
                a1 = fmax(a1, ktg_dot2(n, a->p[k]));
            }
            for (size_t k = 0; k < b->count; k++) {
                b0 = fmin(b0, ktg_dot2(n, b->p[k]));
                b1 = fmax(b1, ktg_dot2(n, b->p[k]));
            }
            least = fmin(least, fmin(a1 - b0, b1 - a0));
        }
    }
    return fmax(0, least);
}

static double to_segment(ktg_vec2 p, ktg_vec2 a, ktg_vec2 b) {
    ktg_vec2 d = ktg_sub2(b, a), v = ktg_sub2(p, a);
    double s = fmax(0, fmin(1, ktg_dot2(v, d) / ktg_dot2(d, d)));
    return ktg_length2(ktg_madd2(v, -s, d));
}

/* The distance of the sides of two polygons that do not overlap (b may be a segment). */
static double distance(const polygon *a, const ktg_vec2 *b, size_t count) {
    double least = INFINITY;
    for (size_t i = 0; i < a->count; i++)
        for (size_t k = 0; k < count; k++) {
            ktg_vec2 p = a->p[i], q = a->p[(i + 1) % a->count], r = b[k], s = b[(k + 1) % count];
            least = fmin(least, fmin(to_segment(r, p, q), to_segment(p, r, s)));
        }
    return least;
}

/* The area two convex counter-clockwise polygons have in common. */
static double common_area(polygon a, const polygon *b) {
    for (size_t i = 0; i < b->count && a.count > 0; i++) {
        ktg_vec2 from = b->p[i], d = ktg_sub2(b->p[(i + 1) % b->count], from);
        polygon kept = {.count = 0};
        for (size_t k = 0; k < a.count; k++) {
            ktg_vec2 p = a.p[k], q = a.p[(k + 1) % a.count];
            double dp = ktg_cross2(d, ktg_sub2(p, from)), dq = ktg_cross2(d, ktg_sub2(q, from));
            if (dp >= 0)
                kept.p[kept.count++] = p;
            if ((dp >= 0) != (dq >= 0))
                kept.p[kept.count++] = ktg_madd2(p, dp / (dp - dq), ktg_sub2(q, p));
        }
        a = kept;
    }
    return a.count >= 3 ? area_of_polygon(a.p, a.count) : 0;
}

/* Flat regions by spreading numbers until nothing changes. */
static uint32_t *regions_of(const ktg_pattern *pattern) {
    uint32_t *region = calloc(pattern->face_count, sizeof *region);
    for (uint32_t f = 0; f < pattern->face_count; f++)
        region[f] = f;
    for (bool changed = true; changed;) {
        changed = false;
        for (size_t e = 0; e < pattern->edge_count; e++) {
            const ktg_pattern_edge *edge = &pattern->edges[e];
            if (edge->kind != KTG_EDGE_FLAT)
                continue;
            uint32_t *a = &region[edge->sides[0].face], *b = &region[edge->sides[1].face];
            changed |= *a != *b;
            *a = *b = *a < *b ? *a : *b;
        }
    }
    return region;
}

typedef struct checking {
    const ktg_pattern *pattern;
    uint32_t *region;
    uint32_t *slot; /* of a face in its piece */
    struct placed {
        polygon polygon;
        uint32_t piece, region;
    } * under;
    size_t under_count;
    check_result result;
} checking;

static void side_ends(const checking *c, const ktg_pattern_side *side, ktg_vec2 ends[2]) {
    const ktg_pattern_piece *piece = &c->pattern->pieces[side->piece];
    const uint32_t *corners = &piece->corners[3 * c->slot[side->face]];
    ends[0] = piece->vertices[corners[side->corner]];
    ends[1] = piece->vertices[corners[(side->corner + 1) % 3]];
}

/* Leaves of a segment what lies on the tab's side of its edge: on the other side is the tab's own
 * face, which keeps them apart. False when nothing is left. */
static bool keep_beside(const ktg_pattern_tab *tab, ktg_vec2 ends[2]) {
    ktg_vec2 last = tab->corners[tab->corner_count - 1];
    ktg_vec2 along = ktg_unit2(ktg_sub2(tab->corners[0], last));
    double y[2];
    for (int k = 0; k < 2; k++)
        y[k] = ktg_cross2(along, ktg_sub2(ends[k], last)) + 1e-6;
    if (y[0] < 0 && y[1] < 0)
        return false;
    for (int k = 0; k < 2; k++)
        if (y[k] < 0)
            ends[k] = ktg_madd2(ends[k], y[k] / (y[k] - y[1 - k]), ktg_sub2(ends[1 - k], ends[k]));
    return true;
}

static void check_beside(checking *c, uint32_t p, size_t i) {
    const ktg_pattern_piece *piece = &c->pattern->pieces[p];
    const ktg_pattern_tab *tab = &piece->tabs[i];
    polygon q = tab_polygon(tab);
    for (size_t slot = 0; slot < piece->face_count; slot++) {
        polygon face = face_of(piece, slot);
        c->result.deepest = fmax(c->result.deepest, overlap(&q, &face));
    }
    for (size_t k = 0; k < i; k++) {
        polygon other = tab_polygon(&piece->tabs[k]);
        c->result.deepest = fmax(c->result.deepest, overlap(&q, &other));
        for (size_t n = 0; n < other.count; n++) {
            ktg_vec2 ends[2] = {other.p[n], other.p[(n + 1) % other.count]};
            if (keep_beside(tab, ends))
                c->result.least_air = fmin(c->result.least_air, distance(&q, ends, 2));
        }
    }
    for (size_t e = 0; e < c->pattern->edge_count; e++) {
        const ktg_pattern_edge *edge = &c->pattern->edges[e];
        bool border = edge->kind == KTG_EDGE_CUT || edge->kind == KTG_EDGE_BORDER;
        for (uint32_t s = 0; border && s < edge->side_count; s++) {
            if (edge->sides[s].piece != p || (e == tab->edge && (int)s == edge->tab_on))
                continue;
            ktg_vec2 ends[2];
            side_ends(c, &edge->sides[s], ends);
            if (keep_beside(tab, ends))
                c->result.least_air = fmin(c->result.least_air, distance(&q, ends, 2));
        }
    }
}

static void check_under(checking *c, const ktg_pattern_tab *tab) {
    const ktg_pattern_edge *edge = &c->pattern->edges[tab->edge];
    const ktg_pattern_side *mate = &edge->sides[1 - edge->tab_on];
    ktg_vec2 from[2], to[2];
    side_ends(c, &edge->sides[edge->tab_on], from);
    side_ends(c, mate, to);
    ktg_motion2 motion = ktg_motion2_between(from[0], from[1], to[1], to[0]);
    struct placed placed = {tab_polygon(tab), mate->piece, c->region[mate->face]};
    for (size_t i = 0; i < placed.polygon.count; i++)
        placed.polygon.p[i] = ktg_move2(motion, placed.polygon.p[i]);
    double inside = 0;
    for (size_t e = 0; e < c->pattern->edge_count; e++)
        for (uint32_t s = 0; s < c->pattern->edges[e].side_count; s++) {
            const ktg_pattern_side *side = &c->pattern->edges[e].sides[s];
            if (c->region[side->face] != placed.region)
                continue;
            if (side->corner == 0) {
                polygon face = face_of(&c->pattern->pieces[side->piece], c->slot[side->face]);
                inside += common_area(placed.polygon, &face);
            }
            ktg_vec2 ends[2];
            side_ends(c, side, ends);
            if (c->pattern->edges[e].kind != KTG_EDGE_FLAT && side != mate)
                c->result.least_inset =
                    fmin(c->result.least_inset, distance(&placed.polygon, ends, 2));
        }
    double area = area_of_polygon(placed.polygon.p, placed.polygon.count);
    c->result.most_outside = fmax(c->result.most_outside, area - inside);
    for (size_t k = 0; k < c->under_count; k++)
        if (c->under[k].piece == placed.piece && c->under[k].region == placed.region)
            c->result.deepest =
                fmax(c->result.deepest, overlap(&placed.polygon, &c->under[k].polygon));
    c->under[c->under_count++] = placed;
}

static void check_outline(checking *c, const ktg_pattern_piece *piece) {
    double area = 0;
    for (size_t slot = 0; slot < piece->face_count; slot++)
        area += area_of_polygon(face_of(piece, slot).p, 3);
    for (size_t i = 0; i < piece->tab_count; i++)
        area += area_of_polygon(piece->tabs[i].corners, piece->tabs[i].corner_count);
    double outline = area_of_polygon(piece->outline, piece->outline_count);
    c->result.worst_outline = fmax(c->result.worst_outline, fabs(outline - area) / area);
}

check_result check_tabs(const ktg_pattern *pattern) {
    checking c = {.pattern = pattern, .region = regions_of(pattern)};
    c.result.least_inset = c.result.least_air = INFINITY;
    c.slot = calloc(pattern->face_count, sizeof *c.slot);
    c.under = calloc(pattern->edge_count, sizeof *c.under);
    for (uint32_t p = 0; p < pattern->piece_count; p++)
        for (uint32_t slot = 0; slot < pattern->pieces[p].face_count; slot++)
            c.slot[pattern->pieces[p].faces[slot]] = slot;
    for (uint32_t p = 0; p < pattern->piece_count; p++) {
        const ktg_pattern_piece *piece = &pattern->pieces[p];
        for (size_t i = 0; i < piece->tab_count; i++) {
            check_beside(&c, p, i);
            check_under(&c, &piece->tabs[i]);
            c.result.tabs++;
        }
        check_outline(&c, piece);
    }
    free(c.region);
    free(c.slot);
    free(c.under);
    return c.result;
}

static bool sides_meet(ktg_vec2 a, ktg_vec2 b, ktg_vec2 c, ktg_vec2 d) {
    ktg_vec2 ab = ktg_sub2(b, a), cd = ktg_sub2(d, c);
    double p = ktg_cross2(ab, ktg_sub2(c, a)), q = ktg_cross2(ab, ktg_sub2(d, a));
    double r = ktg_cross2(cd, ktg_sub2(a, c)), s = ktg_cross2(cd, ktg_sub2(b, c));
    if ((p > 0) != (q > 0) && (r > 0) != (s > 0))
        return true;
    return to_segment(a, c, d) == 0 || to_segment(b, c, d) == 0 || to_segment(c, a, b) == 0;
}

bool is_simple(const ktg_vec2 *p, size_t count) {
    for (size_t i = 0; i < count; i++)
        for (size_t k = i + 2; k < count; k++)
            if (!(i == 0 && k == count - 1) && sides_meet(p[i], p[i + 1], p[k], p[(k + 1) % count]))
                return false;
    return count >= 3;
}
