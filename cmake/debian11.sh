#!/usr/bin/env bash
# Puts Debian 11's C library, its headers and its compiler into DIR/root, so that binaries built with them
# (cmake/debian11.cmake) run with glibc 2.31 or newer: from Ubuntu 20.04 and Debian 11 on. The compiler runs directly on
# the host. Header-only libraries are the host's.
# usage: debian11.sh DIR     Does nothing if it is there already. Exit 3: not available (no network, no apt).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
[ $# -eq 1 ] || { echo "usage: debian11.sh DIR" >&2; exit 2; }
EXIT_SETUP=3
PACKAGES=(libc6-dev gcc-10 g++-10 libstdc++-10-dev libcmocka-dev libkissfft-dev)
HEADERS=(libtinygltf-dev nlohmann-json3-dev libglm-dev libusb-1.0-0-dev libhidapi-dev)
STAMP="2 ${PACKAGES[*]} ${HEADERS[*]}"

mkdir -p "$1"
dir=$(cd "$1" && pwd)
exec 9>"$dir/lock"
flock 9
[ "$(cat "$dir/root/.stamp" 2>/dev/null || true)" != "$STAMP" ] || exit 0

give_up() {
    echo "debian11: Debian 11's C library cannot be fetched: $1" >&2
    exit $EXIT_SETUP
}

source "$here/apt_apart.sh"
find_mirror
echo "debian11: downloading its C library and compiler (60 MB) from $mirror"
if ! download bullseye >"$dir/fetch.log" 2>&1; then
    grep '^[EW]:' "$dir/fetch.log" | head -n 3 >&2 || true
    give_up "$mirror could not be read (is there a network?); all of it is in $dir/fetch.log"
fi

root=$dir/root.new
rm -rf "$root"
mkdir -p "$root"/usr/{bin,sbin,lib,lib64}
for link in bin sbin lib lib64; do
    ln -s usr/$link "$root/$link"
done
for deb in "$dir"/apt/cache/archives/*.deb; do
    case ${deb##*/} in binutils* | libbinutils* | libctf*) continue ;; esac # the host's are good enough
    dpkg-deb --fsys-tarfile "$deb" | tar -C "$root" -x --keep-directory-symlink --exclude='./usr/share/doc/*' \
        --exclude='./usr/share/locale/*' --exclude='./usr/share/man/*'
done
rm -rf "$dir/apt"
find "$root" -type l -lname '/*' -printf '%p\t%l\n' | # otherwise they would refer to the host's files
    while IFS=$'\t' read -r link target; do ln -sfr "$root$target" "$link"; done
for package in "${HEADERS[@]}"; do
    dpkg-query -L "$package" | grep -E '^/usr/(include|share/cmake|share/pkgconfig|lib/.*/(cmake|pkgconfig))/' |
        while read -r path; do
            [ ! -f "$path" ] || install -D -m 644 "$path" "$root$path"
        done
done
echo 'int main(void) { return 0; }' |
    "$root/usr/bin/x86_64-linux-gnu-gcc-10" --sysroot="$root" -x c - -o "$dir/probe" ||
    give_up 'its compiler does not run here'
rm -rf "$dir/root"
mv "$root" "$dir/root"
echo "$STAMP" >"$dir/root/.stamp"
