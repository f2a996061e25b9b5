# Part of ./run: ./run lint, and the first step of ./run test: formatting, clang-tidy, and the printing of names in
# samples.

lint() {
    need_packages "${BUILD_PACKAGES[@]}" git
    need_python lint-venv tests/lint-requirements.txt
    configure release
    local sources
    mapfile -t sources < <(git ls-files '*.c' '*.h' '*.cpp' '*.hpp' ':!*third_party*')
    check_sources "${sources[@]}"
    echo "run: lint: ${#sources[@]} files clean"
}

# The cheapest check first: format and clang-tidy of changed files. Without changes it sets nothing up.
lint_changed() {
    local sources
    mapfile -t sources < <(changed_sources)
    [ ${#sources[@]} -gt 0 ] || return 0
    if ! (need_python lint-venv tests/lint-requirements.txt); then
        echo 'run: SKIPPED: format and lint of what was changed: the tools cannot be had, see above' >&2
        return 0
    fi
    configure release
    check_sources "${sources[@]}"
    echo "run: lint: ${#sources[@]} changed files clean"
}

# The C and C++ files that differ from BASE (default: this branch's base on main), committed or not.
changed_sources() {
    local base
    command -v git >/dev/null || return 0
    base=$(git merge-base HEAD "${KNURL_BASE:-$(git rev-parse --verify -q origin/main || echo main)}" 2>/dev/null) || return 0
    { git diff --name-only --diff-filter=d "$base" && git ls-files --others --exclude-standard; } | sort -u |
        grep -E '\.(c|h|cpp|hpp)$' | grep -v third_party || true
}

check_sources() {
    local windows='((_windows|transport_com)\.c|^tests/windows/.*)$' debug='^(sdk/src/base/rule|tests/base/test_rules)\.c$' units
    /usr/bin/python3 -B tests/tool/printing.py
    build/lint-venv/bin/clang-format --dry-run --Werror "$@"
    # Not part of this build: fuzz targets, the selector of mutants, code for browsers, code that is built with an
    # installed Knurl, other compilers or by a script, and the stand-in for libwebsockets.
    local elsewhere='^tests/(fuzz|mutants|package/(consumer|host|versions))/|^bindings/python/native/|^tests/abi/deprecated\.c$|^samples/bench/closest_peers\.c$|^samples/(web|languages)/|^tests/fidelity/hashes\.c$|/(view|from_texture)_none\.c$'
    units=$(printf '%s\n' "$@" | grep -E '\.(c|cpp)$' | grep -vE "$windows|$debug|$elsewhere" || true)
    [ -z "$units" ] || tidy release <<<"$units"
    units=$(printf '%s\n' "$@" | grep -E "$debug" || true) # compiled in debug builds only
    if [ -n "$units" ]; then
        configure asan-ubsan
        tidy asan-ubsan <<<"$units"
    fi
    units=$(printf '%s\n' "$@" | grep -E '\.(c|cpp)$' | grep -E "$windows" || true)
    if [ -z "$units" ]; then
        return 0
    elif [ -f build/mingw/compile_commands.json ]; then
        tidy mingw <<<"$units"
    else
        echo "run: SKIPPED: what is for Windows alone is only looked at after ./run test windows" >&2
    fi
}

# clang-tidy on the files named in stdin, as a preset compiles them.
tidy() {
    /usr/bin/python3 -B tests/tidy.py build/lint-venv/bin/clang-tidy "build/$1" build/lint-cache || exit 1
}
