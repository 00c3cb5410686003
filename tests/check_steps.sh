#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Steps of ./cmake/run test --ci and --all: what is run, again and not again, and what their table says. Stand-ins take the place
# of ./cmake/run itself.
#
#   tests/check_steps.sh          ends with 77, "skipped", where there is no git
set -euo pipefail
shopt -s extglob
command -v git >/dev/null || { echo "Skipped: there is no git" && exit 77; }
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@b GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@b
unset GIT_DIR GIT_WORK_TREE SHAFTCULL_STEP

mkdir -p "$work/project/cmake"
cp -r "$project/cmake/commands" "$work/project/cmake/"
cat >"$work/project/cmake/run" <<'TXT'
#!/usr/bin/env bash
echo "output of $*"
echo "announced by $*" >&3
case $1 in
  fails) exit 1 ;;
  skipped) exit 77 ;;
  lasts)
    sleep 600 &
    echo $! >"${0%/cmake/run}/build/lasting"
    wait
    ;;
  *) [[ $* != *--no-install* || $1 == --no-install ]] ;;
esac
TXT
chmod 755 "$work/project/cmake/run"
echo build/ >"$work/project/.gitignore"
git -C "$work/project" init -q
git -C "$work/project" add -A
git -C "$work/project" commit -qm "Stand-ins"

# run ci|all STEP…: runs the steps, in a shell of its own; their output is in the file output.
run() {
  exec >"$work/output" 2>&1
  root=$work/project jobs=2 command_line=()
  source "$root/cmake/commands/install.sh"
  source "$root/cmake/commands/steps.sh"
  may_install=${with_install-yes}
  ci_steps=("${@:2}") all_steps=("${@:2}")
  "check_$1"
}

# check RESULT ci|all STEP…: the steps are to end with RESULT.
check() {
  local expected=$1 result=0
  (run "${@:2}") || result=$?
  [[ $result -eq $expected ]] || fail "$2 of ${*:3} ended with $result instead of $expected"
}
failures=0
fail() {
  printf 'FAILED: %s\n' "$1"
  sed 's/^/    /' "$work/output"
  failures=$((failures + 1))
}
says() { grep -qE -- "$1" "$work/output" || fail "does not say \"$1\""; }
says_not() { ! grep -qE -- "$1" "$work/output" || fail "says \"$1\""; }

check 1 all "passes one" "skipped two" "fails three" "bare a && b"
says "^passed +[0-9]+ s, +[0-9]+ s of a processor  ./cmake/run passes one$"
says "^skipped +[0-9]+ s, +[0-9]+ s of a processor  ./cmake/run skipped two$"
says "^FAILED +[0-9]+ s, +[0-9]+ s of a processor  ./cmake/run fails three$"
says "^output of bare a && b$"
says "^announced by passes one$"

check 1 all "passes one" "skipped two" "fails three" "bare a && b"
says_not "^begins: ./cmake/run (passes|bare)"  # they passed on these sources
says "^begins: ./cmake/run skipped two$"
says "^begins: ./cmake/run fails three$"
says "^passed +[0-9]+ s, +[0-9]+ s of a processor  ./cmake/run passes one$"

echo "a change" >"$work/project/a file"
check 0 all "passes one"
says "^begins: ./cmake/run passes one$"
echo "another change" >"$work/project/a file"
check 0 all "passes one"
says "^begins: ./cmake/run passes one$"
check 0 all "passes one"
says_not "^begins"

steps=("test --preset one" "test --layer one" "release one")
check 0 all "${steps[@]}"
git -C "$work/project" commit -q --allow-empty -m "Another commit of the same files"
check 0 all "${steps[@]}"
[[ $(grep ^begins "$work/output") == "begins: ./cmake/run release one" ]] || fail "does not begin just the release again"
echo "a change" >"$work/project/page.md"
check 0 all "${steps[@]}"
says_not "^begins: ./cmake/run test --preset one$"  # it reads no pages
says "^begins: ./cmake/run test --layer one$"
says "^passed .* ./cmake/run test --preset one$"

check 0 ci "passes 1" "passes 2" "skipped 3" "passes 4" "passes 5"
says "^skipped +[0-9]+ s, +[0-9]+ s of a processor  ./cmake/run skipped 3$"
says "^passed +[0-9]+ s, +[0-9]+ s of a processor  ./cmake/run passes 5$"
check 1 ci "fails 1" "fails 2" "fails 3" "passes 4"  # three at a time
says_not "^begins: ./cmake/run passes 4$"

for steps in ci all; do  # ended while a step runs
  rm -rf "$work/project/build"
  mkdir "$work/project/build"
  run $steps "passes one" "lasts two" &
  ended=$!
  for ((i = 0; i < 300; ++i)); do
    if [[ -s $work/project/build/lasting ]] && grep -q "passes one: passed" "$work/output"; then break; fi
    sleep 0.1
  done
  kill "$ended"
  wait "$ended" 2>/dev/null || true
  says "^passed +[0-9]+ s, +[0-9]+ s of a processor  ./cmake/run passes one$"
  says_not "FAILED"
  for ((i = 0; i < 100; ++i)); do kill -0 "$(cat "$work/project/build/lasting")" 2>/dev/null || break; sleep 0.1; done
  [[ $i -lt 100 ]] || fail "$steps has ended, and a step still runs"
done

# Tests of a step that was stopped: ctest and all before it have stand-ins.
run_stopped_step() {
  (
    exec >"$work/output" 2>&1
    root=$work/project jobs=2
    source "$root/cmake/commands/test.sh"
    install_for_tests() { :; }
    configure_and_build() { :; }
    ctest() {
      echo "called: ctest $*"
      printf '1/3 Test  #1: one.two ......   Passed    0.10 sec\n2/3 Test #12: a_b ...***Failed    9.00 sec\n'
      printf '3/3 Test  #3: c ...........***Skipped   0.01 sec\n4/4 Test #4: six ... Passed 0.1 sec\n'
      return 8
    }
    SHAFTCULL_STEP=$1 run_tests --preset serial
  ) || true
}
rm -f "$work/project/build/serial.passed"
run_stopped_step state
says "^called: ctest --preset serial --parallel 2$"
run_stopped_step state
says "^goes on without 2 tests"
says '^called: ctest .* --no-tests=ignore --exclude-regex \^\(one\[\.\]two\|six\)\$$'
run_stopped_step another
says "^called: ctest --preset serial --parallel 2$"

with_install='' check 0 ci "passes 1"
says "^output of --no-install passes 1$"

mv "$work/project/.git" "$work/git"
export GIT_CEILING_DIRECTORIES=$work
check 1 all "passes one"
says "asks git which sources"

[[ $failures -eq 0 ]] || exit 1
echo "All steps as expected."
