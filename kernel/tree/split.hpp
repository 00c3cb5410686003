// SPDX-License-Identifier: MIT
/// Halving a part of the entries that a tree is built from.
#pragma once

#include <cstddef>

#include "kernels/kernel_table.hpp"
#include "tree/entries.hpp"

namespace shaftcull::kernel {

/// What is at places [first, last) of tree order: entries of some streams. Scratch streams have space for them at the
/// same place.
struct Part {
  std::size_t first;
  std::size_t last;
  const EntryStreams* entries;
  const EntryStreams* scratch;
  std::size_t origin = 0;  ///< the place of the streams' first entry

  [[nodiscard]] std::size_t size() const noexcept { return last - first; }
};

struct Halves {
  Part low;
  Part high;
};

/// Halves a part at `cut`, a place within it, as SplitKernels in kernels/kernel_table.hpp says.
Halves split(const Part& part, std::size_t cut, const Kernels& kernels) noexcept;

/// The same halves, made by all threads of the caller's arena. Worth it for parts of at least so many entries.
inline constexpr std::size_t fewest_for_parallel_split = 65536;
Halves split_in_parallel(const Part& part, std::size_t cut, const Kernels& kernels);

}  // namespace shaftcull::kernel
