#!/usr/bin/env bash
# compiler_test.sh SOURCE COMPILER: the release by another compiler runs a shipped task, and a scenario keeps what it claims.
# Skipped unless ZWANG_LONG is set and the compiler is there.
set -euo pipefail
source=$1 compiler=$2
skip() { echo "skipped: $1"; exit 77; }
[[ ${ZWANG_LONG-} ]] || skip 'only with ZWANG_LONG'
command -v "$compiler" >/dev/null || skip "no $compiler here"
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
cmake -S "$source" -B "$place/build" -G Ninja -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_COMPILER="$compiler" \
  -D ZWANG_PRECOMPILE=ON -D ZWANG_BUILD_TESTS=OFF -D ZWANG_CONNECT=OFF >"$place/log" 2>&1 &&
  cmake --build "$place/build" >>"$place/log" 2>&1 || { tail -n 40 "$place/log"; exit 1; }
cd "$place"
"$place/build/zwang" run "$source/specs/wall_align.yaml" | tail -n 20
"$place/build/zwang" test "$source/specs/scenarios/docking.yaml"
