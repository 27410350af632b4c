/* flatten/axes.c - where a sheet lies, which ways it extends and which ways it faces. */
#include "core/memory.h"
#include "core/vec.h"
#include "flatten/sheet.h"

/* One rotation of Jacobi's method in the plane of p and q. */
static void rotate(double m[3][3], double v[3][3], int p, int q) {
    if (m[p][q] == 0)
        return;
    double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
    double t = (theta >= 0 ? 1 : -1) / (fabs(theta) + sqrt(theta * theta + 1));
    double c = 1 / sqrt(t * t + 1), s = t * c;
    for (int k = 0; k < 3; k++) {
        double a = m[k][p], b = m[k][q];
        m[k][p] = c * a - s * b;
        m[k][q] = s * a + c * b;
        a = v[k][p], b = v[k][q];
        v[k][p] = c * a - s * b;
        v[k][q] = s * a + c * b;
    }
    for (int k = 0; k < 3; k++) {
        double a = m[p][k], b = m[q][k];
        m[p][k] = c * a - s * b;
        m[q][k] = s * a + c * b;
    }
}

/* Unit eigenvectors of a symmetric matrix, that of the largest eigenvalue first. */
static void eigenvectors(double m[3][3], ktg_vec3 axes[3]) {
    double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int sweep = 0; sweep < 20; sweep++) {
        rotate(m, v, 0, 1);
        rotate(m, v, 0, 2);
        rotate(m, v, 1, 2);
    }
    int order[3] = {0, 1, 2};
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2 - i; j++)
            if (m[order[j]][order[j]] < m[order[j + 1]][order[j + 1]]) {
                int swap = order[j];
                order[j] = order[j + 1];
                order[j + 1] = swap;
            }
    for (int k = 0; k < 3; k++)
        axes[k] = (ktg_vec3){v[0][order[k]], v[1][order[k]], v[2][order[k]]};
}

ktg_vec3 ktg_face_centre(const ktg_mesh *mesh, uint32_t face) {
    const uint32_t *v = mesh->faces + 3 * (size_t)face;
    const ktg_vec3 *p = mesh->positions;
    return ktg_mul3(ktg_add3(p[v[0]], ktg_add3(p[v[1]], p[v[2]])), 1.0 / 3);
}

static void add_square(double m[3][3], ktg_vec3 d, double weight) {
    const double x[3] = {d.x, d.y, d.z};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            m[i][j] += weight * x[i] * x[j];
}

void ktg_axes_of_vectors(const ktg_mesh *mesh, const ktg_vec3 *vectors, ktg_vec3 *mean,
                         ktg_vec3 axes[3]) {
    double m[3][3] = {{0}}, total = 0;
    ktg_vec3 sum = {0, 0, 0};
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        double area = ktg_length3(ktg_sheet_area(mesh, f));
        sum = ktg_madd3(sum, area, vectors[f]);
        total += area;
    }
    *mean = ktg_mul3(sum, 1 / total);
    for (uint32_t f = 0; f < mesh->face_count; f++)
        add_square(m, ktg_sub3(vectors[f], *mean), ktg_length3(ktg_sheet_area(mesh, f)));
    eigenvectors(m, axes);
}
