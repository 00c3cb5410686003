#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Compares docs/tuning.md with what there is: environment variables that sources read, options that CMake has.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# listed TITLE: the first column of the table below this heading.
listed() { sed -n "/^## $1/,/^## /s/^| \`\([A-Z0-9_]*\)\` .*/\1/p" docs/tuning.md | sort; }
read_by_sources() { grep -rhoE 'getenv\("[A-Z0-9_]+"' kernel bindings bench programs include | cut -d '"' -f 2 | sort -u; }
# Whatever is cached for the user to set: a string or a path, too, but no file that CMake looks for.
options() { { grep -hoE '^ *option\([A-Z0-9_]+' "${lists[@]}" && tr '\n' ' ' <<<"$(cat "${lists[@]}")" |
  grep -oE 'set\(SHAFTCULL_[A-Z0-9_]+ +[^ )]+ +CACHE (STRING|PATH) '; } | sed 's/ *[a-z]*(//; s/ .*//' | sort -u; }

lists=(CMakeLists.txt cmake/*.cmake kernel/CMakeLists.txt bindings/*/CMakeLists.txt bench/CMakeLists.txt programs/CMakeLists.txt)

result=0
compare() {
  [[ $(wc -l <<<"$3") -ge $2 ]] || { echo "only \"$3\" was found: $1" && result=1; }
  diff <(echo "$3") <(echo "$4") || { echo "docs/tuning.md differs ($1; < there is, > the page has)" && result=1; }
}
compare "environment variables" 1 "$(read_by_sources)" "$(listed 'Environment variables')"
compare "CMake options" 10 "$(options)" "$(listed 'CMake options')"
exit $result
