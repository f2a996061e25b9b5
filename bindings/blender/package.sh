#!/usr/bin/env bash
# Packs the Blender extension: one zip for Blender 4.2 and later, and as an add-on for 3.4 to 4.1.
# usage: package.sh OUT.zip
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
[ $# -eq 1 ] || { echo "usage: package.sh OUT.zip" >&2; exit 2; }
out=$(realpath -m "$1")

version=$(sed -n 's/^#define KNURL_VERSION_[A-Z]* \([0-9]*\)$/\1/p' "$root/sdk/include/knurl/base.h" | paste -sd .)
if ! grep -qx "version = \"$version\"" "$here/knurl/blender_manifest.toml" ||
    ! grep -qF "\"version\": (${version//./, })," "$here/knurl/__init__.py"; then
    echo "package: expected version $version, as in knurl/base.h, in blender_manifest.toml and __init__.py" >&2
    exit 1
fi
stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT
mkdir "$stage/knurl"
cp "$here"/knurl/*.py "$here/knurl/blender_manifest.toml" "$root/assets/materials.json" "$root/LICENSE" "$stage/knurl/"
rm -f "$out"
"$root/cmake/zip.py" "$out" "$stage/knurl"
echo "$out: $(stat -c %s "$out") bytes"
