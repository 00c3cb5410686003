#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs a small job of `shaftcull batch` in one process and on ranks, and compares both files.
#
#   programs/batch/small_job.sh PROGRAM [RANKS]     RANKS: 2 unless said
set -euo pipefail
program=$1
ranks=${2:-2}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# Debian's Python has Debian's NumPy, whichever one comes first.
python=python3
if [[ -x /usr/bin/python3 ]]; then python=/usr/bin/python3; fi
"$python" - <<'PY'
import numpy
source = numpy.random.default_rng(1)
def boxes(count, size):
    low = source.uniform(0, 100, (count, 3))
    return numpy.concatenate([low, low + source.uniform(0, size, (count, 3))], 1).astype("float32")
numpy.save("bounds.npy", boxes(200_000, 1))
numpy.save("patches.npy", boxes(2_000, 2))
numpy.save("pairs.npy", source.integers(0, 2_000, (200_000, 2)))
PY
ask=(batch --bounds bounds.npy --shafts pairs.npy --boxes patches.npy --answer list --block 5000)

echo "In one process:"
"$program" "${ask[@]}" --out alone.h5
launch=(mpirun -n "$ranks")
if mpirun --version 2>&1 | grep -q 'Open MPI'; then
  launch+=(--oversubscribe --bind-to none)
  if [[ $EUID -eq 0 ]]; then launch+=(--allow-run-as-root); fi
fi
threads=$((($(getconf _NPROCESSORS_ONLN) + ranks - 1) / ranks))
printf '\nOn %d ranks of %d threads:\n' "$ranks" "$threads"
"${launch[@]}" "$program" "${ask[@]}" --threads "$threads" --out ranks.h5
printf '\nOn %d ranks, with bounds in shares of 8 MB:\n' "$ranks"
"${launch[@]}" "$program" "${ask[@]}" --threads "$threads" --memory 8 --out shares.h5
cmp alone.h5 ranks.h5
cmp alone.h5 shares.h5
printf '\nAll three files are the same: %d bytes.\n' "$(stat -c %s alone.h5)"
