#!/usr/bin/env bash
# completion.sh PROGRAM: the completions do in their shells what a user expects, and the manual page and README name every verb.
# zsh, fish and groff judge where they are installed.
set -euo pipefail
program=$1
readme=$(dirname -- "${BASH_SOURCE[0]}")/../../README.md
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for form in bash zsh fish man; do "$program" completion "$form" >"$folder/$form"; done

# shellcheck disable=SC1091
source "$folder/bash"
offered() {  # WORD...: what bash offers for the last word
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
  _zwang
  printf '%s\n' "${COMPREPLY[@]}" | sort
}
expect() {  # WHAT GOT WANTED
  if [[ $2 != "$3" ]]; then
    printf '%s: offered\n%s\nand not\n%s\n' "$1" "$2" "$3" >&2
    exit 1
  fi
}
verbs=$("$program" --help | awk '/^Subcommands:/ { on = 1; next } on && NF { print $1 }' | sort)
expect 'zwang TAB' "$(offered zwang '' | grep -v '^-')" "$verbs"
expect 'zwang va TAB' "$(offered zwang va)" validate
expect 'zwang run --sc TAB' "$(offered zwang run --sc)" --scene
expect 'zwang robot TAB' "$(offered zwang robot '')" "$(printf 'identify\ninit\ninspect')"
expect 'zwang robot init --up TAB' "$(offered zwang robot init --up)" --update
expect 'zwang run TAB: left to files' "$(offered zwang run '')" ''

for verb in $verbs; do
  grep -q "^\.SS $verb" "$folder/man" || { echo "the manual page lacks $verb" >&2; exit 1; }
  grep -E '^\| `' "$readme" | grep -qE "(zwang |\`)$verb[ \`]" || { echo "the table of README.md lacks $verb" >&2; exit 1; }
done
if command -v zsh >/dev/null; then zsh -n "$folder/zsh"; fi
if command -v fish >/dev/null; then fish --no-execute "$folder/fish"; fi
if command -v groff >/dev/null; then
  warnings=$(groff -man -Tutf8 -ww -z "$folder/man" 2>&1)
  expect 'warnings of groff' "$warnings" ''
fi
