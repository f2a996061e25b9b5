#!/usr/bin/env bash
# Makes assets/*.glb again, byte for byte the same from the same Blender and numpy. Called by `./run assets`.
set -euo pipefail
cd "$(dirname "$0")"
export PYTHONDONTWRITEBYTECODE=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

command -v blender >/dev/null || { echo "make.sh: blender is missing; run: ./run assets" >&2; exit 3; }
python=/usr/bin/python3 # Debian's, which has apt's numpy; the python3 on the PATH may differ

blender --background --factory-startup --python-exit-code 1 --python plate_1d.py -- "$work/plate_1d.glb" \
    >"$work/blender.log" 2>&1 || { cat "$work/blender.log" >&2; exit 1; }
"$python" grid_2d.py "$work/grid_2d.glb"
"$python" knurled_handle.py "$work/knurled_handle.glb"

for asset in "$work"/*.glb; do
    name=$(basename "$asset")
    state=unchanged
    cmp -s "$asset" "../$name" || { mv "$asset" "../$name.part" && mv "../$name.part" "../$name" && state=written; }
    echo "assets/$name: $state, $(stat -c %s "../$name") bytes"
done
