/* unfold/sheet_room.c - how far pieces reach over their sheets. */
#include "unfold/sheet_room.h"
#include "core/memory.h"
#include "pattern/pattern.h"

/* The pull: what a face at the edge of its sheet costs, beside one that stands out by a unit. */
#define PULL 0.04

static double mean_length(const ktg_dual *dual) {
    double sum = 0;
    for (size_t h = 0; h < 3 * (size_t)dual->face_count; h++)
        sum += dual->lengths[h];
    return sum / (3.0 * dual->face_count);
}

ktg_status ktg_sheet_room_new(ktg_context *context, const ktg_arrangement *a, ktg_vec2 half,
                              double margin, ktg_sheet_room *room) {
    *room = (ktg_sheet_room){.a = a,
                             .half = half,
                             .unit = fmin(mean_length(a->dual), 0.25 * fmin(half.x, half.y)),
                             .margin = ktg_new(context, a->piece_count, double),
                             .cost = ktg_new(context, a->dual->face_count, double)};
    if (!room->margin || !room->cost)
        return KTG_MEMORY;
    for (uint32_t p = 0; p < a->piece_count; p++)
        room->margin[p] = margin;
    ktg_sheet_room_recount(room);
    return KTG_OK;
}

void ktg_sheet_room_free(ktg_sheet_room *room) {
    ktg_free(room->margin);
    ktg_free(room->cost);
    *room = (ktg_sheet_room){0};
}

static double cost_of_excess(double excess) {
    return excess > 0 ? excess * (1 + excess) : 0;
}

static double corner_over(const ktg_sheet_room *r, double margin, ktg_vec2 p) {
    return cost_of_excess((fabs(p.x) - r->half.x + margin) / r->unit) +
           cost_of_excess((fabs(p.y) - r->half.y + margin) / r->unit);
}

static double pull_on(const ktg_sheet_room *r, ktg_vec2 p) {
    double x = p.x / r->half.x, y = p.y / r->half.y;
    return PULL * (x * x * x * x + y * y * y * y);
}

static double face_cost(const ktg_sheet_room *r, uint32_t face, uint32_t piece,
                        const ktg_motion2 *motion) {
    const ktg_vec2 *p = r->a->corners + 3 * (size_t)face;
    double margin = r->margin[piece], sum = 0;
    ktg_vec2 middle = {0, 0};
    for (int k = 0; k < 3; k++) {
        ktg_vec2 at = ktg_move2(*motion, p[k]);
        middle = ktg_madd2(middle, 1.0 / 3, at);
        sum += corner_over(r, margin, at);
    }
    return sum + pull_on(r, middle);
}

static const ktg_motion2 still = {1, 0, {0, 0}};

void ktg_sheet_room_recount(ktg_sheet_room *r) {
    r->total = 0;
    for (uint32_t f = 0; f < r->a->dual->face_count; f++)
        r->total += r->cost[f] = face_cost(r, f, r->a->piece[f], &still);
}

bool ktg_sheet_room_allows(const ktg_sheet_room *r, const ktg_branch *branch,
                           const ktg_graft *graft, double allowed, double *change, uint64_t *work) {
    const uint32_t *faces = r->a->order + branch->first;
    uint32_t piece = r->a->piece[graft->other / 3];
    double before = 0, after = 0;
    for (uint32_t i = 0; i < branch->count; i++)
        before += r->cost[faces[i]];
    for (uint32_t i = 0; i < branch->count; i++) {
        after += face_cost(r, faces[i], piece, &graft->motion);
        if (after > before + allowed) {
            *work += i;
            return false;
        }
    }
    *work += branch->count;
    *change = after - before;
    return true;
}

void ktg_sheet_room_follow(ktg_sheet_room *r, const ktg_branch *branch) {
    for (uint32_t i = 0; i < branch->count; i++) {
        uint32_t face = r->a->order[branch->first + i];
        double cost = face_cost(r, face, r->a->piece[face], &still);
        r->total += cost - r->cost[face];
        r->cost[face] = cost;
    }
}

double ktg_sheet_room_over(const ktg_sheet_room *r, double *over_piece, uint32_t *pieces) {
    double sum = 0;
    uint32_t last = KTG_NONE;
    *pieces = 0;
    for (uint32_t p = 0; over_piece && p < r->a->piece_count; p++)
        over_piece[p] = 0;
    for (uint32_t i = 0; i < r->a->dual->face_count; i++) {
        uint32_t face = r->a->order[i], piece = r->a->piece[face];
        double over = 0;
        for (int k = 0; k < 3; k++)
            over += corner_over(r, r->margin[piece], r->a->corners[3 * (size_t)face + k]);
        sum += over;
        if (over_piece)
            over_piece[piece] += over;
        *pieces += over > 0 && piece != last;
        last = over > 0 ? piece : last;
    }
    return sum;
}

/* The motion that brings the corners' best box to the middle of the sheet. */
static ktg_status best_pose(ktg_context *context, const ktg_sheet_room *r, uint32_t piece,
                            ktg_vec2 *points, ktg_motion2 *pose) {
    const ktg_arrangement *a = r->a;
    size_t count = 0;
    double width = 2 * (r->half.x - r->margin[piece]), height = 2 * (r->half.y - r->margin[piece]);
    double rotation, magnification;
    ktg_vec2 low, high = {-INFINITY, -INFINITY};
    for (uint32_t f = 0; f < a->dual->face_count; f++)
        for (int k = 0; k < 3 && a->piece[f] == piece; k++)
            points[count++] = a->corners[3 * (size_t)f + k];
    KTG_TRY(ktg_best_fit(context, points, count, width, height, &rotation, &low, &magnification));
    *pose = (ktg_motion2){cos(rotation), sin(rotation), {0, 0}};
    for (size_t i = 0; i < count; i++) {
        ktg_vec2 p = ktg_move2(*pose, points[i]);
        high = (ktg_vec2){fmax(high.x, p.x), fmax(high.y, p.y)};
    }
    pose->t = ktg_mul2(ktg_add2(low, high), -0.5);
    return KTG_OK;
}

static double piece_cost(const ktg_sheet_room *r, uint32_t piece, const ktg_motion2 *motion) {
    double sum = 0;
    for (uint32_t f = 0; f < r->a->dual->face_count; f++)
        if (r->a->piece[f] == piece)
            sum += face_cost(r, f, piece, motion);
    return sum;
}

ktg_status ktg_sheet_room_pose(ktg_context *context, ktg_arrangement *a, ktg_sheet_room *r) {
    ktg_vec2 *points = ktg_new(context, 3 * (size_t)a->dual->face_count, ktg_vec2);
    ktg_status status = points ? KTG_OK : KTG_MEMORY;
    for (uint32_t p = 0; status == KTG_OK && p < a->piece_count; p++) {
        ktg_motion2 pose;
        status = best_pose(context, r, p, points, &pose);
        if (status == KTG_OK && piece_cost(r, p, &pose) < 0.999 * piece_cost(r, p, &still))
            status = ktg_arrangement_move(context, a, p, pose);
    }
    ktg_free(points);
    ktg_sheet_room_recount(r);
    return status;
}
