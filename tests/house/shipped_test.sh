#!/usr/bin/env bash
# What the project ships hangs together: the files that files name exist, links of the documentation lead
# somewhere, every room has its page, and nothing names a place outside the checkout.
set -euo pipefail
cd -- "${1:?usage: shipped_test.sh ROOT}"

failed=0
complain() {
  printf '%s\n' "$1"
  failed=1
}

for page in README.md CHANGELOG.md LICENSE {solver,lang,runtime,specs,tests}/README.md; do
  if [[ ! -s $page ]]; then complain "$page is missing or empty"; fi
done

# The page of a room, and that of the tests, says what each folder is for.
for room in solver lang runtime tests; do
  for folder in "$room"/*/ "$room"/src/*/; do
    name=$(basename "$folder")
    if [[ ! -d $folder || $name == include || $name == src ]]; then continue; fi
    if ! grep -qF "$name/" "$room/README.md"; then complain "$room/README.md does not say what $folder is for"; fi
  done
done

# `robot:`, `scene:`, `urdf:`, `task:`, `based_on:` lead to files, seen from the file that says so; a matrix has lists of them.
referring=0
while IFS= read -r file; do
  while IFS= read -r target; do
    referring=$((referring + 1))
    if [[ ! -f $(dirname "$file")/$target ]]; then complain "$file names $target, which does not exist"; fi
  done < <(sed -nE 's/#.*//; /^[[:space:]]*((robot|scene|urdf|task|based_on):|-)[[:space:]]/p' "$file" |
    grep -oE '[^][",[:space:]]+\.(yaml|urdf)\b' || true)
done < <(find specs examples -name '*.yaml' 2>/dev/null)
if ((referring == 0)); then complain 'no shipped file names another: the search above is broken'; fi

# A scenario in which something can be pressed says how hard, once nothing moves: by `steady`, or by the force at the end, or none ever.
while IFS= read -r file; do
  if grep -qE 'diagnostic: E|outcome: refused' "$file"; then continue; fi
  scenes=$(grep -oE 'scenes/[a-z0-9_]+\.yaml' "$file" || true)
  if [[ ! $scenes ]]; then
    task=$(dirname "$file")/$(sed -nE 's/^task: *([^ ]+).*/\1/p' "$file")
    scenes=$(grep -oE 'scenes/[a-z0-9_]+\.yaml' "$task" || true)
  fi
  for scene in $scenes; do
    if ! grep -qE '^(objects|robots):' "specs/$scene" 2>/dev/null; then continue; fi
    if grep -qE '\.steady|always: truth\.[a-z_]+\.force < 0\.1 N|at: end, that: abs\(truth\.[a-z_]+\.force - ' "$file"; then continue; fi
    complain "$file does not say what is pressed steadily in $scene"
  done
done < <(find specs/scenarios -name '*.yaml')

# colcon and CMake speak of the same version.
version=$(sed -nE 's/^#define ZWANG_VERSION "(.*)"/\1/p' solver/include/zwang/version.hpp)
if ! grep -qF "<version>$version</version>" package.xml; then complain "package.xml has not version $version of version.hpp"; fi

# Relative links of the documentation.
links=0
while IFS= read -r page; do
  while IFS= read -r target; do
    links=$((links + 1))
    if [[ ! -e $(dirname "$page")/$target ]]; then complain "$page links to $target, which does not exist"; fi
  done < <(grep -oE '\]\([^)#: ]+(#[^)]*)?\)' "$page" | sed -E 's/^\]\(([^)#]+).*/\1/')
done < <(find ./*.md docs examples lang runtime solver specs tests -name '*.md' 2>/dev/null)
if ((links == 0)); then complain 'no page links to another: the search above is broken'; fi

# A block that names a file, as ```cpp examples/01_solver/main.cpp, stands there line by line, indented or not: so it compiles.
blocks=0
stands_in() {  # BLOCK FILE
  awk '{ gsub(/^[ \t]+|[ \t]+$/, "") }
       NR == FNR { wanted[n++] = $0; next }
       { line[m++] = $0 }
       END { for (i = 0; i + n <= m; i++) { for (j = 0; j < n && wanted[j] == line[i + j]; j++); if (j == n) exit 0 }
             exit 1 }' "$1" "$2"
}
block=$(mktemp)
trap 'rm -f "$block"' EXIT
while IFS=: read -r page number fence; do
  target=${fence#* }
  blocks=$((blocks + 1))
  sed -n "$((number + 1)),/^\`\`\`/p" "$page" | sed '$d' >"$block"
  if [[ ! -f $target ]]; then complain "$page:$number: the block names $target, which does not exist"; continue; fi
  if ! stands_in "$block" "$target"; then complain "$page:$number: the block does not stand in $target"; fi
done < <(grep -nE '^```(cpp|cmake) [a-z]' docs/*.md)
if ((blocks == 0)); then complain 'no block of a page names its file: the search above is broken'; fi

# No path of one machine. Tests may look for optional data beside the checkout.
parts=(.ci cmake docs examples lang runtime solver specs tests dev ./*.md ./CMake*)
search() { grep -rnE "$@" "${parts[@]}" 2>/dev/null || true; }
odd=$(search --exclude-dir=house '(^|[^A-Za-z0-9_./-])/(home|root|work|Users)/[A-Za-z0-9]')
if [[ $odd ]]; then complain "paths of one machine:"$'\n'"$odd"; fi
odd=$(search --exclude-dir=tests '\.\./shared')
if [[ $odd ]]; then complain "data from outside the checkout, and not in a test:"$'\n'"$odd"; fi

exit "$failed"
