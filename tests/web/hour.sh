#!/usr/bin/env bash
# The page of an hour, with its figures: hour.sh ZWANG SPECS FOLDER. The run takes minutes, so `./dev test --long` runs it.
set -euo pipefail
[[ ${ZWANG_LONG-} ]] || { echo "skipped: ./dev test --long runs it"; exit 77; }
exec "$(dirname -- "$0")/check.sh" "$@" hour.mjs
