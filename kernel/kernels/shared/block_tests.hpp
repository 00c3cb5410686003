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

/// The tests of a single bound, as Kernels has them.
template <class L, class Stages>
bool keeps_single(const ShaftData& shaft, const float* const* stream) noexcept {
  const WithPlanes completed(shaft, Stages::needs_planes(shaft));
  std::uint64_t kept = 0;
  Stages::cull(completed.shaft(), stream, 1, &kept);
  return kept != 0;
}

/// Whether a box, or the centre of a sphere, is not within the box around a shaft between two boxes. Then the bound is
/// not inside, whatever the joining planes are.
template <class Stages>
bool reaches_out(const ShaftData& shaft, const float* const* stream) noexcept {
  if (shaft.kind != ShaftData::Kind::between) return false;
  constexpr unsigned hi = Stages::streams == 6 ? 3 : 0;
  for (unsigned k = 0; k != 3; ++k) {
    const float below = *stream[k];
    const float above = *stream[k + hi];
    if ((below < shaft.a[k] && below < shaft.b[k]) || (above > shaft.a[k + 3] && above > shaft.b[k + 3])) return true;
  }
  return false;
}

/// Whether all corners of a box are in a shaft with closed contact. Then the box is inside, since a shaft is convex.
/// One test of eight points costs less than the joining planes of the shaft.
template <class Stages>
bool keeps_corners(const ShaftData& shaft, const float* const* stream) noexcept {
  float coordinate[3][8];
  for (unsigned k = 0; k != 3; ++k) {
    const float lo = *stream[k];
    const float hi = *stream[k + 3];
    if (!(lo <= hi)) return false;  // NaN: not inside
    for (unsigned corner = 0; corner != 8; ++corner) coordinate[k][corner] = (corner >> k & 1U) != 0 ? hi : lo;
  }
  const float* const corners[6] = {coordinate[0], coordinate[1], coordinate[2],
                                   coordinate[0], coordinate[1], coordinate[2]};
  std::uint64_t kept = 0;
  Stages::cull(shaft, corners, 8, &kept);
  return kept == 0xff;
}

template <class L, class Stages>
Answer classify_single(const ShaftData& shaft, const float* const* stream) noexcept {
  if (!keeps_single<L, Stages>(shaft, stream)) return Answer::outside;
  if (!shaft.has_planes()) {
    if (reaches_out<Stages>(shaft, stream)) return Answer::overlap;
    if constexpr (Stages::streams == 6) {
      if (shaft.contact == Contact::closed) {
        return keeps_corners<Stages>(shaft, stream) ? Answer::inside : Answer::overlap;
      }
    }
  }
  const WithPlanes completed(shaft, true);
  const std::uint64_t kept = 1;
  std::uint64_t inside = 0;
  Stages::find_inside(completed.shaft(), stream, 1, &kept, &inside);
  return inside == 0 ? Answer::overlap : Answer::inside;
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
