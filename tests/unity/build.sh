#!/usr/bin/env bash
# Compiles the stand-ins, the package and its tests, as C# 7 (which Unity 2021.3 and Debian's mcs both know), with
# warnings as errors. usage: build.sh FOLDER
# FOLDER/            the package as an editor compiles it, with tests
# FOLDER/player/     the package as in a player: without UNITY_EDITOR
# FOLDER/newest/     as Unity 7 compiles it, with both importers
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
[ $# -eq 1 ] || { echo "usage: build.sh FOLDER" >&2; exit 2; }
command -v mcs >/dev/null || { echo "build.sh: no mcs: apt-get install mono-mcs mono-runtime libmono-cil-dev" >&2; exit 1; }
mkdir -p "$1/player" "$1/plain" "$1/newest"
out=$(cd "$1" && pwd)
package=${KNURL_UNITY_PACKAGE:-$root/bindings/unity/package} # one that was packed, or the sources
if [ ! -e "$package/package.json" ]; then
    echo "build.sh: KNURL_UNITY_PACKAGE: expected a folder that holds package.json, found $package" >&2
    exit 1
fi
shopt -s nullglob globstar

# compile NAME FOLDER-OF-OUTPUT OPTIONS... -- SOURCES: does nothing without sources
compile() {
    local name=$1 folder=$2 options=()
    shift 2
    while [ "$1" != -- ]; do options+=("$1"); shift; done
    shift
    [ $# -gt 0 ] || return 0
    timeout 120 mcs -nologo -langversion:7 -unsafe -warnaserror -debug -lib:"$folder" "${options[@]}" \
        -out:"$folder/$name" "$@" || { echo "build.sh: $name does not compile" >&2; exit 1; }
}

unity=(-define:UNITY_2021_3_OR_NEWER,UNITY_STANDALONE,UNITY_STANDALONE_LINUX,UNITY_INCLUDE_TESTS)
editor=("${unity[@]}" -define:UNITY_EDITOR,UNITY_EDITOR_LINUX,KNURL_INPUT_SYSTEM) # the player: a project without it
nunit=(-pkg:nunit)

compile UnityEngine.dll "$out" -target:library -r:System.Web.Extensions.dll -- "$here"/stubs/engine/*.cs
compile UnityEditor.dll "$out" -target:library -r:UnityEngine.dll -- "$here"/stubs/editor/*.cs
cp "$out"/UnityEngine.dll "$out/player/"
cp "$out"/Unity*.dll "$out/plain/"
cp "$out"/Unity*.dll "$out/newest/"

# Documents are checked as well: a public member without one is a warning.
compile Knurl.Haptics.dll "$out" -target:library "${editor[@]}" -r:UnityEngine.dll -r:UnityEditor.dll \
    -doc:"$out/Knurl.Haptics.xml" -- "$package"/Runtime/**/*.cs
compile Knurl.Haptics.dll "$out/player" -target:library "${unity[@]}" -r:UnityEngine.dll -- "$package"/Runtime/**/*.cs
# As IL2CPP, mono's full ahead-of-time compiler has to know all code and all types in advance.
if command -v as >/dev/null && command -v ld >/dev/null; then
    aot=$(cd "$out/player" && timeout 120 mono --aot=full,outfile="$out/player/aot.so" Knurl.Haptics.dll 2>&1) || true
    if ! grep -qE '^Compiled: ([0-9]+)/\1$' <<<"$aot"; then
        echo "build.sh: Knurl.Haptics.dll cannot be compiled ahead of time: $aot" >&2
        exit 1
    fi
fi
while read -r shown; do # the examples in its README; serialised fields are not assigned: CS0649
    compile "$(basename "$shown" .cs).dll" "$out" -target:library -nowarn:0649 "${editor[@]}" -r:UnityEngine.dll \
        -r:Knurl.Haptics.dll -- "$shown"
done < <(/usr/bin/python3 -B "$root/tests/docs/snippets.py" write csharp "$out" bindings/unity)
compile Knurl.Haptics.Editor.dll "$out" -target:library "${editor[@]}" -r:UnityEngine.dll -r:UnityEditor.dll \
    -r:Knurl.Haptics.dll -- "$package"/Editor/**/*.cs
newest=("${editor[@]}" -define:UNITY_7000_0_OR_NEWER,KNURL_UNITYGLTF,KNURL_GLTFAST -r:UnityEngine.dll -r:UnityEditor.dll)
compile Knurl.Haptics.dll "$out/newest" -target:library "${newest[@]}" -- "$package"/Runtime/**/*.cs
compile Knurl.Haptics.Editor.dll "$out/newest" -target:library "${newest[@]}" -r:Knurl.Haptics.dll -- "$package"/Editor/**/*.cs
# The optional assemblies for importers, with stand-ins for these.
importers=()
if [ -d "$package/Importers" ]; then
    compile Importers.dll "$out" -target:library -r:UnityEngine.dll -- "$here"/stubs/importers/*.cs
    for importer in UnityGLTF glTFast; do
        compile "Knurl.Haptics.$importer.dll" "$out" -target:library "${editor[@]}" -define:KNURL_NEWTONSOFT -r:UnityEngine.dll \
            -r:UnityEditor.dll -r:Knurl.Haptics.dll -r:Importers.dll -- "$package/Importers/$importer"/*.cs
        compile "Knurl.Haptics.$importer.dll" "$out/player" -target:library "${unity[@]}" -lib:"$out" -r:UnityEngine.dll \
            -r:Knurl.Haptics.dll -r:Importers.dll -- "$package/Importers/$importer"/*.cs
        importers+=(-r:"Knurl.Haptics.$importer.dll" -r:Importers.dll)
    done
fi
for sample in "$package"/Samples~/*/; do
    name=Sample.$(basename "$sample")
    compile "$name.dll" "$out" -target:library "${editor[@]}" -r:UnityEngine.dll -r:Knurl.Haptics.dll -- "$sample"**/*.cs
    compile "$name.dll" "$out/player" -target:library "${unity[@]}" -r:UnityEngine.dll -r:Knurl.Haptics.dll -- \
        "$sample"**/*.cs
done

# The package's own tests have to compile alone, as they do in Unity; they are run together with cases/, which need
# the player, other domains, other processes or the files of this repository.
tests=("${editor[@]}" "${nunit[@]}" -r:UnityEngine.dll -r:Knurl.Haptics.dll)
cp "$out"/Knurl.Haptics.dll "$out/plain/"
compile Knurl.Haptics.Tests.dll "$out/plain" -target:library "${tests[@]}" -- "$package"/Tests/Runtime/**/*.cs
compile Knurl.Haptics.Tests.dll "$out" -target:library "${tests[@]}" -r:UnityEditor.dll -r:System.Xml.dll \
    -r:System.Xml.Linq.dll -r:System.Web.Extensions.dll -- "$package"/Tests/Runtime/**/*.cs "$here"/cases/*.cs
editor_tests=("$package"/Tests/Editor/**/*.cs)
if [ -e "$out/Knurl.Haptics.Editor.dll" ]; then
    compile Knurl.Haptics.Editor.Tests.dll "$out" -target:library "${tests[@]}" -r:UnityEditor.dll \
        -r:Knurl.Haptics.Editor.dll -r:Knurl.Haptics.Tests.dll -r:Sample.ThreePlates.dll "${importers[@]}" -- \
        "${editor_tests[@]}" "$here"/editor_cases/*.cs
fi
compile Probe.exe "$out" -target:exe "${editor[@]}" -r:UnityEngine.dll -r:Knurl.Haptics.dll -- "$here"/probe/*.cs
