#!/usr/bin/env bash
# usage: check.sh ZWANG TASK FOLDER: installs the reference reader into FOLDER and reads a fresh log with it.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
folder=$3
command -v npm >/dev/null || { echo "npm is not installed; \`./dev test\` installs it" >&2; exit 1; }
mkdir -p "$folder"
cp "$here"/{package.json,package-lock.json,check.mjs} "$folder"
if ! [[ -f $folder/node_modules/.package-lock.json && $folder/node_modules/.package-lock.json -nt $here/package-lock.json ]]; then
  npm ci --prefix "$folder" --no-audit --no-fund --ignore-scripts --loglevel=error
fi
exec node "$folder/check.mjs" "$1" "$2" "$folder/log"
