#!/usr/bin/env bash
# Runs a command in which programs for arm64 run under qemu, also those that it starts itself. usage: under_qemu.sh ROOT
# COMMAND...     ROOT: with their libraries, from cmake/arm64.sh. Exit 3: this kernel or machine cannot.
#
# The kernel gives such programs to qemu (binfmt_misc), in a namespace of their own (Linux 6.7), so that this machine's
# settings stay as they are. Older kernels need these to be set: package qemu-user-static does that.
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: under_qemu.sh ROOT COMMAND..." >&2; exit 2; }
QEMU_LD_PREFIX=$(cd "$1" && pwd)
export QEMU_LD_PREFIX
shift
probe=("$QEMU_LD_PREFIX/lib/ld-linux-aarch64.so.1" --verify "$QEMU_LD_PREFIX/lib/aarch64-linux-gnu/libc.so.6")
if "${probe[@]}" >/dev/null 2>&1; then
    exec "$@"
fi
qemu=$(command -v qemu-aarch64) || { echo "under_qemu: there is no qemu-aarch64 (package qemu-user)" >&2; exit 3; }
# shellcheck disable=SC2016 # the inner shell expands it
inside='
    set -e
    mount -t binfmt_misc none /proc/sys/fs/binfmt_misc
    elf="\\x7fELF\\x02\\x01\\x01\\x00\\x00\\x00\\x00\\x00\\x00\\x00\\x00\\x00\\x02\\x00\\xb7\\x00"
    mask="\\xff\\xff\\xff\\xff\\xff\\xff\\xff\\x00\\xff\\xff\\xff\\xff\\xff\\xff\\xff\\xff\\xfe\\xff\\xff\\xff"
    echo ":arm64:M::$elf:$mask:$1:" >/proc/sys/fs/binfmt_misc/register
    shift
    exec "$@"'
unshare --map-root-user --mount bash -c "$inside" bash "$qemu" "${probe[@]}" >/dev/null 2>&1 || {
    echo "under_qemu: this kernel gives a namespace no programs of its own (binfmt_misc, Linux 6.7), and it knows no arm64" >&2
    exit 3
}
exec unshare --map-root-user --mount bash -c "$inside" bash "$qemu" "$@"
