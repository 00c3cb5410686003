# SPDX-License-Identifier: MIT
# Builds the programs and runs them. Sourced by cmake/run.

# demo [option…]
command_demo() {
  for_library
  for_program
  install_missing
  instruction_sets=BEST
  configure_and_build release -D SHAFTCULL_BUILD_PROGRAM=ON shaftcull_cli
  "$root/build/release/bin/shaftcull" demo "$@"
}

# verify [N]
command_verify() {
  for_library
  for_verify
  install_missing
  configure_and_build release -D SHAFTCULL_BUILD_PROGRAM=ON shaftcull_cli
  "$root/build/release/bin/shaftcull" verify --cases "${1:-1000000}" --seed "$(date +%s)"
}

# bench [option…]
command_bench() {
  for_library
  for_bench
  # What ours is compared with; left out elsewhere if it is not there.
  if command -v apt-get >/dev/null; then packages+=(libbullet-dev libembree-dev libfcl-dev); fi
  install_missing
  configure_and_build release -D SHAFTCULL_BUILD_BENCH=ON shaftcull_bench
  mkdir -p "$root/build/bench"
  "$root/build/release/bin/shaftcull-bench" --out "$root/build/bench/summary.json" "$@"
}

# report [option…]: a page of plots, of what bench has measured
command_report() {
  local python=python3
  packages=(python3:python3 python3-matplotlib)
  needed_elsewhere="Python 3.9 with Matplotlib 3.6"
  install_missing
  # Debian's Python has Debian's Matplotlib, whichever Python comes first in the PATH.
  if [[ -x /usr/bin/python3 ]]; then python=/usr/bin/python3; fi
  "$python" "$root/bench/report.py" "$@"
}

# figures [summary]: whether the times that README, headers and pages give are those that bench has measured
command_figures() {
  packages=(python3:python3)
  needed_elsewhere="Python 3.9"
  install_missing
  python3 "$root/bench/figures.py" "$@"
}

# cluster [RANKS]
command_cluster() {
  local ranks=${1:-2}
  [[ $ranks =~ ^[1-9][0-9]*$ ]] || { echo "cmake/run: cluster takes a number of ranks, not \"$ranks\"" >&2 && exit 2; }
  for_library
  for_program
  packages+=("${batch_packages[@]}")
  needed_elsewhere+="; for batches, HDF5 1.10.5, xxHash 0.8, MPI 3 and, to try them out, NumPy"
  install_missing
  configure_and_build release -D SHAFTCULL_BUILD_PROGRAM=ON shaftcull_cli
  "$root/programs/batch/small_job.sh" "$root/build/release/bin/shaftcull" "$ranks"
}
