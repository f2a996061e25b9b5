#!/usr/bin/env bash
# Compiles the library without loop and devices, the glTF loader and the page's C to WebAssembly: OUT/knurl.mjs and
# OUT/knurl.wasm. The options that change numbers are those of ../../CMakeLists.txt. usage: wasm.sh OUT
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$1/objects/include"
objects=$(realpath "$1/objects")
export NODE_PATH=/usr/share/nodejs # Debian's emcc needs acorn from there
! command -v ccache >/dev/null || export EM_COMPILER_WRAPPER=${EM_COMPILER_WRAPPER-ccache}
for header in nlohmann glm tiny_gltf.h; do # only these: the rest of /usr/include is for another architecture
    ln -sfn "/usr/include/$header" "$objects/include/$header"
done

# usage: compile FILE OBJECTS COUNT: skipped if its object is newer than the file and every header
compile() {
    local object=$2/${1//\//_}.o
    local flags=(-O2 -DNDEBUG -DKNURL_STATIC -D_GNU_SOURCE -Isdk/include -Isdk/src -ffp-contract=off -fno-math-errno
        -fexceptions -idirafter "$2/include")
    [ ! "$object" -nt "$2/newest" ] || [ ! "$object" -nt "$1" ] || return 0
    case $1 in
    *.cpp) em++ -std=c++17 "${flags[@]}" -c "$1" -o "$object" ;;
    *) emcc -std=gnu99 "${flags[@]}" -c "$1" -o "$object" ;;
    esac
    echo "compiled $(find "$2" -name '*.o' -newer "$2/begin" | wc -l) files of $3"
}
export -f compile

cd "$root"
newest=$(find sdk samples/web \( -name '*.h' -o -name '*.hpp' -o -name '*.cpp' \) -printf '%T@\n' | sort -n | tail -n 1)
touch -d "@$newest" "$objects/newest"
touch "$objects/begin"
# The loader as one file, as in sdk/CMakeLists.txt.
loader=$objects/gltf.cpp
find sdk/src/gltf -name '*.cpp' | sort | sed 's|^sdk/src/\(.*\)|#include "\1"|' >"$loader.new"
cmp -s "$loader.new" "$loader" || mv "$loader.new" "$loader"
sources=(sdk/src/{vibration,grating,motion,contact,surface,proxy,guard,hip,scene,audio}/*.c "$loader" sdk/src/base/{error,format,heap,number}.c
    sdk/src/base/{format,regular_file,system}_posix.c samples/web/*.c)
# shellcheck disable=SC2016 # the other shell expands it
printf '%s\n' "${sources[@]}" |
    xargs -P "$(nproc)" -I {} bash -euo pipefail -c 'compile "$1" "$2" "$3"' compile {} "$objects" "${#sources[@]}"
compiled=("${sources[@]//\//_}")
compiled=("${compiled[@]/%/.o}")
printf '%s\n' "${compiled[@]}" >"$objects/linked.new"
cmp -s "$objects/linked.new" "$objects/linked" || mv "$objects/linked.new" "$objects/linked"
made=${objects%/objects}/knurl.wasm
if [ -e "$made" ] && [ -z "$(find "$objects" "$0" -newer "$made" \( -name '*.o' -o -name linked -o -name '*.sh' \))" ]; then
    exit 0
fi
echo 'linking'
em++ -O2 -fexceptions "${compiled[@]/#/$objects/}" -o "${made%.wasm}.mjs" -sMODULARIZE -sEXPORT_ES6 -sENVIRONMENT=web,worker \
    -sALLOW_MEMORY_GROWTH -sMAXIMUM_MEMORY=1GB -sEXPORTED_FUNCTIONS=_malloc,_free \
    -sEXPORTED_RUNTIME_METHODS=UTF8ToString
