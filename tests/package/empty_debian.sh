#!/usr/bin/env bash
# Tries a release's archives in an empty Debian, each in one of its own: what is installed runs the plate. Root only, for
# it mounts; all mounts are of its own namespace and end with it.
# usage: empty_debian.sh RELEASE FOLDER     RELEASE: as ./run release makes it; FOLDER: keeps the empty Debian
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
[ $# -eq 2 ] || { echo "usage: empty_debian.sh RELEASE FOLDER" >&2; exit 2; }
if [ -z "${KNURL_APART:-}" ]; then
    KNURL_APART=1 exec unshare --mount "$0" "$@"
fi
mkdir -p "$2"
release=$(cd "$1" && pwd) dir=$(cd "$2" && pwd)
version=${release##*/release-}

give_up() {
    echo "empty_debian: $1" >&2
    exit 3
}
source "$root/cmake/apt_apart.sh"
find_mirror
if [ ! -e "$dir/base/.complete" ]; then
    rm -rf --one-file-system "$dir/base"
    suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
    debootstrap --variant=minbase --include=ca-certificates --keyring="$keyring" "$suite" "$dir/base" "$mirror" \
        >"$dir/debootstrap.log" 2>&1 || give_up "no Debian could be made, see $dir/debootstrap.log (is there a network?)"
    touch "$dir/base/.complete"
fi
mount -t tmpfs tmpfs "$dir/base/mnt" # what overlays write, and where they are: gone with the namespace

# usage: try NAME COMMANDS: in an empty Debian that has /release and /source
try() {
    local name=$1 layers=$dir/base/mnt begin=$SECONDS
    mkdir -p "$layers/$name"/{upper,work} "$dir/root"
    mount -t overlay overlay -o "lowerdir=$dir/base,upperdir=$layers/$name/upper,workdir=$layers/$name/work" "$dir/root"
    mkdir -p "$dir/root"/{release,source}
    mount --bind "$release" "$dir/root/release"
    mount --bind "$root" "$dir/root/source"
    mount -t proc proc "$dir/root/proc"
    mount --rbind /dev "$dir/root/dev"
    cp /etc/resolv.conf "$dir/root/etc/resolv.conf"
    if ! env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
        VERSION="$version" chroot "$dir/root" /bin/bash -euxo pipefail -c "$preparations$2" >"$dir/$name.log" 2>&1; then
        tail -n 15 "$dir/$name.log" >&2
        echo "empty_debian: FAIL $name, see $dir/$name.log" >&2
        exit 1
    fi
    umount -R -l "$dir/root"
    echo "empty_debian: ok   $name ($((SECONDS - begin)) s)"
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
    try archive 'mkdir /opt/knurl && tar -C /opt/knurl --strip-components=1 -xf /release/knurl-*-Linux.tar.gz
        runs_plate /opt/knurl/bin/knurl'
    try deb 'need /release/libknurl0*.deb /release/knurl_*.deb
        runs_plate knurl'
    try deb-dev 'need /release/libknurl*.deb gcc libc6-dev pkg-config cmake make
        cc /tmp/consumer/plate.c -o /tmp/plate $(pkg-config --cflags --libs knurl) -lm
        [ "$(/tmp/plate)" = "0.400000 N, knurl $VERSION" ]
        cmake -S /tmp/consumer -B /tmp/built -DWANTED="$VERSION"
        cmake --build /tmp/built
        [ "$(/tmp/built/plate)" = "0.400000 N, knurl $VERSION" ]'
    try wheel 'need python3-venv python3-cffi python3-numpy
        python3 -m venv --system-site-packages /tmp/venv
        /tmp/venv/bin/pip install --no-index /release/knurl-*.whl
        /tmp/venv/bin/python /source/bindings/python/examples/stroke.py'
    try engines 'need python3-minimal libpython3-stdlib unzip
        mkdir /tmp/unity /tmp/godot && tar -C /tmp/unity -xf /release/com.knurl.haptics-*.tgz
        unzip -q /release/knurl-godot-[0-9]*.zip -d /tmp/godot
        libraries=$(find /tmp/unity /tmp/godot -name "lib*.so")
        [ "$(wc -w <<<"$libraries")" = 2 ]
        for library in $libraries; do python3 -c "import ctypes, sys; ctypes.CDLL(sys.argv[1])" "$library"; done'
}
