#!/usr/bin/env bash
# Puts Debian 12's mono and NUnit into FOLDER, with mcs, mono and nunit-console in FOLDER/bin: later systems have
# dropped NUnit 2 or all of mono; these binaries run there unchanged. Nothing is installed on the host.
# usage: mono.sh FOLDER     Does nothing if it is there already. Exit 3: not available (no network, no apt).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
[ $# -eq 1 ] || { echo "usage: mono.sh FOLDER" >&2; exit 2; }
PACKAGES=(mono-mcs mono-runtime libmono-cil-dev nunit-console libnunit-cil-dev)

mkdir -p "$1"
dir=$(cd "$1" && pwd)
[ ! -e "$dir/bin/.complete" ] || exit 0
give_up() {
    echo "mono: Debian 12's mono cannot be fetched: $1" >&2
    exit 3
}
source "$here/../../cmake/apt_apart.sh"
find_mirror
echo "mono: downloading Debian 12's (60 MB) from $mirror"
download bookworm >"$dir/fetch.log" 2>&1 || give_up "$mirror could not be read (is there a network?), see $dir/fetch.log"
rm -rf "$dir/usr" "$dir/bin"
for deb in "$dir"/apt/cache/archives/{mono-,libmono,nunit,libnunit}*.deb; do
    dpkg-deb -x "$deb" "$dir"
done
rm -rf "$dir/apt"
mkdir "$dir/bin"
sed -i "s#=/usr\$#=$dir/usr#" "$dir/usr/lib/pkgconfig/nunit.pc"

# usage: program NAME COMMAND...
program() {
    cat >"$dir/bin/$1" <<SH
#!/bin/sh
export MONO_CFG_DIR=$dir/etc MONO_GAC_PREFIX=$dir/usr PKG_CONFIG_PATH=$dir/usr/lib/pkgconfig
export MONO_PATH=$(printf '%s:' "$dir"/usr/lib/cli/nunit*)\$MONO_PATH
exec $dir/usr/bin/mono ${*:2} "\$@"
SH
    chmod +x "$dir/bin/$1"
}
program mono
program mcs "$dir/usr/lib/mono/4.5/mcs.exe"
program nunit-console "$dir/usr/lib/nunit/nunit-console.exe"
"$dir/bin/mcs" --version || give_up 'it does not run here'
touch "$dir/bin/.complete"
