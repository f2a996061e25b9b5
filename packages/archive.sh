#!/usr/bin/env bash
# Packs the files that a build with shared libraries installs, as an archive that runs from any folder: tool, libraries, headers,
# man page and completions, demo scenes, samples, the site; and its debug information, by build ID, in a second archive if
# there is any.
# usage: archive.sh OUT NAME KNURL SITE BUILD [OTHER]     Writes OUT/NAME.tar.gz and OUT/NAME-debug.tar.gz. KNURL: a tool that runs
# here; SITE: made by ./run docs; OTHER: a build for macOS's other processor: its programs and libraries are joined with BUILD's.
# Environment: SOURCE_DATE_EPOCH
set -euo pipefail
[ $# -eq 5 ] || [ $# -eq 6 ] || { echo "usage: archive.sh OUT NAME KNURL SITE BUILD [OTHER]" >&2; exit 2; }
root=$(cd "$(dirname "$0")/.." && pwd)
out=$1 name=$2 knurl=$3 site=$4 build=$5 other=${6:-}
stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT
home=$stage/$name

cmake --install "$build" --prefix "$home" >/dev/null
if [ -n "$other" ]; then
    cmake --install "$other" --prefix "$stage/other" >/dev/null
    for file in "$home"/bin/* "$home"/lib/*.dylib; do
        [ -L "$file" ] || "$root/cmake/universal.py" "$file" "$file" "$stage/other/${file#"$home/"}"
    done
fi
share=$home/share
mkdir -p "$share"/{man/man1,bash-completion/completions,fish/vendor_completions.d,zsh/site-functions} "$home"/{assets,samples}
"$knurl" man >"$share/man/man1/knurl.1"
"$knurl" completion bash >"$share/bash-completion/completions/knurl"
"$knurl" completion fish >"$share/fish/vendor_completions.d/knurl.fish"
"$knurl" completion zsh >"$share/zsh/site-functions/_knurl"
cp "$root"/assets/*.glb "$home/assets/"
cp "$root"/samples/{hello_grating.c,touch_grating.c,feel_scene.c,draw_run.py} "$home/samples/"
cp -r "$site" "$share/doc/knurl/html"

# knurl_study's Fourier transform, which few systems have (BSD licence)
fourier=$(sed -n 's/^pkgcfg_lib_KISSFFT_kissfft-float:[^=]*=//p' "$build/CMakeCache.txt")
if [ -n "$fourier" ]; then
    cp -L "$fourier" "$home/lib/$(readelf -d "$fourier" | sed -n 's/.*SONAME.*\[\(.*\)\]/\1/p')"
    cp /usr/share/doc/libkissfft-dev/copyright "$share/doc/knurl/kissfft.txt"
fi
for file in "$home"/bin/* "$home"/lib/*.so.*; do
    if [ -L "$file" ] || [ ! -f "$file" ]; then continue; fi
    id=$(readelf -n "$file" 2>/dev/null | sed -n 's/.*Build ID: //p') || continue # macOS's are stripped
    if [ -n "$id" ] && [[ $(readelf -SW "$file") == *.debug_info* ]]; then
        debug=$stage/$name-debug/lib/debug/.build-id/${id:0:2}
        mkdir -p "$debug"
        objcopy --only-keep-debug "$file" "$debug/${id:2}.debug"
        strip --strip-unneeded "$file"
    fi
done
for folder in "$name" "$name-debug"; do
    [ ! -d "$stage/$folder" ] || tar -C "$stage" --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner \
        --mode=u+rw,go+r-w -c "$folder" | gzip -9 -n >"$out/$folder.tar.gz"
done
