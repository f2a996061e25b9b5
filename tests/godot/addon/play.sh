#!/usr/bin/env bash
# Plays one case of the add-on's tests in the real engine.
# usage: play.sh CASE ENGINE BUILD_DIR     Exit 77, with the reason: the engine is not there.
# A failing script does not change the engine's exit status, or hangs: so every call has a timeout, a line with an error
# fails, and the line with the counts must be present.
set -euo pipefail
[ $# -eq 3 ] || { echo "usage: play.sh CASE ENGINE BUILD_DIR" >&2; exit 2; }
case=$1
engine=$2
build=$(cd "$3" && pwd)
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)
library=$build/godot/libknurl_godot.linux.x86_64.so
project=$build/godot/tests/$case
log=$project.log

if [ ! -e "$engine/root/.stamp" ]; then
    echo "skipped: addon_$case: there is no Godot in $engine (./run test godot fetches it)"
    exit 77
fi
[ -e "$library" ] || { echo "play: expected the extension at $library" >&2; exit 1; }
engine=$(cd "$engine" && pwd)

# An empty project with the add-on. The list is the editor's; without it the first import crashes as it ends
# (godotengine/godot#111048).
new_project() {
    rm -rf "$project"
    mkdir -p "$project/.godot" "$project/addons"
    cp -r "$root/bindings/godot/addons/knurl" "$project/addons/"
    install -D "$library" "$project/addons/knurl/bin/$(basename "$library")"
    settle_project
}

settle_project() {
    mkdir -p "$project/.godot"
    echo 'res://addons/knurl/knurl.gdextension' >"$project/.godot/extension_list.cfg"
    [ -e "$project/project.godot" ] || cat >"$project/project.godot" <<'CFG'
config_version=5

[application]

config/name="Knurl's tests"

[editor_plugins]

enabled=PackedStringArray("res://addons/knurl/plugin.cfg")

[rendering]

renderer/rendering_method="gl_compatibility"
CFG
}

# The assets, each with the result of Knurl's own loader.
add_assets() {
    local asset
    for asset in "$root"/assets/*.glb "$root"/assets/*.gltf; do
        [ -e "$asset" ] || continue
        cp "$asset" "$project/"
        "$build/knurl" inspect "$asset" >"$project/$(basename "$asset").json"
    done
}

# add_probe SCRIPT: a plugin beside Knurl's that checks from inside the editor.
add_probe() {
    mkdir -p "$project/addons/probe"
    cp "$here/cases/probe.cfg" "$project/addons/probe/plugin.cfg"
    cp "$here/cases/$1.gd" "$project/addons/probe/probe.gd"
    cp "$here/cases/checks.gd" "$project/addons/probe/"
    sed -i 's,plugin.cfg"),plugin.cfg"\, "res://addons/probe/plugin.cfg"),' "$project/project.godot"
}

# play SECONDS CMD ARGS...: in the project, with an end.
play() {
    local seconds=$1 status=0
    shift
    (cd "$project" && timeout --kill-after=5 "$seconds" "$root/bindings/godot/engine/run.sh" "$engine" "$@") \
        >"$log" 2>&1 </dev/null || status=$?
    cat "$log"
    if [ $status -eq 3 ] && grep -q '^run: .* needs the right to mount$' "$log"; then
        echo "skipped: addon_$case: pictures need the right to mount (a chroot or container without it runs the others)"
        exit 77
    fi
    if [ $status -ne 0 ]; then
        echo "play: exit status $status (124: no end within $seconds s)" >&2
        exit 1
    fi
    if grep -E '^(SCRIPT ERROR|ERROR|USER ERROR)|^ *(USER )?ERROR:|WARNING: [0-9]+ ObjectDB|Resources still in use' "$log" |
        grep -vE "$announced" >/dev/null; then
        echo "play: the engine told of errors" >&2
        exit 1
    fi
}

play_script() {
    local script=$1
    shift
    cp "$here/cases/checks.gd" "$here/cases/$script.gd" "$project/"
    play 60 "$@" --path . --script "res://$script.gd" "${arguments[@]}"
    if ! grep -qE '^[1-9][0-9]* passed, 0 failed$' "$log"; then
        echo "play: expected a line 'N passed, 0 failed'" >&2
        exit 1
    fi
}

arguments=() # arguments of a script
announced='^$' # a pattern of errors that are expected
headless=(godot --headless)
display=(xvfb-do godot --rendering-driver opengl3 --audio-driver Dummy --resolution 640x360)

case $case in
presets | mouse)
    new_project
    play_script "$case" "${headless[@]}"
    ;;
tags) # the case writes files, Knurl's own loader gives the expected results
    new_project
    mkdir "$project/files"
    cp "$here/cases/collector.gd" "$project/"
    arguments=(-- write)
    play_script "$case" "${headless[@]}"
    for file in "$project"/files/*.gltf; do
        "$build/knurl" inspect "$file" >"${file%.gltf}.said" 2>"$file.refused" || cp "$file.refused" "${file%.gltf}.said"
    done
    arguments=()
    play_script "$case" "${headless[@]}"
    ;;
assets) # loaded while the game runs, and imported by the editor with the plugin on; scripts that the pages show
    new_project
    add_assets
    play 120 "${headless[@]}" --path . --import
    play_script "$case" "${headless[@]}"
    /usr/bin/python3 -B "$root/tests/docs/snippets.py" write gdscript "$project" >"$project/shown"
    while read -r script; do
        play 60 "${headless[@]}" --path . --check-only --script "res://$(basename "$script")"
    done <"$project/shown"
    ;;
warnings) # the message of a wrong tag at import
    new_project
    cp "$here/cases/wrong_tag.gltf" "$project/"
    play 120 "${headless[@]}" --path . --import
    grep -F "WARNING: Knurl: wrong_tag: material 'Hard' (0): knurl_stiffness: expected a number > 0 (N/m), found -1" "$log"
    ;;
hints) # names that the importer makes bodies, shapes and regions of
    new_project
    cp "$here/cases/hints.gltf" "$project/"
    play 120 "${headless[@]}" --path . --import
    grep -F "WARNING: Knurl: hints: Floor: its name's import hint leaves no triangles to feel" "$log"
    play_script "$case" "${headless[@]}"
    ;;
late) # tagged files that were imported before the plugin was on
    new_project
    cp "$root"/assets/plate_1d.glb "$project/"
    cp "$root"/assets/plate_1d.glb "$project/off.glb"
    cp "$here/cases/hints.gltf" "$project/"
    mv "$project/project.godot" "$project/on"
    sed '/^\[editor_plugins\]/,/^$/d; /^enabled=/d' "$project/on" >"$project/project.godot"
    play 120 "${headless[@]}" --path . --import
    [ -z "$(grep -l knurl/surfaces "$project"/*.import)" ] || { echo "play: the plugin was on" >&2; exit 1; }
    sed -i 's,^\[params\]$,&\n\nknurl/surfaces=false,' "$project/off.glb.import"
    mv "$project/on" "$project/project.godot"
    add_probe late
    play 120 "${headless[@]}" --path . --editor
    grep -qE '^[1-9][0-9]* passed, 0 failed$' "$log" || { echo "play: no counts" >&2; exit 1; }
    grep -F 'Knurl: importing files with tags again, now with surfaces: res://hints.gltf, res://plate_1d.glb' "$log"
    play 120 "${headless[@]}" --path . --editor
    ! grep -F 'importing files with tags again' "$log" || { echo "play: once is enough" >&2; exit 1; }
    ;;
absent) # a system without a library: exports for one, then the project itself there, then back
    new_project
    rm -rf "$project.bin"
    cp "$here"/cases/absent/* "$here/cases/checks.gd" "$root/assets/plate_1d.glb" "$project/"
    sed -i 's,^config/name=.*,&\nrun/main_scene="res://game.tscn",' "$project/project.godot"
    play 120 "${headless[@]}" --path . --import
    play 60 "${headless[@]}" --path . -- felt
    grep -qE '^[1-9][0-9]* passed, 0 failed$' "$log"
    play 120 "${headless[@]}" --path . --export-pack Web game.zip
    grep -F 'Knurl: no library for this system' "$log"
    [ -z "$(cd "$project" && grep -l standins_active .godot/*.cfg)" ] || { echo "play: the editor's lists changed" >&2; exit 1; }
    [ ! -e "$project/addons/knurl/standins_active" ]
    mkdir "$project/exported"
    mv "$project/game.zip" "$project/exported/"
    touch "$project/exported/.gdignore"
    play 60 env -C exported "${headless[@]}" --main-pack game.zip
    grep -qE '^[1-9][0-9]* passed, 0 failed$' "$log" || { echo "play: no counts" >&2; exit 1; }
    [ "$(grep -c '^Knurl: ' "$log")" -eq 1 ] || { echo "play: expected one line of Knurl's" >&2; exit 1; }

    mv "$project/addons/knurl/bin" "$project.bin" # a clone on another system
    rm -r "$project/.godot"
    settle_project
    sed -i.old '/^linux/d' "$project/addons/knurl/knurl.gdextension"
    announced='GDExtension|Error loading extension|^ERROR: Knurl: its library is not loaded'
    add_probe absent # before it knows the stand-ins, the editor complains of the game's scripts as well
    announced+="|^SCRIPT ERROR: Parse Error:|Failed to load script \"res://(game|own).gd|^ERROR: Cannot get class 'Knurl"
    play 120 "${headless[@]}" --path . --editor
    grep -qE '^[1-9][0-9]* passed, 0 failed$' "$log" || { echo "play: no counts" >&2; exit 1; }
    announced='GDExtension|Error loading extension'
    play 60 "${headless[@]}" --path . -- unimported
    grep -qE '^[1-9][0-9]* passed, 0 failed$' "$log" || { echo "play: no counts" >&2; exit 1; }
    [ "$(grep -c '^Knurl: ' "$log")" -eq 1 ] || { echo "play: expected one line of Knurl's" >&2; exit 1; }

    announced='standins_active/'
    mv "$project.bin" "$project/addons/knurl/bin"
    mv "$project/addons/knurl/knurl.gdextension.old" "$project/addons/knurl/knurl.gdextension"
    play 120 "${headless[@]}" --path . --editor
    grep -qE '^[1-9][0-9]* passed, 0 failed$' "$log" || { echo "play: no counts" >&2; exit 1; }
    [ ! -e "$project/addons/knurl/standins_active" ]
    announced='^$'
    play 120 "${headless[@]}" --path . --editor # imports again, now with surfaces
    play 60 "${headless[@]}" --path . -- felt
    grep -qE '^[1-9][0-9]* passed, 0 failed$' "$log" || { echo "play: no counts" >&2; exit 1; }
    ;;
editor) # the plugin's parts, in the editor's process
    new_project
    add_probe probe
    cp "$here/cases/stage.tscn" "$project/"
    play 120 "${headless[@]}" --path . --import
    play 120 "${headless[@]}" --path . --editor
    grep -qE '^[1-9][0-9]* passed, 0 failed$' "$log" || { echo "play: no counts" >&2; exit 1; }
    # The editor adds to a project's version control no ids of its own for the add-on's files.
    diff <(cd "$root/bindings/godot/addons" && find . -name '*.uid' | sort | xargs grep .) \
        <(cd "$project/addons" && find ./knurl -name '*.uid' | sort | xargs grep .)
    ;;
overlay)
    new_project
    play_script "$case" "${display[@]}"
    ;;
package) # a user's download, in an empty project
    rm -rf "$project"
    mkdir -p "$project"
    package=${KNURL_GODOT_PACKAGE:-$project.zip} # one that is to be shipped, or one of this build's
    [ -n "${KNURL_GODOT_PACKAGE:-}" ] || "$root/bindings/godot/package.sh" "$package" "$library"
    /usr/bin/python3 -B "$here/layout.py" "$package" "$root/bindings/godot"
    (cd "$project" && cmake -E tar xf "$package")
    settle_project
    play 120 "${headless[@]}" --path . --import
    play_script "$case" "${headless[@]}"
    ;;
demo) # the sample, its stroke and its picture
    "$root/bindings/godot/demo.sh" "$library" "$project"
    play 60 xvfb-do godot --path . --rendering-driver opengl3 --audio-driver Dummy --resolution 1280x720 -- \
        --stroke --shot "$project/shot.png"
    grep -E '^stroke: [1-9][0-9]{2,} ticks, [0-9]+ overruns, in contact: true$' "$log"
    [ "$(head -c 8 "$project/shot.png" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ]
    ;;
toys) # the sample in which things move: a roller turns under the finger, a marble and a drawer are pushed
    "$root/bindings/godot/demo.sh" "$library" "$project"
    play 60 xvfb-do godot --path . --rendering-driver opengl3 --audio-driver Dummy --resolution 1280x720 res://toys.tscn -- \
        --play --shot "$project/shot.png"
    # 0.02 m x 1 rad/s x 500 ridges/m = 10 ridges a second, of the game's, which a slow machine stretches
    grep -E '^toys: ([5-9]|1[0-5]) ridges a second, marble [1-9][0-9]* mm, drawer [1-9][0-9]* mm$' "$log"
    ;;
recipes) # small scenes, each with one feature
    "$root/bindings/godot/demo.sh" "$library" "$project"
    play_script "$case" "${headless[@]}"
    ;;
pointer) # the sample, felt with the mouse
    "$root/bindings/godot/demo.sh" "$library" "$project"
    play_script "$case" xvfb-do godot --rendering-driver opengl3 --audio-driver Dummy --resolution 1280x720
    ;;
*)
    echo "play: unknown case '$case'" >&2
    exit 2
    ;;
esac
