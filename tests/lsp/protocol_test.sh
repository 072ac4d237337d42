#!/bin/bash
# protocol_test.sh PROGRAM ROOT: the judge of protocol_test.mjs, from npm. Skipped (77) without `--long`, npm or a network.
[ -n "$ZWANG_LONG" ] || { echo "skipped: ./dev test --long runs it"; exit 77; }
command -v npm >/dev/null && command -v node >/dev/null || { echo "skipped: npm is not installed"; exit 77; }
modules=$(mktemp -d) && trap 'rm -rf "$modules"' EXIT
npm install --silent --no-audit --no-fund --prefix "$modules" vscode-languageserver-protocol@3.17.5 ||
  { echo "skipped: npm gives no vscode-languageserver-protocol"; exit 77; }
timeout 120 node "$(dirname "$0")/protocol_test.mjs" "$1" "$2" "$modules"
