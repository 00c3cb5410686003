# SPDX-License-Identifier: MIT
# Configures and builds. Sourced by cmake/run.

# Which instruction sets the presets release, asan and tsan have. What needs no others sets it to BEST.
instruction_sets=ALL

# configure_and_build PRESET [-D NAME=VALUE]… [TARGET…]; without a target, all are built. Options that an earlier command has turned on
# stay as they are. Two commands do not build in one folder at the same time: the second waits.
configure_and_build() {
  local preset=$1 options=() status=0
  shift
  if command -v flock >/dev/null; then
    mkdir -p "$root/build"
    exec 7>>"$root/build/$preset.lock"
    flock 7
  fi
  if [[ $preset == @(release|asan|tsan) ]]; then options+=(-D "SHAFTCULL_INSTRUCTION_SETS=$instruction_sets"); fi
  while [[ ${1:-} == -D ]]; do options+=(-D "$2") && shift 2; done
  if ! (cd "$root" && cmake --preset "$preset" "${options[@]}"); then
    command -v apt-get >/dev/null || stop "" "cmake/run: in all, the build needs $needed_elsewhere."
    exit 1
  fi
  cmake --build "$root/build/$preset" --parallel "$jobs" --target "${@:-all}" || status=$?
  exec 7>&-
  return $status
}
