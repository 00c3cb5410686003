# SPDX-License-Identifier: MIT
# Looks at the sources: format, licences, clang-tidy. Sourced by cmake/run.

# licence -i | --dry-run: adds to each source the line that says its licence, behind what runs a script; or fails if one lacks it.
# Sources of examples stay as they are, for pages show them whole, to be copied.
licence() {
  local source line lacking
  mapfile -t lacking < <(cd "$root" && find .ci/run CMakeLists.txt bench bindings cmake conformance docs include kernel programs tests -type f \
    ! -path '*/examples/*.c*' ! -path '*/examples/*.py' ! -path '*/build/*' \( -name '*.[ch]pp' -o -name '*.[ch]' \
    -o -name '*.cmake' -o -name CMakeLists.txt -o -name '*.sh' -o -name '*.py' -o -name '*.pyi' -o -name run \) \
    -exec grep -LE '^(//|#) SPDX-License-Identifier: MIT$' {} + | sort)
  [[ ${#lacking[@]} -gt 0 ]] || return 0
  if [[ $1 != -i ]]; then
    stop "${lacking[@]}" "" "cmake/run: these sources do not say their licence. ./cmake/run format adds it."
  fi
  for source in "${lacking[@]}"; do
    line='# SPDX-License-Identifier: MIT'
    case $source in *.[ch]pp | *.[ch]) line="//${line#\#}" ;; esac
    if [[ $(head -c 2 "$root/$source") == '#!' ]]; then
      sed -i "1a $line" "$root/$source"
    elif [[ -s $root/$source ]]; then
      sed -i "1i $line" "$root/$source"
    else
      echo "$line" >"$root/$source"
    fi
  done
}

# format [--check]
command_format() {
  local how
  # The version is part of the style: each formats a little differently.
  packages=(clang-format-14:clang-format-14)
  install_missing
  how=(-i)
  if [[ ${1:-} == --check ]]; then
    how=(--dry-run --Werror)
  elif [[ $# -gt 0 ]]; then
    stop "cmake/run: format takes --check or nothing, not \"$1\""
  fi
  licence "${how[0]}"
  find "$root/include" "$root/kernel" "$root/bindings" "$root/programs" "$root/conformance" "$root/bench" "$root/tests" "$root/docs/examples" \( -name '*.[ch]pp' -o -name '*.[ch]' \) -print0 |
    xargs -0 -P "$jobs" -n 64 clang-format-14 "${how[@]}" ||
    stop "" "cmake/run: not all sources are formatted. ./cmake/run format does it."
}

# tidy [--changed | file…]
command_tidy() {
  local how=() arguments=() joined=OFF sources changed base word
  for_library
  for_program
  for_tests
  for_bench
  packages+=("${clang_packages[@]}" clang-tidy-14:clang-tidy-14)
  install_missing
  # For the commands that sources are compiled with: one by one, or for all files in groups, since headers take most of the time.
  if [[ $# -eq 0 ]]; then joined=ON; fi
  (cd "$root" && cmake --preset clang -B build/tidy -D SHAFTCULL_JOIN_SOURCES=$joined -D CMAKE_DISABLE_PRECOMPILE_HEADERS=ON >/dev/null)
  sources=("$@")
  if [[ $# -eq 0 || $1 == --changed ]]; then
    mapfile -t sources < <(grep -o '"file": "[^"]*"' "$root/build/tidy/compile_commands.json" | cut -d '"' -f 4 |
      grep -v "^$root/build/.*/headers/" | sort -u)
    # Following all paths through a source takes three times as long as everything else that is looked for, so that is done
    # only for sources that are named.
    arguments+=(-analyzer-config mode=shallow)
  fi
  if [[ $# -eq 0 ]]; then
    arguments+=(-analyzer-opt-analyze-headers)  # else no function of a source that is included by its group is followed
    how+=(--checks=-bugprone-suspicious-include)
  fi
  for word in "${arguments[@]}"; do how+=(--extra-arg=-Xclang "--extra-arg=$word"); done
  if [[ ${1:-} == --changed ]]; then
    base=$(git -C "$root" merge-base HEAD origin/HEAD 2>/dev/null || true)
    if [[ -z $base || $base == $(git -C "$root" rev-parse HEAD) ]]; then base=HEAD~1; fi
    changed=$(cd "$root" && git diff --relative --name-only --diff-filter=d "$base" -- '*.cpp' 2>/dev/null) ||
      { echo "cmake/run: nothing to compare with, for this clone has only its last commit" && exit 0; }
    mapfile -t sources < <(printf '%s\n' "${sources[@]}" | grep -Fx -f <(sed "/./s|^|$root/|" <<<"$changed"))
    [[ ${#sources[@]} -gt 0 ]] || { echo "cmake/run: no source has changed" && exit 0; }
  fi
  printf '%s\0' "${sources[@]}" | xargs -0 -P "$jobs" -n 1 clang-tidy-14 -p "$root/build/tidy" --quiet "${how[@]}"
}
