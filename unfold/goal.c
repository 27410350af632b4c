/* unfold/goal.c - sheets and tabs in the unit of the dual graph. */
#include "unfold/goal.h"

/* Parts of the sheet that faces fill at best, without tabs and with tabs. */
#define FILL_BARE 0.55
#define FILL_TABS 0.42

/* Kept between a tab and everything else, in mm: a little more than tabs need in the end. */
#define AIR_MM 0.15

static ktg_vec2 printable(const ktg_unfold_options *o) {
    double margins = 2 * o->sheet.margin_mm;
    return (ktg_vec2){o->sheet.width_mm - margins, o->sheet.height_mm - margins};
}

double ktg_goal_mm(const ktg_unfold_options *o, double area, double scale) {
    if (o->mm_per_unit > 0)
        return o->mm_per_unit / scale;
    ktg_vec2 sheet = printable(o);
    double fill = o->finish.tab_height_mm > 0 ? FILL_TABS : FILL_BARE;
    return sqrt(fill * sheet.x * sheet.y / area);
}

bool ktg_goal_tabs(const ktg_unfold_options *o, double mm, ktg_seam_tab_wish *wish) {
    const ktg_finish_options *f = &o->finish;
    if (!(f->tab_height_mm > 0))
        return false;
    *wish = (ktg_seam_tab_wish){.height = f->tab_height_mm / mm,
                                .least = f->tab_least_mm / mm,
                                .edge = f->tab_edge_mm / mm,
                                .inset = f->tab_inset_mm / mm,
                                .air = AIR_MM / mm,
                                .cot = 1 / tan(f->tab_flank),
                                .half = ktg_goal_half(o, mm, 1)};
    return true;
}

ktg_vec2 ktg_goal_half(const ktg_unfold_options *o, double mm, double part) {
    return ktg_mul2(printable(o), 0.5 * sqrt(part) / mm);
}
