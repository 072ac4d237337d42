#!/usr/bin/env bash
# rooms.sh is of use only if it finds what it looks for: every line below is an offence put into an otherwise
# clean tree.
set -euo pipefail
check=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)/rooms.sh
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

failed=0
expect() {  # STATUS DESCRIPTION
  local status=0 output
  output=$("$check" "$tree" 2>&1) || status=$?
  if ((status != $1)); then
    printf 'FAIL: %s: ended with %s instead of %s\n%s\n' "$2" "$status" "$1" "$output"
    failed=1
  fi
}
offence() {  # FILE HEADER
  mkdir -p "$tree/$(dirname "$1")"
  printf '#include <vector>\n#include %s\n' "$2" >"$tree/$1"
  expect 1 "$1 includes $2"
  rm "$tree/$1"
}
clean() {  # FILE HEADER: stays
  mkdir -p "$tree/$(dirname "$1")"
  printf '#include <vector>\n#include %s\n' "$2" >>"$tree/$1"
}

expect 0 'an empty tree'
clean solver/src/sweep/sweep.cpp '<Eigen/Core>'
clean lang/src/tree/reader.cpp '<yaml-cpp/eventhandler.h>'
clean lang/src/robot/urdf.cpp '<urdf_parser/urdf_parser.h>'
clean lang/include/zwang/lang/robot.hpp '"zwang/solver/model.hpp"'
clean runtime/src/plant/mujoco_plant.cpp '<mujoco/mujoco.h>'
clean runtime/cli/command_line/command_line.hpp '<CLI/CLI.hpp>'
clean tests/peers/kdl_test.cpp '<kdl/chain.hpp>'
expect 0 'a tree that keeps the rules'

offence solver/src/a.cpp '"zwang/lang/source.hpp"'
offence solver/src/a.cpp '"zwang/runtime/plant.hpp"'
offence solver/include/zwang/solver/a.hpp '"zwang/lang/source.hpp"'
offence solver/src/a.cpp '"../../lang/src/tree/reader.hpp"'
offence lang/src/a.cpp '"zwang/runtime/plant.hpp"'
offence runtime/src/a.cpp '"solver/src/sweep/sweep.hpp"'
offence lang/src/check/a.cpp '<yaml-cpp/yaml.h>'
offence runtime/src/a.cpp '<yaml-cpp/yaml.h>'
offence lang/src/robot/a.cpp '<urdf_parser/urdf_parser.h>'
offence runtime/src/log/a.cpp '<CLI/CLI.hpp>'
offence runtime/src/schedule/a.cpp '<mujoco/mujoco.h>'
offence runtime/src/run/a.cpp '"plant/simulator.hpp"'
offence runtime/src/guard/a.cpp '"zwang/runtime/scene_plant.hpp"'
offence solver/src/a.cpp '<kdl/chain.hpp>'
offence runtime/src/a.cpp '<gtest/gtest.h>'
offence lang/include/zwang/lang/a.hpp '<yaml-cpp/yaml.h>'
offence runtime/include/zwang/runtime/a.hpp '<nlohmann/json.hpp>'
clean lang/src/check/check.cpp '"physics/physics.hpp"'
clean lang/src/physics/physics.hpp '<vector>'
clean lang/src/load.cpp '"check/check.hpp"'
expect 0 'folders in one order'
offence lang/src/physics/push.cpp '"check/context.hpp"'
printf 'write(testing::TempDir());\n' >"$tree/tests/peers/a_test.cpp"
expect 1 'a test writes where every other does'
rm "$tree/tests/peers/a_test.cpp"
expect 0 'the tree after every offence was taken away'

exit "$failed"
