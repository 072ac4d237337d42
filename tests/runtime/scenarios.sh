#!/usr/bin/env bash
# scenarios.sh PROGRAM [FILE...]: what the shipped scenarios claim; of all of them, where none is named. Those that vary
# what another scenario runs once, or run it on another drive, take 40 % of the time: `./dev test --long` runs them.
set -euo pipefail
program=$1
files=("${@:2}")
long=(blind_hospital docking_in_vain_casters docking_steady faults_of_mass_casters faults_of_mass_diff hospital_blind
  hospital_loaded limited_hospital obstacle_stays_casters oncoming_fails pressed_on wall_align_soft wipe_varied)

is_long() { [[ " ${long[*]} " == *" $(basename "$1" .yaml) "* ]]; }

for name in "${long[@]}"; do
  if [[ ! -f specs/scenarios/$name.yaml ]]; then echo "scenarios.sh names $name, which is no scenario" >&2; exit 1; fi
done
if ((${#files[@]} == 0)); then
  for file in specs/scenarios/*.yaml; do
    if [[ ${ZWANG_LONG-} ]] || ! is_long "$file"; then files+=("$file"); fi
  done
fi
exec "$program" test "${files[@]}"
