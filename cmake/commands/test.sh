# SPDX-License-Identifier: MIT
# Builds, and runs tests. Sourced by cmake/run.

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

presets=(release debug asan tsan serial clang arm64 s390x windows wasm)

# run_tests [--preset NAME] [--layer quick|ci|all] [--only AREA] [ctest option…]
run_tests() {
  local preset= layer= area= options=() targets=() filter=() start=$SECONDS installed built
  while [[ ${1:-} == --@(preset|layer|only)?(=*) ]]; do
    if [[ $1 != *=* ]]; then set -- "$1=${2:?"$1 needs a value"}" "${@:3}"; fi
    case $1 in
      --preset=*) preset=${1#*=} ;;
      --layer=*) layer=${1#*=} ;;
      --only=*) area=${1#*=} ;;
    esac
    shift
  done
  if [[ ! $layer ]]; then layer=$([[ $preset || $area ]] && echo all || echo quick); fi
  preset=${preset:-release}
  [[ $layer == @(quick|ci|all) ]] || stop "cmake/run: there is no layer \"$layer\" of tests, only quick, ci and all"
  [[ " ${presets[*]} " == *" $preset "* ]] || stop "cmake/run: there is no preset \"$preset\" of tests, only ${presets[*]}"
  if [[ $area && $preset == release && $layer == all ]]; then layer=area; fi  # of release, one area needs little of the rest

  use_packages_of "$preset" "$layer" "$area"
  install_missing
  if [[ $preset == release && $layer == @(ci|all) ]]; then
    install_known embedding "${embedding_packages[@]}"
    install_known "64-bit ARM" "${arm64_packages[@]}"
    install_known s390x "${s390x_packages[@]}"
  fi
  if [[ $preset == release && $layer == all ]]; then
    unpack_libcxx "${libcxx_versions[@]}"
    install_known "32-bit builds" "${bits_32_packages[@]}"
    install_known "64-bit RISC-V" "${riscv64_packages[@]}"
    install_known Windows "${windows_packages[@]}"
  fi
  if [[ $preset == release && ($layer == @(ci|all) || $area == python) ]]; then install_known Python "${python_packages[@]}"; fi
  if [[ $preset == release && ($layer == @(ci|all) || $area == batch) ]]; then install_known batch "${batch_packages[@]}"; fi
  installed=$SECONDS

  if [[ $preset == release ]]; then
    options=(-D SHAFTCULL_BUILD_TESTS=ON -D SHAFTCULL_BUILD_PYTHON=AUTO)
    if [[ $layer == @(ci|all) || $area == @(cli|batch) ]]; then options+=(-D SHAFTCULL_BUILD_PROGRAM=ON); fi
    if [[ $layer == all || $area == @(bench|paper) ]]; then options+=(-D SHAFTCULL_BUILD_BENCH=ON); fi
  fi
  case $layer in
    quick) targets=(shaftcull_quick_tests) filter=(--label-regex '^quick$') ;;
    ci) targets=(shaftcull_ci_tests) filter=(--label-regex '^(quick|ci)$') ;;
    all)
      if [[ $preset == @(asan|arm64|s390x|windows|wasm) ]]; then targets=(shaftcull_tests); fi
      if [[ $preset == tsan ]]; then targets=(test_many test_many_tree test_planted_race test_same_bits test_visibility); fi
      ;;
  esac
  if [[ $area ]]; then targets=("test_$area") filter+=(-R "^$area([.]|\$)"); fi
  if [[ $preset == @(asan|tsan) && $layer == ci ]]; then
    # Instruction sets that the best one includes are left out, as for anybody who builds for one processor (kernel/simd/baseline.hpp).
    options=(-D "CMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g1 -DNDEBUG -march=native")
  fi
  configure_and_build "$preset" "${options[@]}" "${targets[@]}"
  built=$SECONDS
  (cd "$root" && ctest --preset "$preset" --parallel "$jobs" "${filter[@]}" "$@")
  printf '\n%d s on %d processors: packages %d, building %d, tests %d\n' $((SECONDS - start)) "$jobs" \
    $((installed - start)) $((built - installed)) $((SECONDS - built))
}

# Steps of the layers above the quick one, each a command of ./cmake/run. Those of .ci/run are begun in this order, two at a time; the
# page comes last, as its tests ask the program that the first of them builds.
ci_steps=(
  "test --layer ci"
  "format --check"
  "tidy --changed"
  "test --preset asan --layer ci"
  "test --preset tsan --layer ci"
  "package --check"
  "bare"
  "page --check"
)
all_steps=(
  "format --check"
  "docs"
  "test --layer all"
  "page --check"
  "package --check"
  "package"
  "test --preset asan"
  "test --preset tsan"
  "test --preset clang"
  "test --preset debug"
  "test --preset serial"
  "fuzz 1800"
  "verify 20000000"
  "test --preset wasm"
  "test --preset windows"
  "test --preset arm64"
  "test --preset s390x"
  "mutate"
  "tidy"
  "bare ./cmake/run demo && ./cmake/run test"
)

# run_step STEP: ./cmake/run with the words of the step. Its output goes to a file, and from there to the standard output when the
# step has ended, so that outputs of two steps do not mix; what it installs is announced at once. Adds a line to the table of steps.
run_step() {
  local start=$SECONDS status=0 result=passed words log first=()
  read -ra words <<<"$1"
  if [[ ${words[0]} == bare && ${#words[@]} -gt 1 ]]; then words=(bare "${1#bare }"); fi
  if [[ ! $may_install ]]; then first=(--no-install); fi
  log=$(mktemp)
  echo "begins: ./cmake/run $1"
  SHAFTCULL_STEP=yes "$root/cmake/run" "${first[@]}" "${words[@]}" 3>&1 </dev/null >"$log" 2>&1 || status=$?
  case $status in
    0) ;;
    77) result=skipped ;;
    *) result=FAILED ;;
  esac
  if [[ $record_changes ]] && [[ $(state_of_sources) != "$sources" ]]; then result="$result, while sources changed"; fi
  {
    flock 9
    printf '%s\t%s\t%d\t%s\n' "$sources" "$result" $((SECONDS - start)) "$1" >>"$record"
    printf '\n==== ./cmake/run %s: %s\n' "$1" "$result"
    cat "$log"
  } 9>>"$record"
  rm "$log"
  [[ $status -eq 0 || $status -eq 77 ]]
}

# print_steps: the table of the steps that were run on these sources, the last time each.
print_steps() {
  printf '\n'
  awk -F '\t' -v sources="$sources" '
    $1 == sources { if (!($4 in result)) order[++n] = $4; result[$4] = $2; seconds[$4] = $3 }
    END { for (i = 1; i <= n; ++i) printf "%-7s %6d s  ./cmake/run %s\n", result[order[i]], seconds[order[i]], order[i] }' "$record"
  printf '%-7s %6d s  in all\n' "" "$SECONDS"
}

# check_ci: the steps of .ci/run. When one has failed, no other is begun.
check_ci() {
  local step failed=
  record=$(mktemp)
  record_changes=
  sources=here
  trap 'print_steps; rm -f "$record"' EXIT
  trap 'exit 130' INT
  for step in "${ci_steps[@]}"; do
    while [[ $(jobs -rp | wc -l) -ge 2 ]]; do wait -n || failed=yes; done
    [[ ! $failed ]] || break
    run_step "$step" &
  done
  while [[ $(jobs -p | wc -l) -gt 0 ]]; do wait -n || failed=yes; done
  [[ ! $failed ]]
}

# state_of_sources: a word that changes with the sources.
state_of_sources() {
  (cd "$root" && { git rev-parse HEAD && git diff HEAD && git ls-files --others --exclude-standard -z | xargs -0 -r sha1sum; } |
    sha1sum | cut -c 1-12)
}

# check_all: all steps, one after the other, for hours. Steps that have passed on the same sources are not run again, so that a run can
# be stopped and goes on when the same command is given. A step that fails does not stop the others.
check_all() {
  local step failed=0
  record=$root/build/all_checks.tsv
  record_changes=yes
  mkdir -p "$root/build"
  touch "$record"
  sources=$(state_of_sources) || stop "cmake/run: test --all asks git which sources it has tested, and git does not answer here."
  trap print_steps EXIT
  trap 'exit 130' INT
  for step in "${all_steps[@]}"; do
    if awk -F '\t' -v sources="$sources" -v step="$step" '
      $1 == sources && $4 == step { passed = $2 == "passed" } END { exit !passed }' "$record"; then continue; fi
    run_step "$step" || failed=1
  done
  exit $failed
}
