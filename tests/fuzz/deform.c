/* tests/fuzz/deform.c - tiny models under edits that are well formed: bytes choose sections,
 * selections and motions. */
#include "tests/fuzz/editing.h"

#include <stdio.h>

static void put_place(FILE *file, fuzz_bytes *bytes) {
    for (int i = 0; i < 3; i++)
        fprintf(file, " %d", (int)fuzz_below(bytes, 6) - 1);
}

static void put_selection(FILE *file, fuzz_bytes *bytes, const char *key) {
    static const char *const words[] = {
        "all",           "group a", "material m0", "component near", "boundary",
        "boundary near", "box",     "halfspace",   "vertex"};
    uint32_t kind = fuzz_below(bytes, 9);
    fprintf(file, "%s = %s", key, words[kind]);
    if (kind == 3 || kind >= 5)
        for (int i = 0; i < (kind == 6 || kind == 7 ? 2 : kind == 8 ? 0 : 1); i++)
            put_place(file, bytes);
    for (uint32_t i = 0; kind == 8 && i < 3; i++)
        fprintf(file, " %u", 1 + fuzz_below(bytes, 12));
    fputs("\n", file);
}

static void put_section(FILE *file, fuzz_bytes *bytes) {
    static const char *const kinds[] = {"fixed", "handle", "rigid", "resize", "link"};
    uint32_t kind = fuzz_below(bytes, 5);
    fprintf(file, "[%s]\n", kinds[kind]);
    put_selection(file, bytes, kind == 4 ? "from" : "set");
    if (kind == 1) {
        fputs("turn =", file);
        put_place(file, bytes);
        fprintf(file, " %d\nmove =", 3 * ((int)fuzz_byte(bytes) - 128));
        put_place(file, bytes);
        fputs("\n", file);
    }
    if (kind == 2 && fuzz_below(bytes, 2))
        fputs("together = yes\n", file);
    if (kind == 3)
        fprintf(file, "scale = %s\n", FUZZ_PICK(bytes, char *, "2", "free", "0.01", "1"));
    if (kind == 4) {
        put_selection(file, bytes, "to");
        fprintf(file, "max = %u\nkind = %s\n", fuzz_below(bytes, 4),
                FUZZ_PICK(bytes, char *, "auto", "vertex", "edge", "face"));
    }
}

static const char *make_edit(fuzz_bytes *bytes) {
    const char *path = fuzz_path("/some.edit");
    FILE *file = fopen(path, "w");
    fuzz_expect(file != NULL, "the edit cannot be written");
    fprintf(file, "[solve]\nsteps = %s\nrefine = %u\n", FUZZ_PICK(bytes, char *, "auto", "1", "7"),
            fuzz_below(bytes, 3));
    uint32_t sections = 1 + fuzz_below(bytes, 4);
    for (uint32_t i = 0; i < sections; i++)
        put_section(file, bytes);
    fclose(file);
    return path;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes bytes = {data, size};
    ktg_context *context = fuzz_context();
    const char *edit = make_edit(&bytes);
    ktg_mesh *mesh = fuzz_read_model(context, fuzz_model(&bytes));
    if (mesh)
        fuzz_editing(context, mesh, edit);
    ktg_mesh_free(&mesh);
    ktg_context_free(&context);
    return 0;
}
