#!/usr/bin/env bash
# Tests a release's wheels for musl, with Debian's musl for x86-64 and for arm64 (under qemu), downloaded into FOLDER.
# usage: musl.sh RELEASE ZIG FOLDER     ZIG: made by cmake/zig.sh     Exit 3: musl cannot be downloaded.
set -euo pipefail
[ $# -eq 3 ] || { echo "usage: musl.sh RELEASE ZIG FOLDER" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$3"
folder=$(cd "$3" && pwd)
PACKAGES=(musl)
give_up() {
    echo "musl: $1" >&2
    exit 3
}
# shellcheck source=cmake/apt_apart.sh
source "$here/../../cmake/apt_apart.sh"
find_mirror
for architecture in amd64 arm64; do
    dir=$folder/$architecture
    [ ! -e "$dir/complete" ] || continue
    mkdir -p "$dir/root"
    printf 'APT::Architecture "%s";\nAPT::Architectures { "%s"; };\n' $architecture $architecture >"$dir/apt.conf"
    APT_CONFIG=$dir/apt.conf download bookworm || give_up "apt could not download Debian 12's musl for $architecture"
    for package in "$dir"/apt/cache/archives/*.deb; do
        dpkg-deb -x "$package" "$dir/root"
    done
    touch "$dir/complete"
done
/usr/bin/python3 -B "$here/musl.py" "$1" "$2" "$folder"
