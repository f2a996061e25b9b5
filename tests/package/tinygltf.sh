#!/usr/bin/env bash
# The loader's tests with other versions of tinygltf: with the headers of the systems in systems.sh, and with each as
# published, without nlohmann-json's folder.
# usage: tinygltf.sh SYSTEMS BUILD     SYSTEMS: systems.sh's folder; BUILD: build folder
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
[ $# -eq 2 ] || { echo "usage: tinygltf.sh SYSTEMS BUILD" >&2; exit 2; }
mkdir -p "$2"
build=$(cd "$2" && pwd)
code=0
mkdir -p "$build/old"
echo '//  - v2.4.3 Fix null object output' >"$build/old/tiny_gltf.h"
if cmake -G Ninja -S "$root" -B "$build/old/build" -DTINYGLTF_INCLUDE_DIR="$build/old" >"$build/old.log" 2>&1 ||
    ! grep -q 'tinygltf: expected 2.5 or newer, found 2.4' "$build/old.log"; then
    echo "tinygltf: FAIL 2.4 is not refused as it is configured, see $build/old.log"
    code=1
fi
for header in "$1"/*.kept/tiny_gltf.h; do
    [ -e "$header" ] || { echo "tinygltf: expected headers in $1, found none" >&2; exit 1; }
    name=$(basename "$(dirname "$header")" .kept)
    mkdir -p "$build/$name"
    sed 's#<nlohmann/json.hpp>#"json.hpp"#' "$header" >"$build/$name/tiny_gltf.h"
    log=$build/$name.log
    failed=0
    (cmake -G Ninja -S "$root" -B "$build/$name/build" -DCMAKE_BUILD_TYPE=Release -DTINYGLTF_INCLUDE_DIR="$build/$name" \
        -DKNURL_GODOT=OFF -DKNURL_UNITY=OFF && cmake --build "$build/$name/build" --target gltf_tests &&
        cd "$build/$name/build" && ctest -L '^gltf$' -j "$(nproc)") >"$log" 2>&1 || failed=1
    echo "tinygltf: $([ $failed -eq 0 ] && echo 'ok  ' || echo FAIL) $(sed -n 's/^-- tinygltf: //p' "$log") ($name):" \
        "$(sed -n 's/^\([0-9]*% tests passed.*\)/\1/p' "$log")"
    [ $failed -eq 0 ] || { code=1; grep -v '^\[' "$log" | tail -n 20 >&2; }
done
exit $code
