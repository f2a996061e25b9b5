#!/usr/bin/env bash
# Compares the committed files with the headers, and runs test_mirror.py, with the libclang of
# bindings/unity/native/requirements.txt. usage: mirror.sh FOLDER. Exit 77: libclang is missing.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
python=$here/../../../build/mirror-venv/bin/python3
if ! "$python" -c 'import clang.cindex' 2>/dev/null; then
    echo "skipped: no libclang in build/mirror-venv; ./run test unity brings it"
    exit 77
fi
"$python" -B "$here/../../../bindings/unity/native/mirror.py" --check || exit 1 # the next step depends on it
exec "$python" -B "$here/test_mirror.py" "$1"
