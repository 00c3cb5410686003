#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_calls.sh PROGRAM…: runs it, and looks for each call that the tables of docs/which-call.md and docs/coming-from.md show in its
# source, calls.cpp. Names without arguments, as "update()", are those of the public headers.
set -euo pipefail
docs=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
"$@"
# White space does not count: lines of the source are broken where they are long.
source=$(tr -d ' \n' <"$docs/examples/calls.cpp")
calls() { grep -o '`[^`]*([^`]*)`\|`{[^`]*}`' | tr -d '`' | sort -u; }
checked=0
while IFS= read -r call; do
  checked=$((checked + 1))
  if [[ $call =~ ([a-z_]+)\(\)$ ]]; then
    grep -rqw "${BASH_REMATCH[1]}" "$docs/../include/shaftcull" && continue
  else
    [[ $source == *"$(tr -d ' ' <<<"$call")"* ]] && continue
  fi
  echo "\"$call\" is in no table's program, docs/examples/calls.cpp"
  exit 1
done < <({ sed -n '/^|/p' "$docs/which-call.md" && sed -n '/^|/p' "$docs/coming-from.md" | cut -d '|' -f 3; } | calls)
[[ $checked -ge 40 ]] || { echo "only $checked calls were found" && exit 1; }
echo "$checked calls"
