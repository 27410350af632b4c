/* deform/edit_make.h - from the lines of an edit file to an edit (deform only). */
#ifndef KTG_DEFORM_EDIT_MAKE_H
#define KTG_DEFORM_EDIT_MAKE_H

#include "deform/choose.h"

/* How far a set is. */
typedef enum ktg_set_state { KTG_SET_UNMADE, KTG_SET_BEGUN, KTG_SET_MADE } ktg_set_state;

typedef struct ktg_edit_maker {
    ktg_context *context;
    ktg_edit_text text;
    ktg_chooser chooser;
    ktg_edit *edit;
    size_t *set_sections; /* set_count: where a set stands in the text */
    uint8_t *set_states;  /* set_count: ktg_set_state */
    uint32_t depth;       /* of sets that are begun */
} ktg_edit_maker;

/* Lists the sets of the text, unmade. */
KTG_NODISCARD ktg_status ktg_sets_list(ktg_edit_maker *maker);
/* Makes all of them, each after those it is made of. */
KTG_NODISCARD ktg_status ktg_sets_make(ktg_edit_maker *maker);

/* What a line selects, added to `chosen` (vertex_count): a set's name, or what choose.h knows. */
KTG_NODISCARD ktg_status ktg_sets_select(ktg_edit_maker *maker, const ktg_edit_line *line,
                                         bool *chosen);

/* The marked vertices as a list; NULL when memory is short. */
uint32_t *ktg_sets_vertices(ktg_context *context, const bool *chosen, uint32_t vertex_count,
                            uint32_t *count);

#endif
