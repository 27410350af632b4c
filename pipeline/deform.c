/* pipeline/deform.c - what a deformation did, in words and as JSON. */
#include "core/memory.h"
#include "pipeline/stages.h"

void ktg_pipeline_tell_deform(ktg_context *context, const ktg_deform_report *r) {
    ktg_log(context, KTG_LOG_NOTE, "deformed: edges are %.1f to %.1f %% of their length",
            100 * r->stretch_min, 100 * r->stretch_max);
    if (r->vertex_links + r->follower_links > 0)
        ktg_log(context, KTG_LOG_NOTE, "links: %u rigid pairs, %u vertices that follow",
                r->vertex_links, r->follower_links);
    if (r->links_left_out > 0)
        ktg_log(context, KTG_LOG_WARNING,
                "links left out because their ends hang on each other already: %u",
                r->links_left_out);
    if (r->flipped_faces + r->degenerate_faces > 0)
        ktg_log(context, KTG_LOG_WARNING,
                "%u faces have turned over, %u have lost their area: move less, or hold less close "
                "to what moves",
                r->flipped_faces, r->degenerate_faces);
}

ktg_status ktg_pipeline_put_deform(ktg_context *context, ktg_output *output,
                                   const ktg_deform_report *r, const char *before) {
    const struct {
        const char *key;
        double value;
    } figures[] = {{"vertices", r->vertices},
                   {"faces", r->faces},
                   {"components", r->components},
                   {"unknowns", r->unknowns},
                   {"vertex_links", r->vertex_links},
                   {"follower_links", r->follower_links},
                   {"links_left_out", r->links_left_out},
                   {"steps", r->steps},
                   {"stretch_min", r->stretch_min},
                   {"stretch_max", r->stretch_max},
                   {"flipped_faces", r->flipped_faces},
                   {"degenerate_faces", r->degenerate_faces},
                   {"feature_error", r->feature_error},
                   {"link_error", r->link_error},
                   {"moved", r->moved},
                   {"seconds_setup", r->seconds_setup},
                   {"seconds_update", r->seconds_update}};
    for (size_t i = 0; i < sizeof figures / sizeof *figures; i++)
        KTG_TRY(ktg_output_print(context, output, "%s\n  \"%s%s\": %.17g",
                                 i > 0 || *before ? "," : "", before, figures[i].key,
                                 figures[i].value));
    return KTG_OK;
}

ktg_status ktg_pipeline_write_deform(ktg_context *context, const ktg_deform_report *report,
                                     ktg_output *output) {
    KTG_TRY(ktg_output_print(context, output, "{"));
    KTG_TRY(ktg_pipeline_put_deform(context, output, report, ""));
    return ktg_output_print(context, output, "\n}\n");
}
