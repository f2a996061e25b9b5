#!/usr/bin/env bash
# Assembles the page in OUT, a folder that any web server can serve: WebAssembly, bundled scripts, demo assets.
# usage: build.sh WORK OUT
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=$1 out=$2
mkdir -p "$work/page" "$out/assets"
cp "$here"/{package.json,package-lock.json,.npmrc} "$work/page/"
if ! cmp -s "$here/package-lock.json" "$work/page/installed.json"; then # the lock file's versions, checked by hash
    echo 'fetching three.js and esbuild'
    (cd "$work/page" && npm ci --ignore-scripts --no-progress) || exit 3 # 3: a dependency is not available
    cp "$here/package-lock.json" "$work/page/installed.json"
fi
"$here/wasm.sh" "$work"
cp "$here"/*.js "$work/knurl.mjs" "$work/page/"
"$work/page/node_modules/@esbuild/linux-x64/bin/esbuild" "$work"/page/{main,view,worker}.js --bundle --minify --format=esm \
    --external:./view.js --legal-comments=eof --outdir="$out" --log-level=warning
cp "$here"/{index.html,start.js,style.css} "$work/knurl.wasm" "$out/"
cat "$here"/../../{LICENSE,bindings/godot/addons/knurl/THIRD_PARTY.md} >"$out/licences.txt" # of the code in knurl.wasm
cp "$here"/../../assets/{plate_1d,grid_2d,knurled_handle}.glb "$out/assets/"
