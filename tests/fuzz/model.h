/* tests/fuzz/model.h - tiny models on an integer grid, made from bytes: coplanar, collinear,
 * coincident, folded, doubled, non-manifold, one-sided, of any genus. */
#ifndef KTG_TESTS_FUZZ_MODEL_H
#define KTG_TESTS_FUZZ_MODEL_H

#include "mesh/mesh.h"
#include "tests/fuzz/fuzz.h"

/* Writes one as OBJ, with polygons, groups, marked edges and texture coordinates where the bytes
 * say so; its path. About 100 triangles at most. */
const char *fuzz_model(fuzz_bytes *bytes);

/* A flat one: z is 0. */
const char *fuzz_flat_model(fuzz_bytes *bytes);

/* Reads it; NULL where it is refused. */
ktg_mesh *fuzz_read_model(ktg_context *context, const char *path);

/* What every mesh promises: indices in range, finite coordinates. */
void fuzz_check_mesh(const ktg_mesh *mesh);

/* Writes a mesh to a file; its path. The format goes by the ending. */
const char *fuzz_write_mesh(ktg_context *context, const ktg_mesh *mesh, const char *name);

#endif
