#!/usr/bin/env bash
# The plugin exports only the functions that C# declares or Unity calls; it needs no library that a player may lack.
# usage: exports.sh PLUGIN MIRROR NM OBJDUMP LIBRARY...      LIBRARY...: those that it may need; without any: no check
set -euo pipefail
plugin=$1 mirror=$2 nm=$3 objdump=$4
shift 4

declared=$({ printf '%s\n' UnityPluginLoad UnityPluginUnload
    sed -nE 's/.*static extern .*[ *](knurl_[a-z0-9_]+)\(.*/\1/p' "$mirror"; } | sort)
[ "$(wc -l <<<"$declared")" -gt 100 ] || { echo "exports: $mirror declares too little: $declared"; exit 1; }
case $plugin in
*.dll)
    exported=$("$objdump" -p "$plugin" | awk '/\[Ordinal\/Name Pointer\] Table/ { on = 1; next }
        NF == 0 { on = 0 } on { print $NF }' | sort)
    needed=$("$objdump" -p "$plugin" | sed -n 's/.*DLL Name: //p' | sort -u) ;;
*)
    exported=$("$nm" -D --defined-only "$plugin" | awk '{ print $NF }' | sort)
    needed=$("$objdump" -p "$plugin" | awk '$1 == "NEEDED" { print $2 }' | sort -u) ;;
esac

status=0
if [ "$declared" != "$exported" ]; then
    echo "exports: < declared, > exported"
    diff <(echo "$declared") <(echo "$exported") || status=1
fi
for library in $needed; do
    if [ $# -gt 0 ] && [[ " $* " != *" $library "* ]]; then
        echo "exports: needs $library"
        status=1
    fi
done
[ $status -ne 0 ] || echo "exports: $(wc -l <<<"$exported") functions; needs $(tr '\n' ' ' <<<"$needed")"
exit $status
