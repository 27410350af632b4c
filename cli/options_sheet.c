/* cli/options_sheet.c - options of the sheets and of what is larger than they are. */
#include "cli/option_lines.h"
#include "cli/words.h"

#include <string.h>

#define LONGEST_PAGE_MM 5000

bool cli_set_paper(settings *s, const char *text) {
    ktg_context *context = NULL;
    if (ktg_context_new(&context) != KTG_OK)
        return false;
    ktg_status status = ktg_sheet_parse(context, text, &s->pipeline.layout.sheet);
    s->pipeline.layout.roll = s->pipeline.marker = false;
    s->sheet_given = true;
    if (status != KTG_OK)
        snprintf(s->complaint, sizeof s->complaint, "%s", ktg_context_message(context));
    ktg_context_free(&context);
    return status == KTG_OK;
}

/* A roll: pages as wide as it is, and as long as a PDF's may be. */
bool cli_set_roll(settings *s, const char *text) {
    ktg_sheet_format *sheet = &s->pipeline.layout.sheet;
    double width_mm;
    if (!cli_parse_length(text, &width_mm) || width_mm < 20 || width_mm > LONGEST_PAGE_MM)
        return false;
    sheet->width_mm = width_mm;
    sheet->height_mm = LONGEST_PAGE_MM;
    strcpy(sheet->name, "the roll");
    s->pipeline.marker = false;
    s->sheet_given = true;
    return s->pipeline.layout.roll = true;
}

/* Fabric is a roll, too; a marker of it is one page as long as a PDF's may be. */
bool cli_set_fabric_width(settings *s, const char *text) {
    if (!cli_set_roll(s, text))
        return false;
    s->pipeline.layout.sheet.height_mm = KTG_LAYOUT_PAGE_MM;
    strcpy(s->pipeline.layout.sheet.name, "fabric");
    return s->pipeline.marker = true;
}

bool cli_set_nap(settings *s, const char *text) {
    (void)text;
    return s->pipeline.layout.nap = true;
}

bool cli_set_landscape(settings *s, const char *text) {
    (void)text;
    s->sheet_given = true;
    ktg_sheet_format *sheet = &s->pipeline.layout.sheet;
    if (ktg_layout_is_page(sheet)) {
        snprintf(s->complaint, sizeof s->complaint,
                 "--landscape turns sheets, not a page as large as the pattern needs");
        return false;
    }
    if (sheet->width_mm < sheet->height_mm && !s->pipeline.layout.roll) {
        double width = sheet->width_mm;
        sheet->width_mm = sheet->height_mm;
        sheet->height_mm = width;
    }
    return true;
}

bool cli_set_margin(settings *s, const char *text) {
    s->sheet_given = true;
    return cli_parse_length(text, &s->pipeline.layout.sheet.margin_mm);
}

bool cli_set_gap(settings *s, const char *text) {
    return cli_parse_length(text, &s->pipeline.layout.gap_mm);
}

bool cli_set_oversize(settings *s, const char *text) {
    static const char *const ways[] = {"split", "tile", "scale", "error", NULL};
    int way = cli_word_index(text, ways);
    s->oversize_given = true;
    s->pipeline.large = way >= 0 ? (ktg_large)way : KTG_LARGE_SPLIT;
    return way >= 0;
}

/* Cloth is cut along its seams only. */
bool cli_set_oversize_flatten(settings *s, const char *text) {
    return strcmp(text, "split") != 0 && cli_set_oversize(s, text);
}

bool cli_set_overlap(settings *s, const char *text) {
    return cli_parse_length(text, &s->pipeline.overlap_mm);
}

bool cli_set_pieces(settings *s, const char *text) {
    return cli_parse_count32(text, 1, &s->pipeline.unfold.pieces);
}

bool cli_set_piece_faces(settings *s, const char *text) {
    return cli_parse_count32(text, 1, &s->pipeline.unfold.piece_faces);
}
