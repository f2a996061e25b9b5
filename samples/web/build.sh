#!/usr/bin/env bash
# Assembles the page in OUT, a folder that any web server can serve: WebAssembly, bundled scripts, demo assets.
# usage: build.sh WORK OUT
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=$1 out=$2
mkdir -p "$work/page" "$out"/{assets,draco}
cp "$here"/{package.json,package-lock.json,.npmrc} "$work/page/"
if ! cmp -s "$here/package-lock.json" "$work/page/installed.json"; then # the lock file's versions, checked by hash
    echo 'fetching three.js and esbuild'
    (cd "$work/page" && npm ci --ignore-scripts --no-progress) || exit 3 # 3: a dependency is not available
    cp "$here/package-lock.json" "$work/page/installed.json"
fi
"$here/wasm.sh" "$work"
cp "$here"/*.js "$here/../../assets/materials.json" "$work/knurl.mjs" "$work/page/"
"$work/page/node_modules/@esbuild/linux-x64/bin/esbuild" "$work"/page/{main,view,worker,unpack}.js --bundle --minify --format=esm \
    --external:./view.js --external:./unpack.js --legal-comments=eof --outdir="$out" --log-level=warning
cp "$here"/{index.html,start.js,style.css} "$work/knurl.wasm" "$out/"
cp "$work"/page/node_modules/three/examples/jsm/libs/draco/gltf/draco_{decoder.wasm,wasm_wrapper.js} "$out/draco/"
cp "$here/apache-2.0.txt" "$out/draco/LICENSE" # of Google's Draco
{
    cat "$here"/../../{LICENSE,bindings/godot/addons/knurl/THIRD_PARTY.md} # of the code in knurl.wasm
    printf '\n# three.js, in view.js and unpack.js\n\n'
    cat "$work/page/node_modules/three/LICENSE"
    printf '\n# meshoptimizer, in unpack.js, under the same licence\n\n'
    sed -n 's|^// \(Copyright .*\)|\1|p' "$work/page/node_modules/three/examples/jsm/libs/meshopt_decoder.module.js"
} >"$out/licences.txt"
cp "$here"/../../assets/{plate_1d,grid_2d,knurled_handle}.glb "$out/assets/"
