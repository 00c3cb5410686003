#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Tries Debian packages out: installs them below an empty folder, builds programs in C++ and C against what is there,
# by pkg-config and by CMake, runs them and the program of the packages, looks at what lintian finds, and removes the
# packages again.
#
#   tests/packages/check.sh FOLDER       of the .deb files; ./cmake/run package --check or --try makes them before
#
# Nobody need be root, and nothing of this machine changes: dpkg gets a database of its own in that folder (--root),
# and fakeroot lets it give files to root. What packages depend on is not there, so dpkg is told to go on without
# (--force-depends) and libraries of this machine stand in. Scripts of packages run here (--force-script-chrootless),
# and know by DPKG_ROOT that what they care for is in that folder.
set -euo pipefail

packages=$(realpath "$1")
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
PATH=$PATH:/usr/sbin:/sbin
export LC_ALL=C.UTF-8
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
root=$work/root

fail() {
  printf 'FAILED: %s\n' "$@" >&2
  exit 1
}
for tool in dpkg fakeroot pkg-config cmake g++ gcc; do
  command -v $tool >/dev/null || fail "there is no $tool on this machine"
done
# equal WHAT IS EXPECTED
equal() { [[ $2 == "$3" ]] || fail "$1 is" "$2" "instead of" "$3"; }

shopt -s nullglob
debs=("$packages"/*.deb)
[[ ${#debs[@]} -ge 3 ]] || fail "there are ${#debs[@]} packages in $packages"
names=()
for deb in "${debs[@]}"; do names+=("$(dpkg-deb --field "$deb" Package)"); done
version=$(dpkg-deb --field "${debs[0]}" Version)
runtime=$(printf '%s\n' "${names[@]}" | grep -x 'libshaftcull[0-9.]*')
echo "Packages: ${names[*]}, version $version"

# What each depends on: its own libraries in this very version, and those of others by the names of their packages.
needs() {
  local deb=("$packages/$1"_*.deb) depends
  depends=$(dpkg-deb --field "${deb[0]}" Depends)
  [[ ", $depends," == *", $2"[,\ ]* ]] || fail "$1 depends on $depends, not on $2"
}
needs "$runtime" libtbb12
needs "$runtime" libc6
needs libshaftcull-dev "$runtime (= $version)"
needs shaftcull "$runtime (= $version)"
needs shaftcull libassimp5

# Installed.
mkdir -p "$root/var/lib/dpkg/"{info,updates} "$work/log"
touch "$root/var/lib/dpkg/"{status,available}
in_root() {
  fakeroot dpkg --root="$root" --force-not-root --force-depends --force-script-chrootless --log="$work/log/dpkg" "$@" \
    >"$work/log/output" 2>&1 ||
    fail "dpkg $* ended with $?" "$(cat "$work/log/output")"
}
in_root --install "${debs[@]}"
for name in "${names[@]}"; do
  equal "the state of $name" "$(dpkg-query --admindir="$root/var/lib/dpkg" -W -f='${db:Status-Status}' "$name")" installed
done
in_root --verify
equal "what dpkg --verify finds" "$(cat "$work/log/output")" ""
triplet=$(dpkg-architecture -qDEB_HOST_MULTIARCH)
libraries=$root/usr/lib/$triplet
for elf in "$libraries"/*.so "$root"/usr/bin/*; do
  [[ $(readelf -d "$elf") != *"(R"*"PATH)"* ]] || fail "$elf has a search path of its own"
done
sort >"$work/expected" <<TXT
libshaftcull ${runtime#libshaftcull} $runtime (>= $version)
libshaftcull_c ${runtime#libshaftcull} $runtime (>= $version)
TXT
equal "the shlibs file of $runtime" "$(sort "$root/var/lib/dpkg/info/$runtime:"*.shlibs)" "$(cat "$work/expected")"

# Used: programs by pkg-config, and by find_package with components.
export PKG_CONFIG_LIBDIR=$libraries/pkgconfig
export LD_LIBRARY_PATH=$libraries
uses() { # PROGRAM LIBRARY: it runs with the library of the packages, and of no other place
  local used
  used=$(ldd "$1")
  [[ $used == *"$2.so.${runtime#libshaftcull} => $libraries/"* ]] || fail "$1 does not use $2 of the packages:" "$used"
}
equal "pkg-config's version" "$(pkg-config --modversion shaftcull shaftcull_c | sort -u)" "${version%-*}"
read -ra flags < <(pkg-config --cflags --libs shaftcull)
g++ -std=c++20 "$project/tests/embedding/client.cpp" -o "$work/client" "${flags[@]}"
uses "$work/client" libshaftcull
"$work/client" >/dev/null || fail "the client's answers are not those on record"
read -ra flags < <(pkg-config --cflags --libs shaftcull_c)
gcc -std=c11 -Wall -Wextra -Wpedantic -Werror "$project/tests/consumer/main.c" -o "$work/client_c" "${flags[@]}"
uses "$work/client_c" libshaftcull_c
equal "the answer in C" "$("$work/client_c")" "kept 1"

quietly() { "$@" >"$work/log/output" 2>&1 || fail "$*" "$(cat "$work/log/output")"; }
quietly cmake -S "$project/tests/consumer" -B "$work/consumer" -D CMAKE_PREFIX_PATH="$root/usr" -D COMPONENTS="cpp;c"
quietly cmake --build "$work/consumer"
for program in consumer consumer_c; do
  uses "$work/consumer/$program" libshaftcull
  equal "the answer of $program" "$("$work/consumer/$program")" "kept 1"
done

# The program: its version, the commands of its manual page as they stand there, some answers with those on record, and, where they can be, with exact
# arithmetic.
program=$root/usr/bin/shaftcull
uses "$program" libshaftcull
[[ $("$program" --version) == "shaftcull ${version%-*} "* ]] || fail "the program's version is $("$program" --version)"
page=$root/usr/share/man/man1/shaftcull.1.gz
mkdir "$work/room"
printf 'v %s\n' '0 9 0' '1 9 0' '0 10 1' '4 0 4' '6 0 4' '4 1 6' '2 4 2' '3 4 2' '2 5 3' >"$work/room/room.obj"
printf 'o lamp\nf 1 2 3\no table\nf 4 5 6\no shelf\nf 7 8 9\n' >>"$work/room/room.obj"
mapfile -t examples < <(zcat "$page" | sed -n 's/\\-/-/g; s/^shaftcull \(cull\|draw\) /& /p')
equal "the number of examples in $page" ${#examples[@]} 3
for example in "${examples[@]}"; do
  (cd "$work/room" && PATH=$root/usr/bin:$PATH bash -c "$example") >"$work/log/output" 2>&1 ||
    fail "$example" "$(cat "$work/log/output")"
done
grep -q '</svg>' "$work/room/shaft.svg" || fail "the manual page's command draws no picture"
quietly "$program" hash --quick --family between
if "$program" --help | grep -q '^  verify '; then quietly "$program" verify --cases 20000; fi

# The Python module, where it was built.
if [[ " ${names[*]} " == *" python3-shaftcull "* ]]; then
  cat >"$work/question.py" <<'PY'
import numpy
import shaftcull

tree = shaftcull.BoxTree(numpy.array([[2, 4, 2, 3, 5, 3], [8, 0, 0, 9, 3, 1]], dtype=numpy.float32))
print(shaftcull.__version__, tree.cull([0, 9, 0, 1, 10, 1], [4, 0, 4, 6, 1, 6]))
PY
  # Python leaves what it compiled beside the module, as on a user's machine.
  answer=$(env -u PYTHONDONTWRITEBYTECODE -u PYTHONPYCACHEPREFIX PYTHONPATH="$root/usr/lib/python3/dist-packages" \
    /usr/bin/python3 "$work/question.py") || fail "Python does not import shaftcull, or does not answer"
  equal "the answer of Python" "$answer" "${version%-*} [ True False]"
  compiled=("$root"/usr/lib/python3/dist-packages/shaftcull/__pycache__/*)
  [[ ${#compiled[@]} -gt 0 ]] || fail "Python has compiled nothing, so that nothing shows whether it would be removed"
fi

# What Debian's own check finds. Overrides say why they are there.
if command -v lintian >/dev/null; then
  quietly lintian --allow-root --fail-on error,warning --tag-display-limit 0 "${debs[@]}"
else
  echo "Skipped: lintian, which is not installed"
fi

# Removed: nothing is left but dpkg's own database.
in_root --purge "${names[@]}"
rm -r "$root/var/lib/dpkg"
equal "what is left" "$(find "$root" -mindepth 1 ! -path "$root/var" ! -path "$root/var/lib")" ""
echo "Installed, used by C++ and C, and removed, in $SECONDS s"
