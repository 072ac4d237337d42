#!/usr/bin/env bash
# The direction of the rooms, read from the #include lines: runtime -> lang -> solver, and each outside library
# known to the one room (and there to the one .cpp) that owns it. And where tests may write.
#
#   rooms.sh ROOT     prints every offence as file:line: what; ends with 1 when there is any
set -euo pipefail
cd -- "${1:?usage: rooms.sh ROOT}"

offences=0
offend() {
  printf '%s\n' "$1"
  offences=$((offences + 1))
}

# file:line:header of every #include, read once.
all_includes=$(
  for folder in solver lang runtime examples; do
    if [[ -d $folder ]]; then
      grep -rnE --include='*.[hc]pp' --include='*.h' --include='*.cc' '^[[:space:]]*#[[:space:]]*include' "$folder" || true
    fi
  done | sed -E 's/^([^:]+:[0-9]+):[^<"]*[<"]([^>"]+).*/\1:\2/'
)
includes() {  # FOLDER: those below it
  grep "^$1/" <<<"$all_includes" || true
}

# ROOM 'ROOMS IT MAY NOT SEE': neither by the public headers nor by a path into the other room's folder.
keep_direction() {
  local room=$1 forbidden=$2 file line header other
  while IFS=: read -r file line header; do
    for other in $forbidden; do
      if [[ $header == zwang/$other/* || $header == *../$other/* || $header == $other/src/* ]]; then
        offend "$file:$line: $room may not know $other (<$header>)"
      fi
    done
  done < <(includes "$room")
}

keep_direction solver 'lang runtime'
keep_direction lang 'runtime'

# Within runtime: control and log know nothing of the simulation, or a robot of one's own would need MuJoCo.
while IFS=: read -r file line header; do
  if [[ $file =~ ^runtime/src/(plant|scenario)/ && $file != runtime/src/plant/plant.cpp ]]; then continue; fi
  if [[ $header =~ ^(plant|scenario)/ || $header =~ ^zwang/runtime/(mujoco_plant|scene_plant|scenario_run|simulated_run)\.hpp$ ]]; then
    offend "$file:$line: control and log may not know the simulation (<$header>)"
  fi
done < <(includes runtime/src)

# Folders of a room stand on each other in one order: whoever reads one of them need not read all. FOLDER is what their includes
# are relative to; the files beside the folders, '.', stand on all of them and are known to none.
keep_order() {
  local folder=$1 file line header from to
  local -A edges=()
  while IFS=: read -r file line header; do
    from=${file#"$folder/"}
    if [[ $from == */* ]]; then from=${from%%/*}; else from=.; fi
    to=${header%%/*}
    if [[ $header != */* && ! -f ${file%/*}/$header && -f $folder/$header ]]; then to=.; fi
    if [[ $to == "$from" || ($to != . && ! -d $folder/$to) ]]; then continue; fi
    edges["$from $to"]="$file:$line"
  done < <(includes "$folder")
  # tsort names the folders of a circle.
  while IFS= read -r from; do
    offend "$folder: its folders stand on each other in a circle, of which $from is one"
  done < <(printf '%s\n' "${!edges[@]}" | tsort 2>&1 >/dev/null | sed -nE 's/^tsort: ([^:-]+)$/\1/p')
}
for folder in solver/src lang/src runtime/src runtime; do keep_order "$folder"; done

# The solver is built with libc++ 14, too, which has no algorithms of std::ranges (elsewhere.libcxx).
while IFS= read -r line; do
  offend "$line: the solver has no std::ranges: libc++ 14 lacks it"
done < <(grep -rnoE --include='*.[hc]pp' 'std::(ranges|views)::[a-z_]+' solver || true)

# A room's insides (src/) are its own: others see include/zwang/ROOM only.
for room in solver lang runtime; do
  while IFS=: read -r file line header; do
    for other in solver lang runtime; do
      if [[ $other != "$room" && $header == *"$other/src/"* ]]; then
        offend "$file:$line: $room reaches into $other/src (<$header>)"
      fi
    done
  done < <(includes "$room")
done

# 'HEADERS (regular expression)' 'WHERE (regular expression of paths)' MOST: a library's headers may be included
# from matching files only, and from MOST files at the most. Tests may include what they test against.
keep_library() {
  local headers=$1 where=$2 most=$3 file line header
  local -A users=()
  while IFS=: read -r file line header; do
    if [[ ! $header =~ ^($headers) ]]; then continue; fi
    users[$file]=1
    if [[ ! $file =~ ^($where)$ ]]; then offend "$file:$line: <$header> belongs to $where"; fi
  done <<<"$all_includes"
  if ((${#users[@]} > most)); then
    offend "$headers: known to ${#users[@]} files instead of $most: ${!users[*]}"
  fi
}

keep_library 'yaml-cpp/' 'lang/src/.*\.cpp' 1
keep_library 'urdf_|urdf/|console_bridge/|tinyxml' 'lang/src/robot/.*\.cpp' 1
keep_library 'CLI/' 'runtime/cli/command_line/.*\.hpp' 1
keep_library '(eprosima|fastdds|fastrtps|fastcdr)/' 'runtime/connect/.*\.cpp' 1
keep_library 'libwebsockets' 'runtime/cli/.*\.cpp' 1
keep_library 'mpi\.h' 'runtime/study/mpi/.*\.cpp' 1
keep_library 'mujoco/' 'runtime/src/plant/.*\.cpp' 7
keep_library 'nlohmann/' '(lang|runtime)/.*\.cpp|lang/src/schema/parts\.hpp|runtime/(cli/json_parts|lsp/json|src/log/foxglove)\.hpp' 20
keep_library 'pybind11/' 'runtime/python/.*\.[ch]pp' 6
keep_library 'zstd|zlib' 'runtime/src/log/.*\.cpp' 1
keep_library 'sqlite3' 'runtime/study/.*\.cpp' 1
keep_library 'kdl/' 'tests/.*' 0
keep_library '(gtest|gmock|benchmark)/' 'tests/.*' 0

# A public header shows no outside library but Eigen: whoever includes it needs nothing else.
while IFS=: read -r file line header; do
  if [[ $header == */* && $header != zwang/* && $header != Eigen/* ]]; then
    offend "$file:$line: a public header shows <$header>"
  fi
done < <(includes '[a-z]*/include')

# Tests run beside each other, each in a process of its own: gtest's folder is one for all of them.
while IFS=: read -r file line _; do
  offend "$file:$line: testing::TempDir() is shared by all tests: use test::TemporaryFolder"
done < <(grep -rnF --include='*.[hc]pp' 'TempDir()' tests 2>/dev/null || true)

exit $((offences > 0))
