#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bench/cycles.sh: how many cycles a word of 64 boxes takes, in slab form and on a grid, as a simulator (llvm-mca) says. It reads the
# innermost loop as g++ compiles it, and supposes that all memory is in the first cache and no branch is mispredicted.
#
# Needs g++ for x86 and aarch64-linux-gnu-g++ (Debian: g++-aarch64-linux-gnu), and llvm-mca 19 (llvm-19; another one by LLVM_MCA).
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
mca=${LLVM_MCA:-llvm-mca-19}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# compile SET COMPILER [flag…]: $work/SET.s
compile() {
  "${@:2}" -std=c++20 -O3 -DNDEBUG -ffp-contract=off -fvisibility=hidden -fPIC -fno-asynchronous-unwind-tables -w \
    -I "$root/include" -I "$root/kernel" -S "$root/kernel/kernels/sets/$1_kernels.cpp" -o "$work/$1.s"
}
compile avx2 g++ -mavx2 -mfma -mbmi -mbmi2
compile neon aarch64-linux-gnu-g++

# loop SET FUNCTION: the longest loop that has no other one in it, of the function whose mangled name contains FUNCTION.
loop() {
  awk -v name="$2" '
    BEGIN { number = loops = 0 }
    /^_Z[^ ]*:/ && index($0, name) && !number { inside = 1; next }
    inside && /^[ \t]*\.size/ { inside = 0 }
    !inside { next }
    /^\.L[A-Za-z0-9_]+:/ { label = $1; sub(":.*", "", label); at[label] = number; next }
    /^[ \t]+[a-z]/ {
      line[number++] = $0
      if ($NF in at) { first[loops] = at[$NF]; last[loops++] = number - 1 }
    }
    END {
      best = -1
      for (i = 0; i < loops; ++i) {
        for (k = 0; k < loops; ++k) if (k != i && first[k] >= first[i] && last[k] <= last[i]) break
        if (k == loops && (best < 0 || last[i] - first[i] > last[best] - first[best])) best = i
      }
      if (best >= 0) for (l = first[best]; l <= last[best]; ++l) print line[l]
    }' "$work/$1.s"
}

# cycles SET WIDTH TRIPLE PROCESSOR FUNCTION PRODUCT: per word. A box takes five products; a vector has WIDTH of them.
cycles() {
  loop "$1" "$5" >"$work/loop.s"
  local products total
  products=$(grep -cE "$6" "$work/loop.s")
  total=$("$mca" -mtriple="$3" -mcpu="$4" -iterations=1000 "$work/loop.s" 2>/dev/null | awk '/^Total Cycles:/ { print $3 }')
  awk -v total="$total" -v boxes=$((products * $2 / 5)) 'BEGIN { printf "%.0f", total / 1000 * 64 / boxes }'
}
row() {
  local set=$1 width=$2 triple=$3 processor=$4 name=${#1}$1
  local slab="10slab_wordsINS0_${name}6FloatsENS0_10BoxCornersENS0_16ConsecutiveWordsIS3_EELj3ELNS0_9ShaftData8SlabFormE0"
  local grid="10grid_wordsINS0_${name}6FloatsELj2ELj0E"
  printf '| `%s` | %s | %s | %s |\n' "$set" "$processor" \
    "$(cycles "$set" "$width" "$triple" "$processor" "$slab" '^[[:space:]]*(fmla|vfn?madd)')" \
    "$(cycles "$set" $((2 * width)) "$triple" "$processor" "$grid" '^[[:space:]]*(sqrdmulh|vpmulhrsw)')"
}
echo '| set | processor | slab form | on a grid |'
echo '|---|---|---|---|'
for processor in haswell icelake-server znver4; do row avx2 8 x86_64-linux-gnu $processor; done
for processor in neoverse-v2 apple-m1; do row neon 4 aarch64-linux-gnu $processor; done
