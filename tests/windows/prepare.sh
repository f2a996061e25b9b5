#!/usr/bin/env bash
# Makes build/windows: libraries and headers for Windows (prefix), and wine's folder (wine). Done once.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
dir=$(cd "$here/../.." && pwd)/build/windows
prefix=$dir/prefix
mkdir -p "$prefix/include" "$prefix/share/cmake"

# Header-only libraries, without the host's C headers beside them.
headers() {
    local name
    for name in tiny_gltf.h nlohmann glm jsmn.h; do
        ln -sfn "/usr/include/$name" "$prefix/include/$name"
    done
    for name in nlohmann_json glm; do # copied: these find their headers relative to themselves
        cp -r "/usr/share/cmake/$name" "$prefix/share/cmake/"
    done
}

# Libraries without MinGW packages in Debian: fetches source packages with private package lists, checked by apt's keys.
# Puts the upstream archives into $dir/sources.
fetch_sources() {
    local apt=$dir/apt options
    rm -rf "$apt" "$dir/sources"
    mkdir -p "$apt"/{lists/partial,cache/archives/partial,sources} "$dir/sources"
    sed 's/^Types:.*/Types: deb-src/' /etc/apt/sources.list.d/debian.sources >"$apt/sources/debian.sources" 2>/dev/null ||
        sed -n 's/^deb /deb-src /p' /etc/apt/sources.list >"$apt/sources/debian.list"
    options=(-qq -o Dir::Etc::sourcelist=/dev/null -o Dir::Etc::sourceparts="$apt/sources" -o Dir::State::lists="$apt/lists"
        -o Dir::Cache="$apt/cache" -o APT::Sandbox::User=root -o Acquire::Languages=none)
    apt-get "${options[@]}" update
    (cd "$apt" && apt-get "${options[@]}" source --download-only "$@")
    mv "$apt"/*.orig.tar.*z* "$dir/sources/"
    rm -rf "$apt"
}

# cross SOURCE BUILD [OPTION...]: configures it for Windows.
cross() {
    cmake -G Ninja -S "$1" -B "$2" -DCMAKE_TOOLCHAIN_FILE="$here/../../cmake/mingw64.cmake" -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_INSTALL_PREFIX="$prefix" "${@:3}"
}

cmocka() {
    local source=$dir/cmocka
    rm -rf "$source"
    mkdir "$source"
    tar -C "$source" --strip-components=1 -xf "$(ls "$dir"/sources/cmocka_*.orig.tar.*z | head -n 1)"
    cross "$source" "$source/build" -DWITH_STATIC_LIB=ON -DWITH_EXAMPLES=OFF
    cmake --build "$source/build" --target cmocka-static
    cp "$(find "$source/build" -name 'libcmocka-static.a')" "$prefix/lib/"
    cp "$source"/include/cmocka*.h "$prefix/include/"
    rm -rf "$source"
}

libraries() {
    local build=$dir/libraries
    rm -rf "$build"
    cross "$here/../../cmake/windows" "$build" -DSOURCES="$dir/sources"
    cmake --build "$build"
    cmake --install "$build"
    rm -rf "$build"
}

mkdir -p "$prefix/lib"
headers
if [ ! -f "$prefix/lib/pkgconfig/kissfft-float.pc" ]; then # the last that is put there
    fetch_sources cmocka libusb-1.0 hidapi kissfft
    cmocka
    libraries
fi
[ -f "$dir/wine/system.reg" ] || "$here/wine.sh" wineboot -i
# Raw HID devices are wine's through the kernel's own nodes; SDL would take them for game controllers or leave them out.
grep -q '^"Enable SDL"=dword:00000000' "$dir/wine/system.reg" || "$here/wine.sh" reg add \
    'HKLM\System\CurrentControlSet\Services\winebus' /v 'Enable SDL' /t REG_DWORD /d 0 /f
