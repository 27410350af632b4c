/* flatten/handles.c - which points are handles: their responses, and the dense systems.
 *
 * Igarashi & Igarashi 2009, section 5: a handle is a row of three barycentric parts. Its response
 * is what the shape does when that row is pulled. */
#include "core/memory.h"
#include "flatten/shape.h"

#include <stdlib.h>

/* The most vertices x handles: 800 MB of responses. */
static const size_t most_responses = (size_t)1 << 25;

/* So many responses are solved for at once. */
enum { block = 16 };

/* Handles closer than this, by the shape's size, are in the same place. */
static const double same_place = 1e-9;

ktg_handle ktg_handle_at_vertex(uint32_t vertex) {
    return (ktg_handle){{vertex, vertex, vertex}, {1, 0, 0}, 0};
}

void ktg_shape_drop_handles(ktg_shape *s) {
    ktg_free(s->handles);
    ktg_free(s->responses1);
    ktg_free(s->responses2);
    ktg_free(s->wanted);
    ktg_free(s->forces);
    s->handles = NULL;
    s->responses1 = NULL;
    s->responses2 = NULL;
    s->wanted = s->forces = NULL;
    s->handle_count = 0;
    ktg_dense_drop(&s->dense1);
    ktg_dense_drop(&s->dense2);
}

/* ---- checks ------------------------------------------------------------------------------- */

static ktg_status check_handle(ktg_context *context, const ktg_shape *s, const ktg_handle *h,
                               uint32_t k) {
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        uint32_t v = h->vertices[i];
        if (v >= s->mesh->vertex_count || s->panel->leaving[v] == KTG_NONE)
            return ktg_fail(context, KTG_ARGUMENT,
                            "handle %u: the shape has no face at a vertex %u", k + 1, v + 1);
        sum += h->parts[i];
    }
    if (!(fabs(sum - 1) <= 1e-9))
        return ktg_fail(context, KTG_ARGUMENT, "handle %u: its parts add up to %g, not to 1", k + 1,
                        sum);
    if (!(h->weight >= 0) || isinf(h->weight))
        return ktg_fail(context, KTG_ARGUMENT, "handle %u: a weight of %g makes no sense", k + 1,
                        h->weight);
    return KTG_OK;
}

/* A handle's place in the rest shape. */
typedef struct place {
    ktg_vec2 at;
    uint32_t handle;
} place;

static int by_place(const void *a, const void *b) {
    const place *p = a, *q = b;
    if (p->at.x != q->at.x)
        return p->at.x < q->at.x ? -1 : 1;
    return (p->at.y > q->at.y) - (p->at.y < q->at.y);
}

/* The first two of sorted places that are one. */
static void find_twice(const place *places, uint32_t count, uint32_t twice[2]) {
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = i + 1; j < count && places[j].at.x - places[i].at.x <= same_place; j++) {
            if (!(fabs(places[j].at.y - places[i].at.y) <= same_place))
                continue;
            uint32_t a = places[i].handle, b = places[j].handle;
            twice[0] = a < b ? a : b;
            twice[1] = a < b ? b : a;
            return;
        }
}

ktg_status ktg_handles_find_twice(ktg_context *context, const ktg_shape *s,
                                  const ktg_handle *handles, uint32_t count, uint32_t twice[2]) {
    place *places = ktg_new(context, count, place);
    twice[0] = twice[1] = KTG_NONE;
    if (!places)
        return KTG_MEMORY;
    for (uint32_t k = 0; k < count; k++)
        places[k] = (place){ktg_handle_place(&handles[k], s->rest), k};
    qsort(places, count, sizeof *places, by_place);
    find_twice(places, count, twice);
    ktg_free(places);
    return KTG_OK;
}

static ktg_status check_handles(ktg_context *context, const ktg_shape *s, const ktg_handle *handles,
                                uint32_t count) {
    for (uint32_t k = 0; k < count; k++)
        KTG_TRY(check_handle(context, s, &handles[k], k));
    if ((size_t)count * s->mesh->vertex_count > most_responses)
        return ktg_fail(context, KTG_LIMIT,
                        "%u handles are too many for a shape of %u vertices; %zu are not", count,
                        s->mesh->vertex_count, most_responses / s->mesh->vertex_count);
    uint32_t twice[2];
    KTG_TRY(ktg_handles_find_twice(context, s, handles, count, twice));
    if (twice[0] == KTG_NONE)
        return KTG_OK;
    return ktg_fail(context, KTG_GEOMETRY, "handles %u and %u are in the same place", twice[0] + 1,
                    twice[1] + 1);
}

/* ---- responses ---------------------------------------------------------------------------- */

/* Columns `first` to `last` of Z = H- B* of step 1; `right` has room for a block. */
static ktg_status respond1(ktg_context *context, ktg_shape *s, uint32_t first, uint32_t last,
                           ktg_vec2 *right) {
    uint32_t n = s->count1, vertices = s->mesh->vertex_count;
    for (size_t i = 0; i < (size_t)n * (last - first); i++)
        right[i] = (ktg_vec2){0, 0};
    for (uint32_t k = first; k < last; k++)
        for (int i = 0; i < 3; i++) {
            uint32_t row = s->number1[s->handles[k].vertices[i]];
            if (row != KTG_NONE)
                right[(size_t)n * (k - first) + row].x += s->handles[k].parts[i];
        }
    KTG_TRY(ktg_factor_solve_hermitian(context, s->factor1, right, last - first, right));
    for (uint32_t k = first; k < last; k++)
        for (uint32_t v = 0; v < vertices; v++)
            if (s->number1[v] != KTG_NONE)
                s->responses1[(size_t)vertices * k + v] =
                    right[(size_t)n * (k - first) + s->number1[v]];
    return KTG_OK;
}

/* The same of step 2. */
static ktg_status respond2(ktg_context *context, ktg_shape *s, uint32_t first, uint32_t last,
                           double *right) {
    uint32_t n = s->count2, vertices = s->mesh->vertex_count;
    for (size_t i = 0; i < (size_t)n * (last - first); i++)
        right[i] = 0;
    for (uint32_t k = first; k < last; k++)
        for (int i = 0; i < 3; i++) {
            uint32_t row = s->number2[s->handles[k].vertices[i]];
            if (row != KTG_NONE)
                right[(size_t)n * (k - first) + row] += s->handles[k].parts[i];
        }
    KTG_TRY(ktg_factor_solve(context, s->factor2, right, last - first, right));
    for (uint32_t k = first; k < last; k++)
        for (uint32_t v = 0; v < vertices; v++)
            if (s->number2[v] != KTG_NONE)
                s->responses2[(size_t)vertices * k + v] =
                    right[(size_t)n * (k - first) + s->number2[v]];
    return KTG_OK;
}

static ktg_status respond(ktg_context *context, ktg_shape *s) {
    ktg_vec2 *right = ktg_new(context, (size_t)block * s->mesh->vertex_count, ktg_vec2);
    ktg_status status = right ? KTG_OK : KTG_MEMORY;
    for (uint32_t first = 0; status == KTG_OK && first < s->handle_count; first += block) {
        uint32_t last = first + block < s->handle_count ? first + block : s->handle_count;
        status = respond1(context, s, first, last, right);
        if (status == KTG_OK)
            status = respond2(context, s, first, last, &right[0].x);
        if (status == KTG_OK)
            status = ktg_check_cancel(context);
    }
    ktg_free(right);
    return status;
}

/* ---- dense systems ------------------------------------------------------------------------ */

static ktg_vec2 row_times1(const ktg_shape *s, uint32_t i, uint32_t j) {
    return ktg_handle_place(&s->handles[i], s->responses1 + (size_t)s->mesh->vertex_count * j);
}

static ktg_vec2 row_times2(const ktg_shape *s, uint32_t i, uint32_t j) {
    const ktg_handle *h = &s->handles[i];
    const double *z = s->responses2 + (size_t)s->mesh->vertex_count * j;
    return (ktg_vec2){h->parts[0] * z[h->vertices[0]] + h->parts[1] * z[h->vertices[1]] +
                          h->parts[2] * z[h->vertices[2]],
                      0};
}

/* B Z + 1/w in the upper left k x k of d->a. */
static ktg_status start_dense(ktg_context *context, const ktg_shape *s, uint32_t border,
                              ktg_vec2 (*entry)(const ktg_shape *s, uint32_t i, uint32_t j),
                              double size, ktg_dense *d) {
    uint32_t count = s->handle_count;
    d->n = count + border;
    d->a = ktg_new(context, (size_t)d->n * d->n, ktg_vec2);
    if (!d->a)
        return KTG_MEMORY;
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t j = 0; j < count; j++)
            d->a[(size_t)i * d->n + j] = entry(s, i, j);
        if (s->handles[i].weight > 0)
            d->a[(size_t)i * d->n + i].x += size / s->handles[i].weight;
    }
    return KTG_OK;
}

/* Puts a column of B N, and its conjugate as a row. */
static void put_border(ktg_dense *d, uint32_t i, uint32_t k, ktg_vec2 value) {
    d->a[(size_t)i * d->n + k] = value;
    d->a[(size_t)k * d->n + i] = (ktg_vec2){value.x, -value.y};
}

static ktg_status factor_dense(ktg_context *context, const ktg_shape *s, ktg_dense *d) {
    uint32_t singular;
    KTG_TRY(ktg_dense_factor(context, d, &singular));
    if (singular == KTG_NONE)
        return KTG_OK;
    return ktg_fail(context, KTG_GEOMETRY,
                    "handle %u has no say: those before it, too close to it, settle its place",
                    (singular < s->handle_count ? singular : s->handle_count - 1) + 1);
}

/* The mean of the diagonal becomes 1, so that it compares with the border. */
static void set_size(ktg_shape *s) {
    double sum1 = 0, sum2 = 0;
    size_t size = (size_t)s->mesh->vertex_count * s->handle_count;
    for (uint32_t i = 0; i < s->handle_count; i++) {
        sum1 += row_times1(s, i, i).x;
        sum2 += row_times2(s, i, i).x;
    }
    s->size1 = sum1 > 0 ? s->handle_count / sum1 : 1;
    s->size2 = sum2 > 0 ? s->handle_count / sum2 : 1;
    for (size_t i = 0; i < size; i++) {
        s->responses1[i] = ktg_mul2(s->responses1[i], s->size1);
        s->responses2[i] *= s->size2;
    }
}

static ktg_status make_dense(ktg_context *context, ktg_shape *s) {
    uint32_t count = s->handle_count;
    KTG_TRY(start_dense(context, s, 2, row_times1, s->size1, &s->dense1));
    KTG_TRY(start_dense(context, s, 1, row_times2, s->size2, &s->dense2));
    for (uint32_t i = 0; i < count; i++) {
        put_border(&s->dense1, i, count, (ktg_vec2){1, 0});
        put_border(&s->dense1, i, count + 1, ktg_handle_place(&s->handles[i], s->centred));
        put_border(&s->dense2, i, count, (ktg_vec2){1, 0});
    }
    KTG_TRY(factor_dense(context, s, &s->dense1));
    return factor_dense(context, s, &s->dense2);
}

/* ---- all ---------------------------------------------------------------------------------- */

static ktg_status compile(ktg_context *context, const ktg_handle *handles, uint32_t count,
                          ktg_shape *s) {
    size_t size = (size_t)s->mesh->vertex_count * count;
    s->handles = ktg_copy_array(context, handles, count, sizeof *handles);
    s->wanted = ktg_new(context, count, ktg_vec2);
    s->forces = ktg_new(context, 2 * ((size_t)count + 2), ktg_vec2);
    s->responses1 = ktg_new(context, size, ktg_vec2);
    s->responses2 = ktg_new(context, size, double);
    if (!s->handles || !s->wanted || !s->forces || !s->responses1 || !s->responses2)
        return KTG_MEMORY;
    s->handle_count = count;
    if (count < 2)
        return KTG_OK;
    KTG_TRY(respond(context, s));
    set_size(s);
    return make_dense(context, s);
}

ktg_status ktg_shape_compile(ktg_context *context, ktg_shape *shape, const ktg_handle *handles,
                             uint32_t count) {
    ktg_shape_drop_handles(shape);
    KTG_TRY(check_handles(context, shape, handles, count));
    ktg_status status = compile(context, handles, count, shape);
    if (status != KTG_OK)
        ktg_shape_drop_handles(shape);
    return status;
}
