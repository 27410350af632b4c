/* core/target.h - where an output file really goes (shared between folders, not installed). */
#ifndef KTG_CORE_TARGET_H
#define KTG_CORE_TARGET_H

#include "core/core.h"

#include <limits.h>
#include <sys/types.h>

/* A path followed through symbolic links, also to a file that does not exist yet. */
typedef struct ktg_target {
    char path[PATH_MAX];  /* of a regular file the same however it was spelt */
    bool exists, regular; /* regular: a plain file, there or to be made */
    mode_t mode;          /* of a file that exists */
    uid_t owner;
    gid_t group;
} ktg_target;

/* 0, or the errno that says why there can be no such file. */
int ktg_target_find(const char *path, ktg_target *place);

/* Whether two paths are one file, there or to be made. Devices are never: they may be named twice.
 */
bool ktg_target_same(const char *a, const char *b);

/* The place of an output, owned by it; NULL where it is no regular file. */
const char *ktg_output_target(const ktg_output *output);

/* The folder of a path, with its slash ("./" where it names none). False where it does not fit. */
bool ktg_target_folder(const char *path, char *folder, size_t size);

#endif
