// SPDX-License-Identifier: MIT
/// The sweep of uniform_grid.hpp, written once for vectors V: a unit of each instruction set gives it its own.
#pragma once

#include <algorithm>
#include <cmath>

#include "peers/uniform_grid.hpp"

namespace shaftcull::bench {
namespace {

/// V has width, Vector, all(x), load(p), multiply_add(x, y, z), add, subtract, minimum, maximum, less_equal(x, y) as
/// bits, and write(indices, bits, out), which writes those of `width` indices whose bits are set.
template <class V>
std::size_t sweep(const UniformGrid& grid, const Box& from, const Box& to, std::uint32_t* found) noexcept {
  using Vector = typename V::Vector;
  int low[3];
  int high[3];
  Vector inverse[3];  // of the travel
  Vector minus_start[3];
  Vector half_length[3];
  for (unsigned k = 0; k < 3; ++k) {
    const float start = 0.5F * (from.lo[k] + from.hi[k]);
    const float end = 0.5F * (to.lo[k] + to.hi[k]);
    const float size = 0.5F * (from.hi[k] - from.lo[k]) + grid.half[k];
    const auto cell_of = [&](float x) {
      return std::clamp(static_cast<int>((x - grid.origin[k]) * grid.inverse_cell), 0, grid.cells[k] - 1);
    };
    low[k] = cell_of(std::min(start, end) - size);
    high[k] = cell_of(std::max(start, end) + size);
    const float travel = end - start;
    const float inverse_travel = std::fabs(travel) > 1e-20F ? 1 / travel : 1e20F;
    inverse[k] = V::all(inverse_travel);
    minus_start[k] = V::all(-start * inverse_travel);
    half_length[k] = V::all(size * std::fabs(inverse_travel));
  }

  const std::uint32_t* out = found;
  std::uint32_t* next = found;
  for (int z = low[2]; z <= high[2]; ++z) {
    for (int y = low[1]; y <= high[1]; ++y) {
      const std::uint32_t* const row = grid.first.data() + (z * grid.cells[1] + y) * grid.cells[0];
      const std::uint32_t end = row[high[0] + 1];
      for (std::uint32_t i = row[low[0]]; i < end; i += V::width) {
        Vector enter = V::all(0.0F);
        Vector leave = V::all(1.0F);
        for (unsigned k = 0; k < 3; ++k) {
          const Vector middle = V::multiply_add(V::load(grid.centre[k].data() + i), inverse[k], minus_start[k]);
          enter = V::maximum(enter, V::subtract(middle, half_length[k]));
          leave = V::minimum(leave, V::add(middle, half_length[k]));
        }
        const unsigned left = end - i;
        const unsigned wanted = left < V::width ? (1U << left) - 1 : (1U << V::width) - 1;
        next += V::write(grid.index.data() + i, V::less_equal(enter, leave) & wanted, next);
      }
    }
  }
  return static_cast<std::size_t>(next - out);
}

}  // namespace
}  // namespace shaftcull::bench
