#!/usr/bin/env bash
# With a room's include path the compiler finds the room's own headers, and does not find those of a later room. Finding is
# the preprocessor's part; the rest of a compilation would only take time.
#
#   include_path_test.sh COMPILER OWN_HEADER FORBIDDEN_HEADER INCLUDE_FOLDER...
set -euo pipefail
compiler=$1 own=$2 forbidden=$3
shift 3
paths=()
for folder; do paths+=("-I$folder"); done

preprocess() {
  printf '#include "%s"\n' "$1" | LC_ALL=C "$compiler" -std=c++20 -E -o /dev/null "${paths[@]}" -x c++ - 2>&1
}

if ! message=$(preprocess "$own"); then
  printf 'FAIL: %s is not found:\n%s\n' "$own" "$message"
  exit 1
fi
if message=$(preprocess "$forbidden"); then
  printf 'FAIL: %s is found in this room\n' "$forbidden"
  exit 1
fi
if [[ $message != *"$forbidden"*"o such file"* && $message != *"$forbidden' file not found"* ]]; then
  printf 'FAIL: %s was refused for another reason:\n%s\n' "$forbidden" "$message"
  exit 1
fi
