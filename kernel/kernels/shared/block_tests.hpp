// SPDX-License-Identifier: MIT
/// From views to bits: blocks of bounds through the stages of a test.
#pragma once

#include <cstddef>
#include <cstdint>

#include "compiled/with_planes.hpp"
#include "kernels/shared/word.hpp"
#include "shaftcull/cull.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// Writes which bounds are inside of those that are not outside, for callers who do not ask which these are.
template <class Stages>
SHAFTCULL_COLD void find_inside_of_kept(const ShaftData& shaft, const float* const* stream, std::size_t count,
                                        std::uint64_t* inside) noexcept {
  std::uint64_t kept[block_words];
  Stages::cull(shaft, stream, count, kept);
  Stages::find_inside(shaft, stream, count, kept, inside);
}

/// Runs the `count` bounds of one block through the stages that the caller wants answers of.
template <class Stages>
void test_block(const ShaftData& shaft, const float* const* stream, std::size_t count, std::uint64_t* kept,
                std::uint64_t* inside) noexcept {
  if (kept != nullptr) Stages::cull(shaft, stream, count, kept);
  if (inside == nullptr) return;
  // With open contact, what lies in the shaft's surface is in the shaft, and outside.
  if (kept == nullptr && shaft.contact == Contact::open) [[unlikely]]
    return find_inside_of_kept<Stages>(shaft, stream, count, inside);
  Stages::find_inside(shaft, stream, count, kept, inside);
}

/// The test of an instruction set, as Kernels has it.
template <class L, class Stages>
void test_bounds(const ShaftData& shaft, const float* const* stream, std::size_t count, std::uint64_t* kept,
                 std::uint64_t* inside) noexcept {
  const WithPlanes completed(shaft, inside != nullptr || Stages::needs_planes(shaft));

  const float* at[Stages::streams];
  for (unsigned s = 0; s < Stages::streams; ++s) at[s] = stream[s];
  while (true) {
    const std::size_t block = count < block_bounds ? count : block_bounds;
    test_block<Stages>(completed.shaft(), at, block, kept, inside);
    count -= block;
    if (count == 0) return;
    for (const float*& s : at) s += block;
    if (kept != nullptr) kept += block_words;
    if (inside != nullptr) inside += block_words;
  }
}

/// As GridKernels has it.
template <class L, class Stages>
void finish_after_grid(const ShaftData& shaft, const float* const* stream, std::size_t count, std::uint64_t* kept,
                       std::uint64_t* inside) noexcept {
  const WithPlanes completed(shaft, inside != nullptr);
  Stages::finish(completed.shaft(), stream, count, kept);
  if (inside != nullptr) Stages::find_inside(completed.shaft(), stream, count, kept, inside);
}

}  // namespace shaftcull::kernel
