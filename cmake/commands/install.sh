# SPDX-License-Identifier: MIT
# Finds and installs packages. Sourced by cmake/run.

# Debian's packages. Behind a colon stands a command, if any other build of that command will do, or an architecture.
library_packages=(g++:c++ cmake:cmake ninja-build:ninja libtbb-dev libxsimd-dev)
program_packages=(libcli11-dev libfmt-dev nlohmann-json3-dev zlib1g-dev)
test_packages=(libgtest-dev libgmock-dev libgmp-dev)
bench_packages=(libbenchmark-dev)
clang_packages=(clang:clang++)
sanitizer_packages=(clang:clang++ libclang-rt-dev llvm:llvm-symbolizer)
docs_packages=(doxygen:doxygen mkdocs:mkdocs mkdocs-material)
# For WebAssembly: the npm package, the page, and the tests of the library.
web_packages=(cmake:cmake ninja-build:ninja clang-19:clang++-19 lld-19 libc++-19-dev-wasm32 libc++abi-19-dev-wasm32 wasi-libc
  libclang-rt-19-dev-wasm32 nodejs:node)
needed_for_web="CMake 3.22, Ninja, clang 19 with lld and libc++ for wasm32-wasi, Node.js 18"
# For the program's `batch`: it is not built without HDF5 and xxHash, and runs in one process without MPI.
batch_packages=(libhdf5-openmpi-dev libopenmpi-dev openmpi-bin libxxhash-dev python3-numpy python3-h5py)

# Groups of packages for tests that are skipped without them. Each group is installed as a whole or not at all.
embedding_packages=(pkg-config:pkg-config clang-14:clang++-14 clang-19:clang++-19 lld:ld.lld)
libcxx_versions=(16 19)
bits_32_packages=(g++-12-multilib)  # g++-multilib and cross compilers exclude each other
arm64_packages=(qemu-user:qemu-aarch64 g++-aarch64-linux-gnu:aarch64-linux-gnu-g++)
s390x_packages=(qemu-user:qemu-s390x g++-s390x-linux-gnu:s390x-linux-gnu-g++)
riscv64_packages=(qemu-user:qemu-riscv64 g++-riscv64-linux-gnu:riscv64-linux-gnu-g++)
windows_packages=(g++-mingw-w64-x86-64-posix:x86_64-w64-mingw32-g++-posix wine64)
# The Python package is not built without the first three. Some of its tests are skipped without the others, and the test of the
# report page is without Matplotlib.
python_packages=(python3-dev python3-numpy pybind11-dev python3-pytest python3-build python3-setuptools python3-wheel mypy
  python3-mpi4py openmpi-bin python3-dask python3-matplotlib)

# What the command needs, what it goes on without, and what other systems call all that.
packages=()
optional_packages=()
needed_elsewhere=
foreign_architecture=
may_install=yes

# announce LINE…: what is about to be installed. A step of test --ci writes to a file, so it announces on descriptor 3 as well.
announce() {
  printf '%s\n' "$@"
  if [[ ${SHAFTCULL_STEP:-} ]]; then printf '%s\n' "$@" >&3; fi
}

stop() {
  printf '%s\n' "$@" >&2
  exit 1
}

# for_library, for_program, for_tests, for_bench: packages that building each of these needs.
for_library() {
  packages+=("${library_packages[@]}")
  needed_elsewhere="a C++20 compiler, CMake 3.22, Ninja, oneTBB, xsimd 8.1"
}
for_program() {
  packages+=("${program_packages[@]}")
  optional_packages+=(libassimp-dev libgmp-dev)  # to read mesh files; for the subcommand `verify`
  needed_elsewhere+=", CLI11, fmt, nlohmann-json, zlib; to read mesh files, assimp; for \`verify\`, GMP"
}
for_tests() {
  packages+=("${test_packages[@]}")
  needed_elsewhere+=", GoogleTest, GMP with its C++ interface"
}
for_bench() {
  packages+=("${bench_packages[@]}" libcli11-dev libfmt-dev nlohmann-json3-dev)
  needed_elsewhere+=", Google Benchmark"
}

# for_processor ARCHITECTURE CPU: packages of a preset whose programs are for another processor: a cross compiler, an emulator, and
# that architecture's libraries, which Debian keeps beside this machine's own once it knows the architecture.
for_processor() {
  local library
  foreign_architecture=$1
  packages=("g++-$2-linux-gnu:$2-linux-gnu-g++" "qemu-user:qemu-$2" cmake:cmake ninja-build:ninja libcli11-dev nlohmann-json3-dev)
  for library in libtbb libgtest libgmock libbenchmark libfmt libgmp; do packages+=("$library-dev:$1"); done
  # Not zlib1g-dev of that architecture: it needs that architecture's libc6-dev, whose version may differ.
  packages+=("zlib1g:$1" zlib1g-dev)
  needed_elsewhere="CMake 3.22, Ninja, a cross compiler and qemu-$2; and for that processor oneTBB, GoogleTest, Google Benchmark,
fmt, GMP and zlib"
}

# for_windows: packages of the preset windows: a cross compiler, wine, zlib for Windows, the sources of GoogleTest, and libraries
# that are headers alone.
for_windows() {
  packages=("g++-mingw-w64-x86-64-posix:x86_64-w64-mingw32-g++-posix" wine64:wine64 cmake:cmake ninja-build:ninja libz-mingw-w64-dev
    googletest libboost-dev libxsimd-dev libcli11-dev libfmt-dev nlohmann-json3-dev)
  needed_elsewhere="mingw-w64 with g++ 12 and threads of POSIX, wine, CMake 3.22, Ninja, zlib for Windows, the sources of GoogleTest
in /usr/src/googletest, Boost, xsimd 8.1, CLI11, fmt and nlohmann-json (or newer ones)"
}

# for_wasm: packages of the preset wasm, whose programs Node.js runs; the sources of GoogleTest, and Boost.
for_wasm() {
  packages=("${web_packages[@]}" googletest libboost-dev)
  needed_elsewhere="$needed_for_web, the sources of GoogleTest in /usr/src/googletest and Boost"
}

# Whether a package is there, for this machine's own architecture unless it names another one.
installed() {
  local own lines
  own=$(dpkg-query -W -f='${Architecture}' dpkg 2>/dev/null || true)
  lines=$(dpkg-query -W -f='${Architecture}:${db:Status-Status}\n' "$1" 2>/dev/null || true)
  [[ $'\n'$lines$'\n' == *$'\n'@(all|"$own"|"${1#*:}"):installed$'\n'* ]]
}

# missing PACKAGE[:COMMAND | :ARCHITECTURE]… prints those that are not there, each once.
missing() {
  local package command
  for package in "$@"; do
    command=
    if [[ $package == *:* && ${package#*:} != "$foreign_architecture" ]]; then
      command=${package#*:}
      package=${package%%:*}
    fi
    if [[ $command ]] && command -v "$command" >/dev/null; then continue; fi
    if command -v apt-get >/dev/null; then
      installed "$package" || echo "$package"
    elif [[ $command ]]; then
      echo "$command"
    fi
  done | awk '!seen[$0]++'
}

# apt_get ARGUMENT…: apt-get with root's rights, for one command at a time. Before it installs, it asks if there is somebody to ask.
apt_get() {
  local as_root=()
  if command -v flock >/dev/null; then
    mkdir -p "$root/build"
    exec 8>>"$root/build/apt.lock"
    flock 8
  fi
  if [[ $EUID -ne 0 ]]; then as_root=(sudo); fi
  if [[ $1 == install && (! -t 0 || ${CI:-}) ]]; then
    as_root+=(env DEBIAN_FRONTEND=noninteractive)
    set -- install -qy "${@:2}"
  fi
  local status=0
  "${as_root[@]}" apt-get "$@" || status=$?
  exec 8>&-
  return $status
}

# install_missing installs the packages that are missing. Without what is needed, the command ends.
install_missing() {
  local needed optional
  mapfile -t needed < <(missing "${packages[@]}")
  mapfile -t optional < <(missing "${optional_packages[@]}")
  if ! command -v apt-get >/dev/null; then
    [[ ${#needed[@]} -gt 0 ]] || return 0
    stop "cmake/run: not found: ${needed[*]}." \
      "This system has no apt-get. Please install, in its own way: $needed_elsewhere." \
      "Then run the same command again."
  fi
  local all=("${needed[@]}" "${optional[@]}")
  [[ ${#all[@]} -gt 0 ]] || return 0
  local by_hand="apt-get update && apt-get install --no-install-recommends ${all[*]}"
  if [[ $foreign_architecture ]]; then by_hand="dpkg --add-architecture $foreign_architecture && $by_hand"; fi
  if [[ ! $may_install || ($EUID -ne 0 && ! -x $(command -v sudo)) ]]; then
    [[ ${#needed[@]} -gt 0 ]] || { echo "cmake/run: goes on without ${optional[*]}" && return 0; }
    stop "cmake/run: packages are missing, and $([[ $may_install ]] && echo "only root can install them" || echo "--no-install was given"). As root, run:" \
      "  $by_hand" "Then run the same command again."
  fi
  announce "./cmake/run ${command_line[*]} needs Debian packages that are not installed: ${needed[*]:-none}."
  if [[ ${#optional[@]} -gt 0 ]]; then announce "It can do more with: ${optional[*]}."; fi
  announce "It installs them now, $([[ $EUID -eq 0 ]] && echo "as root" || echo "with sudo"): $by_hand" \
    "To install nothing: ./cmake/run --no-install ${command_line[*]}"
  if ! { { [[ ! $foreign_architecture ]] || add_architecture; } && apt_get update -q &&
    apt_get install --no-install-recommends "${all[@]}"; }; then
    [[ ${#needed[@]} -gt 0 ]] || { echo "cmake/run: goes on without ${optional[*]}" && return 0; }
    stop "" "cmake/run: the packages could not be installed; the messages above say why. Nothing was configured or built." \
      "apt-get needs the network, or a mirror or cache that it knows, and root's rights. By hand, as root:" "  $by_hand" \
      "Then run the same command again."
  fi
}

add_architecture() {
  local as_root=()
  if [[ $EUID -ne 0 ]]; then as_root=(sudo); fi
  "${as_root[@]}" dpkg --add-architecture "$foreign_architecture"
}

# install_known TESTS PACKAGE… installs those of the packages that this system has. Nothing is removed for them. Some of these
# tests are skipped without them.
install_known() {
  command -v apt-get >/dev/null || return 0
  local tests=$1 package wanted known=()
  shift
  mapfile -t wanted < <(missing "$@")
  for package in "${wanted[@]}"; do
    if apt-cache show "$package" >/dev/null 2>&1; then known+=("$package"); fi
  done
  [[ ${#known[@]} -gt 0 ]] || return 0
  if [[ $may_install && ($EUID -eq 0 || -x $(command -v sudo)) ]]; then
    announce "Tests of $tests use Debian packages that are not installed; they are installed now: ${known[*]}"
    if apt_get install --no-remove --no-install-recommends "${known[@]}"; then return 0; fi
  fi
  echo "cmake/run: goes on without ${known[*]}, so some tests of $tests are skipped"
}

# unpack_libcxx VERSION… puts these versions of libc++ below build/libcxx. They are not installed: Debian's packages of them
# exclude each other.
unpack_libcxx() {
  command -v dpkg-deb >/dev/null || return 0
  local version work package
  for version in "$@"; do
    if [[ -d $root/build/libcxx/$version ]]; then continue; fi
    work=$root/build/libcxx/$version.part
    rm -rf "$work" && mkdir -p "$work"
    if (cd "$work" && apt-get download -q "libc++-$version-dev" "libc++abi-$version-dev" >/dev/null 2>&1 &&
      for package in *.deb; do dpkg-deb -x "$package" . && rm "$package"; done); then
      mv "$work" "$root/build/libcxx/$version"
    else
      rm -rf "$work"
      echo "cmake/run: goes on without libc++ $version, so a test of embedding is skipped"
    fi
  done
}
