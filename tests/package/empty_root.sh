# Empty Debians, and copies of them to try things in, which leave no trace. To be sourced by a script that only root can run,
# with its arguments: it starts the script again with mounts of its own, which end with it. Wants give_up(), which is called
# with why it cannot be had, and $root, the sources.
if [ -z "${KNURL_APART:-}" ]; then
    [ "$(id -u)" -eq 0 ] || give_up 'only root can make an empty Debian'
    command -v debootstrap >/dev/null || give_up 'there is no debootstrap'
    unshare --mount true 2>/dev/null || give_up 'this machine lets not even root mount anything'
    KNURL_APART=1 exec unshare --mount "$0" "$@"
fi
source "$root/cmake/apt_apart.sh"
find_mirror

# usage: make_base FOLDER SUITE: keeps it there, with the packages and objects of earlier times
make_base() {
    dir=$1 base=$1/$2 kept=$1/$2.kept
    mkdir -p "$kept"/{archives/partial,ccache}
    if [ ! -e "$base/.complete" ]; then
        rm -rf --one-file-system "$base"
        debootstrap --variant=minbase --include=ca-certificates --keyring="$keyring" "$2" "$base" "$mirror" \
            >"$dir/$2.log" 2>&1 || give_up "no Debian ($2) could be made, see $dir/$2.log (is there a network?)"
        echo force-unsafe-io >"$base/etc/dpkg/dpkg.cfg.d/knurl" # a copy has nothing to lose
        printf '%s "%s";\n' Acquire::Check-Valid-Until false APT::Keep-Downloaded-Packages true \
            Binary::apt::APT::Keep-Downloaded-Packages true >"$base/etc/apt/apt.conf.d/99knurl"
        touch "$base/.complete"
    fi
    mount -t tmpfs tmpfs "$base/mnt" # overlays and their writes: removed with the namespace
}

# usage: try NAME COMMANDS: in a copy with the sources in /source and, if $release is set, that folder in /release;
# its output goes to FOLDER/NAME.log
try() {
    local name=$1 layers=$base/mnt copy=$dir/root
    mkdir -p "$layers/$name"/{upper,work} "$copy"
    mount -t overlay overlay -o "lowerdir=$base,upperdir=$layers/$name/upper,workdir=$layers/$name/work" "$copy"
    mkdir -p "$copy"/{source,kept,release}
    mount --bind "$root" "$copy/source"
    mount --bind "$kept" "$copy/kept"
    [ -z "${release:-}" ] || mount --bind "$release" "$copy/release"
    mount --bind "$kept/archives" "$copy/var/cache/apt/archives"
    mount -t proc proc "$copy/proc"
    mount --rbind /dev "$copy/dev"
    cp /etc/resolv.conf "$copy/etc/resolv.conf"
    local code=0
    env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
        CCACHE_DIR=/kept/ccache chroot "$copy" /bin/bash -euxo pipefail -c "$2" >"$dir/$name.log" 2>&1 </dev/null || code=$?
    umount -R -l "$copy"
    rm -rf --one-file-system "${layers:?}/$name"
    return $code
}
