# SPDX-License-Identifier: MIT
# Configures and builds. Sourced by cmake/run.

# configure_and_build PRESET [-D NAME=VALUE]… [TARGET…]; without a target, all are built. Options that an earlier command has turned on
# stay as they are.
configure_and_build() {
  local preset=$1 options=()
  shift
  while [[ ${1:-} == -D ]]; do options+=(-D "$2") && shift 2; done
  if ! (cd "$root" && cmake --preset "$preset" "${options[@]}"); then
    command -v apt-get >/dev/null || stop "" "cmake/run: in all, the build needs $needed_elsewhere."
    exit 1
  fi
  cmake --build "$root/build/$preset" --parallel "$jobs" --target "${@:-all}"
}
