#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What ./cmake/run says and does on systems that lack something: run with stand-ins for apt-get, sudo, cmake and the others.
#
#   tests/first_command.sh          ends with 77, "skipped", where it cannot take root's rights away from itself
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
chmod 755 "$work"
mkdir -p "$work/project/cmake" "$work/bin" "$work/log"
cp -r "$project/cmake/run" "$project/cmake/commands" "$work/project/cmake/"
chmod 777 "$work/log"

as_user=()
if [[ $EUID -eq 0 ]]; then
  command -v setpriv >/dev/null || { echo "Skipped: root, and no setpriv" && exit 77; }
  as_user=(setpriv --reuid=65534 --regid=65534 --clear-groups)
fi

# Stand-ins: each writes down how it was called. The environment says how apt-get ends and which packages are installed.
for name in awk bash dirname env getconf; do ln -s "$(command -v $name)" "$work/bin/"; done
stand_in() {
  printf '#!%s\necho "%s $*" >>"%s/log/calls"\n%s\n' "$(command -v bash)" "$1" "$work" "$2" >"$work/bin/$1"
  chmod 755 "$work/bin/$1"
}

failures=0
# system TOOL…: what the next run finds on its PATH, besides what every system has.
system() {
  rm -f "$work"/bin/{apt-get,apt-cache,dpkg,dpkg-query,sudo,cmake,ctest,c++,clang++-19,ninja,node,npm}
  for tool in "$@"; do
    case $tool in
      apt-get) stand_in apt-get 'exit ${APT_RESULT:-0}' ;;
      dpkg-query) stand_in dpkg-query 'for package in ${INSTALLED:-}; do
        for state in ${ARCHITECTURES:-all:installed}; do echo "${package%%:*}:$state"; done
      done' ;;
      sudo) stand_in sudo 'exec "$@"' ;;
      *) stand_in "$tool" 'exit 0' ;;
    esac
  done
}
# run RESULT [NAME=value…]: ./cmake/run $action, not as root, is to end with RESULT.
action=(demo)
run() {
  local expected=$1 result=0
  shift
  : >"$work/log/calls"
  chmod 666 "$work/log/calls"
  "${as_user[@]}" "$work/bin/env" -i PATH="$work/bin" "$@" bash "$work/project/cmake/run" "${action[@]}" >"$work/log/output" 2>&1 ||
    result=$?
  [[ $result -eq $expected ]] || fail "ended with $result instead of $expected"
}
fail() {
  printf 'FAILED, %s: %s\n' "$scenario" "$1"
  sed 's/^/    /' "$work/log/output" "$work/log/calls"
  failures=$((failures + 1))
}
says() { grep -qF -- "$1" "$work/log/output" || fail "does not say \"$1\""; }
called() { grep -qF -- "$1" "$work/log/calls" || fail "did not call \"$1\""; }
not_called() { ! grep -q "^$1 " "$work/log/calls" || fail "called $1"; }

needed="libtbb-dev libxsimd-dev libcli11-dev libfmt-dev nlohmann-json3-dev zlib1g-dev"
optional="libassimp-dev"

scenario="another distribution, nothing installed"
system
run 1
says "not found: c++ cmake ninja."
says "no apt-get"
says "oneTBB"
not_called cmake

scenario="another distribution, a library is missing: cmake names it"
system c++ ninja
stand_in cmake 'exit 1'
run 1
called "cmake --preset release"
says "in all, the build needs a C++20 compiler"

scenario="neither root nor sudo"
system apt-get dpkg-query
run 1
says "only root can install them"
says "  apt-get update && apt-get install --no-install-recommends g++ cmake ninja-build $needed $optional"
not_called apt-get
not_called cmake

scenario="nothing may be installed"
system apt-get dpkg-query sudo
action=(--no-install demo)
run 1
says "packages are missing, and --no-install was given"
says "  apt-get update && apt-get install --no-install-recommends g++ cmake ninja-build $needed $optional"
not_called apt-get
not_called sudo
action=(demo)

scenario="neither root nor sudo, only optional packages are missing"
system apt-get dpkg-query c++ cmake ninja
run 127 INSTALLED="$needed"  # 127: the stand-in for cmake built no program that could be run
says "goes on without $optional"
not_called apt-get
called "cmake --build"

scenario="sudo"
system apt-get dpkg-query sudo c++ cmake ninja
run 127
called "sudo apt-get update"
called "apt-get install -qy --no-install-recommends $needed $optional"
says "./cmake/run demo needs Debian packages that are not installed: $needed."
says "It can do more with: $optional."
says "It installs them now, with sudo"
says "To install nothing: ./cmake/run --no-install demo"
called "cmake --build"

scenario="sudo, but no network"
system apt-get dpkg-query sudo c++ cmake ninja
run 1 APT_RESULT=100
says "could not be installed"
says "Nothing was configured or built"
says "  apt-get update && apt-get install --no-install-recommends $needed $optional"
not_called cmake

scenario="sudo, but no network, and only optional packages are missing"
run 127 APT_RESULT=100 INSTALLED="$needed"
says "goes on without $optional"
called "cmake --build"

scenario="everything installed"
run 127 INSTALLED="$needed $optional"
not_called apt-get
not_called sudo
called "cmake --build"

# The quick tests need no more than the library and GoogleTest.
action=(test)
scenario="test, sudo"
system apt-get dpkg-query sudo c++ cmake ctest ninja
run 0 INSTALLED="libtbb-dev"
called "apt-get install -qy --no-install-recommends libxsimd-dev libgtest-dev libgmock-dev libgmp-dev"
called "--target shaftcull_quick_tests"
called "ctest --preset release --parallel"
says "building"

# This system knows two of the packages that tests of embedding need. They are not of one group.
action=(test --layer all)
tests_need="clang libgtest-dev libgmock-dev libgmp-dev libbenchmark-dev qemu-user valgrind doxygen mkdocs mkdocs-material"
knows() { stand_in apt-cache '[[ $2 == clang-19 || $2 == g++-12-multilib ]]'; }

scenario="all tests, sudo"
system apt-get dpkg-query sudo c++ cmake ctest ninja
knows
run 0 INSTALLED="$needed $optional $tests_need"
called "apt-get install -qy --no-remove --no-install-recommends clang-19"
called "apt-get install -qy --no-remove --no-install-recommends g++-12-multilib"
called "ctest --preset release"

scenario="all tests, sudo, but no network"
run 0 APT_RESULT=100 INSTALLED="$needed $optional $tests_need"
says "goes on without clang-19"
says "goes on without g++-12-multilib"
called "ctest --preset release"

scenario="all tests, neither root nor sudo"
system apt-get dpkg-query c++ cmake ctest ninja
knows
run 0 INSTALLED="$needed $optional $tests_need"
says "goes on without clang-19"
says "goes on without g++-12-multilib"
not_called apt-get
called "ctest --preset release"

# A step of test --ci builds what needs no more than the quick tests, while it installs the rest.
action=(test --layer ci)
scenario="a step of CI, sudo"
system apt-get dpkg-query sudo c++ cmake ctest ninja
knows
step_run() { run "$@" SHAFTCULL_STEP=yes 3>>"$work/log/announced"; }
step_run 0 INSTALLED="$needed libgtest-dev libgmock-dev libgmp-dev"
called "apt-get install -qy --no-install-recommends clang qemu-user valgrind doxygen mkdocs mkdocs-material $optional"
called "apt-get install -qy --no-remove --no-install-recommends clang-19"
called "--target shaftcull_quick_tests"
called "--target shaftcull_ci_tests"

scenario="a step of CI, sudo, but no network"
step_run 1 APT_RESULT=100 INSTALLED="$needed libgtest-dev libgmock-dev libgmp-dev"
says "the packages could not be installed"
not_called ctest

# Another processor's cross compiler is not there, its library of tests is.
action=(test --preset arm64 --only same_bits)
scenario="test of another processor, sudo"
system apt-get dpkg dpkg-query sudo c++ cmake ctest ninja
run 0 INSTALLED="libcli11-dev nlohmann-json3-dev libgtest-dev:arm64"
called "sudo dpkg --add-architecture arm64"
called "apt-get install -qy --no-install-recommends g++-aarch64-linux-gnu qemu-user libtbb-dev:arm64 libgmock-dev:arm64"
called "cmake --build $work/project/build/arm64"
called "--target test_same_bits"
called "ctest --preset arm64"

# For Windows, nothing is emulated: qemu is not asked for.
action=(test --preset windows --only same_bits)
windows_needs="libz-mingw-w64-dev libboost-dev"
scenario="test of Windows, sudo"
system apt-get dpkg-query sudo cmake ctest ninja
run 0 INSTALLED="wine64 googletest libxsimd-dev libcli11-dev libfmt-dev nlohmann-json3-dev"
called "apt-get install -qy --no-install-recommends g++-mingw-w64-x86-64-posix $windows_needs"
not_called dpkg
called "cmake --build $work/project/build/windows"
called "--target test_same_bits"
called "ctest --preset windows"

scenario="test of Windows, neither root nor sudo"
system apt-get dpkg-query cmake ctest ninja
run 1 INSTALLED="wine64 googletest libxsimd-dev libcli11-dev libfmt-dev nlohmann-json3-dev"
says "  apt-get update && apt-get install --no-install-recommends g++-mingw-w64-x86-64-posix $windows_needs"
not_called cmake

# The page: it is made in the project's folder, of what npm installs.
action=(page)
mkdir -p "$work/project/bindings/web/page"
cp "$project"/bindings/web/page/package*.json "$work/project/bindings/web/page/"
chmod 777 "$work/project"
for name in cp mkdir rm; do ln -s "$(command -v $name)" "$work/bin/"; done
web_needs="libc++-19-dev-wasm32 libc++abi-19-dev-wasm32 libclang-rt-19-dev-wasm32"
scenario="page, sudo"
system apt-get dpkg-query sudo cmake ninja clang++-19 node npm
run 0 INSTALLED="lld-19 wasi-libc"
called "apt-get install -qy --no-install-recommends $web_needs"
called "--target shaftcull_web"
called "npm ci --prefix $work/project/build/page-work"
called "node $work/project/bindings/web/page/build.mjs"

scenario="page, npm does not reach its registry"
stand_in npm 'exit 1'
run 1 INSTALLED="lld-19 wasi-libc $web_needs"
says "The page needs npm's registry, which npm does not reach."
not_called node

scenario="page, npm reaches its registry, but does not install"
stand_in npm '[[ $1 == view ]]'
run 1 INSTALLED="lld-19 wasi-libc $web_needs"
says "npm reaches its registry, but did not install"
not_called node

scenario="page, an option that it has not"
action=(page --chek)
run 1
says 'page takes --check or nothing, not "--chek"'
not_called npm

scenario="WebAssembly, sudo"
action=(test --preset wasm)
system apt-get dpkg-query sudo cmake ninja clang++-19 node ctest
run 0 INSTALLED="lld-19 wasi-libc $web_needs"
called "apt-get install -qy --no-install-recommends googletest libboost-dev"
called "--target shaftcull_tests"

scenario="everything installed for another processor, not for this one"
action=(demo)
system apt-get dpkg-query sudo c++ cmake ninja
run 127 INSTALLED="$needed $optional" ARCHITECTURES=arm64:installed
called "apt-get install -qy --no-install-recommends $needed"
scenario="everything installed for this processor and another one"
run 127 INSTALLED="dpkg $needed $optional" ARCHITECTURES=$'arm64:installed\nall:installed'
not_called apt-get

action=(test --preset arm64 --only same_bits)
scenario="test of another processor, neither root nor sudo"
system apt-get dpkg dpkg-query c++ cmake ctest ninja
run 1
says "  dpkg --add-architecture arm64 && apt-get update && apt-get install --no-install-recommends g++-aarch64-linux-gnu"
not_called dpkg

action=(package)
scenario="package, another distribution"
system c++ cmake ninja
run 1
says "only Debian and its like make Debian packages"
not_called cmake

scenario="package, sudo, but no network"
system apt-get dpkg-query sudo c++ cmake ninja
stand_in dpkg-deb 'exit 0'
run 1 APT_RESULT=100 INSTALLED="$needed $optional libgmp-dev"
says "apt-get install --no-install-recommends dpkg-dev file"
not_called cmake

action=(cluster)
scenario="cluster, sudo, but no network"
system apt-get dpkg-query sudo c++ cmake ninja
run 1 APT_RESULT=100 INSTALLED="$needed $optional libopenmpi-dev python3-numpy"
says "apt-get install --no-install-recommends libhdf5-openmpi-dev openmpi-bin libxxhash-dev python3-h5py"
not_called cmake

action=(report)
scenario="report, sudo, but no network"
system apt-get dpkg-query sudo c++ cmake ninja
run 1 APT_RESULT=100 INSTALLED=python3
says "apt-get install --no-install-recommends python3-matplotlib"
not_called cmake

scenario="report, another distribution"
system
run 1
says "not found: python3."
says "Python 3.9 with Matplotlib 3.6"

[[ $failures -eq 0 ]] || exit 1
echo "All scenarios as expected."
