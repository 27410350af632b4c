/* core/file.h - reading a whole file (shared between folders, not installed). */
#ifndef KTG_CORE_FILE_H
#define KTG_CORE_FILE_H

#include "core/core.h"

/* Reads `path` ("-" = standard input) into memory. *bytes has size + 1 bytes, the last one 0; free
 * with ktg_free. KTG_FILE when it does not exist, is a directory, cannot be read or grows without
 * end; KTG_LIMIT above `most` bytes. */
KTG_NODISCARD ktg_status ktg_file_read(ktg_context *context, const char *path, size_t most,
                                       char **bytes, size_t *size);

#endif
