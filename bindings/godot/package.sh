#!/usr/bin/env bash
# Packs the add-on and the libraries that were built into a zip to be unpacked into a Godot project.
# usage: package.sh OUT.zip LIBRARY...
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
[ $# -ge 2 ] || { echo "usage: package.sh OUT.zip LIBRARY..." >&2; exit 2; }
out=$(realpath -m "$1")
shift

version_of() { # of the SDK, from its header
    sed -n 's/^#define KNURL_VERSION_\(MAJOR\|MINOR\|PATCH\) \([0-9]*\)$/\2/p' "$here/../../sdk/include/knurl/base.h" | paste -sd .
}
version=$(version_of)
if ! grep -qx "version=\"$version\"" "$here/addons/knurl/plugin.cfg"; then
    echo "package: addons/knurl/plugin.cfg: version: expected $version, as in knurl/base.h" >&2
    exit 1
fi

stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT
mkdir -p "$stage/addons"
cp -r "$here/addons/knurl" "$stage/addons/"
sed -E 's/\[([^]]*)\]\([a-z][^):]*\)/\1/g' "$here/../../CHANGELOG.md" >"$stage/addons/knurl/CHANGELOG.md" # the pages are elsewhere
mkdir -p "$stage/addons/knurl/bin"
for library in "$@"; do
    name=$(basename "$library")
    if ! grep -q "\"bin/$name\"" "$here/addons/knurl/knurl.gdextension"; then
        echo "package: knurl.gdextension does not name bin/$name" >&2
        exit 1
    fi
    install -m 755 "$library" "$stage/addons/knurl/bin/"
    case $name in # debug information is not shipped
    *.arm64.* | *.dylib) ;; # stripped when they were linked
    *.so) strip --strip-unneeded "$stage/addons/knurl/bin/$name" ;;
    *.dll) ! command -v x86_64-w64-mingw32-strip >/dev/null ||
        x86_64-w64-mingw32-strip --strip-unneeded "$stage/addons/knurl/bin/$name" ;;
    esac
done
mkdir -p "$(dirname "$out")"
rm -f "$out"
"$here/../../cmake/zip.py" "$out" "$stage/addons"
echo "package: $out holds $(cd "$stage/addons/knurl/bin" && echo *)"
