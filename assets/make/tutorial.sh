#!/usr/bin/env bash
# Walks both ways of docs/tutorial.md, from a model without a tag to ridges felt in Godot, and prints the time of each step by the
# clock: a script does not read or hesitate. usage: tutorial.sh BUILD GODOT FOLDER
#   BUILD: build/release; GODOT: of bindings/godot/engine/fetch.sh; FOLDER: for the files and pictures
# Needs Blender, Xvfb and a Godot: ./run test godot blender installs them.
set -euo pipefail
[ $# -eq 3 ] || { sed -n 's/^# \(.*\)usage: /usage: /p' "$0" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
build=$(cd "$1" && pwd) godot=$(cd "$2" && pwd)
rm -rf "$3"
mkdir -p "$3"
out=$(cd "$3" && pwd)
knurl=$build/knurl
cd "$out"

# step NAME COMMAND...: prints its time
step() {
    local name=$1 log begin
    log=$out/$(tr -c 'a-zA-Z\n' _ <<<"$1").log
    shift
    begin=$(date +%s%N)
    "$@" >"$log" 2>&1 || { cat "$log" >&2; echo "tutorial: $name: failed" >&2; exit 1; }
    awk -v name="$name" -v ns=$(($(date +%s%N) - begin)) 'BEGIN { printf "| %s | %.1f s |\n", name, ns / 1e9 }'
}

feel() {
    "$knurl" run "$1.glb" --stroke sweep --seconds 2 --fast --out "$1.csv"
    python3 "$root/samples/draw_run.py" "$1.csv" "$1.svg"
}

# A Godot project with the add-on, a device and the model. usage: play NAME
play() {
    local project=$out/godot_$1
    mkdir -p "$project/.godot" "$project/addons"
    cp -r "$root/bindings/godot/addons/knurl" "$project/addons/"
    install -D "$build/godot/libknurl_godot.linux.x86_64.so" "$project/addons/knurl/bin/libknurl_godot.linux.x86_64.so"
    cp "$1.glb" "$project/model.glb"
    cp "$here/tutorial.gd" "$project/"
    echo 'res://addons/knurl/knurl.gdextension' >"$project/.godot/extension_list.cfg"
    cat >"$project/project.godot" <<'CFG'
config_version=5

[application]

config/name="Tutorial"

[editor_plugins]

enabled=PackedStringArray("res://addons/knurl/plugin.cfg")

[rendering]

renderer/rendering_method="gl_compatibility"
CFG
    (cd "$project" && timeout 200 "$root/bindings/godot/engine/run.sh" "$godot" godot --headless --path . --import)
    (cd "$project" && timeout 200 "$root/bindings/godot/engine/run.sh" "$godot" xvfb-do godot --rendering-driver opengl3 \
        --audio-driver Dummy --resolution 900x420 --path . --script res://tutorial.gd)
    [ -s "$project/felt.txt" ]
}

# The plain handle: without its tag and its texture, which shows the ridges that it had.
"$knurl" tag "$root/assets/knurled_handle.glb" --remove --out tagless.glb >/dev/null
python3 - tagless.glb model.glb <<'END'
import json, struct, sys
data = open(sys.argv[1], "rb").read()
size = struct.unpack_from("<I", data, 12)[0]
file = json.loads(data[20:20 + size])
file["materials"] = [{"name": "Grip", "pbrMetallicRoughness": {"baseColorFactor": [0.55, 0.58, 0.62, 1], "metallicFactor": 0}}]
file["meshes"][0]["name"] = file["nodes"][0]["name"] = "handle"
for unused in ("textures", "images", "samplers"):
    file.pop(unused, None)
text = json.dumps(file).encode()
text += b" " * (-len(text) % 4)
rest = data[20 + size:]
open(sys.argv[2], "wb").write(struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest)
END
"$root/bindings/blender/package.sh" knurl.zip >/dev/null
echo '| step | time |'
echo '|---|---|'
step 'Blender: install, import, choose a material, export' blender --background --factory-startup --python-exit-code 1 \
    --python "$here/tutorial_blender.py" -- knurl.zip model.glb by_blender.glb
step 'tool: list what can be tagged' "$knurl" tag model.glb --list --pretty
step 'tool: tag it' "$knurl" tag model.glb --material Grip --preset knurl_straight --out by_tool.glb
for way in blender tool; do
    step "$way: inspect" "$knurl" inspect "by_$way.glb" --pretty
    step "$way: stroke and draw" feel "by_$way"
    step "$way: Godot, import and play" play "by_$way"
done
grep -h 'ridges' godot_*/felt.txt
