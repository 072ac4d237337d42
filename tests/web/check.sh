#!/usr/bin/env bash
# Makes pages of runs and looks at them in Chromium. Exit code 77, which ctest takes as skipped, where something is missing.
# usage: check.sh ZWANG SPECS FOLDER [SCRIPT [WORD]]
set -euo pipefail
zwang=$1 specs=$2 folder=$3 script=${4-check.mjs}
web=$(cd -- "$(dirname -- "$0")/../../web" && pwd)

skip() { echo "skipped: $*"; exit 77; }
command -v node >/dev/null || skip "no node"
[[ $(node -p 'process.versions.node.split(".")[0]') -ge 18 ]] || skip "node is older than 18"
chromium=$(command -v chromium) || skip "no chromium"
[[ -f $web/dist/report.html ]] || skip "the parts of the page are not built: ./dev web"
[[ -d $web/node_modules/playwright-core ]] || skip "no playwright-core: ./dev web installs it"

rm -rf "$folder"
mkdir -p "$folder"
exec node "$(dirname -- "$0")/$script" "$zwang" "$specs" "$folder" "$chromium" "${@:5}"
