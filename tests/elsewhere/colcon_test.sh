#!/usr/bin/env bash
# colcon_test.sh SOURCE: `colcon build` finds the source tree by its package.xml, and builds and installs it. To save time, it
# builds the room `solver` alone.
# Skipped unless ZWANG_LONG is set and colcon with its extensions for CMake and ROS is there.
set -euo pipefail
source=$1
skip() { echo "skipped: $1"; exit 77; }
[[ ${ZWANG_LONG-} ]] || skip 'only with ZWANG_LONG'
extensions=(python3-colcon-{package-information,package-selection,recursive-crawl,cmake,ros,bash,output})
colcon list --help >/dev/null 2>&1 && colcon build --help 2>/dev/null | grep -q -e --cmake-args ||
  skip "apt install colcon ${extensions[*]}"
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
mkdir -p "$place/src"
ln -s "$source" "$place/src/zwang"
cd "$place"
[[ $(colcon list --base-paths src --names-only) == zwang ]] || { echo 'colcon list does not name zwang'; colcon list --base-paths src; exit 1; }
colcon build --base-paths src --packages-select zwang --cmake-args -DZWANG_ROOMS=solver -DZWANG_BUILD_TESTS=OFF
test -f install/zwang/lib/libzwang_solver.a
test -f install/zwang/share/zwang/package.xml
