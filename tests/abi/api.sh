#!/usr/bin/env bash
# Writes api.json with the libclang that bindings/unity/native/requirements.txt names, and checks it.
# usage: api.sh API.JSON READELF CC LIBRARY... Exit 77: libclang is missing.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
python=$here/../../build/mirror-venv/bin/python3
if ! "$python" -c 'import clang.cindex' 2>/dev/null; then
    echo "skipped: no libclang in build/mirror-venv; ./run mirror brings it"
    exit 77
fi
"$python" -B "$here/../../scripts/api.py" "$1"
exec "$python" -B "$here/test_api.py" "$@"
