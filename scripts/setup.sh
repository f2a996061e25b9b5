# Part of ./run: what every command needs: packages, Python environments, builds.
# shellcheck disable=SC2034 # the other parts use its variables

BUILD_PACKAGES=(g++ cmake ninja-build pkg-config libtinygltf-dev nlohmann-json3-dev libglm-dev libusb-1.0-0-dev
    libhidapi-dev libwebsockets-dev libjsmn-dev libcmocka-dev libkissfft-dev umockdev libumockdev-dev python3)
DEMO_PACKAGES=(g++ cmake ninja-build libtinygltf-dev nlohmann-json3-dev libglm-dev python3)
FUZZ_PACKAGES=(clang llvm libclang-rt-14-dev) # Debian 12's
PLOT_PACKAGES=(python3 python3-numpy python3-matplotlib)
WEB_PACKAGES=(emscripten node-acorn libtinygltf-dev nlohmann-json3-dev libglm-dev)
WINDOWS_PACKAGES=(gcc-mingw-w64-x86-64-posix g++-mingw-w64-x86-64-posix wine wine64 xz-utils)
UNITY_PACKAGES=(mono-mcs mono-runtime libmono-cil-dev nunit-console libnunit-cil-dev)
PYTHON_PACKAGES=(python3-cffi python3-numpy python3-setuptools python3-wheel python3-pip python3-venv)
NUMBERS_PACKAGES=(clang gcc-aarch64-linux-gnu libc6-dev-arm64-cross gcc-arm-linux-gnueabihf libc6-dev-armhf-cross qemu-user)
EXIT_SETUP=3 # what is missing could not be installed

# Where there is ccache, builds go through it. The tests of packages compile the library again in folders of their own: with
# CCACHE_NOHASHDIR they get the objects of build/release, whose debug information names every source by its whole path.
use_ccache() {
    command -v ccache >/dev/null || return 0
    export CCACHE_NOHASHDIR=${CCACHE_NOHASHDIR-1}
    export CMAKE_C_COMPILER_LAUNCHER=${CMAKE_C_COMPILER_LAUNCHER-ccache}
    export CMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER-ccache}
}
use_ccache

# Runs a command whose output goes to a file, and says how far it is: a line that moves on a terminal, else one every 15 s.
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

# Installs those of the named packages that are missing, and says which.
need_packages() {
    local missing=() package sudo=()
    for package in "$@"; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    if ! command -v apt-get >/dev/null; then
        echo "run: these are missing and there is no apt-get to install them: ${missing[*]}" >&2
        exit $EXIT_SETUP
    fi
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null || ! sudo -n true 2>/dev/null; then
            echo "run: these packages are missing: ${missing[*]}" >&2
            echo "run: neither root nor passwordless sudo; run: sudo apt-get install ${missing[*]}" >&2
            exit $EXIT_SETUP
        fi
        sudo=(sudo)
    fi
    echo "run: installing ${missing[*]}"
    local log
    log=$(mktemp)
    if ! with_progress 'installing packages' "$log" "${sudo[@]}" apt-get update -q ||
        ! with_progress 'installing packages' "$log" "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive \
            apt-get install -y -q --no-install-recommends "${missing[@]}"; then
        tail -n 5 "$log" >&2
        rm -f "$log"
        echo "run: apt-get could not install ${missing[*]} (is there a network?)" >&2
        exit $EXIT_SETUP
    fi
    rm -f "$log"
}

# A Python environment in build/NAME with what a file of requirements names, pinned by version and hash.
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

# Configures a preset; quiet unless something goes wrong.
configure() {
    local preset=$1 log=build/$1.log
    mkdir -p build
    cmake --preset "$preset" -DBUILD_TESTING=ON >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
}

# Builds a preset, or only the targets named after it.
build() {
    local preset=$1 log=build/$1.log
    shift
    configure "$preset"
    echo "run: building $preset"
    with_progress "building $preset" "$log" cmake --build --preset "$preset" ${1:+--target "$@"} ||
        { tail -n 60 "$log" >&2; exit 1; }
}
