#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What ./cmake/run release and abi refuse, and the bill of materials of files that are made up. A whole release takes ten minutes, so
# only ./cmake/run release --check makes one.
#
#   tests/packages/release.sh       ends with 77, "skipped", where there is no git or no dpkg-deb
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
for tool in git dpkg-deb dpkg-query python3; do
  command -v $tool >/dev/null || { echo "Skipped: there is no $tool" && exit 77; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@b GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@b
unset GIT_DIR GIT_WORK_TREE
failures=0
fail() {
  printf 'FAILED, %s: %s\n' "$scenario" "$1"
  sed 's/^/    /' "$work/output"
  failures=$((failures + 1))
}
says() { grep -qF -- "$1" "$work/output" || fail "does not say \"$1\""; }
# run RESULT WORD…: ./cmake/run of a small repository, which may install nothing
run() {
  local result=0
  "$work/project/cmake/run" --no-install "${@:2}" >"$work/output" 2>&1 || result=$?
  [[ $result -eq $1 ]] || fail "ended with $result instead of $1"
}

# A repository that has no more than what is looked at before anything is built.
mkdir -p "$work/project/cmake/packaging/"{debian,vcpkg/shaftcull} "$work/project/include/shaftcull" "$work/project/docs"
cp -r "$project/cmake/run" "$project/cmake/commands" "$work/project/cmake/"
cp "$project/include/shaftcull/version.hpp" "$work/project/include/shaftcull/"
for file in CITATION.cff cmake/packaging/debian/changelog cmake/packaging/vcpkg/shaftcull/vcpkg.json docs/shaftcull.1; do
  cp "$project/$file" "$work/project/$file"
done
version=$(sed -n 's/^version: //p' "$project/CITATION.cff")
git -C "$work/project" init -q
commit() { git -C "$work/project" add -A && git -C "$work/project" commit -qm "A state"; }
echo "## Unreleased" >"$work/project/CHANGELOG.md"
commit

scenario="no tag"
run 1 release
says "git knows no tag or commit \"v$version\" here"

scenario="a tag of another version"
git -C "$work/project" tag v7.7.7
run 1 release v7.7.7
says "the sources of v7.7.7 are of version $version"

scenario="a changelog without the version"
git -C "$work/project" tag "v$version"
run 1 release
says "CHANGELOG.md of v$version lacks \"## $version\""

scenario="an option that it has not"
run 1 release --chek
says 'release takes --check and the name of a commit, not "--chek"'

# The bill of materials. Only the names of files matter, and what packages depend on.
mkdir "$work/files" "$work/package"
touch "$work/files/shaftcull-$version.tar.gz" "$work/files/shaftcull-$version-cp311-cp311-linux_x86_64.whl"
# package NAME DEPENDS
package() {
  mkdir -p "$work/package/DEBIAN"
  printf 'Package: %s\nVersion: %s-1\nArchitecture: all\nMaintainer: a <a@b>\nDepends: %s\nDescription: made up\n' "$1" "$version" "$2" \
    >"$work/package/DEBIAN/control"
  dpkg-deb --build "$work/package" "$work/files/$1_$version-1_all.deb" >/dev/null
}
bill() {
  local result=0
  SOURCE_DATE_EPOCH=86400 python3 "$project/cmake/packaging/bill_of_materials.py" "$project" "$version" 0123abcd "$work/files" \
    >"$work/output" 2>&1 || result=$?
  [[ $result -eq $1 ]] || fail "ended with $result instead of $1"
}
# looked_up PACKAGE…: whether Debian's packages, whose versions the bill has, are installed here
looked_up() { dpkg-query -W "$@" >/dev/null 2>&1; }

scenario="a library that docs/third-party.md does not list"
package libshaftcull1 "libc6 (>= 2.34), libtbb12, libmagic1"
bill 1
says "libshaftcull1_$version-1_all.deb depends on libmagic1, of which docs/third-party.md has no row"

scenario="a bill of materials"
package libshaftcull1 "libc6 (>= 2.34), libtbb12"
if looked_up libtbb-dev libxsimd-dev pybind11-dev; then
  bill 0
  python3 - "$work/files" "$version" >"$work/output" 2>&1 <<'PY' || fail "is not what it should be"
import hashlib, json, pathlib, subprocess, sys

folder, version = pathlib.Path(sys.argv[1]), sys.argv[2]
bill = json.loads((folder / f"shaftcull-{version}.spdx.json").read_text())
assert bill["spdxVersion"] == "SPDX-2.3" and bill["creationInfo"]["created"] == "1970-01-02T00:00:00Z", bill
items = {item["SPDXID"]: item for item in bill["packages"]}
assert len(items) == len(bill["packages"]), "an identifier is there twice"
files = {item["packageFileName"]: item for item in bill["packages"] if "packageFileName" in item}
assert sorted(files) == sorted(f.name for f in folder.iterdir() if f.suffix != ".json"), files
for name, item in files.items():
    assert item["checksums"][0]["checksumValue"] == hashlib.sha256((folder / name).read_bytes()).hexdigest(), name
relations = {(r["spdxElementId"], r["relationshipType"], r["relatedSpdxElement"]) for r in bill["relationships"]}
assert {one for one, _, _ in relations} | {other for _, _, other in relations} <= {*items, "SPDXRef-DOCUMENT"}
of = lambda name: {(kind, items[other]["name"]) for one, kind, other in relations if one == files[name]["SPDXID"]}
library = {("CONTAINS", "xsimd"), ("DYNAMIC_LINK", "TBB")}
assert of(f"libshaftcull1_{version}-1_all.deb") == library
assert of(f"shaftcull-{version}-cp311-cp311-linux_x86_64.whl") == {*library, ("CONTAINS", "pybind11")}
assert of(f"shaftcull-{version}.tar.gz") == set()
xsimd = next(item for item in bill["packages"] if item["name"] == "xsimd")
asked = subprocess.run(["dpkg-query", "-W", "-f=${Version}", "libxsimd-dev"], capture_output=True, text=True, check=True)
assert (xsimd["licenseConcluded"], xsimd["versionInfo"]) == ("BSD-3-Clause", asked.stdout), xsimd
PY
fi

[[ $failures -eq 0 ]] || exit 1
echo "All refusals and the bill of materials as expected."
