/* pipeline/pipeline.h - the whole job as one call: a model goes in, files that can be printed come
 * out.
 *
 *     ktg_pipeline_options options;
 *     ktg_pipeline_defaults(&options);
 *     options.model = "fox.obj";
 *     options.outputs = (const char *[]){"fox.pdf", "fox.json"};
 *     options.output_count = 2;
 *     ktg_pipeline_report report;
 *     if (ktg_pipeline_run(context, &options, &report) != KTG_OK)
 *         puts(ktg_context_message(context));
 */
#ifndef KTG_PIPELINE_PIPELINE_H
#define KTG_PIPELINE_PIPELINE_H

#include "core/core.h"
#include "deform/deform.h"
#include "flatten/flatten.h"
#include "layout/layout.h"
#include "mesh/mesh.h"
#include "paint/paint.h"
#include "pattern/pattern.h"
#include "render/render.h"
#include "unfold/unfold.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How large the finished model becomes. */
typedef enum ktg_size_rule {
    KTG_SIZE_FIT,    /* paper: as large as `sheets` sheets allow; cloth: not allowed */
    KTG_SIZE_HEIGHT, /* the extent along `up` is size_mm */
    KTG_SIZE_WIDTH,  /* the extent along x (z when x is up) is size_mm */
    KTG_SIZE_LENGTH, /* the extent along the third axis is size_mm */
    KTG_SIZE_FACTOR  /* size_mm millimetres per unit of the model file */
} ktg_size_rule;

/* What is done when something is larger than a sheet at the size that is asked for. */
typedef enum ktg_large {
    KTG_LARGE_SPLIT, /* paper: the fewest pieces such that each fits (cloth: like error) */
    KTG_LARGE_TILE,  /* larger pieces become posters: they are spread over sheets that overlap */
    KTG_LARGE_SCALE, /* the size shrinks until every piece fits a sheet */
    KTG_LARGE_ERROR  /* the run fails and says which size would fit */
} ktg_large;

typedef enum ktg_axis { KTG_AXIS_AUTO, KTG_AXIS_X, KTG_AXIS_Y, KTG_AXIS_Z } ktg_axis;

/* Whether the model's images and colours are printed. */
typedef enum ktg_colour_rule {
    KTG_COLOURS_AUTO, /* paper: yes, unless it has one colour all over; cloth: no */
    KTG_COLOURS_ON,
    KTG_COLOURS_OFF
} ktg_colour_rule;

/* The number of faces that stands for "as many as there are". */
#define KTG_ALL_FACES 0

struct ktg_pipeline_report;

typedef struct ktg_pipeline_options {
    ktg_pattern_mode mode; /* KTG_PAPER unfolds, KTG_CLOTH flattens */
    const char *model;     /* path of the model file */
    ktg_mesh_format model_format;
    uint32_t faces; /* simplify to this many; 500 for paper, KTG_ALL_FACES for cloth */

    const char *edit; /* an edit file (deform/deform.h) by which the model is changed as it is read,
                         or NULL */
    const char *const *keep; /* keep_count files of edges that stay folds (ktg_mesh_read_edges) */
    const char *const *cut;  /* cut_count files of edges that are cut; both for paper only */
    const char *const *omit; /* omit_count groups, objects or materials whose faces are left out */
    size_t keep_count, cut_count, omit_count;

    bool
        part_groups; /* cloth: each connected part of the model, as it was read, becomes a group, so
                        that seams of KTG_SEAMS_GROUPS are between parts that the repair joins */

    ktg_size_rule size_rule;
    double size_mm;
    uint32_t sheets;   /* with KTG_SIZE_FIT: how many it may take; 1 */
    ktg_axis up;       /* auto: z for STL, y otherwise */
    ktg_large large;   /* split; cloth wants tile */
    double overlap_mm; /* of the sheets of a poster; 10 */

    ktg_unfold_options unfold; /* its sheet, finish, scale, oversize and rules are set by the run */
    ktg_flatten_options flatten;
    ktg_finish_options finish;
    ktg_layout_options layout; /* what unfold.seconds leaves limits its time */
    ktg_render_options
        render;              /* its `up`, `marker`, `strain_limit` and `paint` are set by the run */
    ktg_colour_rule colours; /* auto */
    bool textures_anywhere; /* images and material files outside the model's folder are read, too */
    bool marker; /* cloth: the layout's roll is fabric, on which all pieces lie, twins too, and
                    whole: finish.twins and on_fold are passed over */

    const char *const *outputs; /* output_count paths, kinds by ending: .pdf .svg .dxf .png .json;
                                   "-" is PDF on standard output. A PNG shows all sheets, an SVG or
                                   a DXF of several becomes NAME-01.svg, NAME-02.svg, ... (of cloth
                                   a DXF is one, unless render.plain_dxf); with "%d" in its name any
                                   becomes a file for each sheet, its number in that place */
    size_t output_count;
    const char *report; /* where the figures go as JSON, or NULL; one of the outputs in every other
                           way */

    void (*made)(void *user,
                 const struct ktg_pipeline_report *report); /* called once, when all is written and
                                                               only the files' names are to come; or
                                                               NULL */
    void *user;
} ktg_pipeline_options;

KTG_API void ktg_pipeline_defaults(ktg_pipeline_options *options);

/* What came out, and how it was made. */
typedef struct ktg_pipeline_report {
    ktg_mesh_report
        model; /* as read, without what is left out; self-intersections not looked for */
    ktg_deform_report deform; /* with an edit */
    ktg_repair_report repair;
    ktg_paint_report paint;
    ktg_simplify_report simplify;
    ktg_unfold_report unfold;   /* paper */
    ktg_flatten_report flatten; /* cloth */
    ktg_finish_report finish;
    ktg_layout_report layout;
    uint32_t faces, pieces, components;
    uint32_t self_intersections; /* of the surface that was unfolded; pairs of faces */
    double fabric_length_mm;     /* of a marker: how much of the roll it takes; else 0 */
    ktg_vec2 sheet_mm; /* width and height of the sheets; of a page that fits, what it became */
    double mm_per_unit;
    ktg_vec3 size_mm; /* of the finished model: width, height (along up), length */
    ktg_axis up;      /* the axis that was taken */
    double seconds, seconds_unfold;
} ktg_pipeline_report;

/* Gives back what the report owns (flatten.panels); the figures stay. */
KTG_API void ktg_pipeline_report_free(ktg_pipeline_report *report);

/* Reads, deforms, leaves out, repairs, simplifies, unfolds (or flattens), scales, finishes, lays
 * out, renders and writes. All outputs are written beside their places first, brought to the disk
 * and then renamed together: when anything fails, no file is touched. The log says which files were
 * written. `report` may be NULL; after a failure it holds what was known by then;
 * it is freed by ktg_pipeline_report_free either way. KTG_ARGUMENT for
 * options that make no sense, an ending that is not known, a file that is to be written twice or is
 * the model. */
KTG_API KTG_NODISCARD ktg_status ktg_pipeline_run(ktg_context *context,
                                                  const ktg_pipeline_options *options,
                                                  ktg_pipeline_report *report);

/* What the log says of a deformation; ktg_pipeline_run does so itself. */
KTG_API void ktg_pipeline_tell_deform(ktg_context *context, const ktg_deform_report *report);

/* Its figures as JSON, as `katagami deform --report` writes them and, with "deform_" before each
 * key, ktg_pipeline_write_report. */
KTG_API KTG_NODISCARD ktg_status ktg_pipeline_write_deform(ktg_context *context,
                                                           const ktg_deform_report *report,
                                                           ktg_output *output);

/* The report as JSON, as options->report gets it: faces, pieces, components, seams, tabs_full,
 * tabs_reduced, tabs_none, sheets, mm_per_unit, fill, seconds, seconds_unfold, stopped_by and more
 * (docs/report.md); with a pattern (or NULL) of cloth, the lengths of its seams. */
KTG_API KTG_NODISCARD ktg_status ktg_pipeline_write_report(ktg_context *context,
                                                           const ktg_pipeline_options *options,
                                                           const ktg_pipeline_report *report,
                                                           const ktg_pattern *pattern,
                                                           ktg_output *output);

/* ---- warping a piece ---------------------------------------------------------------------- */

/* A piece of a cloth pattern that is moved by handles. */
typedef struct ktg_warp_job {
    const char *pattern; /* a JSON file */
    const char *piece;   /* its number ("3", "piece3"; from 1) or its name; NULL: the only one */
    const char *handles; /* ktg_handles_read; lengths in mm, vertices those of the piece */
    ktg_warp_options warp;
    bool sheet_given; /* options->layout.sheet and .roll are wished for, not those of the pattern */
    bool allowance_given, hem_given, notch_given; /* the same of options->finish */
} ktg_warp_job;

typedef struct ktg_warp_result {
    ktg_warp_report warp;
    ktg_finish_report finish; /* of the whole pattern, finished again */
    ktg_layout_report layout;
    uint32_t piece;              /* its index */
    uint32_t seams_off;          /* of that piece: sides differ by more than 0.5 mm */
    double seam_error_mm;        /* the largest difference of its seams, */
    double seam_error_before_mm; /* and what it was */
    uint32_t twins_lost;         /* pieces that were cut with it and no longer are */
    double allowance_mm, hem_mm; /* that it was finished with */
} ktg_warp_result;

/* Reads a pattern, warps one piece, measures seams and strain again, finishes the pattern with the
 * allowances it was made with (as its outlines show them) unless others are given, lays it on
 * sheets like its own, and writes options->outputs. The log says what seams of the piece differ by,
 * and which twins are none any more. Of `options`, finish, layout, large, overlap_mm, render,
 * outputs and output_count count. KTG_GEOMETRY where faces stay folded or the piece lies on itself,
 * KTG_ARGUMENT for a pattern of paper, or a piece that is not there. `result` may be NULL. */
KTG_API KTG_NODISCARD ktg_status ktg_pipeline_warp(ktg_context *context,
                                                   const ktg_pipeline_options *options,
                                                   const ktg_warp_job *job,
                                                   ktg_warp_result *result);

#ifdef __cplusplus
}
#endif
#endif
