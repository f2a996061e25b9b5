#!/usr/bin/env bash
# Tries a release's archives in an empty Debian, each in a separate one: the installed tool runs the plate. Root only,
# because it mounts; all mounts are in its own namespace and end with it.
# usage: empty_debian.sh RELEASE FOLDER     RELEASE: made by ./run release; FOLDER: keeps the empty Debian
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
[ $# -eq 2 ] || { echo "usage: empty_debian.sh RELEASE FOLDER" >&2; exit 2; }
give_up() {
    echo "empty_debian: $1" >&2
    exit 3
}
source "$here/empty_root.sh"
mkdir -p "$2"
release=$(cd "$1" && pwd)
make_base "$(cd "$2" && pwd)" "$(. /etc/os-release && echo "$VERSION_CODENAME")"

# usage: try_archive NAME COMMANDS: in an empty Debian that has /release and /source
try_archive() {
    local begin=$SECONDS
    if ! try "$1" "VERSION=${release##*/release-}$preparations$2"; then
        tail -n 15 "$dir/$1.log" >&2
        echo "empty_debian: FAIL $1, see $dir/$1.log" >&2
        exit 1
    fi
    echo "empty_debian: ok   $1 ($((SECONDS - begin)) s)"
}

# shellcheck disable=SC2016 # the shell inside expands these
preparations='
need() { apt-get update -q && apt-get install -y -q --no-install-recommends "$@"; }
runs_plate() { # usage: runs_plate KNURL
    [ "$("$1" --version)" = "knurl $VERSION" ]
    "$1" run /source/assets/plate_1d.glb --fast --seconds 1 --out /tmp/felt.csv
    [ "$(wc -l </tmp/felt.csv)" = 1001 ]
}
cp -r /source/tests/package/consumer /tmp/consumer
'
# shellcheck disable=SC2016
{
    try_archive archive 'mkdir /opt/knurl && tar -C /opt/knurl --strip-components=1 -xf /release/knurl-"$VERSION"-linux-x86_64.tar.gz
        need libstdc++6
        runs_plate /opt/knurl/bin/knurl
        /opt/knurl/bin/knurl run /opt/knurl/assets/plate_1d.glb --fast --seconds 1 >/dev/null
        /opt/knurl/bin/knurl metrics --method T3 --period-ms 8 >/dev/null # knurl_study and its library
        [ -s /opt/knurl/share/man/man1/knurl.1 ] && [ -s /opt/knurl/share/doc/knurl/html/index.html ]'
    try_archive deb 'need /release/libknurl0*.deb /release/knurl_*.deb bash-completion man-db
        runs_plate knurl
        knurl metrics --method T3 --period-ms 8 >/dev/null
        man knurl | grep -q "knurl inspect" && man knurl_study | grep -q "knurl inspect"
        (set +ux; source /usr/share/bash-completion/completions/knurl && complete -p knurl) | grep -q _knurl'
    try_archive deb-dev 'need /release/libknurl*.deb gcc libc6-dev pkg-config cmake make
        [ -s /usr/share/knurl/api.json ]
        cc /tmp/consumer/plate.c -o /tmp/plate $(pkg-config --cflags --libs knurl) -lm
        [ "$(/tmp/plate)" = "0.400000 N, knurl $VERSION" ]
        cmake -S /tmp/consumer -B /tmp/built -DWANTED="$VERSION"
        cmake --build /tmp/built
        [ "$(/tmp/built/plate)" = "0.400000 N, knurl $VERSION" ]'
    try_archive deb-minors 'minor=${VERSION%.*} # the libraries of the next minor version, which is made from this one, beside it
        dpkg-deb -R /release/libknurl"$minor"_*.deb /tmp/next
        sed -i "s/libknurl$minor/libknurl9.9/g" /tmp/next/DEBIAN/*
        mv /tmp/next/usr/share/doc/libknurl"$minor" /tmp/next/usr/share/doc/libknurl9.9
        mv /tmp/next/usr/share/lintian/overrides/libknurl"$minor" /tmp/next/usr/share/lintian/overrides/libknurl9.9
        for file in /tmp/next/usr/lib/*/*.so.*; do mv "$file" "${file/so.$minor/so.9.9}"; done
        dpkg-deb -b /tmp/next /tmp/libknurl9.9.deb
        need /release/libknurl"$minor"_*.deb /release/knurl_*.deb /tmp/libknurl9.9.deb
        runs_plate knurl'
    try_archive wheel 'need python3-venv python3-cffi python3-numpy
        python3 -m venv --system-site-packages /tmp/venv
        /tmp/venv/bin/pip install --no-index /release/knurl-*manylinux*x86_64.whl
        /tmp/venv/bin/python /source/bindings/python/examples/stroke.py'
    try_archive wheel-source 'need python3-venv python3-cffi python3-numpy python3-setuptools python3-wheel g++ cmake make \
            libtinygltf-dev nlohmann-json3-dev libglm-dev
        python3 -m venv --system-site-packages /tmp/venv
        /tmp/venv/bin/pip install --no-index --no-build-isolation /release/knurl-"$VERSION".tar.gz
        /tmp/venv/bin/python /source/bindings/python/examples/stroke.py'
    try_archive engines 'need python3-minimal libpython3-stdlib unzip
        mkdir /tmp/unity /tmp/godot && tar -C /tmp/unity -xf /release/com.knurl.haptics-*.tgz
        unzip -q /release/knurl-godot-[0-9]*.zip -d /tmp/godot
        [ "$(find /tmp/unity /tmp/godot -name "*.dylib" -o -name "*.arm64.so" | wc -l)" = 3 ] # of other systems
        libraries=$(find /tmp/unity /tmp/godot -name "lib*.so" ! -name "*.arm64.so")
        [ "$(wc -w <<<"$libraries")" = 2 ]
        for library in $libraries; do python3 -c "import ctypes, sys; ctypes.CDLL(sys.argv[1])" "$library"; done'
}
