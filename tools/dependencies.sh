# tools/dependencies.sh - installs what a build needs and is missing (sourced by the other tools).
#
# The list is Debian 12's; meson.build checks the same set and names what it misses.

build_packages="gcc g++ meson ninja-build pkg-config libcgal-dev libgmp-dev libmpfr-dev \
libopenmesh-dev libsuitesparse-dev libcairo2-dev libjansson-dev libcmocka-dev fonts-dejavu-core"
# what some tests look at the results with, and the formatting lint
test_packages="poppler-utils clang-format python3"

# install_missing PACKAGE...: says first what it is going to do.
install_missing() {
    if ! command -v dpkg-query >/dev/null 2>&1; then
        return 0 # not a Debian system: meson names what is missing
    fi
    missing=""
    for package in "$@"; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' ||
            missing="$missing $package"
    done
    [ -z "$missing" ] && return 0
    echo "Katagami needs these packages and installs them with apt-get:$missing" >&2
    as_root=""
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null 2>&1; then
            echo "Neither root nor sudo: please have somebody run  apt-get install$missing" >&2
            return 1
        fi
        as_root="sudo"
    fi
    $as_root apt-get update -qq >&2 || return 1
    # shellcheck disable=SC2086
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
        $missing >&2
}

# configure FOLDER [MESON OPTIONS]: sets up a build folder once.
configure() {
    folder=$1
    shift
    [ -f "$folder/build.ninja" ] && return 0
    rm -rf "$folder"
    meson setup "$folder" "$root" "$@" >"$root/build.log" 2>&1 || {
        cat "$root/build.log" >&2
        return 1
    }
    rm -f "$root/build.log"
}
