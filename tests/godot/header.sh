#!/usr/bin/env bash
# Compiles the binding against the header that the engine itself dumps. usage: header.sh CC FOLDER
# Exit 77: there is no engine, see run.sh.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
compiler=$1 folder=$2
engine=${KNURL_GODOT_ROOT:-$root/build/godot-engine}
if [ ! -x "$engine/root/usr/bin/godot" ]; then
    echo "skipped: no Godot in $engine; bindings/godot/engine/fetch.sh $engine brings it"
    exit 77
fi
mkdir -p "$folder"
cd "$folder"
rm -f gdextension_interface.h
timeout 60 "$root/bindings/godot/engine/run.sh" "$engine" \
    godot --headless --dump-gdextension-interface --quit >dump.log 2>&1 || { cat dump.log; exit 1; }
[ -s gdextension_interface.h ] || { cat dump.log; exit 1; }
for source in "$root"/bindings/godot/src/*.c; do
    "$compiler" -std=c99 -pedantic-errors -Wall -Wextra -Wshadow -Wconversion -Werror -fsyntax-only \
        -isystem "$folder" -I "$root/sdk/include" -I "$root/bindings/common" "$source"
done
echo "header: all of the binding compiles against the engine's own header"
