#!/usr/bin/env bash
# Builds the Debian packages (libknurlMAJOR.MINOR, libknurl-dev, knurl, and their debug symbols) from the source archive, and
# checks them with lintian, if that is installed.
# usage: debian.sh OUT SOURCE.tar.gz VERSION FOLDER     FOLDER: to build in. Environment: SOURCE_DATE_EPOCH; DEBFULLNAME and
# DEBEMAIL: the maintainer
set -euo pipefail
[ $# -eq 4 ] || { echo "usage: debian.sh OUT SOURCE.tar.gz VERSION FOLDER" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
out=$(cd "$1" && pwd)
version=$3
minor=${version%.*}
maintainer="${DEBFULLNAME:-The Knurl authors} <${DEBEMAIL:-root@localhost}>"

rm -rf "$4"
mkdir -p "$4"
tar -C "$4" -xf "$2"
cd "$4/knurl-$version"
cp -r "$here/debian" debian
for file in debian/libknurl.*; do
    mv "$file" "debian/libknurl$minor.${file#*.}"
done
control=$(<debian/control.in)
control=${control//@MINOR@/"$minor"}
printf '%s\n' "${control//@MAINTAINER@/"$maintainer"}" >debian/control
rm debian/control.in
printf 'knurl (%s-1) unstable; urgency=medium\n\n  * See changelog.gz.\n\n -- %s  %s\n' "$version" "$maintainer" \
    "$(date -u -R -d "@$SOURCE_DATE_EPOCH")" >debian/changelog
if [ -d "$here/../build/mirror-venv" ]; then # libclang, for api.json
    mkdir -p build
    ln -s "$(cd "$here/../build/mirror-venv" && pwd)" build/mirror-venv
fi
dpkg-buildpackage -b -us -uc -d
cd ..
if command -v lintian >/dev/null; then
    # These packages are not for Debian's own archive: they close no bug there, and root@localhost stands for an address
    # that whoever publishes them sets.
    lintian --fail-on error,warning --suppress-tags \
        root-in-contact,bogus-mail-host,bogus-mail-host-in-debian-changelog,initial-upload-closes-no-bugs -- *.changes
else
    echo 'debian: lintian is not installed: the packages were not checked'
fi
mv -- *.deb "$out/"
