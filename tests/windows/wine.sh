#!/usr/bin/env bash
# Runs a Windows program under wine, in the build's own prefix and without a display.  usage: wine.sh PROGRAM...
# Prints its output at its end, through a file: wine's own processes, which stay for a while, would keep a pipe open.
here=$(cd "$(dirname "$0")" && pwd)
export WINEPREFIX="$here/../../build/windows/wine" WINEDEBUG=-all WINEDLLOVERRIDES='mscoree,mshtml,winedbg.exe='
unset DISPLAY WAYLAND_DISPLAY
out=$(mktemp)
trap 'rm -f "$out"' EXIT
wine "$@" </dev/null >"$out" 2>&1
status=$?
cat "$out"
exit $status
