#!/usr/bin/env bash
# Runs a Windows program under wine, in a prefix of the build's own and without a display.  usage: wine.sh PROGRAM...
# What it prints comes at its end, by way of a file: wine's own processes, which stay a while, would hold a pipe open.
here=$(cd "$(dirname "$0")" && pwd)
export WINEPREFIX="$here/../../build/windows/wine" WINEDEBUG=-all WINEDLLOVERRIDES='mscoree,mshtml,winedbg.exe='
unset DISPLAY WAYLAND_DISPLAY
out=$(mktemp)
trap 'rm -f "$out"' EXIT
wine "$@" </dev/null >"$out" 2>&1
status=$?
cat "$out"
exit $status
