# SPDX-License-Identifier: MIT
# Which packages each command needs. Sourced by cmake/run.

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
embedding_packages=(pkg-config:pkg-config clang-14:clang++-14 clang-19:clang++-19 lld:ld.lld libembree-dev)
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

# for_library, for_program, for_verify, for_tests, for_bench: packages that building each of these needs.
for_library() {
  packages+=("${library_packages[@]}")
  needed_elsewhere="a C++20 compiler, CMake 3.22, Ninja, oneTBB, xsimd 8.1"
}
for_program() {
  packages+=("${program_packages[@]}")
  optional_packages+=(libassimp-dev)  # to read mesh files
  needed_elsewhere+=", CLI11, fmt, nlohmann-json, zlib; to read mesh files, assimp"
}
for_verify() {
  for_program
  packages+=(libgmp-dev)
  needed_elsewhere+="; for \`verify\`, GMP"
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

# use_packages_of PRESET LAYER AREA: what building and running these tests needs.
use_packages_of() {
  case $1 in
    arm64) for_processor arm64 aarch64 ;;
    s390x) for_processor s390x s390x ;;
    windows) for_windows ;;
    wasm) for_wasm ;;
    *)
      for_library
      for_tests
      if [[ $1 == tsan ]]; then packages+=("${sanitizer_packages[@]}") && return; fi
      if [[ $1 == asan ]]; then packages+=("${sanitizer_packages[@]}"); fi
      # Of release, the C interface is compiled by clang, too.
      if [[ $1 == clang || ($1 == release && $2 == @(ci|all)) ]]; then packages+=("${clang_packages[@]}"); fi
      if [[ $1 != release || $2 == @(ci|all) || $3 == @(cli|batch) ]]; then for_program; fi
      if [[ $1 != release || $2 == all || $3 == @(bench|paper) ]]; then for_bench; fi
      # Tests on emulated processors and of instruction budgets are skipped without them.
      if [[ $2 == @(ci|all) || $3 == budget ]] && command -v apt-get >/dev/null; then
        packages+=(qemu-user:qemu-x86_64)
        if [[ $1 == release ]]; then packages+=(valgrind:valgrind "${docs_packages[@]}"); fi
      fi
      ;;
  esac
}
