#!/bin/sh
# SPDX-License-Identifier: MIT
# Compiles SOURCE for 64-bit ARM with the includes of INCLUDE, and runs it emulated. Exit code 77 where the tools are missing.
source=$1
include=$2
program=$3
for clang in clang++-19 clang++-18 clang++-17 clang++-16 clang++; do
  command -v "$clang" >/dev/null && break
done
for tool in "$clang" ld.lld qemu-aarch64; do
  command -v "$tool" >/dev/null || { echo "Skipped: $tool was not found (Debian: clang, lld, qemu-user)."; exit 77; }
done
# Without a standard library for that processor: all that is asked of one is <cfloat>, which the compiler has as <float.h>.
mkdir -p "$program.include" && echo '#include <float.h>' >"$program.include/cfloat"
"$clang" --target=aarch64-linux-gnu -std=c++20 -O2 -Wall -Wextra -Werror -ffreestanding -fno-exceptions -nostdlib -static \
  -fuse-ld=lld -I "$include" \
  -isystem "$program.include" "$source" -o "$program" || exit 1
qemu-aarch64 "$program"
