#!/usr/bin/env bash
# Assembles the page in OUT, a folder that any web server can serve: WebAssembly, bundled scripts, demo assets; and in
# OUT-npm the package for npm.
# usage: build.sh WORK OUT
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=$1 out=$2
mkdir -p "$work/page" "$out"/{assets,draco} "$out-npm"
cp "$here"/{package.json,package-lock.json,.npmrc} "$work/page/"
if ! cmp -s "$here/package-lock.json" "$work/page/installed.json"; then # the lock file's versions, checked by hash
    echo 'fetching three.js and esbuild'
    (cd "$work/page" && npm ci --ignore-scripts --no-progress) || exit 3 # 3: a dependency is not available
    cp "$here/package-lock.json" "$work/page/installed.json"
fi
"$here/wasm.sh" "$work"
cp -r "$here"/{*.js,npm} "$here/../../assets/materials.json" "$work/knurl.mjs" "$work/page/"
bundle() { # usage: bundle OUT SCRIPT...
    "$work/page/node_modules/@esbuild/linux-x64/bin/esbuild" "${@:2}" --bundle --minify --format=esm --outdir="$1" --log-level=warning \
        --external:./{view,unpack,index}.js --legal-comments=eof
}
bundle "$out" "$work"/page/{main,view,worker,unpack}.js
bundle "$out-npm" "$work"/page/npm/{index,figure}.js
cp "$here"/npm/*.{json,md,html,d.ts} "$here"/../../{LICENSE,bindings/godot/addons/knurl/THIRD_PARTY.md,assets/plate_1d.glb} "$work/knurl.wasm" "$out-npm/"
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
