#!/usr/bin/env bash
# Fetches Godot 4 with software rendering and a virtual display into DIR/root, for the tests and the demo.
# Debian's testing packages are downloaded and unpacked by a private apt, which checks Debian's signatures: nothing is
# installed on the host. Any Godot 4 will do; prints a note if it is not the one in godot.sha256.
# usage: fetch.sh DIR     Does nothing if it is there already. Exit 3: not available (no network, no apt).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
[ $# -eq 1 ] || { echo "usage: fetch.sh DIR" >&2; exit 2; }
EXIT_SETUP=3
PACKAGES=(godot libgl1 libglx-mesa0 libgl1-mesa-dri libegl1 libegl-mesa0 xvfb xkb-data x11-xkb-utils
    fontconfig-config fonts-dejavu-core dash coreutils)
SUITES=(forky sid) # testing is not installable on some days: try the next one
PIN=$here/godot.sha256 # of Debian's 4.6.3+ds-2
STAMP="2 ${PACKAGES[*]} $(cat "$PIN")"

mkdir -p "$1"
dir=$(cd "$1" && pwd)
exec 9>"$dir/lock" # two test runs at once fetch it once
flock 9
if [ "$(cat "$dir/root/.stamp" 2>/dev/null || true)" = "$STAMP" ]; then
    install -m 755 "$here/xvfb-do" "$dir/root/usr/bin/xvfb-do"
    exit 0
fi

give_up() {
    echo "fetch: Godot cannot be fetched: $1" >&2
    exit $EXIT_SETUP
}

source "$here/../../../cmake/apt_apart.sh"

unpack() {
    local root=$1 link deb
    rm -rf "$root"
    mkdir -p "$root"/usr/{bin,sbin,lib,lib64} "$root"/{proc,dev,sys,tmp,run,root,etc/ssl/certs}
    for link in bin sbin lib lib64; do
        ln -s usr/$link "$root/$link"
    done
    for deb in "$dir"/apt/cache/archives/*.deb; do
        dpkg-deb --fsys-tarfile "$deb" | tar -C "$root" -x --keep-directory-symlink \
            --exclude='./usr/share/doc/*' --exclude='./usr/share/locale/*' --exclude='./usr/share/man/*' \
            --exclude='./usr/share/icons/*'
    done
    # The files that the packages' install scripts would have made.
    printf 'root:x:0:0:root:/root:/bin/sh\n' >"$root/etc/passwd"
    printf 'root:x:0:\n' >"$root/etc/group"
    ln -sf dash "$root/usr/bin/sh"
    cp /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/" 2>/dev/null || true # otherwise Godot prints an error
    install -m 755 "$here/xvfb-do" "$root/usr/bin/xvfb-do"
}

find_mirror
echo "fetch: downloading Godot and software rendering (160 MB) from $mirror"
log=$dir/fetch.log
fetched=''
for suite in "${SUITES[@]}"; do
    if download "$suite" >"$log" 2>&1; then
        fetched=$suite
        break
    fi
done
if [ -z "$fetched" ]; then
    grep '^[EW]:' "$log" | head -n 3 >&2 || true
    give_up "$mirror could not be read (is there a network?); all of it is in $log"
fi
new=$dir/root.new
unpack "$new"
rm -rf "$dir/apt"
if ! (cd "$new" && sha256sum --status --check "$PIN"); then # apt has checked the signature of this one, too
    echo "fetch: note: Debian $fetched has another Godot than the one that the tests were last run with ($PIN):" \
        "sha256 $(sha256sum "$new/usr/bin/godot" | cut -d ' ' -f 1)"
fi
rm -rf "$dir/root"
mv "$new" "$dir/root"
version=$("$here/run.sh" "$dir" godot --headless --version | tail -n 1) || give_up 'what was unpacked does not run'
case $version in
4.*) echo "$STAMP" >"$dir/root/.stamp" ;;
*) give_up "expected a Godot 4, found '$version'" ;;
esac
echo "fetch: Godot $version from Debian $fetched in $dir"
