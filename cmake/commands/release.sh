# SPDX-License-Identifier: MIT
# Makes a release from a commit, and compares binary interfaces. Sourced by cmake/run. docs/releasing.md describes both.

# version_at FOLDER: the version of the sources there.
version_at() {
  sed -n 's/^#define SHAFTCULL_VERSION_\(MAJOR\|MINOR\|PATCH\) \([0-9]*\)$/\2/p' "$1/include/shaftcull/version.hpp" | paste -sd .
}

# unpack COMMIT FOLDER: puts the sources of a commit into a new folder.
unpack() {
  rm -rf "$2"
  mkdir -p "$2"
  git -C "$root" archive --format=tar "$1" | tar -x -C "$2"
}

# commit_of NAME: the commit that a tag, branch or hash names.
commit_of() {
  git -C "$root" rev-parse --verify --quiet "$1^{commit}" || stop "cmake/run: git knows no tag or commit \"$1\" here"
}

# release [--check] [COMMIT]
command_release() {
  local check= name version commit work out file
  if [[ ${1:-} == --check ]]; then check=yes && shift; fi
  [[ $# -le 1 && ${1:-} != -* ]] || stop "cmake/run: release takes --check and the name of a commit, not \"$*\""
  packages=(git:git)
  install_missing
  name=${1:-v$(version_at "$root")}
  commit=$(commit_of "$name") || exit 1
  work=$root/build/release-work
  unpack "$commit" "$work/first"
  version=$(version_at "$work/first")
  if [[ $name == v[0-9]* && $name != "v$version" ]]; then
    stop "cmake/run: the sources of $name are of version $version. Set the version in include/shaftcull/version.hpp, and move the tag."
  fi
  for file in CITATION.cff:"version: $version" cmake/packaging/vcpkg/shaftcull/vcpkg.json:"\"version\": \"$version\"" \
    cmake/packaging/debian/changelog:"shaftcull ($version-" docs/shaftcull.1:"\"shaftcull $version\"" CHANGELOG.md:"## $version"; do
    if grep -qF -- "${file#*:}" "$work/first/${file%%:*}"; then continue; fi
    if [[ $name == v[0-9]* ]]; then stop "cmake/run: ${file%%:*} of $name lacks \"${file#*:}\" (docs/releasing.md)"; fi
    echo "cmake/run: ${file%%:*} lacks \"${file#*:}\", which a tag would need"
  done
  for_library
  for_verify
  packages+=(dpkg-dev:dpkg-shlibdeps file:file python3-dev python3-numpy pybind11-dev python3-build python3-setuptools python3-wheel
    "${web_packages[@]}" npm:npm abigail-tools:abidiff)
  install_missing
  command -v dpkg-deb >/dev/null || stop "cmake/run: a release has Debian packages, which only Debian and its like make."
  compare_interfaces "$commit"
  make_release "$commit" "$version" "$work/first" "$work/files"
  if [[ $check ]]; then
    # In a folder whose name has another length.
    unpack "$commit" "$work/once_more_from_the_beginning"
    make_release "$commit" "$version" "$work/once_more_from_the_beginning" "$work/again"
    diff -r "$work/files" "$work/again" || stop "cmake/run: the files above differ when they are made again"
    echo "Made twice in two folders, with the same bits."
  fi
  out=$root/build/releases/$version
  rm -rf "$out"
  mkdir -p "$root/build/releases"
  mv "$work/files" "$out"
  rm -rf "$work"
  cat "$out/SHA256SUMS"
  echo "The release is in $out."
}

# make_release COMMIT VERSION SOURCES OUT: all files of a release, in a new folder. All times in them are that of the commit.
make_release() {
  local commit=$1 version=$2 sources=$3 out=$4 map="-ffile-prefix-map=$3=." deb
  export SOURCE_DATE_EPOCH
  SOURCE_DATE_EPOCH=$(git -C "$root" show -s --format=%ct "$commit")
  rm -rf "$out"
  mkdir -p "$out"
  git -C "$root" archive --format=tar --prefix="shaftcull-$version/" "$commit" | gzip -9n >"$out/shaftcull-$version.tar.gz"
  (
    cd "$sources"
    ./cmake/run --no-install package
    for deb in build/packages/*.deb; do cp "$deb" "$out"; done
    CMAKE_ARGS="-DCMAKE_CXX_FLAGS='$map' -DCMAKE_MODULE_LINKER_FLAGS=-s" \
      /usr/bin/python3 -m build --no-isolation --wheel --outdir "$out" bindings/python
    cmake --preset web -D CMAKE_CXX_FLAGS_RELEASE="-O3 -DNDEBUG $map"
    cmake --build build/web --parallel "$jobs" --target shaftcull_web
    npm pack --silent --pack-destination "$out" ./build/web/shaftcull >/dev/null
  )
  /usr/bin/python3 "$sources/cmake/packaging/bill_of_materials.py" "$sources" "$version" "$commit" "$out"
  (cd "$out" && find . -type f ! -name SHA256SUMS -printf '%P\0' | sort -z | xargs -0 sha256sum >SHA256SUMS)
}

# abi [COMMIT]
command_abi() {
  packages=(git:git abigail-tools:abidiff)
  for_library
  install_missing
  compare_interfaces "$(commit_of HEAD)" "${1:-}"
}

# compare_interfaces COMMIT [OLDER]: fails if a program that was linked with the older commit might not run with the shared libraries of
# the newer one. The older one is the last release with the same major version, unless another is named.
compare_interfaces() {
  local commit=$1 older=${2:-} work=$root/build/abi version name library status=0 side
  unpack "$commit" "$work/newer"
  version=$(version_at "$work/newer")
  if [[ ! $older ]]; then
    while read -r name; do
      if [[ $(commit_of "$name") != "$commit" ]]; then older=$name && break; fi
    done < <(git -C "$root" tag --list "v${version%%.*}.*" --sort=-version:refname --merged "$commit")
    if [[ ! $older ]]; then
      echo "No earlier release has the major version ${version%%.*}, so there is no interface to compare with."
      return 0
    fi
  fi
  unpack "$(commit_of "$older")" "$work/older"
  for side in older newer; do
    cmake -S "$work/$side" -B "$work/$side/build" -G Ninja -D CMAKE_BUILD_TYPE=Debug -D BUILD_SHARED_LIBS=ON \
      -D SHAFTCULL_INSTRUCTION_SETS=BEST >/dev/null
    cmake --build "$work/$side/build" --parallel "$jobs" --target shaftcull shaftcull_c
  done
  for library in kernel/libshaftcull.so bindings/c/libshaftcull_c.so; do
    abidiff --no-added-syms --headers-dir1 "$work/older/include" --headers-dir2 "$work/newer/include" \
      "$work/older/build/$library" "$work/newer/build/$library" || status=$?
  done
  [[ $status -eq 0 ]] || stop "cmake/run: programs that were linked with $older may not run with the libraries of $version." \
    "A change of the interface needs a new major version."
  echo "Programs that were linked with $older run with the libraries of $version."
}
