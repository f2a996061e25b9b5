# Downloads packages of another Debian than this host's with a private apt: nothing is installed on the host. Source
# this file; it needs $dir (the destination), PACKAGES, and give_up(), which is called with the reason of a failure.
# download SUITE [ARCHITECTURE] puts them into $dir/apt/cache/archives.
for tool in apt-get dpkg-deb tar; do
    command -v $tool >/dev/null || give_up "there is no $tool"
done

# The host's own mirror and key, in either of apt's notations.
find_mirror() {
    local sources=/etc/apt/sources.list.d/debian.sources
    mirror=''
    keyring=/usr/share/keyrings/debian-archive-keyring.gpg
    if [ -r $sources ]; then
        mirror=$(sed -n 's/^URIs:[[:space:]]*\([^[:space:]]*\).*/\1/p' $sources | grep -v -e '-security' | head -n 1 || true)
        local key
        key=$(sed -n 's/^Signed-By:[[:space:]]*\(\/.*\)/\1/p' $sources | head -n 1)
        keyring=${key:-$keyring}
    elif [ -r /etc/apt/sources.list ]; then
        mirror=$(sed -n 's/^deb \(\[[^]]*\] \)\?\([^ ]*debian[^ ]*\) .*/\2/p' /etc/apt/sources.list |
            grep -v -e security -e updates | head -n 1 || true)
    fi
    [ -n "${mirror:-}" ] || give_up "apt here names no Debian mirror to fetch it from"
    [ -r "$keyring" ] || give_up "Debian's keys are not here ($keyring; package debian-archive-keyring)"
}

# An apt without installed packages, so that it downloads all dependencies, including the C library. Testing's Release
# file is often past its Valid-Until date; its signature is still checked.
apt_apart() {
    local apt=$dir/apt
    apt-get -o Dir::Etc::sourcelist=/dev/null -o Dir::Etc::sourceparts="$apt/sources" \
        -o Dir::Etc::preferences=/dev/null -o Dir::Etc::preferencesparts="$apt/preferences" \
        -o Dir::State="$apt/state" -o Dir::State::status="$apt/status" \
        -o Dir::Cache="$apt/cache" -o Dir::Log="$apt/log" -o APT::Sandbox::User=root \
        ${architecture:+-o APT::Architecture="$architecture" -o APT::Architectures="$architecture"} \
        -o APT::Install-Recommends=0 -o Acquire::Languages=none -o Acquire::Check-Valid-Until=false \
        -o Acquire::Retries=3 -o Acquire::http::Timeout=20 \
        -o Acquire::IndexTargets::deb::DEP-11::DefaultEnabled=false -o APT::Update::Error-Mode=any "$@"
}

download() {
    local suite=$1 architecture=${2:-} apt=$dir/apt
    rm -rf "$apt"
    mkdir -p "$apt"/{sources,preferences,log,state/lists/partial,cache/archives/partial}
    : >"$apt/status"
    printf 'Types: deb\nURIs: %s\nSuites: %s\nComponents: main\nSigned-By: %s\n' "$mirror" "$suite" "$keyring" \
        >"$apt/sources/debian.sources"
    apt_apart -qq update && apt_apart -qq -y --download-only install "${PACKAGES[@]}"
}
