#!/usr/bin/env bash
# Holds what is committed against the headers, and runs test_mirror.py, with the libclang that
# bindings/unity/native/requirements.txt names. usage: mirror.sh FOLDER. Exit 77: libclang is not there.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
python=$here/../../../build/mirror-venv/bin/python3
if ! "$python" -c 'import clang.cindex' 2>/dev/null; then
    echo "skipped: no libclang in build/mirror-venv; ./run test unity brings it"
    exit 77
fi
"$python" -B "$here/../../../bindings/unity/native/mirror.py" --check || exit 1 # what follows starts from there
exec "$python" -B "$here/test_mirror.py" "$1"
