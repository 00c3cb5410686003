#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check.sh SOURCE PROGRAM…           whether the pages of docs/ show this source, and what this program prints, as they are
# check.sh --update SOURCE PROGRAM…  writes both into the pages
#
# A page shows a source where a comment names it, in the line before a block of code:
#   <!-- docs/examples/swept.cpp -->             all of it, without such marks as the following
#   <!-- docs/examples/ten_minutes.c: tree -->   what stands between [[tree]] and [[end]] in it, moved to the left
#   <!-- docs/examples/swept.cpp prints -->      what the program prints
set -euo pipefail
docs=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
update=
if [[ ${1:-} == --update ]]; then update=yes && shift; fi
source=$1
program=("${@:2}")
printed=$(set -o pipefail && "${program[@]}" | tr -d '\r') || { echo "${program[*]} ended with an error" && exit 1; }

# part NAME: the lines of the source between [[NAME]] and [[end]].
part() {
  awk -v name="[[$1]]" '
    index($0, "[[end]]") { inside = 0 }
    inside { if (!indent && match($0, /[^ ]/)) indent = RSTART; print substr($0, indent) }
    index($0, name) { inside = 1 }' "$docs/examples/$source"
}

# shown: the page from the standard input, with what it shows of the source as that is now.
shown() {
  local line wanted
  while IFS= read -r line; do
    printf '%s\n' "$line"
    case $line in
      "<!-- docs/examples/$source -->") wanted=$(grep -v "\[\[.*\]\]" "$docs/examples/$source") ;;
      "<!-- docs/examples/$source prints -->") wanted=$printed ;;
      "<!-- docs/examples/$source: "*" -->")
        wanted=${line#*: } && wanted=$(part "${wanted% -->}")
        [[ $wanted ]] || { echo "$source has no part \"$line\"" >&2 && return 1; }
        ;;
      *) continue ;;
    esac
    IFS= read -r line
    printf '%s\n%s\n' "$line" "$wanted"
    while IFS= read -r line && [[ $line != '```' ]]; do :; done
    printf '%s\n' "$line"
  done
}

blocks=0
result=0
for page in "$docs"/*.md "$docs"/recipes/*.md; do
  found=$(grep -c "^<!-- docs/examples/$source\( -->\| prints -->\|: \)" "$page" || true)
  if [[ $found -eq 0 ]]; then continue; fi
  blocks=$((blocks + found))
  now=$(shown <"$page")
  if [[ $update ]]; then
    printf '%s\n' "$now" >"$page"
  elif ! diff -u "$page" - <<<"$now"; then
    echo "$page differs from $source or what it prints: docs/examples/check.sh --update $source ${program[*]} mends it"
    result=1
  fi
done
if [[ $blocks -eq 0 ]]; then echo "No page shows $source" && result=1; fi
echo "$blocks blocks of $source"
exit $result
