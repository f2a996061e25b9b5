#!/usr/bin/env bash
# Puts Debian 11's libraries for arm64 that the tests link or load into DIR/root, without its C headers: the compiler in
# build/zig has these. The libraries run under qemu.
# usage: arm64.sh DIR     Does nothing if they are there already. Exit 3: they cannot be had (no network, no apt).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
[ $# -eq 1 ] || { echo "usage: arm64.sh DIR" >&2; exit 2; }
EXIT_SETUP=3
PACKAGES=(libcmocka-dev libkissfft-dev libwebsockets-dev libpng-dev libjpeg-dev libusb-1.0-0 libhidapi-hidraw0)
mkdir -p "$1"
dir=$(cd "$1" && pwd)
stamp="$(cat "${BASH_SOURCE[0]}") $dir"
[ "$(cat "$dir/root/.stamp" 2>/dev/null || true)" != "$stamp" ] || exit 0

give_up() {
    echo "arm64: Debian 11's libraries for arm64 cannot be fetched: $1" >&2
    exit $EXIT_SETUP
}

source "$here/apt_apart.sh"
find_mirror
echo "arm64: downloading libraries (20 MB) from $mirror"
download bullseye arm64 >"$dir/fetch.log" 2>&1 ||
    give_up "$mirror could not be read (is there a network?); all of it is in $dir/fetch.log"
rm -rf "$dir/root"
root=$dir/root
mkdir -p "$root/usr/lib"
ln -s usr/lib "$root/lib"
for deb in "$dir"/apt/cache/archives/*.deb; do
    case ${deb##*/} in libc6-dev* | libc-dev* | linux-libc* | dpkg* | debconf* | perl* | tar_*) continue ;; esac
    dpkg-deb --fsys-tarfile "$deb" | tar -C "$root" -x --keep-directory-symlink --exclude='./usr/share/*'
done
rm -rf "$dir/apt"
sed -i "s|^prefix=\"\?/usr\"\?|prefix=$root/usr|" "$root"/usr/lib/*/pkgconfig/*.pc
cp -r "$root/usr/include/aarch64-linux-gnu/." /usr/include/jsmn.h "$root/usr/include/" # jsmn: a header alone, the host's
echo "$stamp" >"$root/.stamp"
