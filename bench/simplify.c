/* bench/simplify.c - how long simplification takes, and how far it moves a texture.
 *
 *     BUILD/bench/simplify [SIDE [CHARTS]]
 *
 * A ball as a cube blown up, each of its six sides SIDE x SIDE quadrangles (90: 97,200 faces) and
 * CHARTS x CHARTS charts (1), simplified to several numbers of faces without and with its texture
 * coordinates. The slip is the distance between what a point of the result shows and what the ball
 * shows there, as a part of a side: 28 points of each face, those faces left out that have no
 * texture coordinates any more. */
#include "core/vec.h"
#include "mesh/mesh.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define POINTS 28 /* of a face that are looked at */

typedef struct ball {
    uint32_t side, charts;
    double *positions;
    uint32_t *faces, vertex_count, face_count;
} ball;

/* ---- the ball ------------------------------------------------------------------------------- */

/* The direction of the point (u, v), from -1 to 1, of a side. The tangents even its cells out. */
static ktg_vec3 point_on(uint32_t side, double u, double v) {
    double x = tan(KTG_PI / 4 * u), y = tan(KTG_PI / 4 * v), c[3];
    c[side % 3] = side < 3 ? 1 : -1;
    c[(side + 1) % 3] = side < 3 ? x : -x;
    c[(side + 2) % 3] = y;
    return ktg_unit3((ktg_vec3){c[0], c[1], c[2]});
}

/* Where a side shows a direction, from 0 to 1. */
static ktg_vec2 place_on(uint32_t side, ktg_vec3 p) {
    double c[3] = {p.x, p.y, p.z}, down = fabs(c[side % 3]);
    double x = atan(c[(side + 1) % 3] / down), y = atan(c[(side + 2) % 3] / down);
    return (ktg_vec2){0.5 + (side < 3 ? x : -x) * 2 / KTG_PI, 0.5 + y * 2 / KTG_PI};
}

static void make_side(ball *b, uint32_t side) {
    uint32_t n = b->side, w = n + 1, first = b->vertex_count;
    for (uint32_t i = 0; i < w; i++)
        for (uint32_t j = 0; j < w; j++) {
            ktg_vec3 p = point_on(side, 2.0 * j / n - 1, 2.0 * i / n - 1);
            double *to = b->positions + 3 * (size_t)b->vertex_count++;
            to[0] = round(p.x * 1e9) / 1e9; /* so that sides meet exactly */
            to[1] = round(p.y * 1e9) / 1e9;
            to[2] = round(p.z * 1e9) / 1e9;
        }
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < n; j++) {
            uint32_t at = first + w * i + j,
                     corners[6] = {at, at + 1, at + w + 1, at, at + w + 1, at + w};
            for (int k = 0; k < 6; k++)
                b->faces[6 * (size_t)(n * (n * side + i) + j) + (size_t)k] = corners[k];
        }
}

/* Numbers that say side and chart in front, so that they can be told from the coordinate alone. */
static void set_uvs(const ball *b, ktg_mesh *mesh) {
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        uint32_t cell = f / 2, n = b->side, side = cell / (n * n);
        uint32_t row = cell / n % n * b->charts / n, column = cell % n * b->charts / n;
        for (uint32_t h = 3 * f; h < 3 * f + 3; h++) {
            ktg_vec2 place = place_on(side, mesh->positions[mesh->faces[h]]);
            mesh->uvs[h] = (ktg_vec2){place.x + 4 * side + 100 * column, place.y + 100 * row};
            mesh->face_uv[h] = h;
        }
    }
}

static ktg_status make_ball(ktg_context *context, uint32_t side, uint32_t charts, ktg_mesh **mesh) {
    ball b = {side, charts, NULL, NULL, 0, 12 * side * side};
    b.positions = calloc(18 * (size_t)(side + 1) * (side + 1), sizeof *b.positions);
    b.faces = calloc(3 * (size_t)b.face_count, sizeof *b.faces);
    for (uint32_t k = 0; b.positions && b.faces && k < 6; k++)
        make_side(&b, k);
    ktg_status status =
        ktg_mesh_new(context, b.positions, b.vertex_count, b.faces, b.face_count, mesh);
    if (status == KTG_OK) {
        (*mesh)->uv_count = 3 * b.face_count;
        (*mesh)->uvs = calloc((*mesh)->uv_count, sizeof *(*mesh)->uvs);
        (*mesh)->face_uv = calloc((*mesh)->uv_count, sizeof *(*mesh)->face_uv);
        set_uvs(&b, *mesh);
        status = ktg_mesh_repair(context, *mesh, NULL);
    }
    free(b.positions);
    free(b.faces);
    return status;
}

/* ---- the slip ------------------------------------------------------------------------------- */

static double slip_at(const ktg_mesh *mesh, uint32_t f, const double w[3]) {
    ktg_vec3 p = {0, 0, 0};
    ktg_vec2 uv = {0, 0};
    for (uint32_t k = 0; k < 3; k++) {
        p = ktg_madd3(p, w[k], mesh->positions[mesh->faces[3 * f + k]]);
        uv = ktg_madd2(uv, w[k], mesh->uvs[mesh->face_uv[3 * f + k]]);
    }
    ktg_vec2 first = mesh->uvs[mesh->face_uv[3 * f]];
    double column = 100 * floor((first.x + 2) / 100), row = 100 * floor((first.y + 2) / 100);
    uint32_t side = (uint32_t)floor((first.x - column + 1) / 4);
    ktg_vec2 place = place_on(side, p);
    return hypot(uv.x - column - 4 * side - place.x, uv.y - row - place.y);
}

static int compare(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print_slip(const ktg_mesh *mesh) {
    double *slips = malloc(POINTS * (size_t)mesh->face_count * sizeof *slips);
    size_t count = 0;
    for (uint32_t f = 0; slips && f < mesh->face_count; f++)
        for (int a = 0; a <= 6; a++)
            for (int b = 0; a + b <= 6 && mesh->face_uv[3 * f] != KTG_NONE; b++) {
                double w[3] = {a / 6.0, b / 6.0, (6 - a - b) / 6.0};
                slips[count++] = slip_at(mesh, f, w);
            }
    if (count > 0) {
        qsort(slips, count, sizeof *slips, compare);
        printf(" %8.2f %8.2f %8.2f\n", 100 * slips[count / 2], 100 * slips[count * 95 / 100],
               100 * slips[count - 1]);
    } else {
        printf(" %8s %8s %8s\n", "-", "-", "-");
    }
    free(slips);
}

/* ---- the table ------------------------------------------------------------------------------ */

static void drop_uvs(ktg_mesh *mesh) {
    free(mesh->uvs);
    free(mesh->face_uv);
    mesh->uvs = NULL;
    mesh->face_uv = NULL;
    mesh->uv_count = 0;
}

static ktg_status measure(ktg_context *context, const ktg_mesh *model, uint32_t target,
                          bool texture) {
    ktg_mesh *mesh = NULL;
    ktg_simplify_report report;
    double distance = 0, seconds = 0;
    ktg_status status = ktg_mesh_copy(context, model, &mesh);
    if (status == KTG_OK) {
        if (!texture)
            drop_uvs(mesh);
        clock_t start = clock();
        status = ktg_mesh_simplify(context, mesh, target, &report);
        seconds = (double)(clock() - start) / CLOCKS_PER_SEC; /* of the processor */
    }
    if (status == KTG_OK)
        status = ktg_mesh_hausdorff(context, model, mesh, 0.01, &distance);
    if (status == KTG_OK) {
        printf("%8u %8s %8.2f %8u %9.4f %9u", target, texture ? "yes" : "no", seconds,
               report.faces_after, distance, texture ? report.faces_without_uv : 0);
        if (texture)
            print_slip(mesh);
        else
            printf("\n");
        fflush(stdout);
    }
    ktg_mesh_free(&mesh);
    return status;
}

int main(int argc, char **argv) {
    static const uint32_t targets[] = {2000, 500, 200, 100};
    long side = argc > 1 ? strtol(argv[1], NULL, 10) : 90;
    long charts = argc > 2 ? strtol(argv[2], NULL, 10) : 1;
    ktg_context *context = NULL;
    ktg_mesh *model = NULL;
    if (argc > 3 || side < 4 || side > 1000 || charts < 1 || charts > side) {
        fprintf(stderr, "usage: simplify [SIDE [CHARTS]]\n");
        return 2;
    }
    ktg_status status = ktg_context_new(&context);
    if (status == KTG_OK)
        status = make_ball(context, (uint32_t)side, (uint32_t)charts, &model);
    printf("%8s %8s %8s %8s %9s %9s %8s %8s %8s\n", "target", "texture", "seconds", "faces",
           "distance", "lost", "slip 50%", "95 %", "worst");
    for (size_t i = 0; i < sizeof targets / sizeof *targets; i++)
        for (int texture = 0; status == KTG_OK && texture < 2; texture++)
            status = measure(context, model, targets[i], texture);
    if (status != KTG_OK)
        fprintf(stderr, "simplify: %s\n", context ? ktg_context_message(context) : "no memory");
    ktg_mesh_free(&model);
    ktg_context_free(&context);
    return status == KTG_OK ? 0 : 1;
}
