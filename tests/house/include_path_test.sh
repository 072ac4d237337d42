#!/usr/bin/env bash
# A room's compiler finds the room's own headers, and does not find those of a later room.
#
#   include_path_test.sh COMPILER OWN_HEADER FORBIDDEN_HEADER INCLUDE_FOLDER...
set -euo pipefail
compiler=$1 own=$2 forbidden=$3
shift 3
paths=()
for folder; do paths+=("-I$folder"); done

compile() { printf '#include "%s"\n' "$1" | LC_ALL=C "$compiler" -std=c++20 -fsyntax-only "${paths[@]}" -x c++ - 2>&1; }

if ! message=$(compile "$own"); then
  printf 'FAIL: %s does not compile:\n%s\n' "$own" "$message"
  exit 1
fi
if message=$(compile "$forbidden"); then
  printf 'FAIL: %s compiles in this room\n' "$forbidden"
  exit 1
fi
if [[ $message != *"$forbidden"*"o such file"* && $message != *"$forbidden' file not found"* ]]; then
  printf 'FAIL: %s was refused for another reason:\n%s\n' "$forbidden" "$message"
  exit 1
fi
