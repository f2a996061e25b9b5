# Part of ./run: ./run test, soak, fuzz and mutants.

LABELS='base vibration grating motion contact scene audio loop device gltf tool docs bindings fidelity stability realtime clock threads'
LABELS+=' windows godot unity abi package python blender web'

run_tests() {
    local all='' label labels=() excluded='' narrow=() targets=() whole=''
    [ "${1:-}" != all ] || { all=1; shift; }
    for label in "$@"; do
        case " $LABELS " in
        *" $label "*) labels+=("$label") ;;
        *) echo "run: unknown label '$label'; known: all $LABELS" >&2; exit 2 ;;
        esac
        case $label in
        gltf | threads | tool) targets+=("${label}_tests") ;; # these targets are only programs
        *) whole=1 ;;
        esac
    done
    need_packages "${BUILD_PACKAGES[@]}"
    [ -z "$all" ] || ! (need_packages ccache) || use_ccache # the tests of packages compile the library five times
    [ "${labels[*]}" != windows ] || { test_windows; return; }
    if [ ${#labels[@]} -gt 0 ]; then
        narrow=(-L "$(IFS='|'; echo "^(${labels[*]})\$")")
    elif [ -z "$all" ]; then
        excluded=extended
    fi
    [ -n "$all" ] || lint_changed
    wanted() { [[ " ${labels[*]:-${all:+$1}} " == *" $1 "* ]]; }
    ! wanted godot || fetch_godot || echo "run: SKIPPED: tests in the real Godot: it could not be fetched, see above" >&2
    ! wanted unity || prepare_unity || echo "run: SKIPPED: tests of the Unity package's C#: see above" >&2
    ! wanted python || (need_packages "${PYTHON_PACKAGES[@]}") ||
        echo "run: SKIPPED: tests of the Python module: see above" >&2
    ! wanted blender || (need_packages blender xvfb xauth && need_npm) ||
        echo "run: SKIPPED: tests of the Blender extension: see above" >&2
    ! wanted web || prepare_web "${labels[@]}" || echo "run: SKIPPED: the page in a browser: see above" >&2
    [ -z "$whole" ] || targets=()
    build release "${targets[@]}"
    run_ctest release "$excluded" "${narrow[@]}"
    if [ -n "$all" ] && [ "${labels[*]}" != godot ]; then # the engine cannot load a sanitizer's runtime
        build asan-ubsan "${targets[@]}"
        run_ctest asan-ubsan "" "${narrow[@]}"
    fi
    ! wanted device || cat build/release/tests/device/faults/faults.md # results of each fault
    [ -z "$all" ] || ! wanted threads || test_threads
    [ -z "$all" ] || [ ${#labels[@]} -gt 0 ] || fuzz_in_tests
    [ -z "$all" ] || [ ${#labels[@]} -gt 0 ] || test_systems 'gltf tool' "$CURRENT_SYSTEM"
    ! wanted windows || test_windows
}

# Runs the README's two commands in empty Debians; prints a note and continues if these cannot be made. usage:
# test_systems LABELS SUITE...
test_systems() {
    local code=0
    (need_packages debootstrap) && tests/package/systems.sh build/systems "$@" || code=$?
    [ $code -ne $EXIT_SETUP ] || { echo "run: SKIPPED: the two commands in an empty Debian (${*:2}): see above" >&2; return 0; }
    return $code
}

# Runs the tests of a built preset: first those that only compute, one per CPU; then those that wait for threads,
# several per CPU, repeating failures one by one; last those in real time, one by one. usage: run_ctest PRESET EXCLUDED
# [OPTION...]: EXCLUDED is a pattern of labels, or nothing
run_ctest() {
    local preset=$1 excluded=${2:+|$2} failed=0 some=0 part select
    shift 2
    for part in computes waits measures; do
        case $part in
        computes) select=(-LE "^(clock|realtime$excluded)\$" -j "$(nproc)") ;;
        waits) select=(-L '^clock$' -LE "^(realtime$excluded)\$" -j "$((2 * $(nproc)))") ;;
        measures) select=(-L '^realtime$' -LE "^(none$excluded)\$" -j 1) ;;
        esac
        [ "$(test_preset "$preset" "${select[@]}" "$@" -N 2>/dev/null | grep -c 'Test *#')" -gt 0 ] || continue
        some=1
        if ! test_preset "$preset" "${select[@]}" "$@"; then
            if [ $part != waits ]; then
                failed=1
            else
                echo 'run: what failed beside others is run by itself: that decides'
                test_preset "$preset" -j 1 --rerun-failed || failed=1
            fi
        fi
        grep -hi '^skipped:\|^unity: \|^web: ' "build/$preset/Testing/Temporary/LastTest.log" || true # in one
    done
    if [ $some -eq 0 ]; then
        echo "run: $preset has no test with these labels" >&2
        return 1
    fi
    return $failed
}

# Runs programs with threads under ThreadSanitizer; prints a note and continues if that cannot start.
test_threads() {
    local probe=build/tsan-probe runner=()
    mkdir -p build
    if ! echo 'int main(void) { return 0; }' | cc -fsanitize=thread -x c - -o "$probe" 2>/dev/null; then
        echo "run: SKIPPED: ThreadSanitizer: this compiler cannot build with it" >&2
        return 0
    fi
    if ! "$probe" 2>/dev/null; then # it needs addresses that some kernels' ASLR uses
        runner=(setarch -R)
        if ! "${runner[@]}" "$probe" 2>/dev/null; then
            echo "run: SKIPPED: ThreadSanitizer cannot start on this machine, with or without ASLR" >&2
            return 0
        fi
    fi
    build tsan threads_tests
    if [ ${#runner[@]} -eq 0 ]; then
        run_ctest tsan '' -L '^threads$'
    else
        export -f run_ctest test_preset
        "${runner[@]}" bash -euo pipefail -c 'run_ctest tsan "" -L "^threads\$"'
    fi
}

# Cross-builds for Windows with MinGW-w64 and runs the tests under wine; prints a note and continues if these are not
# available.
test_windows() {
    local preset
    if ! prepare_windows; then
        echo "run: SKIPPED: Windows: nothing was tested for it" >&2
        return 0
    fi
    build release knurl_tool knurl_study_tool emulate_rawhid emulate_inverse3 emulate_serial # for comparison, and devices
    for preset in mingw mingw-dll; do
        build "$preset"
        run_ctest "$preset" ""
    done
}

# mono and NUnit for the Unity package's C#, from Debian 12 if the system has none; and libclang, which generates its
# mirror of the headers.
prepare_unity() {
    if ! (need_packages "${UNITY_PACKAGES[@]}"); then
        mkdir -p build
        (need_packages pkg-config && with_progress "fetching Debian 12's mono" build/mono.log tests/unity/mono.sh build/mono) ||
            { tail -n 1 build/mono.log >&2; return $EXIT_SETUP; }
        echo "run: the C# is tested with Debian 12's mono, in build/mono"
        PATH=$PWD/build/mono/bin:$PATH
    fi
    (need_python mirror-venv bindings/unity/native/requirements.txt)
}

# The page for its tests in a browser. If requested by label, installs missing packages and runs every case; otherwise
# runs a few cases if all is installed. usage: prepare_web [LABEL...]
prepare_web() {
    local code=0
    if [ $# -gt 0 ]; then
        export KNURL_WEB_ALL=1
        (need_packages chromium && web) || code=$?
    elif command -v emcc >/dev/null && command -v npm >/dev/null && command -v chromium >/dev/null; then
        (web) || code=$?
    else
        echo 'run: Emscripten, npm and Chromium are not all installed; ./run test web installs them' >&2
        return $EXIT_SETUP
    fi
    [ $code -eq 0 ] || [ $code -eq $EXIT_SETUP ] || exit $code
    return $code
}

# The cross compiler, wine, and libraries for Windows; prints a note if these are not available.
prepare_windows() {
    if ! (need_packages "${WINDOWS_PACKAGES[@]}"); then
        echo "run: MinGW-w64 and wine cannot be had here" >&2
        return 1
    fi
    mkdir -p build
    if ! with_progress 'preparing for Windows' build/windows.log tests/windows/prepare.sh; then
        tail -n 5 build/windows.log >&2
        echo "run: cmocka or wine could not be set up for Windows (build/windows.log)" >&2
        return 1
    fi
}

# Hashes of results from other compilers and machines: they must be equal.
same_numbers() {
    (need_packages "${NUMBERS_PACKAGES[@]}") || echo 'run: some compilers cannot be had, see above; they are left out' >&2
    mkdir -p build
    /usr/bin/python3 -B tests/fidelity/same_numbers.py "$PWD" "$PWD/build/same_numbers" cc
}

# Checks the cross-built libraries for macOS and for arm64, with a run under qemu.
test_elsewhere() {
    prepare_zig || return 1
    (need_packages llvm qemu-user libc6-arm64-cross) || echo 'run: qemu cannot be had, see above: nothing runs under it' >&2
    build_elsewhere knurl_godot godot/libknurl_godot.macos.dylib
    build_elsewhere knurl_unity unity/libknurl_unity.dylib
    build windows-arm64 knurl_godot
    build macos-arm64 knurl_tool
    build linux-arm64 knurl_tool
    tests/package/elsewhere.py build build/release/knurl assets/plate_1d.glb
}

# The tests of the library and the tool as programs for arm64, under qemu; prints a note and continues if these cannot be
# had. Left out are tests of this machine's compilers and packages, those in real time, and those of a process's end by a
# signal: qemu 7.2 takes a SIGBUS or SIGSEGV that another process sends for a fault of its own, and starts slowly. Debian
# 11's hidapi crashes in hid_enumerate() when no memory is left, and with it two tests. One number of figure 8 differs by
# 4e-7 N from the golden one, as its spectrum is taken in single precision. The guard process starts from memory and without
# an environment, in which qemu finds neither it nor its libraries.
test_arm64() {
    local tested='base|vibration|grating|motion|contact|scene|audio|loop|device|gltf|tool|fidelity|stability|bindings'
    local left_out='exit_.*|.*_tool|failing_device|failing_session|fidelity_figures|fidelity_pictures|gltf_bombs|gltf_limits'
    left_out+='|guard_process|languages'
    if ! (need_packages qemu-user && prepare_zig) ||
        ! with_progress 'fetching libraries for arm64' build/arm64.log cmake/arm64.sh build/arm64 ||
        ! with_progress 'trying qemu' build/arm64.log tests/package/under_qemu.sh build/arm64/root true; then
        tail -n 1 build/arm64.log >&2 || true
        echo 'run: SKIPPED: tests for arm64 under qemu: see above' >&2
        return 0
    fi
    build linux-arm64-tests
    (cd build/linux-arm64-tests && ../../tests/package/under_qemu.sh ../arm64/root ctest --output-on-failure -j "$(nproc)" \
        -L "^($tested)\$" -LE '^(realtime|extended|docs|package|abi|python|web|blender|unity|godot)$' -E "^($left_out)\$")
}

# Tries the Blender extension in PyPI's releases of Blender; prints a note and continues if they cannot be had.
soak_blender() {
    local code=0
    (need_packages python3-venv && need_npm) && tests/blender/run.sh build/release build/blender 4.2 4.5 5.0 || code=$?
    [ $code -ne 77 ] && [ $code -ne $EXIT_SETUP ] || { echo 'run: SKIPPED: releases of Blender: see above' >&2; return 0; }
    return $code
}

# The recipes for other package managers, with their tools.
test_recipes() {
    need_packages nix-bin ruby
    need_python recipes-venv tests/package/recipes-requirements.txt
    /usr/bin/python3 -B tests/package/recipes.py "$PWD" build/recipes build/recipes-venv/bin/conan
}

# The Python module's tests, with 100 runs of each that could hang; prints a note and continues if it cannot be built.
soak_python() {
    (need_packages "${PYTHON_PACKAGES[@]}") || { echo 'run: SKIPPED: the Python module: see above' >&2; return 0; }
    KNURL_TEST_RUNS=100 test_preset release -R '^python$'
}

# The long forms of tests: each for a minute, or some ten times as long. Without ctest, which would stop them after two
# minutes.
soak() {
    need_packages "${BUILD_PACKAGES[@]}"
    build release
    export KNURL_STRESS_SECONDS=60 KNURL_DEVICE_SECONDS=60 KNURL_LONG=10 KNURL_FUZZ=10 KNURL_FUZZ_FRAMES=20000000
    local name failed=()
    for name in stress stress_loops device_load falcon_fuzz rawhid_fuzz contact_closest contact_walks \
        stability_protection_grids weigh rooms smooth_rooms failing_scene failing_gltf failing_device failing_session conform \
        conform_drivers verify ridges; do
        echo "run: soak: $name"
        if ! with_progress "running $name" "build/soak-$name.log" "build/release/tests/test_$name"; then
            grep -E 'ERROR|LINE|FAILED' "build/soak-$name.log" >&2 || true
            failed+=("$name")
        fi
    done
    soak_python || failed+=(python)
    tests/tool/ridges_corpus.py build/release/knurl build/ridges || failed+=(ridges_corpus)
    same_numbers || failed+=(same_numbers)
    test_elsewhere || failed+=('macOS and arm64')
    (test_arm64) || failed+=('tests for arm64')
    (test_recipes) || failed+=(recipes)
    soak_blender || failed+=(blender)
    test_systems '' "$CURRENT_SYSTEM" "$NEWEST_SYSTEM" || failed+=('the two commands in other systems') # with warnings
    figures --check || failed+=("figures --check")
    [ ${#failed[@]} -eq 0 ] || { echo "run: soak: FAILED: ${failed[*]}" >&2; exit 1; }
    echo 'run: soak: all is well'
}

# One target of libFuzzer for some seconds; prints its result in a line. usage: fuzz_target NAME SECONDS
fuzz_target() {
    local name=$1 seconds=$2 dir=build/fuzz log=build/fuzz/$1.log seeds=() options=()
    mkdir -p "$dir/corpus/$name" "$dir/findings"
    [ ! -d "tests/fuzz/seeds/$name" ] || seeds=("tests/fuzz/seeds/$name")
    [ "$name" != gltf ] || seeds+=(assets)
    [ ! -f "tests/fuzz/$name.dict" ] || options=("-dict=tests/fuzz/$name.dict")
    local failed=0
    nice "$dir/fuzzers/fuzz_$name" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=16384 \
        -print_final_stats=1 -artifact_prefix="$dir/findings/$name-" "${options[@]}" "$dir/corpus/$name" "${seeds[@]}" \
        >"$log" 2>&1 || failed=1
    awk -v name="$name" -v failed=$failed '
        /inline 8-bit counters/ { gsub(/[^0-9 ]/, " "); edges = $2 }
        /cov: / { sub(/.*cov: /, ""); covered = $1 }
        /stat::average_exec_per_sec/ { rate = $2 }
        /stat::number_of_executed_units/ { runs = $2 }
        END { printf "run: fuzz: %-10s %9d runs, %6d/s, %5d of %5d edges%s\n", name, runs, rate, covered, edges,
              failed ? ": A FINDING, see build/fuzz/findings" : "" }' "$log"
    [ $failed -eq 0 ] || { tail -n 30 "$log" >&2; return 1; }
}

# usage: fuzz [MINUTES]: of CPU, shared by all targets, as many at once as there are CPUs
fuzz() {
    local minutes=${1:-10} names
    [[ $minutes =~ ^[0-9]+$ && $minutes -ge 1 ]] || { echo "run: fuzz: expected minutes, found '$minutes'" >&2; exit 2; }
    need_packages "${BUILD_PACKAGES[@]}" "${FUZZ_PACKAGES[@]}"
    build fuzz fuzzers
    names=$(sed -n 's/^ *knurl_fuzzer(\([a-z_]*\) .*/\1/p' tests/fuzz/CMakeLists.txt)
    local seconds=$((minutes * 60 / $(wc -w <<<"$names")))
    echo "run: fuzz: each target for $seconds s"
    export -f fuzz_target
    # shellcheck disable=SC2016 # the other shell expands it
    xargs -P "$(nproc)" -I {} bash -euo pipefail -c 'fuzz_target "$1" "$2"' fuzz {} "$seconds" <<<"$names"
}

# Five minutes of fuzzing, if Clang is available.
fuzz_in_tests() {
    if ! (need_packages "${FUZZ_PACKAGES[@]}"); then
        echo "run: SKIPPED: fuzzing: Clang cannot be had, see above" >&2
        return 0
    fi
    fuzz 5
}

# usage: mutants [ROOM] [COUNT] [--seed SEED] [--again]
mutants() {
    need_packages "${BUILD_PACKAGES[@]}" git
    need_python mirror-venv bindings/unity/native/requirements.txt # libclang
    configure release # for the compile options of each source
    build/mirror-venv/bin/python -B tests/mutants/mutants.py "$@"
}
