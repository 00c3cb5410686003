# SPDX-License-Identifier: MIT
# Tests: areas and layers, planted faults, made-up bytes, instruction counts, a bare machine. Sourced by cmake/run.

presets=(release debug asan tsan serial clang arm64 s390x windows wasm)

# install_for_tests PRESET LAYER AREA: what building and running these tests needs, and what some of them are skipped without.
install_for_tests() {
  use_packages_of "$@"
  install_missing
  if [[ $1 != release ]]; then return 0; fi
  if [[ $2 == @(ci|all) ]]; then
    install_known embedding "${embedding_packages[@]}"
    install_known "64-bit ARM" "${arm64_packages[@]}"
    install_known s390x "${s390x_packages[@]}"
  fi
  if [[ $2 == all ]]; then
    unpack_libcxx "${libcxx_versions[@]}"
    install_known "32-bit builds" "${bits_32_packages[@]}"
    install_known "64-bit RISC-V" "${riscv64_packages[@]}"
    install_known Windows "${windows_packages[@]}"
  fi
  if [[ $2 == @(ci|all) || $3 == python ]]; then install_known Python "${python_packages[@]}"; fi
  if [[ $2 == @(ci|all) || $3 == batch ]]; then install_known batch "${batch_packages[@]}"; fi
}

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

  if [[ $preset == release && $layer == ci && ${SHAFTCULL_STEP:-} ]]; then
    # Most of the packages are for a few tests, and take minutes to install. All other tests are built meanwhile.
    use_packages_of release quick ""
    install_missing
    installed=$SECONDS
    (packages=() optional_packages=() && install_for_tests release ci "") &
    configure_and_build release -D SHAFTCULL_BUILD_TESTS=ON shaftcull_quick_tests
    wait $!
  else
    install_for_tests "$preset" "$layer" "$area"
    installed=$SECONDS
  fi

  if [[ $preset == release ]]; then
    options=(-D SHAFTCULL_BUILD_TESTS=ON -D SHAFTCULL_BUILD_PYTHON=AUTO)
    if [[ $layer == @(ci|all) || $area == @(cli|batch) ]]; then options+=(-D SHAFTCULL_BUILD_PROGRAM=ON); fi
    if [[ $layer == all || $area == @(bench|paper) ]]; then options+=(-D SHAFTCULL_BUILD_BENCH=ON); fi
  fi
  case $layer in
    quick) instruction_sets=BEST targets=(shaftcull_quick_tests) filter=(--label-regex '^quick$') ;;
    ci) targets=(shaftcull_ci_tests) filter=(--label-regex '^(quick|ci)$') ;;
    all)
      if [[ $preset == @(asan|arm64|s390x|windows|wasm) ]]; then targets=(shaftcull_tests); fi
      if [[ $preset == tsan ]]; then targets=(test_dynamic_threads test_executor test_many test_many_tree test_planted_race test_same_bits test_visibility); fi
      ;;
  esac
  if [[ $area ]]; then targets=("test_$area") filter+=(-R "^$area([.]|\$)"); fi
  if [[ $preset == @(asan|tsan) && $layer == ci ]]; then instruction_sets=BEST; fi
  configure_and_build "$preset" "${options[@]}" "${targets[@]}"
  built=$SECONDS
  SHAFTCULL_TEST_LAYER=$layer run_ctest --preset "$preset" --parallel "$jobs" "${filter[@]}" "$@"
  printf '\n%d s on %d processors: packages %d, building %d, tests %d\n' $((SECONDS - start)) "$jobs" \
    $((installed - start)) $((built - installed)) $((SECONDS - built))
}

# of_all: whether this is a step of --all.
of_all() { [[ ${SHAFTCULL_STEP:-yes} != yes ]]; }

# goes_on FILE: whether a step of --all was stopped, and its files are still the same. Otherwise the file is new, and names them.
goes_on() {
  if [[ -f $1 && $(head -n 1 "$1") == "$SHAFTCULL_STEP" ]]; then return 0; fi
  echo "$SHAFTCULL_STEP" >"$1"
  return 1
}

# run_ctest --preset NAME option…: ctest. When a step of --all goes on, without the tests that have passed.
run_ctest() {
  if ! of_all; then
    (cd "$root" && ctest "$@")
    return
  fi
  local passed=$root/build/$2.passed names=() without=()
  if goes_on "$passed"; then mapfile -t -s 1 names <"$passed"; fi
  if [[ ${#names[@]} -gt 0 ]]; then
    without=(--no-tests=ignore --exclude-regex "^($(IFS='|' && echo "${names[*]//./[.]}"))\$")
    echo "goes on without ${#names[@]} tests that have passed on these files"
  fi
  (cd "$root" && ctest "$@" "${without[@]}") |
    awk -v passed="$passed" '{ print } $2 == "Test" && $(NF - 2) == "Passed" { print $4 >>passed } { fflush() }'
}

# test [--ci | --all | option…]
command_test() {
  case ${1:-} in
    --ci | --all)
      [[ $# -eq 1 ]] || { echo "cmake/run: test $1 takes nothing else, not \"$2\"" >&2 && exit 2; }
      "check_${1#--}"
      ;;
    *) run_tests "$@" ;;
  esac
}

# mutate [option…]
command_mutate() {
  local preset=release layer=quick
  if [[ $* =~ --preset[=\ ]([a-z0-9]+) ]]; then preset=${BASH_REMATCH[1]}; fi
  if [[ $* =~ --layer[=\ ]([a-z]+) ]]; then layer=${BASH_REMATCH[1]}; fi
  use_packages_of "$preset" "${layer/every/ci}" ""
  if [[ $layer == every ]]; then packages+=("${sanitizer_packages[@]}"); fi
  packages+=(python3:python3)
  install_missing
  if of_all && goes_on "$root/build/mutate.step"; then set -- "$@" --resume; fi
  "$root/tests/mutation/mutate.py" "$@"
}

# fuzz [seconds | --runs N]
command_fuzz() {
  local unit number ends
  case ${1:-} in
    --runs) unit="inputs behind --runs" number=${2:-} ends=(-runs="${2:-}" -seed=1) ;;
    *) unit=seconds number=${1:-60} ends=(-max_total_time="${1:-60}") ;;
  esac
  [[ $number =~ ^[0-9]+$ ]] || { echo "cmake/run: fuzz takes a number of $unit, not \"$number\"" >&2 && exit 2; }
  for_library
  for_tests
  packages+=("${sanitizer_packages[@]}")
  install_missing
  configure_and_build fuzz test_fuzz
  mkdir -p "$root/build/fuzz/corpus"
  # Loop counts and entropy guide libFuzzer little here and take half of the time; so do the traces of allocations.
  ASAN_OPTIONS=malloc_context_size=0:quarantine_size_mb=4 "$root/build/fuzz/tests/fuzz/test_fuzz" \
    "${ends[@]}" -max_len=256 -entropic=0 -use_counters=0 -print_final_stats=1 \
    -artifact_prefix="$root/build/fuzz/" "$root/build/fuzz/corpus" "$root/tests/fuzz/corpus"
}

# budget [--record | ctest option…]
command_budget() {
  for_library
  for_tests
  packages+=(valgrind:valgrind)
  install_missing
  configure_and_build release -D SHAFTCULL_BUILD_TESTS=ON test_budget
  if [[ ${1:-} == --record ]]; then
    cmake --build "$root/build/release" --target shaftcull_record_budget
  else
    (cd "$root" && ctest --preset release --label-regex '^budget$' --verbose "$@")
  fi
}

# bare [command]
command_bare() {
  packages=(debootstrap)
  if [[ $EUID -eq 0 ]] && command -v apt-get >/dev/null; then install_missing; fi
  local status=0
  "$root/tests/bare_machine.sh" "$@" || status=$?
  if [[ $status -ne 77 || ${SHAFTCULL_STEP:-} ]]; then exit "$status"; fi
}
