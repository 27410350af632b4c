/* mesh/read_edges.c - the edges that a file names: paths of vertex numbers, or OBJ `l` elements. */
#include "core/memory.h"
#include "core/vec.h"
#include "mesh/edge_index.h"
#include "mesh/read.h"
#include "mesh/weld.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* An OBJ's own vertices are the model's when they are nearer than this part of its size: programs
 * write six decimals, and STL holds floats. */
#define NEAR 1e-5

/* A vertex of the mesh along x. */
typedef struct place {
    double x;
    uint32_t vertex;
} place;

typedef struct edge_file {
    ktg_scan *scan;
    const ktg_mesh *mesh;
    ktg_edge_list *list;
    size_t vertex_capacity, line_capacity;
    uint32_t *weld;
    ktg_edge_index index; /* of welded vertices */
    ktg_vec3 *own;        /* own_count: positions of the file's `v` lines */
    size_t own_count, own_capacity, own_so_far;
    place *places; /* vertex_count, sorted; only where own_count > 0 */
    double near;
} edge_file;

/* ---- one edge ------------------------------------------------------------------------------- */

static ktg_status add_edge(edge_file *f, uint32_t a, uint32_t b) {
    ktg_edge_list *list = f->list;
    const ktg_edge_entry *entry;
    size_t n = list->count;
    if (ktg_edge_index_find(&f->index, f->weld[a], f->weld[b], &entry) == 0)
        return ktg_scan_fail(f->scan, KTG_FORMAT,
                             "vertices %u and %u of the model have no edge between them", a + 1,
                             b + 1);
    if (list->count == KTG_NONE - 1)
        return ktg_scan_fail(f->scan, KTG_LIMIT, "more edges than can be numbered");
    KTG_TRY(ktg_reserve(f->scan->context, &list->vertices, &f->vertex_capacity, 2 * n + 2));
    KTG_TRY(ktg_reserve(f->scan->context, &list->lines, &f->line_capacity, n + 1));
    list->vertices[2 * n] = a;
    list->vertices[2 * n + 1] = b;
    list->lines[list->count++] = f->scan->line;
    return KTG_OK;
}

static ktg_status fail_range(edge_file *f, int64_t number) {
    return ktg_scan_fail(f->scan, KTG_FORMAT,
                         "vertex number %lld, but the model's vertices are numbered 1 to %u",
                         (long long)number, f->mesh->vertex_count);
}

/* A vertex of the mesh by its number. */
static ktg_status read_number(edge_file *f, uint32_t *vertex) {
    int64_t number;
    KTG_TRY(ktg_scan_integer(f->scan, "the number of a vertex", &number));
    if (number < 1 || number > f->mesh->vertex_count)
        return fail_range(f, number);
    *vertex = (uint32_t)(number - 1);
    return KTG_OK;
}

/* What is left of the line is a path. */
static ktg_status read_path(edge_file *f, ktg_status (*read)(edge_file *f, uint32_t *vertex)) {
    uint32_t before = 0, vertex = 0;
    KTG_TRY(read(f, &before));
    if (ktg_scan_line_ends(f->scan))
        return ktg_scan_fail(f->scan, KTG_FORMAT,
                             "one vertex is no edge; the numbers of two or more are wanted");
    do {
        KTG_TRY(read(f, &vertex));
        KTG_TRY(add_edge(f, before, vertex));
        before = vertex;
    } while (!ktg_scan_line_ends(f->scan));
    return KTG_OK;
}

static ktg_status read_text(edge_file *f) {
    for (; ktg_scan_content(f->scan); ktg_scan_next_line(f->scan)) {
        KTG_TRY(ktg_scan_row(f->scan));
        KTG_TRY(read_path(f, read_number));
    }
    return KTG_OK;
}

/* ---- OBJ ------------------------------------------------------------------------------------ */

static ktg_status read_own_vertices(edge_file *f, ktg_scan scan) {
    for (; ktg_scan_content(&scan); ktg_scan_next_line(&scan)) {
        KTG_TRY(ktg_scan_row(&scan));
        if (!ktg_word_is(ktg_scan_word(&scan), "v"))
            continue;
        KTG_TRY(ktg_reserve(scan.context, &f->own, &f->own_capacity, f->own_count + 1));
        ktg_vec3 *p = &f->own[f->own_count++];
        KTG_TRY(ktg_scan_number(&scan, "the x of a vertex", &p->x));
        KTG_TRY(ktg_scan_number(&scan, "the y of a vertex", &p->y));
        KTG_TRY(ktg_scan_number(&scan, "the z of a vertex", &p->z));
    }
    return KTG_OK;
}

static int compare_places(const void *a, const void *b) {
    const place *p = a, *q = b;
    if (p->x != q->x)
        return p->x < q->x ? -1 : 1;
    return (p->vertex > q->vertex) - (p->vertex < q->vertex);
}

static ktg_status sort_places(edge_file *f) {
    const ktg_mesh *mesh = f->mesh;
    ktg_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    f->places = ktg_new(f->scan->context, mesh->vertex_count, place);
    if (!f->places)
        return KTG_MEMORY;
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        ktg_vec3 p = mesh->positions[v];
        f->places[v] = (place){p.x, v};
        low = (ktg_vec3){fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z)};
        high = (ktg_vec3){fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z)};
    }
    qsort(f->places, mesh->vertex_count, sizeof *f->places, compare_places);
    f->near = NEAR * ktg_length3(ktg_sub3(high, low));
    return KTG_OK;
}

/* The first place that is not left of x. */
static size_t first_place(const edge_file *f, double x) {
    size_t low = 0, high = f->mesh->vertex_count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (f->places[middle].x < x)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* The vertex of the mesh that is nearest to a point, KTG_NONE where none is near. */
static uint32_t vertex_at(const edge_file *f, ktg_vec3 p) {
    double least = f->near;
    uint32_t nearest = KTG_NONE;
    for (size_t i = first_place(f, p.x - f->near);
         i < f->mesh->vertex_count && f->places[i].x <= p.x + f->near; i++) {
        uint32_t v = f->places[i].vertex;
        double distance = ktg_length3(ktg_sub3(f->mesh->positions[v], p));
        if (distance < least || (distance == least && nearest == KTG_NONE)) {
            least = distance;
            nearest = v;
        }
    }
    return nearest;
}

/* v, v/vt; one of the file's own vertices, or of the model's where it has none. */
static ktg_status read_corner(edge_file *f, uint32_t *vertex) {
    size_t count = f->own_count > 0 ? f->own_so_far : f->mesh->vertex_count;
    int64_t number;
    KTG_TRY(ktg_scan_integer(f->scan, "the number of a vertex", &number));
    if (*f->scan->at == '/')
        (void)ktg_scan_word(f->scan); /* a texture coordinate */
    int64_t wanted = number < 0 ? number + (int64_t)count + 1 : number;
    if (f->own_count == 0 && (wanted < 1 || wanted > f->mesh->vertex_count))
        return fail_range(f, number);
    if (wanted < 1 || (f->own_count > 0 && (uint64_t)wanted > f->own_count))
        return ktg_scan_fail(f->scan, KTG_FORMAT, "vertex number %lld, but the file has only %zu",
                             (long long)number, f->own_count);
    *vertex = (uint32_t)(wanted - 1);
    if (f->own_count == 0)
        return KTG_OK;
    ktg_vec3 p = f->own[wanted - 1];
    *vertex = vertex_at(f, p);
    if (*vertex == KTG_NONE)
        return ktg_scan_fail(f->scan, KTG_FORMAT,
                             "vertex number %lld of this file lies at (%g, %g, %g), where the "
                             "model has none",
                             (long long)number, p.x, p.y, p.z);
    return KTG_OK;
}

static ktg_status read_lines(edge_file *f) {
    for (; ktg_scan_content(f->scan); ktg_scan_next_line(f->scan)) {
        KTG_TRY(ktg_scan_row(f->scan));
        ktg_word keyword = ktg_scan_word(f->scan);
        f->own_so_far += ktg_word_is(keyword, "v");
        if (ktg_word_is(keyword, "l"))
            KTG_TRY(read_path(f, read_corner));
    }
    return KTG_OK;
}

static ktg_status read_obj(edge_file *f) {
    f->scan->continued = true;
    KTG_TRY(read_own_vertices(f, *f->scan));
    if (f->own_count > 0)
        KTG_TRY(sort_places(f));
    return read_lines(f);
}

/* ---- the file ------------------------------------------------------------------------------- */

/* Whether it is OBJ: by its ending, or because a word stands where numbers are wanted. */
static bool is_obj(ktg_scan scan, const char *path) {
    static const char *const words[] = {"v", "vt", "vn", "l",      "f",
                                        "o", "g",  "s",  "mtllib", "usemtl"};
    if (ktg_mesh_format_of(path) == KTG_MESH_OBJ)
        return true;
    if (!ktg_scan_content(&scan))
        return false;
    ktg_word word = ktg_scan_word(&scan);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (ktg_word_is(word, words[i]))
            return true;
    return false;
}

static ktg_status read_edges(edge_file *f, const char *path) {
    const ktg_scan *scan = f->scan;
    ktg_context *context = scan->context;
    KTG_TRY(ktg_mesh_weld(context, f->mesh->positions, f->mesh->vertex_count, &f->weld));
    KTG_TRY(ktg_edge_index_new(context, f->mesh->faces, f->mesh->face_count, f->weld, &f->index));
    if (memchr(scan->at, 0, (size_t)(scan->end - scan->at)))
        return ktg_fail(context, KTG_FORMAT, "%s: holds binary data, so it names no edges",
                        scan->name);
    KTG_TRY(is_obj(*scan, path) ? read_obj(f) : read_text(f));
    if (f->list->count == 0)
        return ktg_fail(context, KTG_FORMAT,
                        "%s: names no edges; lines of vertex numbers are wanted, or an OBJ file "
                        "with l elements",
                        scan->name);
    return KTG_OK;
}

void ktg_edge_list_free(ktg_edge_list *list) {
    ktg_free(list->vertices);
    ktg_free(list->lines);
    ktg_free(list->file);
    *list = (ktg_edge_list){0};
}

ktg_status ktg_mesh_read_edges(ktg_context *context, const char *path, const ktg_mesh *mesh,
                               ktg_edge_list *list) {
    ktg_scan_file file;
    ktg_scan scan;
    edge_file f = {.scan = &scan, .mesh = mesh, .list = list};
    *list = (ktg_edge_list){0};
    ktg_status status = ktg_scan_open(context, path, &file, &scan);
    if (status == KTG_OK)
        status = read_edges(&f, path);
    if (status == KTG_OK) {
        list->file = file.name; /* handed over */
        file.name = NULL;
    } else {
        ktg_edge_list_free(list);
    }
    ktg_free(f.weld);
    ktg_free(f.own);
    ktg_free(f.places);
    ktg_edge_index_free(&f.index);
    ktg_scan_close(&file, &scan);
    return status;
}
