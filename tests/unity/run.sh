#!/usr/bin/env bash
# Builds and runs the Unity package's tests without Unity: NUnit under mono, with stand-ins for the engine.
# usage: run.sh NATIVE KNURL FOLDER [NAME]
#   NATIVE  the folder of libknurl_unity.so (build/release/unity)
#   KNURL   the command-line tool, for traces to compare with
#   FOLDER  for all output (build/unity)
#   NAME    only this fixture or test, by its full name: Knurl.Tests.Axes
# Ends with "unity: N passed, N failed, N skipped"; exit 1 on a failure, on an assembly that does not load, or if no
# test ran; 77 without mono.
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
[ $# -ge 3 ] || { sed -n 's/^# \(usage.*\)/\1/p' "$0" >&2; exit 2; }
if ! command -v nunit-console >/dev/null || ! command -v mcs >/dev/null; then
    echo "skipped: no mono; apt-get install mono-mcs mono-runtime libmono-cil-dev nunit-console libnunit-cil-dev"
    exit 77
fi
native=$(cd "$1" && pwd) || exit 1
tool=$(realpath "$2")
mkdir -p "$3" && out=$(cd "$3" && pwd) || exit 1
rm -f "$out"/*.dll "$out"/*.exe # nothing of a former build is to be found by accident
"$here/build.sh" "$out" || { echo "unity: 0 passed, 1 failed, 0 skipped"; exit 1; }

# Libraries that are not the package's: see cases/VersionTests.cs.
mkdir -p "$out/empty" "$out/rubbish"
version=$(sed -n 's/.*string Version = "\(.*\)";/\1/p' "$root/bindings/unity/package/Runtime/NativeMethods.g.cs")
stranger() { # NAME VERSION [INTERFACE]: without one it is older than interfaces
    mkdir -p "$out/$1"
    printf 'const char *%s(void) { return "%s"; }\n' knurl_version_string "$2" ${3:+knurl_unity_interface "$3"} |
        timeout 60 "${CC:-cc}" -shared -fPIC -o "$out/$1/libknurl_unity.so" -x c -
}
stranger stranger 9.8.7 0123456789abcdef && stranger twin "$version" 0123456789abcdef && stranger old 0.0.9 || exit 1

# Results of the C tool for the same paths: see cases/TraceTests.cs.
timeout 120 python3 "$here/traces.py" "$tool" "$root/assets" "$out/traces" || exit 1

export LD_LIBRARY_PATH=$native${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export KNURL_TEST_ROOT=$root KNURL_TEST_FOLDER=$out KNURL_TEST_TOOL=$tool
only=()
[ $# -lt 4 ] || only=(-run="$4")
passed=0 failed=0 skipped=0
for tests in Knurl.Haptics.Tests Knurl.Haptics.Editor.Tests; do
    [ -e "$out/$tests.dll" ] || continue
    rm -f "$out/$tests.xml"
    code=0
    (cd "$out" && timeout 400 nunit-console -nologo -nodots -noshadow -domain=None -process=Single \
        -result="$out/$tests.xml" "${only[@]}" "$out/$tests.dll" </dev/null) >"$out/$tests.log" 2>&1 || code=$?
    grep '^note: ' "$out/$tests.log"
    counts=$(python3 "$here/count.py" "$out/$tests.xml" "$code" ${4:+--one}) || {
        if grep -q '^Errors and Failures' "$out/$tests.log"; then
            sed -n '/^Errors and Failures/,$p' "$out/$tests.log" | grep -v -e '(wrapper ' -e ' System\.Reflection\.' -e '^$'
        else
            tail -n 30 "$out/$tests.log"
        fi
    }
    read -r p f s <<<"$counts"
    passed=$((passed + p)) failed=$((failed + f)) skipped=$((skipped + s))
done
echo "unity: $passed passed, $failed failed, $skipped skipped"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
