#!/usr/bin/env bash
# Runs a Windows program under wine, in a prefix of the build's own and without a display.  usage: wine.sh PROGRAM...
here=$(cd "$(dirname "$0")" && pwd)
export WINEPREFIX="$here/../../build/windows/wine" WINEDEBUG=-all WINEDLLOVERRIDES='mscoree,mshtml='
unset DISPLAY WAYLAND_DISPLAY
exec wine "$@"
