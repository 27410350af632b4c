/* flatten/start.c - flat shapes to start from: conformal with a border that keeps its length, and
 * Tutte's.
 *
 * Sawhney & Crane, "Boundary First Flattening" (2017): the scale factors e^u of a conformal map to
 * the plane solve L u = -K inside (K: angle defects), here with u = 0 on the border. What flows out
 * at the border turns it: exterior angles k - h. Lengths and angles make the border's curve, which
 * is closed by the least change of lengths, and the inside is its harmonic extension. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/iterate.h"

/* A border walked once, counter-clockwise. */
typedef struct border {
    uint32_t count;
    uint32_t *vertices;
    double *lengths; /* from each vertex to the next */
    double *angles;  /* direction of that edge on the flat panel */
} border;

static void free_border(border *b) {
    ktg_free(b->vertices);
    ktg_free(b->lengths);
    ktg_free(b->angles);
}

static bool is_on_border(const ktg_panel *panel, uint32_t v) {
    return panel->adjacency->twin[panel->leaving[v]] == KTG_NONE;
}

static ktg_status walk_border(ktg_context *context, const ktg_panel *panel, border *b) {
    uint32_t first = 0;
    while (!is_on_border(panel, first))
        first++;
    b->vertices = ktg_new(context, panel->vertex_count, uint32_t);
    b->lengths = ktg_new(context, panel->vertex_count, double);
    b->angles = ktg_new(context, panel->vertex_count, double);
    if (!b->vertices || !b->lengths || !b->angles)
        return KTG_MEMORY;
    uint32_t v = first;
    do {
        uint32_t next = panel->faces[ktg_halfedge_next(panel->leaving[v])];
        b->vertices[b->count] = v;
        b->lengths[b->count++] = ktg_length3(ktg_sub3(panel->positions[next], panel->positions[v]));
        v = next;
    } while (v != first);
    return KTG_OK;
}

static ktg_status hold_border(ktg_context *context, const ktg_panel *panel,
                              ktg_laplacian **inside) {
    bool *held = ktg_new(context, panel->vertex_count, bool);
    if (!held)
        return KTG_MEMORY;
    for (uint32_t v = 0; v < panel->vertex_count; v++)
        held[v] = is_on_border(panel, v);
    ktg_status status = ktg_laplacian_new(context, panel, held, inside);
    ktg_free(held);
    return status;
}

/* ---- conformal ---------------------------------------------------------------------------- */

void ktg_angle_defects(const ktg_panel *panel, const ktg_rest *rests, ktg_vec2 *defects) {
    for (uint32_t v = 0; v < panel->vertex_count; v++)
        defects[v] = (ktg_vec2){is_on_border(panel, v) ? KTG_PI : 2 * KTG_PI, 0};
    for (uint32_t f = 0; f < panel->face_count; f++) {
        const uint32_t *v = panel->faces + 3 * (size_t)f;
        double length = 1 / rests[f].inverse_length, height = 1 / rests[f].inverse_height;
        double a = atan2(height, rests[f].x), b = atan2(height, length - rests[f].x);
        defects[v[0]].x -= a;
        defects[v[1]].x -= b;
        defects[v[2]].x -= KTG_PI - a - b;
    }
}

/* Adds to each border vertex's exterior angle what flows out there: (L u) where u is 0. */
static void add_flow(const ktg_panel *panel, const double *weights, const ktg_vec2 *u,
                     ktg_vec2 *defects) {
    for (uint32_t h = 0; h < panel->adjacency->halfedge_count; h++) {
        uint32_t a = panel->faces[h], b = panel->faces[ktg_halfedge_next(h)];
        uint32_t edge = panel->adjacency->halfedge_edge[h];
        if (is_on_border(panel, a))
            defects[a].x -= weights[edge] * u[b].x;
    }
}

/* Changes the lengths so that the curve closes: least sum (l' - l)^2 / l. */
static void close_curve(border *b) {
    double xx = 0, xy = 0, yy = 0;
    ktg_vec2 gap = {0, 0};
    for (uint32_t i = 0; i < b->count; i++) {
        ktg_vec2 t = {cos(b->angles[i]), sin(b->angles[i])};
        gap = ktg_madd2(gap, b->lengths[i], t);
        xx += b->lengths[i] * t.x * t.x;
        xy += b->lengths[i] * t.x * t.y;
        yy += b->lengths[i] * t.y * t.y;
    }
    double determinant = xx * yy - xy * xy;
    ktg_vec2 pull = {(yy * gap.x - xy * gap.y) / determinant,
                     (xx * gap.y - xy * gap.x) / determinant};
    for (uint32_t i = 0; i < b->count; i++) {
        ktg_vec2 t = {cos(b->angles[i]), sin(b->angles[i])};
        b->lengths[i] -= b->lengths[i] * ktg_dot2(t, pull);
    }
}

static void lay_border(border *b, const ktg_vec2 *turns, ktg_vec2 *flat) {
    double angle = 0;
    for (uint32_t i = 0; i < b->count; i++) {
        angle += i > 0 ? turns[b->vertices[i]].x : 0;
        b->angles[i] = angle;
    }
    close_curve(b);
    ktg_vec2 at = {0, 0};
    for (uint32_t i = 0; i < b->count; i++) {
        flat[b->vertices[i]] = at;
        at = ktg_madd2(at, b->lengths[i], (ktg_vec2){cos(b->angles[i]), sin(b->angles[i])});
    }
}

typedef struct conformal_work {
    border border;
    ktg_laplacian *inside;
    double *weights;
    ktg_vec2 *defects;
} conformal_work;

static ktg_status conformal(ktg_context *context, const ktg_panel *panel, const ktg_rest *rests,
                            conformal_work *work, ktg_vec2 *flat) {
    KTG_TRY(walk_border(context, panel, &work->border));
    KTG_TRY(hold_border(context, panel, &work->inside));
    work->weights = ktg_new(context, panel->adjacency->edge_count, double);
    work->defects = ktg_new(context, panel->vertex_count, ktg_vec2);
    if (!work->weights || !work->defects)
        return KTG_MEMORY;
    ktg_cotangent_weights(panel, rests, work->weights);
    KTG_TRY(ktg_laplacian_factor(context, work->inside, work->weights));
    ktg_angle_defects(panel, rests, work->defects);
    KTG_TRY(ktg_laplacian_solve(context, work->inside, work->defects, flat)); /* -u */
    for (uint32_t v = 0; v < panel->vertex_count; v++)
        flat[v].x = -flat[v].x;
    add_flow(panel, work->weights, flat, work->defects);
    lay_border(&work->border, work->defects, flat);
    return ktg_laplacian_extend(context, work->inside, flat);
}

ktg_status ktg_conformal_start(ktg_context *context, const ktg_panel *panel, const ktg_rest *rests,
                               ktg_vec2 *flat) {
    conformal_work work = {0};
    ktg_status status = conformal(context, panel, rests, &work, flat);
    free_border(&work.border);
    ktg_laplacian_free(&work.inside);
    ktg_free(work.weights);
    ktg_free(work.defects);
    return status;
}

/* ---- convex ------------------------------------------------------------------------------- */

/* Around a circle with the panel's area, half by length and half by number, so that short edges
 * keep a place of their own. */
static void lay_circle(const ktg_panel *panel, const ktg_rest *rests, const border *b,
                       ktg_vec2 *flat) {
    double area = 0, length = 0, angle = 0;
    for (uint32_t f = 0; f < panel->face_count; f++)
        area += rests[f].area;
    for (uint32_t i = 0; i < b->count; i++)
        length += b->lengths[i];
    double radius = sqrt(area / KTG_PI);
    for (uint32_t i = 0; i < b->count; i++) {
        flat[b->vertices[i]] = (ktg_vec2){radius * cos(angle), radius * sin(angle)};
        angle += KTG_PI * (b->lengths[i] / length + 1.0 / b->count);
    }
}

static ktg_status extend_alike(ktg_context *context, const ktg_panel *panel, ktg_laplacian *inside,
                               ktg_vec2 *flat) {
    double *weights = ktg_new(context, panel->adjacency->edge_count, double);
    if (!weights)
        return KTG_MEMORY;
    for (uint32_t e = 0; e < panel->adjacency->edge_count; e++)
        weights[e] = 1;
    ktg_status status = ktg_laplacian_factor(context, inside, weights);
    ktg_free(weights);
    return status == KTG_OK ? ktg_laplacian_extend(context, inside, flat) : status;
}

ktg_status ktg_convex_start(ktg_context *context, const ktg_panel *panel, const ktg_rest *rests,
                            ktg_vec2 *flat) {
    border b = {0};
    ktg_laplacian *inside = NULL;
    ktg_status status = walk_border(context, panel, &b);
    if (status == KTG_OK)
        status = hold_border(context, panel, &inside);
    if (status == KTG_OK) {
        lay_circle(panel, rests, &b, flat);
        status = extend_alike(context, panel, inside, flat);
    }
    free_border(&b);
    ktg_laplacian_free(&inside);
    return status;
}
