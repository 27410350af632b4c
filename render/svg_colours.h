/* render/svg_colours.h - the colours of a sheet as a picture within an SVG (render only). */
#ifndef KTG_RENDER_SVG_COLOURS_H
#define KTG_RENDER_SVG_COLOURS_H

#include "render/plot.h"

/* Appends a layer with the picture, `units` user units in a millimetre, where the sheet has
 * colours.
 */
KTG_NODISCARD ktg_status ktg_svg_put_colours(const ktg_plot *plot, double units,
                                             ktg_output *output);

#endif
