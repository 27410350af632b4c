#!/bin/sh
# Every source file is as .clang-format wants it. usage: format.sh ROOT
command -v clang-format >/dev/null 2>&1 || exit 77
cd "$1" || exit 1
find core mesh deform pattern unfold flatten layout render verify pipeline cli tests bench \
    \( -name '*.c' -o -name '*.h' -o -name '*.cpp' -o -name '*.hpp' \) -print0 2>/dev/null |
    xargs -0 clang-format --dry-run -Werror
