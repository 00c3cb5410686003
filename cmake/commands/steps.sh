# SPDX-License-Identifier: MIT
# The steps of ./cmake/run test --ci and --all, each of them a command of ./cmake/run. Sourced by cmake/run.

# They are begun in this order, some at a time, since each has parts that keep few processors busy. The longest of --ci is the first,
# and goes before the others where processors are few. The tests of the page ask the program that `test --layer` builds.
ci_steps=(
  "test --layer ci"
  "format --check"
  "tidy --changed"
  "test --preset asan --layer ci"
  "bare"
  "package --try"
  "page --check"
  "test --preset tsan --layer ci"
)
all_steps=(
  "test --layer all"
  "format --check"
  "docs"
  "page --check"
  "package --check"
  "release --check HEAD"
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
  "mutate --layer every"
  "tidy"
  "bare ./cmake/run demo && ./cmake/run test"
)

# run_steps NUMBER STEP…: the steps, so many at once. Fails if one has failed. When one of --ci has failed, no other is begun.
run_steps() {
  local step failed= first=$2
  for step in "${@:2}"; do
    while [[ $(jobs -rp | wc -l) -ge $1 ]]; do wait -n || failed=yes; done
    if [[ $step == page* ]]; then
      until [[ -x $root/build/release/bin/shaftcull || $(jobs -rp | wc -l) -eq 0 ]]; do wait -n || failed=yes; done
    fi
    if [[ ! $record_changes ]] && grep -q $'\tFAILED' "$record"; then break; fi
    run_step "$step" $([[ $record_changes || $step == "$first" ]] || echo nice -n 5) &
  done
  while [[ $(jobs -p | wc -l) -gt 0 ]]; do wait -n || failed=yes; done
  [[ ! $failed ]]
}

# end_steps prints the table, and ends what is still running: Ctrl-C does not reach commands that run at the same time as others.
end_steps() {
  local pid
  for pid in $(jobs -p); do end_tree "$pid"; done
  print_steps
}

# end_tree PID: ends a process, and then those that it has started.
end_tree() {
  local child children
  children=$(cat "/proc/$1/task/"*/children 2>/dev/null || true)
  kill "$1" 2>/dev/null || true
  for child in $children; do end_tree "$child"; done
}

# run_step STEP [COMMAND…]: ./cmake/run with the words of the step, started by the command. SHAFTCULL_STEP is `yes`, or of --all the
# state of the files that the step reads. Its output goes to a file, and from there
# to the standard output when the step has ended, so that outputs of two steps do not mix; what it installs is announced at once.
# Adds a line to the table of steps.
run_step() {
  local start=$SECONDS status=0 result=passed words log first=() spent TIMEFORMAT='%0U %0S'
  read -ra words <<<"$1"
  if [[ ${words[0]} == bare && ${#words[@]} -gt 1 ]]; then words=(bare "${1#bare }"); fi
  if [[ ! $may_install ]]; then first=(--no-install); fi
  log=$(mktemp)
  echo "begins: ./cmake/run $1"
  { time SHAFTCULL_STEP=${state[$1]} "${@:2}" "$root/cmake/run" "${first[@]}" "${words[@]}" 3>&1 </dev/null >"$log" 2>&1; } 2>"$log.time" || status=$?
  read -ra spent <"$log.time"
  case $status in
    0) ;;
    77) result=skipped ;;
    *) result=FAILED ;;
  esac
  if [[ $record_changes ]] && [[ $(state_of_sources "$1") != "${state[$1]}" ]]; then result="$result, while sources changed"; fi
  {
    flock 9
    printf '%s\t%s\t%d\t%s\t%d\n' "${state[$1]}" "$result" $((SECONDS - start)) "$1" $((spent[0] + spent[1])) >>"$record"
    printf '\n==== ./cmake/run %s: %s\n' "$1" "$result"
    cat "$log"
  } 9>>"$record"
  rm "$log" "$log.time"
  [[ $status -eq 0 || $status -eq 77 ]]
}

# print_steps: the table of the steps that were run on these sources, the last time each.
print_steps() {
  printf '\n'
  awk -F '\t' -v states="${state[*]}" '
    index(" " states " ", " " $1 " ") { if (!($4 in result)) order[++n] = $4; result[$4] = $2; seconds[$4] = $3; spent[$4] = $5 }
    END {
      for (i = 1; i <= n; ++i) {
        step = order[i]
        printf "%-7s %6d s, %5d s of a processor  ./cmake/run %s\n", result[step], seconds[step], spent[step], step
        all += spent[step]
      }
      printf "%-7s %6d s, %5d s of a processor  in all\n", "", now, all
    }' now="$SECONDS" "$record"
}

# check_ci: the steps of .ci/run.
check_ci() {
  record=$(mktemp)
  record_changes=
  local step
  declare -gA state=()
  for step in "${ci_steps[@]}"; do state[$step]=yes; done
  trap 'end_steps; rm -f "$record"' EXIT
  trap 'exit 130' INT TERM
  run_steps 3 "${ci_steps[@]}"
}

# state_of_sources STEP: a word that changes with the files that the step reads. The steps that take longest do not read pages of
# documentation; that of a release reads the number of the commit.
state_of_sources() {
  local files=(.)
  case $1 in "test --preset "* | fuzz* | verify* | mutate* | tidy) files=(. ':!*.md') ;; esac
  (cd "$root" && {
    [[ $1 != release* ]] || git rev-parse HEAD
    git ls-files --stage -- "${files[@]}"
    git diff -- "${files[@]}"
    git ls-files --others --exclude-standard -z -- "${files[@]}" | xargs -0 -r sha1sum
  } | sha1sum | cut -c 1-12)
}

# check_all: all steps, for hours. Steps that have passed on the same sources are not run again, so that a run can be stopped and goes
# on when the same command is given. A step that fails does not stop the others.
check_all() {
  local step left=()
  declare -gA state=()
  record=$root/build/all_checks.tsv
  record_changes=yes
  mkdir -p "$root/build"
  touch "$record"
  git -C "$root" rev-parse --verify -q HEAD >/dev/null ||
    stop "cmake/run: test --all asks git which sources it has tested, and git does not answer here."
  trap end_steps EXIT
  trap 'exit 130' INT TERM
  for step in "${all_steps[@]}"; do
    state[$step]=$(state_of_sources "$step")
    awk -F '\t' -v state="${state[$step]}" -v step="$step" '
      $1 == state && $4 == step { passed = $2 == "passed" } END { exit !passed }' "$record" || left+=("$step")
  done
  [[ ${#left[@]} -eq 0 ]] || run_steps 2 "${left[@]}"
}
