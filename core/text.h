/* core/text.h - text in printf form, the same in every locale (shared between folders, not
 * installed).
 *
 * A program that calls the library may have set a locale in which numbers have decimal commas. */
#ifndef KTG_CORE_TEXT_H
#define KTG_CORE_TEXT_H

#include "core/core.h"

#include <stdarg.h>
#include <stdio.h>

/* snprintf, vsnprintf and vfprintf, but numbers have a point. */
int ktg_format(char *text, size_t size, const char *format, ...) KTG_PRINTF(3, 4);
int ktg_vformat(char *text, size_t size, const char *format, va_list arguments) KTG_PRINTF(3, 0);
int ktg_vprint(FILE *stream, const char *format, va_list arguments) KTG_PRINTF(2, 0);

/* The same of any length into `size` bytes: where it is too long, "..." stands for its middle, so
 * that a long path takes away neither itself nor what is said of it. */
void ktg_vformat_elided(char *text, size_t size, const char *format, va_list arguments)
    KTG_PRINTF(3, 0);

#endif
