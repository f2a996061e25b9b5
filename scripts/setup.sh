# Part of ./run, for every command: packages, Python environments, builds.
# shellcheck disable=SC2034 # the other parts use its variables

BUILD_PACKAGES=(g++ cmake ninja-build pkg-config libtinygltf-dev nlohmann-json3-dev libglm-dev libusb-1.0-0-dev
    libhidapi-dev libwebsockets-dev libjsmn-dev libcmocka-dev libkissfft-dev libpng-dev libjpeg-dev umockdev libumockdev-dev python3)
DEMO_PACKAGES=(g++ cmake ninja-build libtinygltf-dev nlohmann-json3-dev libglm-dev python3)
FUZZ_PACKAGES=(clang llvm libclang-rt-dev)
PLOT_PACKAGES=(python3 python3-numpy python3-matplotlib)
WEB_PACKAGES=(emscripten node-acorn libtinygltf-dev nlohmann-json3-dev libglm-dev)
WINDOWS_PACKAGES=(gcc-mingw-w64-x86-64-posix g++-mingw-w64-x86-64-posix wine wine64 xz-utils)
UNITY_PACKAGES=(mono-mcs mono-runtime libmono-cil-dev nunit-console libnunit-cil-dev glslang-tools)
PYTHON_PACKAGES=(python3-cffi python3-numpy python3-setuptools python3-wheel python3-pip python3-venv
    python3-pandas python3-matplotlib mypy)
NUMBERS_PACKAGES=(clang gcc-aarch64-linux-gnu libc6-dev-arm64-cross gcc-arm-linux-gnueabihf libc6-dev-armhf-cross qemu-user)
OLDEST_SYSTEM=bullseye CURRENT_SYSTEM=trixie NEWEST_SYSTEM=sid # Debian suites in which the two commands are tested
EXIT_SETUP=3 # a dependency could not be installed

# Uses ccache if it is installed. The tests of packages compile the library again in other folders: with
# CCACHE_NOHASHDIR they reuse the objects of build/release, whose debug information has full paths of sources.
use_ccache() {
    command -v ccache >/dev/null || return 0
    export CCACHE_NOHASHDIR=${CCACHE_NOHASHDIR-1}
    export CMAKE_C_COMPILER_LAUNCHER=${CMAKE_C_COMPILER_LAUNCHER-ccache}
    export CMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER-ccache}
}
use_ccache

# Runs a command with its output in a file, and shows progress: one changing line on a terminal, otherwise a line every
# 15 s.
# usage: with_progress WHAT LOG COMMAND...
with_progress() {
    local what=$1 log=$2 code=0 ticker
    shift 2
    : >"$log"
    (
        while sleep 1 >/dev/null && kill -0 $$ 2>/dev/null; do
            if [ -t 2 ]; then
                printf '\r\033[K%.*s' "$(($(tput cols 2>/dev/null || echo 80) - 1))" \
                    "run: $what, $SECONDS s: $(tail -n 1 "$log" | tr -d '\r')" >&2
            elif [ $((SECONDS % 15)) -eq 0 ]; then
                echo "run: still $what, $SECONDS s: $(tail -n 1 "$log" | tr -d '\r' | cut -c 1-100)" >&2
            fi
        done
    ) &
    ticker=$!
    "$@" >>"$log" 2>&1 || code=$?
    kill $ticker 2>/dev/null || true
    wait $ticker 2>/dev/null || true
    [ ! -t 2 ] || printf '\r\033[K' >&2
    return $code
}

# Installs missing packages and prints their names; without apt-get it prints the names to install.
need_packages() {
    if ! command -v apt-get >/dev/null; then
        look_for_packages "$@"
        return
    fi
    local missing=() package sudo=()
    for package in "$@"; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null || ! sudo -n true 2>/dev/null; then
            echo "run: these packages are missing: ${missing[*]}" >&2
            echo "run: neither root nor passwordless sudo; run: sudo apt-get install ${missing[*]}" >&2
            exit $EXIT_SETUP
        fi
        sudo=(sudo)
    fi
    local log absent=()
    log=$(mktemp)
    if with_progress 'reading lists of packages' "$log" "${sudo[@]}" \
        apt-get update -q -o APT::Update::Error-Mode=any; then
        for package in "${missing[@]}"; do
            apt-cache show "$package" >/dev/null 2>&1 || absent+=("$package")
        done
        if [ ${#absent[@]} -gt 0 ]; then
            rm -f "$log"
            echo "run: this system has no package ${absent[*]}" >&2
            exit $EXIT_SETUP
        fi
    fi
    echo "run: installing ${missing[*]}"
    if ! with_progress 'installing packages' "$log" "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y -q --no-install-recommends "${missing[@]}"; then
        tail -n 5 "$log" >&2
        rm -f "$log"
        echo "run: apt-get could not install ${missing[*]} (is there a network?)" >&2
        exit $EXIT_SETUP
    fi
    rm -f "$log"
}

# Without apt-get: lists the missing packages by the system's names from docs/building.md. A header in that list may be
# in /usr/local/include.
look_for_packages() {
    local column query install package name missing=() headers=()
    if command -v dnf >/dev/null; then
        column=2 query='rpm -q' install='dnf install'
    elif command -v pacman >/dev/null; then
        column=3 query='pacman -Q' install='pacman -S'
    elif command -v zypper >/dev/null; then
        column=4 query='rpm -q' install='zypper install'
    else
        echo "run: neither apt-get, dnf, pacman nor zypper: expecting what Debian calls $*" >&2
        return 0
    fi
    for package in "$@"; do
        name=$(awk -F '[ |`]+' -v package="$package" -v column=$column '$2 == package { print $(column + 1) }' docs/building.md)
        case ${name:=$package} in
        *.h) [ -f "/usr/include/$name" ] || [ -f "/usr/local/include/$name" ] || headers+=("$name") ;;
        *) $query "$name" >/dev/null 2>&1 || missing+=("$name") ;;
        esac
    done
    [ ${#missing[@]} -eq 0 ] || echo "run: these packages are missing; run: sudo $install ${missing[*]}" >&2
    [ ${#headers[@]} -eq 0 ] || echo "run: to be put into /usr/local/include (docs/building.md says from where): ${headers[*]}" >&2
    [ $((${#missing[@]} + ${#headers[@]})) -eq 0 ] || exit $EXIT_SETUP
}

# npm, from wherever it is.
need_npm() {
    command -v npm >/dev/null || need_packages npm
}

# A Python environment in build/NAME from a file of requirements, pinned by version and hash.
need_python() {
    local venv=build/$1 requirements=$2
    need_packages python3-venv
    cmp -s "$requirements" "$venv/installed.txt" && return
    local names
    names=$(sed -n 's/^\([a-z-]*==[0-9.]*\).*/\1/p' "$requirements" | paste -sd ' ')
    echo "run: installing $names"
    mkdir -p build
    if ! with_progress "making $venv" "$venv.log" /usr/bin/python3 -m venv --clear "$venv" ||
        ! with_progress "filling $venv" "$venv.log" \
            "$venv/bin/pip" install --require-hashes --only-binary :all: -r "$requirements"; then
        tail -n 5 "$venv.log" >&2
        echo "run: pip could not install $names (is there a network?)" >&2
        exit $EXIT_SETUP
    fi
    cp "$requirements" "$venv/installed.txt"
}

# Warnings are errors with Debian 12's compiler and libraries, the reference. Others have different warnings.
warnings_as_errors() {
    # shellcheck source=/dev/null
    if [ -z "${CC:-}${CXX:-}" ] && [ "$(. /etc/os-release 2>/dev/null && echo "${ID:-} ${VERSION_ID:-}")" = 'debian 12' ]; then
        echo ON
    else
        echo OFF
    fi
}

# Configures a preset, with any CMake; quiet unless something goes wrong. usage: configure PRESET [OPTION...]
configure() {
    local preset=$1 log=build/$1.log options
    shift
    mkdir -p build
    mapfile -t options < <(/usr/bin/python3 -B scripts/preset.py "$preset")
    cmake -DKNURL_WARNINGS_AS_ERRORS="$(warnings_as_errors)" -DBUILD_TESTING=ON "${options[@]}" "$@" >"$log" 2>&1 ||
        { cat "$log" >&2; exit 1; }
    sed -n 's/^ *\(-- \)\?\(.* \(is\|are\) left out: .*\)/run: SKIPPED: \2/p' "$log" >&2
}

# Runs the tests of a preset. usage: test_preset PRESET [OPTION...]: ctest's
test_preset() {
    (cd "build/$1" && ctest --output-on-failure "${@:2}")
}

# Builds a preset, or only the targets named after it.
build() {
    local preset=$1 log=build/$1.log
    shift
    configure "$preset"
    echo "run: building $preset"
    with_progress "building $preset" "$log" cmake --build "build/$preset" ${1:+--target "$@"} ||
        { tail -n 60 "$log" >&2; exit 1; }
    ! grep -q 'warning:' "$log" || echo "run: the compiler warned $(grep -c 'warning:' "$log") times, see $log"
}
