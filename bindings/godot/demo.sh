#!/usr/bin/env bash
# Assembles the demo: samples/godot, the add-on, the library and a tagged glTF file, in one project.
# usage: demo.sh LIBRARY PROJECT
set -euo pipefail
[ $# -eq 2 ] || { echo "usage: demo.sh LIBRARY PROJECT" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
library=$1
project=$2
rm -rf "$project"
mkdir -p "$project/.godot" "$project/addons"
cp -r "$here"/../../samples/godot/* "$project/"
cp "$here/../../assets/knurled_handle.glb" "$project/"
cp -r "$here/addons/knurl" "$project/addons/"
install -D "$library" "$project/addons/knurl/bin/$(basename "$library")"
# The editor writes this file when it first sees an extension; a game that was never opened there needs it, too.
echo 'res://addons/knurl/knurl.gdextension' >"$project/.godot/extension_list.cfg"
