/* render/dxf.h - the words of a DXF file, Release 12, ASCII (render only). */
#ifndef KTG_RENDER_DXF_H
#define KTG_RENDER_DXF_H

#include "render/plot.h"

typedef struct ktg_dxf {
    ktg_context *context;
    ktg_output *output;
    bool ascii_only; /* other letters become question marks, not escapes */
} ktg_dxf;

/* A group: its code, and a value. Texts are clean UTF-8; what a DXF reserves is written otherwise.
 */
KTG_NODISCARD ktg_status ktg_dxf_word(const ktg_dxf *dxf, int code, const char *word);
KTG_NODISCARD ktg_status ktg_dxf_integer(const ktg_dxf *dxf, int code, int value);
KTG_NODISCARD ktg_status ktg_dxf_real(const ktg_dxf *dxf, int code, double value);
KTG_NODISCARD ktg_status ktg_dxf_text(const ktg_dxf *dxf, int code, const char *text);
/* A point in the codes 10 + `which` and 20 + `which`. */
KTG_NODISCARD ktg_status ktg_dxf_point(const ktg_dxf *dxf, int which, ktg_vec2 point);

/* "0 SECTION 2 NAME" ... "0 ENDSEC". */
KTG_NODISCARD ktg_status ktg_dxf_section(const ktg_dxf *dxf, const char *name);
/* The beginning of an entity in a layer. */
KTG_NODISCARD ktg_status ktg_dxf_entity(const ktg_dxf *dxf, const char *kind, const char *layer);

/* A LINE for two points, else a POLYLINE; `pattern` names its line type, or NULL. */
KTG_NODISCARD ktg_status ktg_dxf_way(const ktg_dxf *dxf, const char *layer, const char *pattern,
                                     const ktg_vec2 *points, size_t count, bool closed);
/* A TEXT that begins at a point; and one with its middle there, `width` wide for readers that know
 * no middles. */
KTG_NODISCARD ktg_status ktg_dxf_line(const ktg_dxf *dxf, const char *layer, ktg_vec2 at,
                                      double height, const char *text);
KTG_NODISCARD ktg_status ktg_dxf_label(const ktg_dxf *dxf, const char *layer, ktg_vec2 at,
                                       double width, double height, double angle, const char *text);

#endif
