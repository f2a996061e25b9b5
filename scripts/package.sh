# Part of ./run: ./run godot-demo, package-* and release.

GODOT_ENGINE=${KNURL_GODOT_ROOT:-$PWD/build/godot-engine}
GODOT_LIBRARY=godot/libknurl_godot.linux.x86_64.so # below a preset's folder

# Fetches the engine, once; prints the reason if it is not available.
fetch_godot() {
    bindings/godot/engine/fetch.sh "$GODOT_ENGINE"
}

godot_demo() {
    need_packages "${BUILD_PACKAGES[@]}"
    fetch_godot
    build release knurl_godot
    local project=$PWD/build/godot-demo
    bindings/godot/demo.sh "build/release/$GODOT_LIBRARY" "$project"
    echo "run: the demo project is in build/godot-demo; open it with Godot 4.3 or later"
    (cd "$project" && timeout 120 "$OLDPWD/bindings/godot/engine/run.sh" "$GODOT_ENGINE" xvfb-do godot --path . \
        --rendering-driver opengl3 --audio-driver Dummy --resolution 1280x720 -- --stroke --shot "$project/shot.png")
    echo "run: what was felt is drawn in build/godot-demo/shot.png"
}

# Fetches the compiler for macOS and for arm64; prints the reason if it cannot be downloaded.
prepare_zig() {
    need_packages "${BUILD_PACKAGES[@]}" python3-venv
    mkdir -p build
    if ! with_progress 'preparing for macOS and arm64' build/zig.log cmake/zig.sh build/zig; then
        tail -n 3 build/zig.log >&2
        return 1
    fi
}

# Builds an engine's library for macOS, as one file for both processors, and for Linux on arm64.
# usage: build_elsewhere TARGET FILE_BELOW_A_PRESET     Writes build/macos/FILE.
build_elsewhere() {
    local preset
    for preset in macos-arm64 macos-x86_64 linux-arm64; do
        build $preset "$1"
    done
    mkdir -p "build/macos/$(dirname "$2")"
    cmake/universal.py "build/macos/$2" "build/macos-arm64/$2" "build/macos-x86_64/$2"
}

package_godot() {
    case ${1:-} in
    '' | linux) ;;
    *) echo "run: package-godot: expected linux or nothing, found '$1'" >&2; exit 2 ;;
    esac
    need_packages "${BUILD_PACKAGES[@]}"
    build release knurl_godot knurl_tool
    local libraries=("build/release/$GODOT_LIBRARY") version
    if [ "${1:-}" = linux ]; then
        echo 'run: the package is for Linux alone, as asked for'
    elif prepare_windows; then
        build mingw knurl_godot
        libraries+=(build/mingw/godot/libknurl_godot.windows.x86_64.dll)
    else
        echo "run: SKIPPED: the Windows library, see above: the package is without it" >&2
    fi
    if [ "${1:-}" != linux ] && prepare_zig; then
        build_elsewhere knurl_godot godot/libknurl_godot.macos.dylib
        build windows-arm64 knurl_godot
        libraries+=(build/macos/godot/libknurl_godot.macos.dylib build/linux-arm64/godot/libknurl_godot.linux.arm64.so
            build/windows-arm64/godot/libknurl_godot.windows.arm64.dll)
    elif [ "${1:-}" != linux ]; then
        echo "run: SKIPPED: the libraries for macOS and arm64, see above: the package is without them" >&2
    fi
    version=$(sed -n 's/^#define KNURL_VERSION_[A-Z]* \([0-9]*\)$/\1/p' sdk/include/knurl/base.h | paste -sd .)
    local package=$PWD/build/knurl-godot-$version.zip
    bindings/godot/package.sh "$package" "${libraries[@]}"
    bindings/godot/demo.sh "build/release/$GODOT_LIBRARY" "$PWD/build/knurl-godot-demo"
    strip --strip-unneeded "build/knurl-godot-demo/addons/knurl/bin/${GODOT_LIBRARY##*/}" # contains folder names
    cmake/zip.py "build/knurl-godot-demo-$version.zip" build/knurl-godot-demo
    echo "run: the demo project is in build/knurl-godot-demo-$version.zip"
    if fetch_godot; then
        KNURL_GODOT_PACKAGE=$package test_preset release -R '^addon_package$' --no-tests=error
    else
        echo "run: SKIPPED: trying the package in Godot: it could not be fetched, see above" >&2
    fi
}

# Fetches Debian 11's C library and compiler, so that releases run on older Linux; prints the reason if they are not
# available.
prepare_debian11() {
    mkdir -p build
    if ! with_progress 'preparing for older Linux' build/debian11.log cmake/debian11.sh build/debian11; then
        tail -n 3 build/debian11.log >&2
        return 1
    fi
}

package_unity() {
    need_packages "${BUILD_PACKAGES[@]}"
    build release knurl_tool
    local libraries=(build/debian11/unity/libknurl_unity.so) any=()
    if prepare_debian11; then
        build debian11 knurl_unity
    else
        echo "run: SKIPPED: the Linux library for glibc 2.31 (see above): it is built for this machine's" >&2
        build release knurl_unity
        libraries=(build/release/unity/libknurl_unity.so) any=(--any-glibc)
    fi
    if prepare_windows; then
        build mingw knurl_unity
        libraries+=(build/mingw/unity/knurl_unity.dll)
    else
        echo "run: SKIPPED: the Windows library, see above: the package is without it" >&2
    fi
    if prepare_zig; then
        build_elsewhere knurl_unity unity/libknurl_unity.dylib
        libraries+=(build/macos/unity/libknurl_unity.dylib)
    else
        echo "run: SKIPPED: the macOS library, see above: the package is without it" >&2
    fi
    bindings/unity/package.sh "${any[@]}" "$PWD/build" "${libraries[@]}"
    if prepare_unity; then
        echo "run: trying what was packed"
        KNURL_UNITY_PACKAGE=$PWD/build/com.knurl.haptics tests/unity/run.sh \
            build/com.knurl.haptics/Plugins/Linux/x86_64 build/release/knurl build/unity-package
    else
        echo "run: SKIPPED: trying the package: mono could not be had, see above" >&2
    fi
    [ -z "${1:-}" ] || bindings/unity/branch.sh build/com.knurl.haptics "$1"
}

# One zip for Windows, including both engines' packages, tested in a separate folder.
package_windows() {
    local version name tried
    version=$(sed -n 's/^#define KNURL_VERSION_[A-Z]* \([0-9]*\)$/\1/p' sdk/include/knurl/base.h | paste -sd .)
    name=knurl-$version-windows-x86_64
    rm -f "build/$name.zip"
    if ! prepare_windows; then
        echo "run: SKIPPED: the package for Windows, see above" >&2
        return 0
    fi
    build release knurl_tool knurl_study_tool
    build mingw-dll knurl_gltf knurl_tool knurl_study_tool
    cmake/windows/package.sh "build/$name.zip" build/mingw-dll "build/knurl-godot-$version.zip" \
        "build/com.knurl.haptics-$version.tgz"
    echo 'run: trying what was packed'
    tried=$(mktemp -d)
    /usr/bin/python3 -m zipfile -e "build/$name.zip" "$tried"
    x86_64-w64-mingw32-gcc-posix -std=c99 -I"$tried/$name/include" samples/hello_grating.c -L"$tried/$name/lib" -lknurl \
        -o "$tried/$name/bin/hello_grating.exe"
    tests/windows/wine.sh "$tried/$name/bin/hello_grating.exe" >/dev/null
    tests/windows/tool.py "$tried/$name/bin/knurl.exe" "$tried/$name/bin" build/release/knurl "$tried/$name/assets" \
        build/windows/wine
    rm -rf "$tried"
}

# Uses the time of the last commit for archives: the same sources give the same bytes.
date_sources() {
    need_packages git
    SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
    export SOURCE_DATE_EPOCH
}

# Builds the contents of an archive: the tool, shared libraries. usage: build_shared NAME [OPTION...]: CMake's, for the
# toolchain     In build/archive-NAME.
build_shared() {
    local name=$1 folder=build/archive-$1 log=build/package.log
    shift
    CFLAGS="-ffile-prefix-map=$PWD=." CXXFLAGS="-ffile-prefix-map=$PWD=." \
        cmake -G Ninja -S . -B "$folder" -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS_RELEASE='-O3 -g1' \
        -DCMAKE_CXX_FLAGS_RELEASE='-O2 -g1' -DBUILD_SHARED_LIBS=ON -DBUILD_TESTING=OFF -DKNURL_VIEW=OFF -DKNURL_PICTURES=OFF \
        -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_BUILD_RPATH_USE_ORIGIN=ON "$@" >"$log" 2>&1 &&
        with_progress "building the archive for $name" "$log" cmake --build "$folder" || { tail -n 20 "$log" >&2; exit 1; }
}

# usage: release_archive OUT NAME BUILD [OTHER]: see packages/archive.sh
release_archive() {
    packages/archive.sh "$1" "$2" build/release/knurl build/docs/html "${@:3}" >>build/package.log 2>&1 ||
        { tail -n 20 build/package.log >&2; exit 1; }
}

# Makes the Python package's own source archive, with the same bytes each time, and unpacks it into build/python-source.
# usage: release_python_source OUT.tar.gz FOLDER     FOLDER: bindings/python in a copy of the sources, which is written to
release_python_source() {
    local made=build/python-archive name
    name=$(basename "$1" .tar.gz)
    rm -rf "$made" build/python-source
    mkdir -p "$made"
    (cd "$2" && /usr/bin/python3 setup.py -q sdist --dist-dir "$OLDPWD/$made") >build/package.log 2>&1 ||
        { tail -n 20 build/package.log >&2; exit 1; }
    tar -C "$made" -xf "$made/$name.tar.gz"
    tar -C "$made" --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner \
        --mode=u+rw,go+r-w -c "$name" | gzip -9 -n >"$1"
    mv "$made/$name" build/python-source
}

# Builds a wheel from build/python-source. usage: release_wheel OUT PLATFORM TARGET     PLATFORM: Python's name, such as
# linux-x86_64; TARGET: Zig's, or nothing for this machine
release_wheel() {
    local log=build/package.log options=()
    [ -z "$3" ] || options=("-DCMAKE_TOOLCHAIN_FILE=$PWD/cmake/zig.cmake" "-DKNURL_ZIG_TARGET=$3" -DCMAKE_SHARED_LINKER_FLAGS=-s)
    rm -rf build/python-source/build # of another platform
    KNURL_BUILD_FOLDER=$PWD/build/wheel-${3:-$2} _PYTHON_HOST_PLATFORM=$2 CMAKE_GENERATOR=Ninja CMAKE_ARGS="${options[*]}" \
        with_progress "building the wheel for ${3:-$2}" "$log" /usr/bin/python3 -m pip wheel --no-build-isolation --no-deps \
        --no-index --wheel-dir "$1" build/python-source || { tail -n 20 "$log" >&2; exit 1; }
}

# Archives and wheels for Linux on x86-64, with compilers that old systems' C libraries are enough for, if they can be had;
# those for Linux on arm64 and for macOS; and wheels for musl. usage: release_archives OUT VERSION
release_archives() {
    local arch name=knurl-$2 zig="-DCMAKE_TOOLCHAIN_FILE=$PWD/cmake/zig.cmake" link=-DCMAKE_SHARED_LINKER_FLAGS=-Wl,--build-id
    local oldest=() host
    host=$(uname -m)
    if prepare_debian11; then
        oldest=("-DCMAKE_TOOLCHAIN_FILE=$PWD/cmake/debian11.cmake")
    else
        echo "run: SKIPPED: the archive for glibc 2.31 (see above): it is built for this machine's" >&2
    fi
    build_shared "$host" "${oldest[@]}" "$link" "${link/SHARED/EXE}"
    release_archive "$1" "$name-linux-$host" "build/archive-$host"
    if ! prepare_zig; then
        echo "run: SKIPPED: files for macOS, arm64, musl and glibc 2.28 (see above): one wheel is built, for this machine's" >&2
        release_wheel "$1" "linux-$host" ''
        return 0
    fi
    build_shared aarch64 "$zig" -DKNURL_ZIG_TARGET=aarch64-linux-gnu.2.28
    release_archive "$1" "$name-linux-aarch64" build/archive-aarch64
    for arch in aarch64 x86_64; do
        build_shared macos-$arch "$zig" -DKNURL_ZIG_TARGET=$arch-macos.11.0
        release_wheel "$1" linux-$arch $arch-linux-gnu.2.28
        release_wheel "$1" linux-$arch $arch-linux-musl
        release_wheel "$1" macosx-11.0-${arch/aarch64/arm64} $arch-macos.11.0
    done
    release_archive "$1" "$name-macos-universal" build/archive-macos-{aarch64,x86_64}
}

# usage: release [check]
release() {
    case ${1:-} in
    '' | check) ;;
    *) echo "run: release: expected check or nothing, found '$1'" >&2; exit 2 ;;
    esac
    need_packages "${BUILD_PACKAGES[@]}" "${PYTHON_PACKAGES[@]}" debhelper lintian patchelf
    need_python mirror-venv bindings/unity/native/requirements.txt # for api.json
    local version out log=build/package.log name source
    version=$(sed -n 's/^#define KNURL_VERSION_[A-Z]* \([0-9]*\)$/\1/p' sdk/include/knurl/base.h | paste -sd .)
    out=$PWD/build/release-$version
    name=knurl-$version
    date_sources
    rm -rf "$out"
    mkdir -p "$out"
    docs
    build release knurl_tool
    source=$out/$name-source.tar.gz
    git archive --prefix="$name/" HEAD | gzip -9 -n >"$source"
    with_progress 'building Debian packages' "$log" packages/debian.sh "$out" "$source" "$version" build/debian || { tail -n 20 "$log" >&2; exit 1; }
    release_python_source "$out/$name.tar.gz" "build/debian/$name/bindings/python"
    release_archives "$out" "$version"
    package_godot
    package_unity
    package_windows
    mv "build/knurl-godot-$version.zip" "build/knurl-godot-demo-$version.zip" build/com.knurl.haptics-"$version".tgz "$out/"
    [ ! -f "build/knurl-$version-windows-x86_64.zip" ] || mv "build/knurl-$version-windows-x86_64.zip" "$out/"
    bindings/blender/package.sh "$out/knurl-blender-$version.zip"
    packages/sbom.py "$out" "$version" "$out/$name.spdx.json"
    (cd "$out" && sha256sum -- * >SHA256SUMS)
    if [ -n "${KNURL_SIGNING_KEY:-}" ]; then
        gpg --batch --local-user "$KNURL_SIGNING_KEY" --armor --detach-sign --output "$out/SHA256SUMS.asc" "$out/SHA256SUMS"
    else
        echo 'run: not signed: KNURL_SIGNING_KEY names no key of gpg'
    fi
    echo "run: in $out:"
    ls "$out"
    [ "${1:-}" != check ] || check_release "$out"
}

# Tests the archives in an empty Debian, and compares them with a second build: of a clone, in another folder, without
# compiler caches.
# usage: check_release RELEASE
check_release() {
    local again=$PWD/build/again
    need_packages debootstrap
    echo 'run: trying each archive in an empty Debian'
    tests/package/empty_debian.sh "$1" build/empty-debian
    if compgen -G "$1/*-macos-*" >/dev/null; then
        need_packages llvm
        /usr/bin/python3 -B tests/package/macos.py "$1" build/zig
        need_packages qemu-user
        tests/package/musl.sh "$1" build/zig build/musl
    else
        echo 'run: SKIPPED: the files for macOS and musl: the release has none' >&2
    fi
    echo 'run: trying the two commands in the oldest and in the newest system'
    test_systems '' "$OLDEST_SYSTEM" "$NEWEST_SYSTEM"
    [ ! -d build/systems ] || tests/package/tinygltf.sh build/systems build/tinygltf
    echo 'run: building all of it again'
    rm -rf "$again"
    git clone -q . "$again"
    mkdir -p "$again/build/debian11" # reuse downloads
    ln -s "$PWD/build/windows" "$PWD/build/zig" "$PWD/build/mirror-venv" "$PWD/build/docs-venv" "$again/build/"
    ln -s "$PWD/build/debian11/root" "$again/build/debian11/root"
    KNURL_GODOT_ROOT=$GODOT_ENGINE CCACHE_DISABLE=1 "$again/run" release
    if ! diff "$1/SHA256SUMS" "$again/build/${1##*/}/SHA256SUMS"; then
        echo 'run: the second build gave other bytes, see above (was all committed?)' >&2
        exit 1
    fi
    rm -rf "$again"
    echo 'run: the second build gave the same bytes'
}
