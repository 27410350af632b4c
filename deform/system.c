/* deform/system.c - the rows over what is free: assembled, factored once, solved often.
 *
 * Vertex values are x = C y + d: y has a value for each body that is free, C hands it to the body's
 * vertices and, weighted, to those who follow them, d holds what is known. |A x - target|^2 is
 * least where C^T A^T A C y = C^T A^T (target - A d). That one matrix serves turns, positions and
 * scales alike, because none of the constraints mixes coordinates. */
#include "core/memory.h"
#include "core/sets.h"
#include "deform/solver.h"

#include <string.h>

/* A matrix with more entries than this is not tried (6 GB). */
#define MOST_ENTRIES ((size_t)250000000)
#define MOST_SOLVES  4
/* What a solve may be off by, as a part of the largest value. */
static const double exact_enough = 1e-8;

struct ktg_system {
    const ktg_rows *rows;
    uint32_t vertex_count, unknown_count;
    size_t *first;    /* vertex_count + 1: a vertex's part of C ... */
    uint32_t *column; /* ... unknowns */
    double *weight;   /* ... and what they weigh */
    ktg_factor *factor;
    int solves;        /* how many it takes, each on what the one before left */
    double *right;     /* 3 unknown_count, column by column; also the solution */
    ktg_vec3 *on_rows; /* rows->count */
    ktg_vec3 *on_vertices;
};

/* ---- C -------------------------------------------------------------------------------------- */

/* How many unknowns each vertex hangs on, at most; followers stand behind their masters. */
static void count_weights(const ktg_bodies *bodies, const uint32_t *number, size_t *counts) {
    for (uint32_t v = 0; v < bodies->vertex_count; v++)
        counts[v] = !bodies->follows[v] && number[ktg_set_of(bodies->parent, v)] != KTG_NONE;
    for (uint32_t i = 0; i < bodies->follower_count; i++) {
        const ktg_follower *f = &bodies->followers[i];
        counts[f->vertex] = 0;
        for (int k = 0; k < 3 && f->masters[k] != KTG_NONE; k++)
            counts[f->vertex] += counts[f->masters[k]];
    }
}

static void fill_follower(ktg_system *s, const ktg_follower *f) {
    size_t at = s->first[f->vertex];
    for (int k = 0; k < 3 && f->masters[k] != KTG_NONE; k++)
        for (size_t i = s->first[f->masters[k]]; i < s->first[f->masters[k] + 1]; i++) {
            s->column[at] = s->column[i];
            s->weight[at++] = f->weights[k] * s->weight[i];
        }
}

static ktg_status fill_weights(ktg_context *context, const ktg_bodies *bodies,
                               const uint32_t *number, ktg_system *s) {
    s->first = ktg_new(context, (size_t)s->vertex_count + 1, size_t);
    if (!s->first)
        return KTG_MEMORY;
    count_weights(bodies, number, s->first + 1);
    for (uint32_t v = 0; v < s->vertex_count; v++) {
        s->first[v + 1] += s->first[v];
        if (s->first[v + 1] > MOST_ENTRIES)
            return ktg_fail(context, KTG_LIMIT,
                            "links that follow each other over and over reach too far");
    }
    s->column = ktg_new(context, s->first[s->vertex_count], uint32_t);
    s->weight = ktg_new(context, s->first[s->vertex_count], double);
    if (!s->column || !s->weight)
        return KTG_MEMORY;
    for (uint32_t v = 0; v < s->vertex_count; v++) {
        uint32_t root = ktg_set_of(bodies->parent, v);
        if (bodies->follows[v] || number[root] == KTG_NONE)
            continue;
        s->column[s->first[v]] = number[root];
        s->weight[s->first[v]] = 1;
    }
    for (uint32_t i = 0; i < bodies->follower_count; i++)
        fill_follower(s, &bodies->followers[i]);
    return KTG_OK;
}

/* ---- the matrix ----------------------------------------------------------------------------- */

typedef struct assembly {
    ktg_context *context;
    const ktg_system *system;
    ktg_sparse_entry *entries;
    size_t count, capacity;
    uint32_t *place;   /* unknown_count: where an unknown stands in the merged row, + 1 */
    uint32_t *columns; /* the merged row */
    double *values;
    size_t column_capacity, value_capacity;
} assembly;

static ktg_status add_term(assembly *a, uint32_t *count, uint32_t column, double value) {
    if (a->place[column] == 0) {
        KTG_TRY(ktg_reserve(a->context, &a->columns, &a->column_capacity, (size_t)*count + 1));
        KTG_TRY(ktg_reserve(a->context, &a->values, &a->value_capacity, (size_t)*count + 1));
        a->columns[*count] = column;
        a->values[*count] = 0;
        a->place[column] = ++*count;
    }
    a->values[a->place[column] - 1] += value;
    return KTG_OK;
}

/* The row's terms over the unknowns. *constant: vertices of it are known. */
static ktg_status merge_row(assembly *a, uint32_t row, uint32_t *count, bool *constant) {
    const ktg_system *s = a->system;
    *count = 0;
    *constant = false;
    ktg_status status = KTG_OK;
    for (size_t i = s->rows->first[row]; status == KTG_OK && i < s->rows->first[row + 1]; i++) {
        uint32_t v = s->rows->column[i];
        *constant |= s->first[v] == s->first[v + 1];
        for (size_t k = s->first[v]; status == KTG_OK && k < s->first[v + 1]; k++)
            status = add_term(a, count, s->column[k], s->rows->value[i] * s->weight[k]);
    }
    for (uint32_t i = 0; i < *count; i++)
        a->place[a->columns[i]] = 0;
    return status;
}

/* The products of a merged row with itself. One that lies within a single body says nothing: its
 * terms add up to zero. */
static ktg_status add_products(assembly *a, uint32_t row) {
    uint32_t count;
    bool constant;
    KTG_TRY(merge_row(a, row, &count, &constant));
    if (count == 0 || (count == 1 && !constant))
        return KTG_OK;
    size_t products = (size_t)count * (count + 1) / 2;
    if (a->count + products > MOST_ENTRIES)
        return ktg_fail(a->context, KTG_LIMIT,
                        "vertex %u has %u neighbours: too many, with all others, for a factor",
                        a->system->rows->vertex[row] + 1, count - 1);
    KTG_TRY(ktg_reserve(a->context, &a->entries, &a->capacity, a->count + products));
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k <= i; k++) {
            uint32_t x = a->columns[i], y = a->columns[k];
            a->entries[a->count++] =
                (ktg_sparse_entry){x > y ? x : y, x > y ? y : x, a->values[i] * a->values[k]};
        }
    return KTG_OK;
}

/* Factors, or factors anew where there is a factor: the entries are the same then but for their
 * values, because which there are hangs on the mesh and the bodies alone. */
static ktg_status factor(ktg_context *context, ktg_system *s) {
    assembly a = {.context = context, .system = s};
    a.place = ktg_new(context, s->unknown_count, uint32_t);
    ktg_status status = a.place ? KTG_OK : KTG_MEMORY;
    if (status == KTG_OK) /* a vertex has six neighbours, more or less */
        status = ktg_reserve(context, &a.entries, &a.capacity, 30 * (size_t)s->rows->count);
    for (uint32_t m = 0; status == KTG_OK && m < s->rows->count; m++)
        status = add_products(&a, m);
    if (status == KTG_OK)
        status = s->factor ? ktg_factor_refill(context, s->factor, a.entries, a.count)
                           : ktg_factor_new_ordered(context, s->unknown_count, a.entries, a.count,
                                                    KTG_ORDER_DISSECTION, &s->factor);
    ktg_free(a.entries);
    ktg_free(a.place);
    ktg_free(a.columns);
    ktg_free(a.values);
    return status;
}

/* ---- solving -------------------------------------------------------------------------------- */

/* right = C^T A^T (target - A x); false when that is nothing. */
static bool put_residual(ktg_system *s, const ktg_vec3 *target, const ktg_vec3 *x) {
    size_t n = s->unknown_count;
    ktg_rows_apply(s->rows, x, s->on_rows);
    memset(s->on_vertices, 0, s->vertex_count * sizeof *s->on_vertices);
    memset(s->right, 0, 3 * n * sizeof *s->right);
    for (uint32_t m = 0; m < s->rows->count; m++) {
        ktg_vec3 left = ktg_sub3(target[m], s->on_rows[m]);
        for (size_t i = s->rows->first[m]; i < s->rows->first[m + 1]; i++) {
            ktg_vec3 *sum = &s->on_vertices[s->rows->column[i]];
            *sum = ktg_madd3(*sum, s->rows->value[i], left);
        }
    }
    for (uint32_t v = 0; v < s->vertex_count; v++)
        for (size_t i = s->first[v]; i < s->first[v + 1]; i++) {
            double *right = s->right + s->column[i];
            right[0] += s->weight[i] * s->on_vertices[v].x;
            right[n] += s->weight[i] * s->on_vertices[v].y;
            right[2 * n] += s->weight[i] * s->on_vertices[v].z;
        }
    for (size_t i = 0; i < 3 * n; i++)
        if (s->right[i] != 0)
            return true;
    return false;
}

/* x += C solution; the largest change of an unknown. */
static double take_change(const ktg_system *s, ktg_vec3 *x) {
    size_t n = s->unknown_count;
    double largest = 0;
    for (size_t i = 0; i < 3 * n; i++)
        largest = ktg_max(largest, fabs(s->right[i]));
    for (uint32_t v = 0; v < s->vertex_count; v++)
        for (size_t i = s->first[v]; i < s->first[v + 1]; i++) {
            const double *change = s->right + s->column[i];
            ktg_vec3 by = {change[0], change[n], change[2 * n]};
            x[v] = ktg_madd3(x[v], s->weight[i], by);
        }
    return largest;
}

/* One solve; *change is the largest change of an unknown. */
static ktg_status solve_once(ktg_context *context, ktg_system *s, const ktg_vec3 *target,
                             ktg_vec3 *x, double *change) {
    *change = 0;
    if (!put_residual(s, target, x))
        return KTG_OK;
    KTG_TRY(ktg_factor_solve(context, s->factor, s->right, 3, s->right));
    *change = take_change(s, x);
    return KTG_OK;
}

/* Where all that is known is 1, all else must become 1: by how much it does not is what a solve
 * loses, and each further one loses that part of the one before. */
static ktg_status count_solves(ktg_context *context, ktg_system *s) {
    ktg_vec3 *x = ktg_new(context, s->vertex_count, ktg_vec3);
    ktg_vec3 *target = ktg_new(context, s->rows->count, ktg_vec3);
    ktg_status status = x && target ? KTG_OK : KTG_MEMORY;
    double lost = 0, change;
    for (uint32_t v = 0; x && v < s->vertex_count; v++) {
        x[v].x = 1;
        for (size_t i = s->first[v]; i < s->first[v + 1]; i++)
            x[v].x -= s->weight[i];
    }
    if (status == KTG_OK)
        status = solve_once(context, s, target, x, &change);
    for (uint32_t v = 0; status == KTG_OK && v < s->vertex_count; v++)
        if (s->first[v] < s->first[v + 1])
            lost = ktg_max(lost, fabs(x[v].x - 1));
    double left = lost;
    for (s->solves = 1; left > exact_enough && s->solves < MOST_SOLVES; s->solves++)
        left *= lost;
    ktg_free(x);
    ktg_free(target);
    return status;
}

ktg_status ktg_system_solve(ktg_context *context, ktg_system *s, const ktg_vec3 *target,
                            ktg_vec3 *x) {
    double change = INFINITY;
    for (int i = 0; i < s->solves && change > 0; i++)
        KTG_TRY(solve_once(context, s, target, x, &change));
    return KTG_OK;
}

/* ---- making --------------------------------------------------------------------------------- */

/* Numbers the free bodies; those of vertices without faces stay where they are. */
static void number_bodies(const ktg_rows *rows, const ktg_bodies *bodies, const bool *known,
                          uint32_t *number, uint32_t *count) {
    for (uint32_t v = 0; v < bodies->vertex_count; v++)
        number[v] = KTG_NONE;
    for (uint32_t m = 0; m < rows->count; m++)
        if (!bodies->follows[rows->vertex[m]])
            number[ktg_set_of(bodies->parent, rows->vertex[m])] = 0;
    for (uint32_t v = 0; v < bodies->vertex_count; v++)
        if (number[v] != KTG_NONE)
            number[v] = known[v] ? KTG_NONE : (*count)++;
}

static ktg_status fill(ktg_context *context, const ktg_bodies *bodies, const bool *known,
                       uint32_t *number, ktg_system *s) {
    s->vertex_count = bodies->vertex_count;
    number_bodies(s->rows, bodies, known, number, &s->unknown_count);
    KTG_TRY(fill_weights(context, bodies, number, s));
    s->right = ktg_new(context, 3 * (size_t)s->unknown_count, double);
    s->on_rows = ktg_new(context, s->rows->count, ktg_vec3);
    s->on_vertices = ktg_new(context, s->vertex_count, ktg_vec3);
    if (!s->right || !s->on_rows || !s->on_vertices)
        return KTG_MEMORY;
    if (s->unknown_count == 0)
        return KTG_OK;
    KTG_TRY(factor(context, s));
    return count_solves(context, s);
}

ktg_status ktg_system_new(ktg_context *context, const ktg_rows *rows, const ktg_bodies *bodies,
                          const bool *known, ktg_system **system) {
    uint32_t *number = ktg_new(context, bodies->vertex_count, uint32_t);
    *system = number ? ktg_new(context, 1, ktg_system) : NULL;
    ktg_status status = KTG_MEMORY;
    if (*system) {
        (*system)->rows = rows;
        status = fill(context, bodies, known, number, *system);
    }
    ktg_free(number);
    if (status != KTG_OK)
        ktg_system_free(system);
    return status;
}

void ktg_system_free(ktg_system **system) {
    if (!system || !*system)
        return;
    ktg_factor_free(&(*system)->factor);
    ktg_free((*system)->first);
    ktg_free((*system)->column);
    ktg_free((*system)->weight);
    ktg_free((*system)->right);
    ktg_free((*system)->on_rows);
    ktg_free((*system)->on_vertices);
    ktg_free(*system);
    *system = NULL;
}

uint32_t ktg_system_unknowns(const ktg_system *system) {
    return system->unknown_count;
}

ktg_status ktg_system_refill(ktg_context *context, ktg_system *s, const ktg_rows *rows) {
    s->rows = rows;
    if (s->unknown_count == 0)
        return KTG_OK;
    KTG_TRY(factor(context, s));
    return count_solves(context, s);
}
