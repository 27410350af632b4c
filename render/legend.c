/* render/legend.c - what the kinds of lines mean: a short sample and a word of each. */
#include "render/draw.h"
#include "render/furniture.h"
#include "render/poster.h"
#include "render/text.h"

#define SAMPLE_MM       6.0
#define WORD_GAP_MM     1.2
#define ENTRY_GAP_MM    3.0
#define BRIEF_GAP_MM    2.2
#define MARK_SAMPLE_MM  3.0 /* of what is no line */
#define LEGEND_DIGIT_MM 1.7

const char *ktg_legend_word(ktg_stroke stroke, bool brief) {
    static const char *const words[KTG_STROKE_COUNT][2] = {
        [KTG_STROKE_CUT] = {"cut", "cut"},
        [KTG_STROKE_MOUNTAIN] = {"mountain fold", "mountain"},
        [KTG_STROKE_VALLEY] = {"valley fold", "valley"},
        [KTG_STROKE_TAB] = {"glue tab", "tab"},
        [KTG_STROKE_JOINT] = {"edge to edge", "edge to edge"},
        [KTG_STROKE_SEW] = {"seam", "seam"},
        [KTG_STROKE_GRAIN] = {"grain", "grain"},
        [KTG_STROKE_PLACE_FOLD] = {"place on fold", "on fold"},
        [KTG_STROKE_DART] = {"dart", "dart"},
        [KTG_STROKE_NOTCH] = {"notch", "notch"},
        [KTG_STROKE_INTERNAL] = {"inner line", "inner"},
        [KTG_STROKE_TRIM] = {"trim", "trim"},
        [KTG_STROKE_JOIN] = {"join", "join"},
    };
    return words[stroke][brief];
}

static void tab_sample(const ktg_drawing *drawing, cairo_t *cairo, double x, double y,
                       double width) {
    double half = 1.1, flank = 1.6;
    cairo_move_to(cairo, x, y + half);
    cairo_line_to(cairo, x + flank, y - half);
    cairo_line_to(cairo, x + width - flank, y - half);
    cairo_line_to(cairo, x + width, y + half);
    ktg_draw_set_tint(cairo);
    cairo_fill_preserve(cairo);
    ktg_draw_set_stroke(drawing, cairo, KTG_STROKE_CUT);
    cairo_stroke(cairo);
}

/* A cut with the mark on it. */
static void joint_sample(const ktg_drawing *drawing, cairo_t *cairo, double x, double y,
                         double width) {
    double middle = x + width / 2, foot = y + 0.6;
    ktg_vec2 mark[] = {{middle - 0.85, foot}, {middle, foot - 1}, {middle + 0.85, foot}};
    ktg_draw_stroke(drawing, cairo, KTG_STROKE_CUT, (ktg_vec2){x, foot},
                    (ktg_vec2){x + width, foot});
    ktg_draw_joint(drawing, cairo, mark);
}

void ktg_legend_sample(const ktg_drawing *drawing, cairo_t *cairo, ktg_stroke stroke, double x,
                       double y, double width) {
    ktg_vec2 from = {x, y}, to = {x + width, y};
    if (stroke == KTG_STROKE_TAB) {
        tab_sample(drawing, cairo, x, y, width);
        return;
    }
    if (stroke == KTG_STROKE_JOINT) {
        joint_sample(drawing, cairo, x, y, width);
        return;
    }
    if (stroke == KTG_STROKE_NOTCH) {
        from = (ktg_vec2){x + width / 2, y - 1.1};
        to = (ktg_vec2){x + width / 2, y + 1.1};
    }
    ktg_draw_stroke(drawing, cairo, stroke, from, to);
    if (stroke == KTG_STROKE_GRAIN) {
        ktg_draw_arrow_head(cairo, from, to, 1.8);
        ktg_draw_arrow_head(cairo, to, from, 1.8);
    }
}

static void set_words(cairo_t *cairo) {
    ktg_text_set(cairo, KTG_FACE_PLAIN, LEGEND_DIGIT_MM);
}

static double sample_width(ktg_stroke stroke) {
    return stroke == KTG_STROKE_JOINT || stroke == KTG_STROKE_NOTCH ? MARK_SAMPLE_MM : SAMPLE_MM;
}

static double entry_gap(bool brief) {
    return brief ? BRIEF_GAP_MM : ENTRY_GAP_MM;
}

static double entry_width(cairo_t *cairo, ktg_stroke stroke, bool brief) {
    return sample_width(stroke) + WORD_GAP_MM +
           ktg_text_width(cairo, ktg_legend_word(stroke, brief));
}

/* Which strokes a reader of the page meets, as bits: those of the pattern, but how sheets join only
 * where they do. */
static unsigned kinds_on(const ktg_page *page) {
    unsigned joins = 1u << KTG_STROKE_TRIM | 1u << KTG_STROKE_JOIN;
    return page->drawing->kinds & ~(ktg_is_tile(page->sheet) ? 0 : joins);
}

double ktg_legend_width(const ktg_page *page, bool brief) {
    double width = -entry_gap(brief);
    set_words(page->cairo);
    for (int k = 0; k < KTG_STROKE_COUNT; k++)
        if (kinds_on(page) & 1u << k)
            width += entry_width(page->cairo, (ktg_stroke)k, brief) + entry_gap(brief);
    return width;
}

static void draw_entry(const ktg_page *page, ktg_stroke stroke, double x, double y, bool brief) {
    cairo_t *cairo = page->cairo;
    ktg_legend_sample(page->drawing, cairo, stroke, x, y, sample_width(stroke));
    cairo_set_source_rgb(cairo, 0.25, 0.25, 0.25);
    ktg_text_draw(cairo, x + sample_width(stroke) + WORD_GAP_MM, y + LEGEND_DIGIT_MM / 2,
                  ktg_legend_word(stroke, brief));
}

size_t ktg_legend_draw(const ktg_page *page, double x, double y, double width, bool brief,
                       bool dry) {
    size_t lines = 1;
    double at = 0;
    set_words(page->cairo);
    for (int k = 0; k < KTG_STROKE_COUNT; k++) {
        if (!(kinds_on(page) & 1u << k))
            continue;
        double entry = entry_width(page->cairo, (ktg_stroke)k, brief);
        if (at > 0 && at + entry > width + 1e-6) {
            at = 0;
            lines++;
        }
        if (!dry)
            draw_entry(page, (ktg_stroke)k, x + at, y + (double)(lines - 1) * KTG_LEGEND_LINE_MM,
                       brief);
        at += entry + entry_gap(brief);
    }
    return lines;
}
