#!/usr/bin/env bash
# The add-on's C# and the examples in its README match the class reference, and compile as C# 7 against stand-ins for
# the engine's. Exit 77: no mono.
# usage: csharp.sh FOLDER
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
[ $# -eq 1 ] || { echo "usage: csharp.sh FOLDER" >&2; exit 2; }
/usr/bin/python3 -B "$root/bindings/godot/csharp.py" --check
command -v mcs >/dev/null || { echo "skipped: no mcs; apt-get install mono-mcs"; exit 77; }
mkdir -p "$1"
mcs -langversion:7 -warnaserror -target:library -out:"$1/Knurl.dll" "$here/csharp/Godot.cs" \
    "$root/bindings/godot/addons/knurl/csharp/"*.cs
/usr/bin/python3 -B "$root/tests/docs/snippets.py" write csharp "$1" bindings/godot | while read -r shown; do
    mcs -langversion:7 -warnaserror -target:library -out:"${shown%.cs}.dll" "$here/csharp/Godot.cs" \
        "$root/bindings/godot/addons/knurl/csharp/"*.cs "$shown"
done
echo 'the C# classes are up to date and compile'
