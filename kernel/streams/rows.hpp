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

/// What was written to rows, as kernels read it.
template <class View>
[[nodiscard]] View view_of(const RowsOf<View>& row, std::size_t count) noexcept {
  View view;
  for (std::size_t s = 0; s != row.size(); ++s) view.stream[s] = row[s];
  view.count = count;
  return view;
}

}  // namespace shaftcull::kernel
