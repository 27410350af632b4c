# tools/dependencies.sh - installs what a build needs and is missing (sourced by the other tools).
# shellcheck shell=sh disable=SC2034,SC2154
#
# The list is Debian 12's; meson.build checks the same set and names what it misses.

build_packages="gcc g++ meson ninja-build pkg-config libcgal-dev libgmp-dev libmpfr-dev \
libopenmesh-dev libsuitesparse-dev libcairo2-dev libfontconfig-dev libpng-dev libjpeg-dev libjansson-dev libcmocka-dev fonts-dejavu-core"
# what some tests look at the results with, and the formatting lint
test_packages="poppler-utils clang-format python3 librsvg2-bin python3-ezdxf locales"

# run_quietly WHAT COMMAND...: its words are shown only when it fails.
run_quietly() {
    what=$1
    shift
    log=$(mktemp)
    if "$@" >"$log" 2>&1; then
        rm -f "$log"
        return 0
    fi
    tail -n 40 "$log" >&2
    rm -f "$log"
    echo "$what failed; its last lines are above." >&2
    return 1
}

# install_missing PACKAGE...: says first what it is going to do.
install_missing() {
    if ! command -v dpkg-query >/dev/null 2>&1 || ! command -v apt-get >/dev/null 2>&1; then
        return 0 # not a Debian system: meson names what is missing
    fi
    missing=""
    for package in "$@"; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' ||
            missing="$missing $package"
    done
    [ -z "$missing" ] && return 0
    as_root=""
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null 2>&1; then
            echo "Katagami needs packages that only an administrator can install here. Please have this run:" >&2
            echo "    apt-get install --no-install-recommends$missing" >&2
            return 1
        fi
        as_root="sudo"
    fi
    echo "Katagami needs these packages and installs them with apt-get:" >&2
    # shellcheck disable=SC2086
    echo $missing | fold -s -w 76 | sed 's/^/    /' >&2
    [ -z "$as_root" ] || sudo true || return 1 # asks for the password where it can be seen
    run_quietly "apt-get update" $as_root apt-get update || return 1
    # shellcheck disable=SC2086
    run_quietly "apt-get install" $as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y --no-install-recommends $missing
}

# configure FOLDER [MESON OPTIONS]: sets up a build folder once, and anew when the clone has moved.
configure() {
    folder=$1
    shift
    [ -f "$folder/build.ninja" ] && grep -qF "\"$root\"" "$folder/meson-info/meson-info.json" && return 0
    rm -rf "$folder"
    run_quietly "meson setup" meson setup "$folder" "$root" "$@"
}

# build FOLDER [TARGET]: a line that counts on a terminal, silence elsewhere.
build() {
    if [ -t 2 ]; then
        NINJA_STATUS="[%f of %t] " ninja -C "$@" >&2
    else
        run_quietly "The build" ninja -C "$@"
    fi
}
