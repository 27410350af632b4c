/* deform/choose.h - which vertices a selection means (deform only). */
#ifndef KTG_DEFORM_CHOOSE_H
#define KTG_DEFORM_CHOOSE_H

#include "deform/edit_text.h"

/* What selections are made on; parts of the mesh are looked for when they are first asked for. */
typedef struct ktg_chooser {
    const ktg_edit_text *text;
    const ktg_mesh *mesh;
    ktg_adjacency *adjacency;
    uint32_t *loops; /* vertex_count: the border loop a vertex is on, named by a vertex of it, or
                        KTG_NONE; where two loops touch they count as one */
    uint32_t *parts; /* vertex_count, and their names */
    uint32_t part_count;
    ktg_names part_names;
} ktg_chooser;

KTG_NODISCARD ktg_status ktg_chooser_new(const ktg_edit_text *text, const ktg_mesh *mesh,
                                         ktg_chooser *chooser);
void ktg_chooser_free(ktg_chooser *chooser);

/* Is this one of the words a selection begins with? */
bool ktg_choose_knows(const char *word);

/* Marks what the words of the line say from `at` on ("group NAME", "sphere X Y Z R", ...) in
 * chosen, vertex_count. Sets are not known here. */
KTG_NODISCARD ktg_status ktg_choose(ktg_chooser *chooser, const ktg_edit_line *line, bool *chosen);

/* Adds all neighbours, or takes off all that have a neighbour outside; `rings` times. */
KTG_NODISCARD ktg_status ktg_choose_grow(ktg_chooser *chooser, uint32_t rings, bool *chosen);
KTG_NODISCARD ktg_status ktg_choose_shrink(ktg_chooser *chooser, uint32_t rings, bool *chosen);

#endif
