#!/usr/bin/env bash
# Installs the build into a fresh folder, builds every example against it, runs each; 0 is what they end with.
set -euo pipefail
cmake=$1 source=$2 binary=$3 compiler=$4
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT

step() {
  local name=$1
  shift
  "$@" >"$place/log" 2>&1 && return
  printf 'FAIL: %s\n' "$name"
  cat "$place/log"
  exit 1
}

step install "$cmake" --install "$binary" --prefix "$place/prefix"
step configure "$cmake" -S "$source/examples" -B "$place/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$place/prefix"
step build "$cmake" --build "$place/build"

ran=0
for program in "$place"/build/[0-9]*/[0-9]*; do
  if [[ -f $program && -x $program ]]; then
    arguments=()
    case $program in
      */03_own_loop | */04_own_plant) arguments=("$source/specs/wall_align.yaml") ;;
      */05_live) arguments=("$source/specs/wall_align.yaml" "$source/specs/obstacle.yaml" "$place/live.mcap") ;;
    esac
    step "run $(basename "$program")" "$program" "${arguments[@]}"
    # A task that a robot without signals cannot do.
    [[ $program != */03_own_loop ]] || step "run it with signals" "$program" "$source/specs/docking.yaml"
    ran=$((ran + 1))
  fi
done
printf '%s examples ran\n' "$ran"
((ran > 0))
