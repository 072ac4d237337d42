#!/usr/bin/env bash
# encoders.sh PROGRAM STUDIES FOLDER: the studies of encoders that fail, and none. With ZWANG_LONG in the environment
# (`./dev test --long`) 60 cells of each; else the single cells that once found a fault of the guard, and a few more.
# Ends with 1 and prints the study if an expectation is broken.
set -u
program=$1 studies=$2 folder=$3
mkdir -p "$folder"
bad=0
sweep() {  # STUDY [OPTIONS]
  local study=$1 name
  name=$(basename "$study" .yaml)
  shift
  "$program" sweep "$study" --fresh --out "$folder/$name.db" "$@" >"$folder/$name.txt" 2>&1 && return
  bad=1
  cat "$folder/$name.txt"
}
for study in "$studies"/cases/*.yaml; do sweep "$study" -j1; done
if [ -n "${ZWANG_LONG:-}" ]; then
  for study in "$studies"/*.yaml; do sweep "$study" --runs 60 -j2; done
else
  sweep "$studies/starts.yaml" --runs 8 -j1
  for name in wall_align corner released button; do sweep "$studies/$name.yaml" --runs 2 -j1; done
fi
exit $bad
