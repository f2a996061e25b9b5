#!/usr/bin/env bash
# Tests of the page in a browser; 77 and the reason if there is no browser. usage: web.sh ROOT KNURL TMP
set -euo pipefail
page=$1/build/web
modules=$1/build/web-work/page/node_modules
skip() { echo "SKIPPED: the page in a browser: $1"; exit 77; }
[ -f "$page/main.js" ] || skip "it is not built: ./run test web builds and tries it"
[ -d "$modules/playwright-core" ] || skip "playwright-core is not installed: ./run test web installs it"
command -v node >/dev/null || skip "there is no node"
browser=$(command -v chromium) || skip "there is no chromium: ./run test web installs it"
mkdir -p "$3"
if [ -z "${KNURL_WEB_ALL:-}" ]; then
    export SHORT=1
    echo 'SKIPPED: most cases of the page in a browser: ./run test web runs them all'
fi
node "$1/tests/web/browser.mjs" "$page" "$modules" "$2" "$3" "$browser" | sed -u 's/^/web: /'
