#!/usr/bin/env bash
# What shared libraries of the rooms would show, linked from the archives of this build: names of public headers alone. Each
# room finds there what it needs of the rooms before it.
#
#   exports_test.sh ROOT COMPILER SOLVER LANG RUNTIME SIMULATION     (the last four are archives)
set -euo pipefail
root=$1 compiler=$2
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT

# The simulation watches boundaries with the code of the runtime.
shared_within='FrameTable|RegionFence|carried'
public=$(cat "$root"/{solver,lang,runtime}/include/zwang/*/*.hpp | grep -oE '\w+' | sort -u)
libraries=$(pkg-config --libs yaml-cpp urdfdom libzstd zlib)

offences=0
before=()
for archive in "${@:3}"; do
  library=$place/$(basename "$archive" .a).so
  mujoco=()
  if [[ $archive == *simulation* ]]; then mujoco=(-lmujoco); fi
  # shellcheck disable=SC2086
  "$compiler" -shared -o "$library" -Wl,--whole-archive "$archive" -Wl,--no-whole-archive "${before[@]}" $libraries \
    "${mujoco[@]}" -pthread -Wl,--no-undefined
  before+=("$library")
  # zwang::ROOM::NAME, of functions, tables and types.
  names=$(nm -DC --defined-only "$library" | grep -oE '(^| )[TtVvBDR] (vtable for |typeinfo for )?zwang::(solver|lang|runtime)::\w+' |
    grep -oE '\w+$' | sort -u)
  if [[ -z $names ]]; then
    printf '%s shows nothing\n' "$(basename "$library")"
    offences=$((offences + 1))
  fi
  while read -r name; do
    if [[ $name =~ ^($shared_within)$ ]]; then continue; fi
    printf '%s shows `%s`, which no public header names\n' "$(basename "$library")" "$name"
    offences=$((offences + 1))
  done < <(comm -23 <(printf '%s\n' "$names") <(printf '%s\n' "$public"))
done
((offences == 0))
