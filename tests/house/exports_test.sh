#!/usr/bin/env bash
# What shared libraries of the rooms would show, linked from the archives of this build: names of public headers alone. Each
# room, and each program, finds there what it needs of the rooms before it.
#
#   exports_test.sh ROOT COMPILER SOLVER LANG RUNTIME SIMULATION [-- PROGRAM OBJECT...]...     (the four are archives)
set -euo pipefail
root=$1 compiler=$2
shift 2
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT

# The simulation watches boundaries with the code of the runtime. Its velocity loops have the gains that the runtime expects.
shared_within='FrameTable|RegionFence|carried|loop_gains'
public=$(cat "$root"/{solver,lang,runtime}/include/zwang/*/*.hpp | grep -oE '\w+' | sort -u)
libraries=$(pkg-config --libs yaml-cpp urdfdom libzstd zlib)

offences=0
before=()
while (($#)) && [[ $1 != -- ]]; do
  archive=$1
  shift
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
# What a program needs of other libraries is not asked here: the linker only warns of it.
while (($#)); do
  program=$2
  shift 2
  objects=()
  while (($#)) && [[ $1 != -- ]]; do objects+=("$1"); shift; done
  missing=$("$compiler" -o "$place/program" "${objects[@]}" "${before[@]}" -Wl,--warn-unresolved-symbols 2>&1 |
    grep -oE "(undefined reference to|undefined|hidden) .*zwang::(solver|lang|runtime)::.*" | sort -u || true)
  if [[ $missing ]]; then
    printf 'shared libraries do not show what %s needs:\n%s\n' "$program" "$missing"
    offences=$((offences + 1))
  fi
done
((offences == 0))
