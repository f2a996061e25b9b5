#!/usr/bin/env bash
# Runs the tests of the Godot extension in the real engine, headless: every test_*.gd of this folder, or those named.
# usage: run.sh LIBRARY KNURL FOLDER [SCRIPT...]     FOLDER: for the project
# A script passes when it exits with 0, prints its closing line with nothing failed, and no error that it did not
# announce. Exit 77: there is no engine (KNURL_GODOT_ROOT, or build/godot-engine, as bindings/godot/engine/fetch.sh
# makes it).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
[ $# -ge 3 ] || { echo "usage: run.sh LIBRARY KNURL FOLDER [SCRIPT...]" >&2; exit 2; }
library=$1 tool=$2 folder=$3
shift 3
engine=${KNURL_GODOT_ROOT:-$root/build/godot-engine}
if [ ! -x "$engine/root/usr/bin/godot" ]; then
    echo "skipped: no Godot in $engine; bindings/godot/engine/fetch.sh $engine brings it"
    exit 77
fi

# The project, and the list of extensions that the editor would have made of it.
mkdir -p "$folder/.godot"
folder=$(cd "$folder" && pwd)
rm -f "$folder"/*.gd
cp "$here"/*.gd "$here"/project.godot "$here"/knurl.gdextension "$library" "$folder/"
cp "$root"/assets/{plate_1d,grid_2d,knurled_handle}.glb "$folder/"
echo 'res://knurl.gdextension' >"$folder/.godot/extension_list.cfg"
/usr/bin/python3 "$root/tests/unity/traces.py" "$tool" "$root/assets" "$folder"

[ $# -gt 0 ] || set -- "$here"/test_*.gd
status=0
for script in "$@"; do
    name=$(basename "$script")
    log=$folder/${name%.gd}.log
    code=0 # freed memory is overwritten, so that its use shows
    (cd "$folder" && MALLOC_PERTURB_=85 timeout 120 "$root/bindings/godot/engine/run.sh" "$engine" \
        godot --headless --path . --script "res://$name" </dev/null) >"$log" 2>&1 || code=$?
    # Errors that were announced are taken out, one line for each announcement.
    unexpected=$(awk '/^expected error: / { sub(/^expected error: /, ""); parts[++count] = $0 }
        { lines[NR] = $0 }
        END {
            for (i = 1; i <= NR; i++) {
                if (lines[i] !~ /^(SCRIPT |USER )?ERROR:/) continue
                taken = 0
                for (j = 1; j <= count && !taken; j++)
                    if (!used[j] && index(lines[i], parts[j])) { used[j] = 1; taken = 1 }
                if (!taken) print "unexpected: " lines[i]
            }
            for (j = 1; j <= count; j++) if (!used[j]) print "missing: an error with: " parts[j]
        }' "$log")
    closing=$(grep -E '^[0-9]+ passed, [0-9]+ failed$' "$log" | tail -n 1 || true)
    grep -E '^(FAIL|note): ' "$log" || true
    [ -z "$unexpected" ] || echo "$unexpected"
    echo "$name: ${closing:-no closing line}, exit $code"
    if [ "$code" -ne 0 ] || [ -n "$unexpected" ] || [[ ! $closing =~ ^[1-9][0-9]*\ passed,\ 0\ failed$ ]]; then
        status=1
        tail -n 20 "$log"
    fi
done
exit $status
