#!/usr/bin/env bash
# Packs the Blender extension and tries it in a real Blender: that of the system, or releases of PyPI's bpy. Every file that
# the tests export goes through the Khronos validator and `knurl inspect --check`.
# usage: run.sh TOOLS FOLDER [VERSION...]
#   TOOLS: the folder of knurl and cycles; FOLDER: kept for the next time. Exit 77, with the reasons: no Blender.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
[ $# -ge 2 ] || { sed -n 's/^# \(usage.*\)/\1/p' "$0" >&2; exit 2; }
tools=$(cd "$1" && pwd)
mkdir -p "$2"
folder=$(cd "$2" && pwd)
shift 2
zip=$folder/knurl.zip
ran=0
"$here/../../bindings/blender/package.sh" "$zip"

skip() { echo "skipped: blender: $1"; }

# The validator, as pinned in package-lock.json.
modules=$folder/validator
if ! cmp -s "$here/package-lock.json" "$modules/package-lock.json" || [ ! -e "$modules/.stamp" ]; then
    mkdir -p "$modules"
    cp "$here"/package{,-lock}.json "$modules"
    if (cd "$modules" && npm ci --ignore-scripts --no-progress) >"$folder/npm.log" 2>&1; then
        touch "$modules/.stamp"
    else
        rm -f "$modules/.stamp"
    fi
fi

# The exported files of one Blender. usage: judge NAME
judge() {
    local file result failed=0
    if [ -e "$modules/.stamp" ]; then
        node "$here/validate.js" "$folder/exported" "$modules" | sed "s/^/blender: $1: /" || failed=1
    else
        skip "the Khronos validator cannot be installed: $(tail -n 1 "$folder/npm.log")"
    fi
    for file in "$folder/exported"/*.glb; do
        "$tools/knurl" inspect "$file" --check >/dev/null 2>"$folder/inspect.log" && result=clean || result=warned
        case $(basename "$file") in
        ${result}_*) ;;
        *) echo "blender: $1: knurl inspect --check: expected another result for $(basename "$file"): $(cat "$folder/inspect.log")" >&2
            failed=1 ;;
        esac
    done
    echo "blender: $1: knurl inspect --check: $(find "$folder/exported" -name 'clean_*' | wc -l) files without a warning," \
        "$(find "$folder/exported" -name 'warned_*' | wc -l) with the one that they were made for"
    return $failed
}

# The largest of the numbers behind a word in the log of the Blender `name`.
worst() { sed -n "s/.*$1: //p" "$folder/$name.log" | sort -g | tail -n 1; }

# In an empty home of Blender's own. usage: try NAME PROGRAM ARGS...
try() {
    local name=$1
    shift
    rm -rf "${folder:?}"/{home,exported}
    mkdir "$folder"/{home,exported}
    BLENDER_USER_RESOURCES=$folder/home KNURL_KEEP=$folder/exported PYTHONDONTWRITEBYTECODE=1 \
        timeout 500 "$@" "$tools" "$zip" >"$folder/$name.log" 2>&1 ||
        { cat "$folder/$name.log" >&2; echo "blender: $name: failed" >&2; exit 1; }
    echo "blender: $name: $(sed -n 's/^Ran \(.*\) in .*/\1/p' "$folder/$name.log")"
    echo "blender: $name: from drawn to felt ridges at most $(worst 'difference'), on curved triangles $(worst 'if curved')"
    judge "$name"
    ran=1
}

# The drawing itself needs a window.
window() {
    local log=$folder/window.log
    command -v xvfb-run >/dev/null || { skip 'ridges in a window: there is no xvfb-run'; return 0; }
    rm -rf "${folder:?}/home"
    mkdir "$folder/home"
    BLENDER_USER_RESOURCES=$folder/home timeout 200 xvfb-run -a -s '-screen 0 800x600x24' blender --factory-startup \
        --window-geometry 0 0 640 480 --python "$here/window.py" -- "$tools" "$zip" >"$log" 2>&1 </dev/null &&
        grep -q '^window: ok' "$log" || { cat "$log" >&2; echo "blender: ridges in a window: failed" >&2; exit 1; }
    echo 'blender: ridges in a window: ok'
}

if [ $# -eq 0 ]; then
    if command -v blender >/dev/null; then
        try "$(blender --version | head -n 1)" blender --background --factory-startup --python-exit-code 1 \
            --python "$here/main.py" --
        window
    else
        skip './run test blender installs it'
    fi
fi
for version; do # some 500 MB each
    environment=$folder/bpy-$version
    if [ ! -e "$environment/.stamp" ]; then
        rm -rf "$environment"
        if ! { command -v python3.11 && python3.11 -m venv "$environment" &&
            "$environment/bin/pip" install -q "bpy==$version.*" numpy; } >"$folder/pip.log" 2>&1; then
            skip "bpy $version cannot be installed: $(tail -n 1 "$folder/pip.log")"
            continue
        fi
        touch "$environment/.stamp"
    fi
    try "bpy $version" "$environment/bin/python" "$here/main.py"
done
[ $ran -eq 1 ] || exit 77
