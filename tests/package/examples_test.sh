#!/usr/bin/env bash
# Installs the build into a fresh folder, builds every example against it, runs each; 0 is what they end with. Then a
# library that is loaded at run time, with the runtime in it. Neither that nor a host with its own robot loads MuJoCo.
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

step 'configure the plugin' "$cmake" -S "$source/tests/package/plugin" -B "$place/plugin" -G Ninja \
  -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$place/prefix"
step 'build the plugin' "$cmake" --build "$place/plugin"
step 'load the plugin' "$place/plugin/host" "$place/plugin/libcontroller.so" "$source/specs/wall_align.yaml"
for binary in "$place/plugin/libcontroller.so" "$place/build/04_own_plant/04_own_plant"; do
  needed=$(ldd "$binary")
  if [[ $needed == *mujoco* || $needed != *urdf* ]]; then
    printf 'FAIL: %s needs %s\n' "$(basename "$binary")" "$needed"
    exit 1
  fi
done
