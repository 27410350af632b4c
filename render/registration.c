/* render/registration.c - marks by which a cutter finds the print on a sheet. */
#include "render/draw.h"
#include "render/furniture.h"

#define LEAST_REACH_MM 0.8
#define MOST_REACH_MM  3.0

/* Between what printers leave white and the pieces, where there is room, else anywhere in the
 * margin. */
bool ktg_registration_find(const ktg_pattern_sheet *sheet, ktg_vec2 marks[KTG_REGISTRATION_MARKS],
                           double *reach) {
    const double *p = sheet->printable;
    double margin = fmin(fmin(p[0], p[1]), fmin(sheet->width_mm - p[2], sheet->height_mm - p[3]));
    double edge = margin >= KTG_PAPER_EDGE_MM + 2 * LEAST_REACH_MM ? KTG_PAPER_EDGE_MM : 0;
    double in = (edge + margin) / 2;
    *reach = fmin(0.9 * (margin - edge) / 2, MOST_REACH_MM);
    marks[0] = (ktg_vec2){in, in};
    marks[1] = (ktg_vec2){in, sheet->height_mm - in};
    marks[2] = (ktg_vec2){sheet->width_mm - in, sheet->height_mm - in};
    return *reach >= LEAST_REACH_MM;
}

void ktg_registration_draw(const ktg_page *page) {
    ktg_vec2 marks[KTG_REGISTRATION_MARKS];
    double r;
    if (!page->drawing->options.registration || !ktg_registration_find(page->sheet, marks, &r))
        return;
    cairo_t *cairo = page->cairo;
    ktg_draw_set_stroke(page->drawing, cairo, KTG_STROKE_CUT);
    cairo_set_line_width(cairo, KTG_FOLD_MM);
    for (int k = 0; k < KTG_REGISTRATION_MARKS; k++) {
        double x = marks[k].x, y = page->sheet->height_mm - marks[k].y;
        cairo_move_to(cairo, x - r, y);
        cairo_line_to(cairo, x + r, y);
        cairo_move_to(cairo, x, y - r);
        cairo_line_to(cairo, x, y + r);
        cairo_new_sub_path(cairo);
        cairo_arc(cairo, x, y, r / 2, 0, 2 * KTG_PI);
    }
    cairo_stroke(cairo);
}
