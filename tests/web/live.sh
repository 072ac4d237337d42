#!/usr/bin/env bash
# The live page, in a browser: live.sh ZWANG SPECS FOLDER. It takes half a minute, so `./dev test --long` runs it.
set -euo pipefail
[[ ${ZWANG_LONG-} ]] || { echo "skipped: ./dev test --long runs it"; exit 77; }
exec "$(dirname -- "$0")/check.sh" "$@" live.mjs
