#!/usr/bin/env bash
# Draws the pictures of the Unity package's tutorial again, without a Unity: what the sample Three Plates draws when it is
# played with the stand-ins of tests/unity and the real native library. usage: unity_tutorial.sh BUILD FOLDER
#   BUILD: build/release; FOLDER: for the stand-ins and the frame
set -euo pipefail
[ $# -eq 2 ] || { sed -n 's/^# \(.*\)usage: /usage: /p' "$0" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
build=$(cd "$1" && pwd)
mkdir -p "$2"
out=$(cd "$2" && pwd)
"$root/tests/unity/build.sh" "$out"
cd "$out"
mcs -nologo -langversion:7 -warnaserror -r:UnityEngine.dll -r:UnityEditor.dll -r:Knurl.Haptics.dll -r:Sample.ThreePlates.dll \
    -out:unity_tutorial.exe "$here/unity_tutorial.cs"
for ((left = 20; ; left--)); do
    LD_LIBRARY_PATH=$build/unity mono unity_tutorial.exe >frame.tsv && break
    [ $left -gt 1 ] || { echo "unity_tutorial: 20 strokes were uneven: this machine is too busy" >&2; exit 1; }
done
/usr/bin/python3 -B "$here/unity_tutorial.py" frame.tsv "$root/bindings/unity/package/Documentation~/images"
