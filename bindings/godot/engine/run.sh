#!/usr/bin/env bash
# Runs a program that fetch.sh fetched; its exit status is the program's.
# usage: run.sh DIR CMD ARGS...     CMD: godot, or xvfb-do godot (with a display to draw on)
# The program sees the current folder (or KNURL_GODOT_BIND, a folder above it) at its own path, /tmp, /proc and /dev,
# and nothing else of the host. If the system does not allow mounts, it sees the whole host and only --headless works.
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: run.sh DIR CMD ARGS..." >&2; exit 2; }
dir=$(cd "$1" && pwd)
shift
root=$dir/root
[ -x "$root/usr/bin/godot" ] || { echo "run: there is no Godot in $dir; fetch.sh brings it" >&2; exit 3; }
home=$dir/home # for Godot's settings and caches, instead of this user's
mkdir -p "$home"

# Root can mount; other users, if the system allows it, as root of their own user namespace.
if unshare --mount true 2>/dev/null; then
    apart=(unshare --mount)
elif unshare --user --map-root-user --mount true 2>/dev/null; then
    apart=(unshare --user --map-root-user --mount)
else
    libraries=$root/usr/lib/x86_64-linux-gnu
    program=$1
    shift
    [ "$program" != xvfb-do ] || { echo "run: xvfb-do needs the right to mount" >&2; exit 3; }
    HOME=$home exec "$root/usr/lib64/ld-linux-x86-64.so.2" --inhibit-cache \
        --library-path "$libraries:$libraries/pulseaudio" "$root/usr/bin/$program" "$@"
fi

export KNURL_ROOT=$root KNURL_HOME=$home KNURL_CWD=$PWD KNURL_BIND=${KNURL_GODOT_BIND:-$PWD}
# shellcheck disable=SC2016 # the inner shell expands these
exec "${apart[@]}" -- /bin/sh -c '
    set -e
    mount --rbind /proc "$KNURL_ROOT/proc"
    mount --rbind /dev "$KNURL_ROOT/dev"
    mount --bind /tmp "$KNURL_ROOT/tmp"
    mount --bind "$KNURL_HOME" "$KNURL_ROOT/root"
    mkdir -p "$KNURL_ROOT$KNURL_BIND"
    mount --bind "$KNURL_BIND" "$KNURL_ROOT$KNURL_BIND"
    exec chroot "$KNURL_ROOT" /usr/bin/env -C "$KNURL_CWD" PATH=/usr/bin:/usr/sbin HOME=/root LANG=C.UTF-8 \
        XDG_RUNTIME_DIR=/tmp "$@"' sh "$@"
