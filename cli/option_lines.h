/* cli/option_lines.h - the table of options, which read_options.c reads the command line by (cli
 * only). */
#ifndef KTG_CLI_OPTION_LINES_H
#define KTG_CLI_OPTION_LINES_H

#include "cli/cli.h"

/* Takes the value of its option (NULL where it has none); false when it is not right. */
typedef bool option_setter(settings *s, const char *text);

typedef struct option_line {
    const char *name;
    char letter;
    const char *value; /* what its value is called; NULL: it has none */
    int commands;
    bool late; /* applied after all that is not */
    option_setter *apply;
    const char *help;
} option_line;

extern const option_line cli_option_lines[];
extern const int cli_option_count;

/* More lines than there are. */
#define CLI_MOST_OPTIONS 128

/* options_model.c */
option_setter cli_set_output, cli_set_keep, cli_set_cut, cli_set_omit, cli_set_edit, cli_set_sets,
    cli_set_preview, cli_set_handles, cli_set_faces, cli_set_height, cli_set_width, cli_set_length,
    cli_set_scale, cli_set_sheets, cli_set_unit, cli_set_up, cli_set_report, cli_set_quiet,
    cli_set_help;

/* options_sheet.c */
option_setter cli_set_paper, cli_set_roll, cli_set_fabric_width, cli_set_nap, cli_set_landscape,
    cli_set_margin, cli_set_gap, cli_set_oversize, cli_set_oversize_flatten, cli_set_overlap,
    cli_set_pieces, cli_set_piece_faces;

/* options_print.c */
option_setter cli_set_tabs, cli_set_tab_side, cli_set_number, cli_set_folds, cli_set_flat,
    cli_set_dpi, cli_set_no_guide, cli_set_black, cli_set_svg_unit, cli_set_real_dashes,
    cli_set_plain_dxf, cli_set_texture, cli_set_no_texture, cli_set_textures_anywhere,
    cli_set_registration;

/* options_search.c */
option_setter cli_set_method_unfold, cli_set_method_flatten, cli_set_weight, cli_set_warp_weight,
    cli_set_refine, cli_set_effort, cli_set_ease, cli_set_population, cli_set_generations,
    cli_set_patience, cli_set_restarts, cli_set_crossover, cli_set_mutation, cli_set_seed,
    cli_set_threads, cli_set_time;

/* options_cloth.c */
option_setter cli_set_seams, cli_set_crease, cli_set_max_strain, cli_set_fabric, cli_set_grain,
    cli_set_on_fold, cli_set_no_twins, cli_set_no_strain_map, cli_set_allowance, cli_set_hem,
    cli_set_notch, cli_set_notch_every;

#endif
