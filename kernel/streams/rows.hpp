// SPDX-License-Identifier: MIT
/// Rows: where the coordinates of bounds are written, in the order of a view's streams.
///
/// Bounds side by side are a view where they are read (BoxView, SphereView) and rows where they are written. Kernels
/// take the first element of either: `const float* const*` and `float* const*`.
#pragma once

#include <array>
#include <cstddef>
#include <tuple>

#include "shaftcull/streams.hpp"

namespace shaftcull::kernel {

/// How many coordinates a bound has: a box six, a sphere four.
template <class View>
inline constexpr std::size_t row_count = std::tuple_size_v<decltype(View::stream)>;

template <class View>
using RowsOf = std::array<float*, row_count<View>>;

/// The rows of an array of them.
template <std::size_t rows, std::size_t length>
[[nodiscard]] std::array<float*, rows> rows_in(float (&memory)[rows][length]) noexcept {
  std::array<float*, rows> row;
  for (std::size_t s = 0; s != rows; ++s) row[s] = memory[s];
  return row;
}

/// Words of 1 MiB. Rows that are a multiple of it apart share the same few places of caches and of the processor's page
/// tables: where 256 parts of six such rows are written in turn, that takes four times as long.
inline constexpr std::size_t far_apart_words = 4096;

/// Floats in each of `rows` rows of `count` floats and their padding. Rows that are a page apart would have to share a
/// set of the level 1 cache, which has eight places: nine are an odd number of words long.
[[nodiscard]] constexpr std::size_t row_floats(std::size_t rows, std::size_t count) noexcept {
  const std::size_t words = bit_words(count);
  return ((rows > 8 || words % far_apart_words == 0) && count != 0 ? words | 1U : words) * 64;
}

/// The view of rows of so many floats, one behind the other.
template <class View>
[[nodiscard]] View view_in(const float* memory, std::size_t count) noexcept {
  View view;
  if (count == 0) return view;
  for (std::size_t s = 0; s != row_count<View>; ++s) view.stream[s] = memory + s * row_floats(row_count<View>, count);
  view.count = count;
  return view;
}

/// What was written to rows, as kernels read it.
template <class View>
[[nodiscard]] View view_of(const RowsOf<View>& row, std::size_t count) noexcept {
  View view;
  for (std::size_t s = 0; s != row.size(); ++s) view.stream[s] = row[s];
  view.count = count;
  return view;
}

}  // namespace shaftcull::kernel
