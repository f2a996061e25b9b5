#!/usr/bin/env bash
# The README's two commands in empty systems, as after a clone there: ./run demo, and ./run test or its parts. Prints
# for each the time of both, including installation, the tests, and the compiler's warnings.
# usage: systems.sh FOLDER PARTS SUITE...     FOLDER: keeps the empty systems; PARTS: '' for ./run test whole, or labels
# Exit 1: something failed; 3: an empty system is not available.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
[ $# -ge 3 ] || { sed -n 's/^# \(usage.*\)/\1/p' "$0" >&2; exit 2; }
give_up() {
    echo "systems: $1" >&2
    exit 3
}
source "$root/tests/package/empty_root.sh"
mkdir -p "$1"
folder=$(cd "$1" && pwd) parts=$2
shift 2

# shellcheck disable=SC2016 # the shell inside expands these
commands='
apt-get update -q || exit 3
apt-get install -y -q --no-install-recommends ccache
mkdir /knurl
tar -C /source --exclude=./build --exclude=./.git -c . | tar -C /knurl -x
cd /knurl
export CCACHE_BASEDIR=/knurl
TIMEFORMAT="systems: demo %0R %0U %0S"
time ./run demo
cp build/release.log /tmp/demo.log
[ -s build/demo/sweep.svg ]
TIMEFORMAT="systems: test %0R %0U %0S"
time ./run test '$parts'
grep -ho "[^ ]*: warning: .*" /tmp/demo.log build/release.log | sort -u | sed "s#^[./]*#systems: warns #" || true
cp /usr/include/tiny_gltf.h /kept/
'
code=0
for suite in "$@"; do
    make_base "$folder" "$suite"
    failed=0
    try "$suite-commands" "$commands" || failed=$?
    log=$folder/$suite-commands.log
    [ $failed -ne 3 ] || grep -q '^+ ./run' "$log" || give_up "$suite has no packages to install (is there a network?)"
    awk -v suite="$suite" -v failed=$failed '
        /^systems: demo / { demo = $3; cpu = $4 + $5 }
        /^systems: test / { test = $3; cpu += $4 + $5 }
        /Test .*(Passed|Failed|\*\*\*)/ { ran++ }
        /\*\*\*Skipped/ { skipped++ }
        /^systems: warns / { warned++ }
        END { printf "systems: %s %s: demo %d s, tests %d s (%d s of CPU): %d run, %d skipped; %d warnings\n",
              failed ? "FAIL" : "ok  ", suite, demo, test, cpu, ran, skipped, warned }' "$log"
    grep '^systems: warns ' "$log" || true
    [ $failed -eq 0 ] || { code=1; grep -v '^+' "$log" | tail -n 30 >&2; echo "systems: see $log" >&2; }
done
exit $code
