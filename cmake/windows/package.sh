#!/usr/bin/env bash
# Packs the files for Windows into one zip: the tool, the DLLs with headers and import libraries, libusb and hidapi,
# both
# engines' packages, assets to try, and all licences.
# usage: package.sh OUT.zip BUILD ENGINE_PACKAGE...     BUILD: the folder of the preset mingw-dll, built
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
[ $# -ge 2 ] || { echo "usage: package.sh OUT.zip BUILD ENGINE_PACKAGE..." >&2; exit 2; }
out=$(realpath -m "$1")
build=$2
shift 2
root=$here/../..
prefix=$root/build/windows/prefix

stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT
home=$stage/$(basename "$out" .zip)
cmake --install "$build" --strip --prefix "$home" >/dev/null
mkdir "$home"/{assets,engines,licences}
install -m 755 "$prefix"/bin/*.dll "$home/bin/"
cp "$root"/assets/*.glb "$home/assets/"
[ $# -eq 0 ] || cp "$@" "$home/engines/"
cp "$prefix"/licences/* "$home/licences/" # with libusb's sources, as its licence requires
cp "$root/bindings/unity/package/Third Party Notices.md" "$home/licences/knurl.md"
for name in bin/knurl.exe bin/knurl_study.exe bin/knurl.dll bin/knurl_gltf.dll bin/libusb-1.0.dll bin/hidapi.dll \
    lib/libknurl.dll.a include/knurl/knurl.h licences/libusb.txt; do
    [ -f "$home/$name" ] || { echo "package: $name is missing" >&2; exit 1; }
done
"$root/cmake/zip.py" "$out" "$home"
echo "package: $out holds $(cd "$home" && echo bin/* engines/*)"
