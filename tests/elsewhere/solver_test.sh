#!/usr/bin/env bash
# solver_test.sh SOURCE aarch64|libcxx: the solver and its tests for another processor, under QEMU, or with another standard
# library. Then its numbers beside those of this compiler: equal to 1e-9 of the largest of their vector.
# Skipped unless ZWANG_LONG is set and the compiler is there.
set -euo pipefail
source=$1 platform=$2
skip() { echo "skipped: $1"; exit 77; }
[[ ${ZWANG_LONG-} ]] || skip 'only with ZWANG_LONG'
[[ -d /usr/src/googletest ]] || skip 'apt install googletest'
emulator=()
case $platform in
  aarch64)
    command -v aarch64-linux-gnu-g++ >/dev/null || skip 'apt install g++-aarch64-linux-gnu'
    command -v qemu-aarch64 >/dev/null || skip 'apt install qemu-user'
    emulator=(qemu-aarch64 -L /usr/aarch64-linux-gnu)
    options=(-D CMAKE_SYSTEM_NAME=Linux -D CMAKE_SYSTEM_PROCESSOR=aarch64
      -D CMAKE_CXX_COMPILER=aarch64-linux-gnu-g++ -D CMAKE_C_COMPILER=aarch64-linux-gnu-gcc) ;;
  libcxx)
    command -v clang++ >/dev/null || skip 'apt install clang'
    [[ -d /usr/lib/llvm-14/include/c++/v1 ]] || skip 'apt install libc++-14-dev libc++abi-14-dev'
    options=(-D CMAKE_CXX_COMPILER=clang++ -D CMAKE_CXX_FLAGS=-stdlib=libc++) ;;
esac
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT

build() {  # FOLDER TARGET... -- OPTIONS
  local folder=$1 targets=()
  shift
  while [[ $1 != -- ]]; do targets+=("$1"); shift; done
  shift
  cmake -S "$source/tests/elsewhere/solver" -B "$folder" -G Ninja -D CMAKE_BUILD_TYPE=Release "$@" >"$place/log" 2>&1 &&
    cmake --build "$folder" --target "${targets[@]}" >>"$place/log" 2>&1 || { tail -n 40 "$place/log"; exit 1; }
}
build "$place/there" solver_test solver_digits -- "${options[@]}"
build "$place/here" solver_digits --

# The oracle counts in long double, which 64-bit ARM has in software alone, and QEMU slower still.
ZWANG_ORACLE_PROBLEMS=${ZWANG_ORACLE_PROBLEMS:-2} "${emulator[@]}" "$place/there/solver_test" --gtest_brief=1 \
  --gtest_filter=-Acceptance.*
"$place/here/solver_digits" >"$place/here.txt"
"${emulator[@]}" "$place/there/solver_digits" >"$place/there.txt"
paste -d '|' "$place/here.txt" "$place/there.txt" | awk -F '|' '
  {
    columns = split($1, here, " ")
    if (split($2, there, " ") != columns) { print "line " NR " differs in its length"; exit 1 }
    largest = 0
    for (i = 1; i <= columns; ++i) { size = here[i] < 0 ? -here[i] : here[i]; if (size > largest) largest = size }
    for (i = 1; i <= columns; ++i) {
      apart = here[i] - there[i]
      if (apart < 0) apart = -apart
      if (largest > 0 && apart / largest > worst) worst = apart / largest
    }
  }
  END {
    printf "%d vectors, largest relative difference %.1e\n", NR, worst
    exit NR == 0 || !(worst <= 1e-9)
  }'
