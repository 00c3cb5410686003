#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check.sh BUILD: tests the npm package in BUILD/web/shaftcull and the page BUILD/page/index.html, made with what is in
# BUILD/page-work: ./cmake/run page --check. Answers in the page are compared with those of the program, if BUILD has it. Without
# what npm installs there, the package is tested alone.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1
modules=$build/page-work/node_modules
export SHAFTCULL_PACKAGE=$build/web/shaftcull SHAFTCULL_PAGE=$build/page/index.html SHAFTCULL_MODULES=$modules
if [[ -x $build/release/bin/shaftcull ]]; then export SHAFTCULL_PROGRAM=$build/release/bin/shaftcull; fi

# Clients find the package as users do: among their modules.
client=$build/page-work/client
mkdir -p "$client/node_modules"
ln -sfn "$build/web/shaftcull" "$client/node_modules/shaftcull"

# What the guide shows first prints what the guide says.
block() { awk -v kind="\`\`\`$1" '$0 == "```" { on = 0 } on { print } $0 == kind { on = 1 }' "$here/../../../docs/web.md"; }
block js >"$client/guide.mjs"
diff <(node "$client/guide.mjs") <(block text)

if [[ ! -d $modules ]]; then
  node --test "$here/package.test.mjs"
  echo "Skipped: the page and the package's types, for npm did not reach its registry"
  exit 0
fi
cp "$here/types.ts" "$here/tsconfig.json" "$client"
node "$modules/typescript/bin/tsc" -p "$client"
node --test "$here/package.test.mjs" "$here"/../page/tests/*.test.mjs
