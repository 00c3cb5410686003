# SPDX-License-Identifier: MIT
# Makes what is given to users: packages, the page, the documentation. Sourced by cmake/run.

# package [--check | --try]: Debian packages in build/packages; these, tried out; or such as are tried out only, in
# build/packages-tried, which are compiled in a third of the time: not optimised, for this machine's instruction sets, and without
# `verify`.
command_package() {
  local python compile link targets folder=packages optimised="-O3 -DNDEBUG" options=(-D SHAFTCULL_INSTRUCTION_SETS=AUTO) build
  command -v dpkg-deb >/dev/null ||
    stop "cmake/run: only Debian and its like make Debian packages. docs/packages.md has other ways to install."
  for_library
  for_verify
  packages+=(dpkg-dev:dpkg-shlibdeps file:file)
  if [[ ${1:-} == --@(check|try) ]]; then
    packages+=(pkg-config:pkg-config fakeroot:fakeroot)
    optional_packages+=(lintian)
  elif [[ $# -gt 0 ]]; then
    stop "cmake/run: package takes --check, --try or nothing, not \"$1\""
  fi
  # The Python module, where the sources have it, is made for Debian's Python.
  python=()
  if [[ -d $root/bindings/python ]]; then
    optional_packages+=(python3-dev python3-numpy pybind11-dev)
    python=(-D Python3_EXECUTABLE=/usr/bin/python3)
  fi
  install_missing
  cd "$root"
  # Debian's flags, without debugging information, which would be stripped. No -march: each instruction set has its own flags.
  export DEB_BUILD_MAINT_OPTIONS=hardening=+bindnow DEB_CXXFLAGS_MAINT_STRIP=-g
  if [[ ${1:-} == --try ]]; then
    folder=packages-tried optimised="-O0 -DNDEBUG"
    options=(-D SHAFTCULL_INSTRUCTION_SETS=BEST -D CMAKE_DISABLE_FIND_PACKAGE_GMP=ON)
    DEB_BUILD_MAINT_OPTIONS+=,-fortify  # which needs optimisation
  fi
  build=build/${folder/packages/package}
  compile="$(dpkg-buildflags --get CXXFLAGS) $(dpkg-buildflags --get CPPFLAGS)"
  link=$(dpkg-buildflags --get LDFLAGS)
  cmake --preset package -B "$build" -D CMAKE_CXX_FLAGS="$compile" -D CMAKE_CXX_FLAGS_RELEASE="$optimised" \
    "${options[@]}" -D CMAKE_EXE_LINKER_FLAGS="$link" \
    -D CMAKE_SHARED_LINKER_FLAGS="$link" -D CMAKE_MODULE_LINKER_FLAGS="$link" "${python[@]}"
  targets=(shaftcull shaftcull_c shaftcull_cli)
  if grep -q '^shaftcull_python:' < <(cmake --build "$build" --target help); then targets+=(shaftcull_python); fi
  cmake --build "$build" --parallel "$jobs" --target "${targets[@]}"
  rm -rf "build/$folder"
  # Files get the time of the changelog at the latest, so that the same sources give the same packages.
  SOURCE_DATE_EPOCH=$(dpkg-parsechangelog -l cmake/packaging/debian/changelog -S Timestamp) \
    cpack --config "$build/CPackConfig.cmake" -B "$root/build/$folder"
  rm -rf "build/$folder/_CPack_Packages"
  if [[ ${1:-} == --@(check|try) ]]; then tests/packages/check.sh "$root/build/$folder"; fi
}

# page [--check]
command_page() {
  local work
  packages=("${web_packages[@]}" npm:npm)
  needed_elsewhere="$needed_for_web and npm"
  if [[ ${1:-} == --check ]]; then
    packages+=(chromium:chromium)
    needed_elsewhere+=", and Chromium"
  elif [[ $# -gt 0 ]]; then
    stop "cmake/run: page takes --check or nothing, not \"$1\""
  fi
  install_missing
  configure_and_build web shaftcull_web
  work=$root/build/page-work
  mkdir -p "$work"
  cp "$root"/bindings/web/page/package*.json "$work"
  if npm ci --prefix "$work" --no-audit --no-fund --loglevel=error; then
    node "$root/bindings/web/page/build.mjs" --modules "$work/node_modules" "$root/build/web/shaftcull" "$root/build/page/index.html"
  elif npm view three version --fetch-retries=1 >/dev/null 2>&1; then
    stop "cmake/run: npm reaches its registry, but did not install what the page is made of; the messages above say why."
  else
    [[ ${1:-} == --check ]] || stop "cmake/run: the package is in build/web/shaftcull. The page needs npm's registry, which npm does not reach."
    rm -rf "$work/node_modules" "$root/build/page"
  fi
  if [[ ${1:-} == --check ]]; then "$root/bindings/web/tests/check.sh" "$root/build"; fi
}

# docs: the documentation as a site, build/docs/index.html
command_docs() {
  packages=("${docs_packages[@]}")
  needed_elsewhere="Doxygen, MkDocs 1.4 and its theme Material"
  install_missing
  "$root/cmake/site/build.sh" "$root/build/docs-work" "$root/build/docs"
}
