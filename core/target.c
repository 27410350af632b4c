/* core/target.c - where an output file really goes. */
#include "core/target.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* More links than any system follows. */
#define MOST_LINKS 40

bool ktg_target_folder(const char *path, char *folder, size_t size) {
    const char *slash = strrchr(path, '/');
    int length = slash ? snprintf(folder, size, "%.*s", (int)(slash + 1 - path), path)
                       : snprintf(folder, size, "./");
    return length >= 0 && (size_t)length < size;
}

/* Puts what the link at `path` says in its place. */
static int follow_once(char path[PATH_MAX]) {
    char target[PATH_MAX], folder[PATH_MAX] = "";
    ssize_t length = readlink(path, target, sizeof target - 1);
    if (length < 0)
        return errno;
    target[length] = '\0';
    if (target[0] != '/' && strchr(path, '/') && !ktg_target_folder(path, folder, sizeof folder))
        return ENAMETOOLONG;
    int written = snprintf(path, PATH_MAX, "%s%s", folder, target);
    return written < PATH_MAX ? 0 : ENAMETOOLONG;
}

static int follow(char path[PATH_MAX]) {
    struct stat about;
    for (int links = 0; links < MOST_LINKS; links++) {
        if (lstat(path, &about) != 0)
            return errno == ENOENT ? 0 : errno;
        if (!S_ISLNK(about.st_mode))
            return 0;
        int error = follow_once(path);
        if (error != 0)
            return error;
    }
    return ELOOP;
}

static const char *last_part(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* Spells the folder in full, where it exists. */
static int spell_out(char path[PATH_MAX]) {
    char folder[PATH_MAX], full[PATH_MAX], name[PATH_MAX];
    if (!ktg_target_folder(path, folder, sizeof folder) || !realpath(folder, full))
        return 0;
    strcpy(name, last_part(path));
    int written = snprintf(path, PATH_MAX, "%s%s%s", full, full[1] ? "/" : "", name);
    return written < PATH_MAX ? 0 : ENAMETOOLONG;
}

int ktg_target_find(const char *path, ktg_target *place) {
    struct stat about;
    *place = (ktg_target){.regular = true};
    if (strlen(path) >= PATH_MAX)
        return ENAMETOOLONG;
    strcpy(place->path, path);
    if (stat(path, &about) == 0) {
        place->exists = true;
        place->regular = S_ISREG(about.st_mode);
        place->mode = about.st_mode;
        place->owner = about.st_uid;
        place->group = about.st_gid;
    } else if (errno != ENOENT) {
        return errno;
    }
    int error = place->regular ? follow(place->path) : 0;
    return error == 0 && place->regular ? spell_out(place->path) : error;
}

static bool same_inode(const char *a, const char *b) {
    struct stat x, y;
    return stat(a, &x) == 0 && stat(b, &y) == 0 && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

bool ktg_target_same(const char *a, const char *b) {
    ktg_target x, y;
    if (ktg_target_find(a, &x) != 0 || ktg_target_find(b, &y) != 0)
        return strcmp(a, b) == 0;
    if (!x.regular || !y.regular)
        return false;
    return strcmp(x.path, y.path) == 0 || (x.exists && y.exists && same_inode(x.path, y.path));
}
