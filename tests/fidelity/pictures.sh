#!/usr/bin/env bash
# Checks that pictures with quickly computed data are up to date: assets/pictures/NAME.data summarises the data of
# NAME.png. `./run figures --check` checks all the others. usage: pictures.sh KNURL FOLDER
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
code=0
mkdir -p "$2"
"$1" run "$root/assets/plate_1d.glb" --stroke sweep --seconds 5 --fast --out "$2/sweep.csv" --wav "$2/sweep.wav" \
    >"$2/sweep.json" # the demo's
/usr/bin/python3 -B "$root/samples/study/drawn.py" --check "$root/assets/pictures/sweep.data" "$2/sweep.csv" || code=1
/usr/bin/python3 -B "$root/samples/study/drawn.py" --check "$root/assets/pictures/sound.data" "$2"/sweep.{csv,wav} || code=1
for name in signals coverage temporal preferences; do
    "$1" study $name --out "$2" >/dev/null
    /usr/bin/python3 -B "$root/samples/study/drawn.py" --check "$root/assets/pictures/$name.data" \
        "$2/$name".{json,csv} || code=1
done
exit $code
