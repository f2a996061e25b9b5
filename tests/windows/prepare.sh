#!/usr/bin/env bash
# Makes build/windows: what a build for Windows links and includes (prefix), and where wine lives (wine). Done once.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
dir=$(cd "$here/../.." && pwd)/build/windows
prefix=$dir/prefix
mkdir -p "$prefix/include" "$prefix/share/cmake"

# The C++ libraries that are headers alone, without the host's C headers that stand beside them.
headers() {
    local name
    for name in tiny_gltf.h nlohmann glm; do
        ln -sfn "/usr/include/$name" "$prefix/include/$name"
    done
    for name in nlohmann_json glm; do # copied: these find their headers from where they stand
        cp -r "/usr/share/cmake/$name" "$prefix/share/cmake/"
    done
}

# Debian has no cmocka for MinGW: its source package, fetched with package lists of our own and checked by apt's keys.
cmocka() {
    local apt=$dir/apt options
    rm -rf "$apt" "$dir/cmocka"
    mkdir -p "$apt"/{lists/partial,cache/archives/partial,sources} "$dir/cmocka"
    sed 's/^Types:.*/Types: deb-src/' /etc/apt/sources.list.d/debian.sources >"$apt/sources/debian.sources" 2>/dev/null ||
        sed -n 's/^deb /deb-src /p' /etc/apt/sources.list >"$apt/sources/debian.list"
    options=(-qq -o Dir::Etc::sourcelist=/dev/null -o Dir::Etc::sourceparts="$apt/sources" -o Dir::State::lists="$apt/lists"
        -o Dir::Cache="$apt/cache" -o APT::Sandbox::User=root -o Acquire::Languages=none)
    apt-get "${options[@]}" update
    (cd "$apt" && apt-get "${options[@]}" source --download-only cmocka)
    tar -C "$dir/cmocka" --strip-components=1 -xf "$(ls "$apt"/cmocka_*.orig.tar.*z | head -n 1)"
    cmake -G Ninja -S "$dir/cmocka" -B "$dir/cmocka/build" -DCMAKE_TOOLCHAIN_FILE="$here/../../cmake/mingw64.cmake" \
        -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" -DWITH_STATIC_LIB=ON -DWITH_EXAMPLES=OFF
    cmake --build "$dir/cmocka/build" --target cmocka-static
    cp "$(find "$dir/cmocka/build" -name 'libcmocka-static.a')" "$prefix/lib/"
    cp "$dir"/cmocka/include/cmocka*.h "$prefix/include/"
    rm -rf "$apt" "$dir/cmocka"
}

mkdir -p "$prefix/lib"
headers
[ -f "$prefix/lib/libcmocka-static.a" ] || cmocka
[ -f "$dir/wine/system.reg" ] || "$here/wine.sh" wineboot -i
