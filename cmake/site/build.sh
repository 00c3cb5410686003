#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# build.sh WORK SITE: makes the documentation site in the folder SITE, with WORK for what is made on the way. Ends with 77 if
# doxygen, mkdocs or its theme is not installed, and fails on any warning.
set -euo pipefail
mkdir -p "$1" "$(dirname "$2")"
work=$(cd "$1" && pwd)
site=$(cd "$(dirname "$2")" && pwd)/$(basename "$2")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

for command in doxygen mkdocs awk; do
  command -v "$command" >/dev/null || { echo "There is no $command (Debian: doxygen, mkdocs)" && exit 77; }
done
# The theme is looked for by the Python that runs mkdocs, which need not be the first one in the PATH.
python=$(sed -n '1s/^#! *//p' "$(command -v mkdocs)")
$python -c 'import pymdownx, sys, mkdocs.utils; sys.exit("material" not in mkdocs.utils.get_theme_names())' 2>/dev/null ||
  { echo "There is no theme material (Debian: mkdocs-material)" && exit 77; }

rm -rf "$work/reference" "$work/xml"
# The reference gets a way back to the guide.
doxygen -l "$work/layout.xml"
sed -i 's|<navindex>|<navindex><tab type="user" url="../index.html" title="Guide"/>|' "$work/layout.xml"
SHAFTCULL_SITE_WORK=$work doxygen cmake/site/Doxyfile
# Enumerators are what it does not warn of.
awk '
  /<enumvalue / { inside = 1; words = 0 }
  inside && /<name>/ { name = $0; gsub(/.*<name>|<\/name>.*/, "", name) }
  inside && /<para>/ { words = 1 }
  /<\/enumvalue>/ { if (!words) { print "the enumerator " name " has no words"; bad = 1 }; inside = 0; ++count }
  END { if (count < 50) { print "only " count " enumerators were found"; bad = 1 }; exit bad }' "$work"/xml/*.xml
# With one warning it fails, and then it is worth reading.
if ! SHAFTCULL_REFERENCE=$work/reference SHAFTCULL_SITE=$site mkdocs build --clean --config-file cmake/site/mkdocs.yml \
  >"$work/mkdocs.txt" 2>&1; then
  cat "$work/mkdocs.txt"
  exit 1
fi
echo "The site is $site/index.html"
