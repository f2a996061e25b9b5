#!/usr/bin/env bash
# Runs test_mirror.py with the libclang that bindings/unity/native/requirements.txt names. usage: mirror.sh FOLDER
# Exit 77: it is not there.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
python=$here/../../../build/mirror-venv/bin/python3
if ! "$python" -c 'import clang.cindex' 2>/dev/null; then
    echo "skipped: no libclang in build/mirror-venv; ./run test unity brings it"
    exit 77
fi
exec "$python" -B "$here/test_mirror.py" "$1"
