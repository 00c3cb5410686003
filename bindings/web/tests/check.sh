#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check.sh BUILD: tests the npm package in BUILD/web/shaftcull and the page BUILD/page/index.html, made with what is in
# BUILD/page-work: ./cmake/run page --check. Answers in the page are compared with those of the program, if BUILD has it.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1
modules=$build/page-work/node_modules

# A client in TypeScript finds the package as users do: among its modules.
types=$build/page-work/types
mkdir -p "$types/node_modules"
cp "$here/types.ts" "$here/tsconfig.json" "$types"
ln -sfn "$build/web/shaftcull" "$types/node_modules/shaftcull"
node "$modules/typescript/bin/tsc" -p "$types"

# What the guide shows first prints what the guide says.
block() { awk -v kind="\`\`\`$1" '$0 == "```" { on = 0 } on { print } $0 == kind { on = 1 }' "$here/../../../docs/web.md"; }
block js >"$types/guide.mjs"
diff <(node "$types/guide.mjs") <(block text)

export SHAFTCULL_PACKAGE=$build/web/shaftcull SHAFTCULL_PAGE=$build/page/index.html SHAFTCULL_MODULES=$modules
if [[ -x $build/release/bin/shaftcull ]]; then export SHAFTCULL_PROGRAM=$build/release/bin/shaftcull; fi
node --test "$here/package.test.mjs" "$here/../page/tests/page.test.mjs"
