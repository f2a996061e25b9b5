#!/usr/bin/env bash
# Packs the Blender extension and tries it in a real Blender: that of the system, or releases of PyPI's bpy.
# usage: run.sh KNURL FOLDER [VERSION...]     FOLDER: kept for the next time. Exit 77, with the reason: no Blender.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
[ $# -ge 2 ] || { echo "usage: run.sh KNURL FOLDER [VERSION...]" >&2; exit 2; }
knurl=$(realpath "$1")
mkdir -p "$2"
folder=$(cd "$2" && pwd)
shift 2
zip=$folder/knurl.zip
"$here/../../bindings/blender/package.sh" "$zip"

# In an empty home of Blender's own. usage: try NAME PROGRAM ARGS...
try() {
    local name=$1
    shift
    rm -rf "$folder/home"
    mkdir "$folder/home"
    BLENDER_USER_RESOURCES=$folder/home PYTHONDONTWRITEBYTECODE=1 timeout 300 "$@" "$knurl" "$zip" >"$folder/$name.log" 2>&1 ||
        { cat "$folder/$name.log" >&2; echo "blender: $name: failed" >&2; exit 1; }
    echo "blender: $name: $(sed -n 's/^Ran \(.*\) in .*/\1/p' "$folder/$name.log")"
}

if [ $# -eq 0 ]; then
    command -v blender >/dev/null || { echo "skipped: blender: ./run test blender installs it"; exit 77; }
    try "$(blender --version | head -n 1)" blender --background --factory-startup --python-exit-code 1 \
        --python "$here/test_extension.py" --
fi
for version; do # some 500 MB each
    environment=$folder/bpy-$version
    if [ ! -e "$environment/.stamp" ]; then
        rm -rf "$environment"
        if ! { command -v python3.11 && python3.11 -m venv "$environment" &&
            "$environment/bin/pip" install -q "bpy==$version.*" numpy; } >"$folder/pip.log" 2>&1; then
            tail -n 1 "$folder/pip.log"
            echo "skipped: blender: bpy $version cannot be installed, see above"
            continue
        fi
        touch "$environment/.stamp"
    fi
    try "bpy $version" "$environment/bin/python" "$here/test_extension.py"
done
