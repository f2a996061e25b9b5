#!/usr/bin/env bash
# Puts the compiler for macOS, and for Linux and Windows on arm64, into DIR: Zig's, which includes their headers and C
# libraries, and the headers of Knurl's other dependencies (cmake/zig.cmake uses them). Header-only libraries are the
# host's.
# usage: zig.sh DIR     Does nothing if that version is there already. Exit 3: it cannot be downloaded.
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: zig.sh DIR" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1"
dir=$(cd "$1" && pwd)
stamp=$(cat "$here/zig-requirements.txt" "${BASH_SOURCE[0]}")
[ "$(cat "$dir/stamp" 2>/dev/null)" != "$stamp" ] || exit 0

python3 -m venv --clear "$dir/venv"
"$dir/venv/bin/pip" install -q --disable-pip-version-check --require-hashes -r "$here/zig-requirements.txt" || exit 3
mkdir -p "$dir/bin" "$dir/prefix/include" "$dir/prefix/share/cmake" "$dir/prefix/lib/pkgconfig"
for tool in ar ranlib; do
    printf '#!/bin/sh\nexec "%s" -m ziglang %s "$@"\n' "$dir/venv/bin/python" $tool >"$dir/bin/$tool"
done
for target in aarch64-macos.11.0 x86_64-macos.11.0 aarch64-linux-gnu.2.31 aarch64-linux-gnu.2.28 x86_64-linux-gnu.2.28 \
    x86_64-linux-musl aarch64-linux-musl aarch64-windows-gnu; do
    for tool in cc c++; do
        printf '#!/bin/sh\nexec "%s" -m ziglang %s -target %s "$@"\n' "$dir/venv/bin/python" $tool $target \
            >"$dir/bin/$target-$tool"
    done
done
chmod +x "$dir"/bin/*
for name in tiny_gltf.h nlohmann glm libusb-1.0 hidapi; do # without the host's C headers, which are beside them
    ln -sfn "/usr/include/$name" "$dir/prefix/include/$name"
done
for name in nlohmann_json glm; do
    cp -r "/usr/share/cmake/$name" "$dir/prefix/share/cmake/"
done
for name in libusb-1.0 hidapi-hidraw; do # the libraries themselves are loaded at run time
    printf 'Name: %s\nDescription: headers\nVersion: %s\nCflags: -I%s\n' "$name" "$(pkg-config --modversion "$name")" \
        "$dir/prefix/include/${name%-hidraw}" >"$dir/prefix/lib/pkgconfig/$name.pc"
done
sed 's/^Name: .*/Name: hidapi/' "$dir/prefix/lib/pkgconfig/hidapi-hidraw.pc" >"$dir/prefix/lib/pkgconfig/hidapi.pc"
echo "$stamp" >"$dir/stamp"
