/* render/guide.c - "How to read this pattern": a page of its own where sheets had no room for it.
 */
#include "render/draw.h"
#include "render/furniture.h"
#include "render/more_pages.h"
#include "render/text.h"

static const char *explain(ktg_stroke stroke) {
    static const char *const words[KTG_STROKE_COUNT] = {
        [KTG_STROKE_CUT] = "cut: along the whole outline, slits too",
        [KTG_STROKE_MOUNTAIN] = "mountain fold: away from you, the print outside",
        [KTG_STROKE_VALLEY] = "valley fold: towards you, the print inside",
        [KTG_STROKE_TAB] =
            "glue tab: fold it at its foot, glue it under the edge of the same number",
        [KTG_STROKE_JOINT] =
            "no tab: glue it edge to edge, halves on each other, on a strip of paper inside",
        [KTG_STROKE_SEW] = "seam: sew here",
        [KTG_STROKE_GRAIN] = "grain: lay it along the threads of the cloth",
        [KTG_STROKE_PLACE_FOLD] = "place on fold: lay it on the fold of the doubled cloth",
        [KTG_STROKE_DART] = "dart: bring both sides together and sew",
        [KTG_STROKE_NOTCH] = "notch: must meet the same notch of the other piece",
        [KTG_STROKE_INTERNAL] = "inner line: a mark, neither cut nor sewn",
        [KTG_STROKE_TRIM] = "trim: cut the sheet here before it is joined to its neighbour",
        [KTG_STROKE_JOIN] = "join: lay the neighbour, trimmed, up to this line",
    };
    return words[stroke];
}

static void write_lines(ktg_column *at) {
    for (int k = 0; k < KTG_STROKE_COUNT; k++)
        if (at->drawing->kinds & 1u << k) {
            ktg_legend_sample(at->drawing, at->cairo, (ktg_stroke)k, at->x, at->y + 1.2 * at->scale,
                              18 * at->scale);
            ktg_column_write(at, KTG_FACE_PLAIN, 2.4, 23, explain((ktg_stroke)k));
            ktg_column_skip(at, 1.6);
        }
}

static void write_head(ktg_column *at) {
    char details[KTG_DETAIL_COUNT][KTG_DETAIL_SIZE];
    ktg_column_write(at, KTG_FACE_BOLD, 4.2, 0, "How to read this pattern");
    ktg_column_skip(at, 1);
    ktg_column_write(at, KTG_FACE_BOLD, 2.8, 0, at->drawing->title);
    size_t count = ktg_furniture_details(at->drawing, SIZE_MAX, details);
    for (size_t i = 0; i + 1 < count; i++) /* the last one has a section of its own */
        ktg_column_write(at, KTG_FACE_PLAIN, 2.4, 0, details[i]);
    ktg_column_skip(at, 5);
}

static void write_rulers(ktg_column *at) {
    double room = at->floor - at->y - 6;
    ktg_column_write(at, KTG_FACE_BOLD, 2.8, 0, "Size");
    ktg_column_write(at, KTG_FACE_PLAIN, 2.4, 0,
                     "Print at 100 %, not fitted to the page, then measure both rulers.");
    if (room < ktg_ruler_length(false) || at->width < ktg_ruler_length(false) + 6)
        return;
    bool whole = room >= ktg_ruler_length(true) && at->width >= ktg_ruler_length(true) + 6;
    double foot = at->y + 4 + ktg_ruler_length(whole);
    ktg_ruler_draw(at->cairo, at->x + 2, foot, whole, true);
    ktg_ruler_draw(at->cairo, at->x + 6, foot + 4, whole, false);
}

void ktg_guide_draw(const ktg_drawing *drawing, cairo_t *cairo, double width_mm, double height_mm) {
    ktg_column at = ktg_column_begin(drawing, cairo, width_mm, height_mm);
    write_head(&at);
    ktg_column_write(&at, KTG_FACE_BOLD, 2.8, 0, "Lines");
    ktg_column_skip(&at, 1);
    write_lines(&at);
    ktg_column_skip(&at, 5);
    ktg_column_write(&at, KTG_FACE_BOLD, 2.8, 0, "Numbers");
    ktg_column_write(&at, KTG_FACE_PLAIN, 2.4, 0, "Edges with the same number belong together.");
    ktg_column_write(&at, KTG_FACE_PLAIN, 2.4, 0,
                     "Edges without one meet in a narrow notch: they belong together, too.");
    ktg_column_write(
        &at, KTG_FACE_PLAIN, 2.4, 0,
        "A dot follows numbers that could be read upside down: \"6.\" is six, not nine.");
    ktg_column_skip(&at, 5);
    write_rulers(&at);
}
