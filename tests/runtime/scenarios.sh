#!/usr/bin/env bash
# scenarios.sh PROGRAM [FILE...]: what the shipped scenarios claim; of all of them, where none is named. `./dev test` runs
# so many cells that each value of a matrix occurs, `./dev test --long` the whole matrix. Scenarios that vary what another one
# runs once, or run it on another drive, take half of the time: `./dev test --long` runs them.
set -euo pipefail
program=$1
files=("${@:2}")
long=(blind_hospital blind_obstacle cradle_varied docking_casters docking_casters_badly_seen docking_diff_badly_seen
  docking_diff_in_vain docking_in_vain_casters docking_live_casters docking_live_diff docking_steady
  faults_of_mass_casters faults_of_mass_diff faults_slip_askew felt_carry felt_cart felt_corner felt_cradle felt_deliver
  felt_docking felt_door felt_follow_wall felt_hospital felt_obstacle_twins felt_patrol felt_wall_align_twins
  hospital_blind hospital_diff_blind hospital_diff_closed hospital_loaded limited_docking limited_docking_twins
  limited_hospital limited_hospital_diff limited_hospital_twins limited_obstacle_casters limited_obstacle_twins
  limited_wall_align_twins obstacle_corner obstacle_gently obstacle_leaves_diff obstacle_light obstacle_rollers obstacle_stays_casters oncoming_fails owned_wall_align pressed_on
  switch_hospital_hard switch_obstacle_hard velocity_wall_align_casters wall_align_soft wipe_varied)

is_long() { [[ " ${long[*]} " == *" $(basename "$1" .yaml) "* ]]; }

for name in "${long[@]}"; do
  if [[ ! -f specs/scenarios/$name.yaml ]]; then echo "scenarios.sh names $name, which is no scenario" >&2; exit 1; fi
done
if ((${#files[@]} == 0)); then
  for file in specs/scenarios/*.yaml; do
    if [[ ${ZWANG_LONG-} ]] || ! is_long "$file"; then files+=("$file"); fi
  done
fi
cells=(--each-value)
if [[ ${ZWANG_LONG-} ]]; then cells=(); fi
exec "$program" test "${cells[@]}" "${files[@]}"
