#!/usr/bin/env bash
# Packs the Unity package with the libraries that were built: OUT_DIR/com.knurl.haptics, a folder to be added from disk
# or committed to a branch for git URLs, and OUT_DIR/com.knurl.haptics-VERSION.tgz, the same as a tarball.
# A Linux library that needs a newer glibc than 2.31 (Ubuntu 20.04) is an error, or with --any-glibc a warning.
# KNURL_URL: the https address of the repository, for the manifest's documentationUrl and so on; without it there are no
# addresses.
# KNURL_UNITY_ORGANIZATION: the id of a Unity organization: the tarball is signed for it with Unity's `upm`, whose
# credentials are the caller's. Unity 6.3 and later warn of tarballs that are not signed.
# usage: package.sh [--any-glibc] OUT_DIR LIBRARY...
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
GLIBC=2.31
any=''
[ "${1:-}" != --any-glibc ] || { any=1; shift; }
[ $# -ge 2 ] || { echo "usage: package.sh [--any-glibc] OUT_DIR LIBRARY..." >&2; exit 2; }
name=com.knurl.haptics
export SOURCE_DATE_EPOCH=499162500 # npm's: October 1985; strip writes it into Windows libraries
mkdir -p "$1"
out=$(cd "$1" && pwd)
shift

header=$here/../../sdk/include/knurl/base.h
version=$(sed -n 's/^#define KNURL_VERSION_\(MAJOR\|MINOR\|PATCH\) \([0-9]*\)$/\2/p' "$header" | paste -sd .)
if ! grep -qx "  \"version\": \"$version\"," "$here/package/package.json"; then
    echo "package: package/package.json: version: expected $version, as in knurl/base.h" >&2
    exit 1
fi

# place_library FILE FOLDER MAGIC [STRIP]: copies it into the stage; STRIP removes its debug information.
place_library() {
    if [ "$(head -c "${#3}" "$1")" != "$3" ]; then
        echo "package: $1: expected a library that starts with '${3#$'\x7f'}', found another kind of file" >&2
        exit 1
    fi
    install -m 644 "$1" "$stage/$name/Plugins/$2/"
    [ $# -lt 4 ] || ! command -v "$4" >/dev/null || "$4" --strip-unneeded "$stage/$name/Plugins/$2/$(basename "$1")"
}

# check_glibc LIBRARY: by the versions of the symbols that it needs.
check_glibc() {
    local newest
    newest=$(objdump -T "$1" | grep -o 'GLIBC_[0-9.]*' | sed 's/GLIBC_//' | sort -uV | tail -n 1 || true)
    if [ -n "$newest" ] && [ "$(printf '%s\n' "$newest" $GLIBC | sort -V | tail -n 1)" != $GLIBC ]; then
        echo "package: $1: expected symbols of glibc $GLIBC or older, found ones of $newest${any:+: packed all the same}" >&2
        [ -n "$any" ] || exit 1
    fi
}

stage=$(mktemp -d "$out/.package.XXXXXX") # on the same file system, so that the final move is atomic
trap 'rm -rf "$stage"' EXIT
mkdir "$stage/$name"
# Leaves out files that git ignores, such as a library put there for a test.
tar -C "$here/package" --exclude='*.so' --exclude='*.dll' --exclude='*.dylib' -cf - . | tar -C "$stage/$name" -xf -
find "$stage/$name" -name '.*' -type f -delete
for library in "$@"; do
    case $(basename "$library") in
    libknurl_unity.so)
        check_glibc "$library"
        place_library "$library" Linux/x86_64 $'\x7fELF' strip
        ;;
    knurl_unity.dll) place_library "$library" Windows/x86_64 MZ x86_64-w64-mingw32-strip ;;
    libknurl_unity.dylib) place_library "$library" macOS $'\xca\xfe\xba\xbe' ;; # stripped when it was linked
    *)
        echo "package: $library: expected libknurl_unity.so, libknurl_unity.dylib or knurl_unity.dll" >&2
        exit 1
        ;;
    esac
done
for system in Linux macOS Windows; do # no library, no meta for it
    if [ -z "$(find "$stage/$name/Plugins/$system" -type f ! -name '*.meta')" ]; then
        rm -rf "$stage/$name/Plugins/$system" "$stage/$name/Plugins/$system.meta"
    fi
done
if [ -n "${KNURL_URL:-}" ]; then
    python3 - "$stage/$name/package.json" "$KNURL_URL" <<'PY'
import json
import sys

path, url = sys.argv[1], sys.argv[2].rstrip("/").removesuffix(".git")
with open(path, encoding="utf-8") as file:
    manifest = json.load(file)
below = url + "/blob/main/bindings/unity/package/"
manifest.update(documentationUrl=below + "Documentation~/com.knurl.haptics.md", changelogUrl=below + "CHANGELOG.md",
                licensesUrl=below + "LICENSE.md", repository={"type": "git", "url": url + ".git"})
with open(path, "w", encoding="utf-8", newline="\n") as file:
    file.write(json.dumps(manifest, indent=2, ensure_ascii=False) + "\n")
PY
    page=${KNURL_URL%/}
    sed -i "s|Page = \"\"|Page = \"${page%.git}/blob/main/bindings/unity/package/Documentation~/com.knurl.haptics.md\"|" \
        "$stage/$name/Runtime/Manual.cs"
fi
"$here/metas.py" --check --packed "$stage/$name" >/dev/null
"$here/validate.py" ${KNURL_URL:+--published} "$stage/$name"
find "$stage/$name" -type f -exec chmod 644 {} +
find "$stage/$name" -type d -exec chmod 755 {} +

# # In npm's layout, and reproducible: sorted, with one time and one owner.
tar -C "$stage" --transform "s,^$name,package,S" --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 \
    --numeric-owner --format=ustar -cf "$stage/tar" "$name"
gzip -n -9 <"$stage/tar" >"$stage/tgz"
signed=unsigned
if [ -n "${KNURL_UNITY_ORGANIZATION:-}" ]; then
    command -v upm >/dev/null || { echo "package: KNURL_UNITY_ORGANIZATION is set, and Unity's upm is not here to sign with" >&2; exit 1; }
    upm pack "$stage/$name" --organization-id "$KNURL_UNITY_ORGANIZATION" --destination "$stage/upm"
    mv "$stage/upm/$name-$version.tgz" "$stage/tgz"
    signed=signed
fi
[ ! -e "$out/$name" ] || mv "$out/$name" "$stage/old"
mv "$stage/$name" "$out/$name"
mv "$stage/tgz" "$out/$name-$version.tgz"
libraries=$(find "$out/$name/Plugins" -type f ! -name '*.meta' -printf '%f\n' | sort | paste -sd ' ')
echo "package: $out/$name-$version.tgz, $signed, holds $libraries"
