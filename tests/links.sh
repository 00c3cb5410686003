#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# links.sh FOLDER LEAST: checks the links of all pages in a folder: those in Markdown of the project, or those in HTML of its site.
# Fails for one that leads nowhere, and if there are fewer than LEAST. Ends with 77 if there is no such folder, or no awk.
set -euo pipefail
tests=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
command -v awk >/dev/null || { echo "Skipped: there is no awk" && exit 77; }
[[ -d $1 ]] || { echo "Skipped: there is no $1" && exit 77; }

# First that it notices what is wrong: a page that is missing, and a heading.
planted=$(mktemp -d)
trap 'rm -rf "$planted"' EXIT
printf '# A page\n\n[right](#a-page) and [right](page.md) and [wrong](missing.md) and [wrong](#missing)\n' >"$planted/page.md"
found=$(cd "$planted" && awk -v least=1 -f "$tests/links.awk" page.md || true)
[[ $(grep -c 'missing' <<<"$found") -eq 2 && $(wc -l <<<"$found") -eq 3 ]] || { echo "what is wrong is not noticed: $found" && exit 1; }

cd "$1"
if [[ -f index.html ]]; then
  find . -name '*.html' -print0
else
  find *.md docs kernel bench bindings tests -name '*.md' -print0
fi | sed -z 's|^\./||' | xargs -0 awk -v least="$2" -f "$tests/links.awk"
