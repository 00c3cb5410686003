// SPDX-License-Identifier: MIT
/// The answers of one shaft for a few bounds, tested on a grid (kernel/kernels/grid/forming.hpp). The library does so
/// for many shafts and bounds only, so the bounds are put into a whole tile, and the shaft into a group of shafts.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include "shaftcull/compiled.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull {

/// As many bounds and shafts are tested on a grid; cull/agreement.cpp and cull/grid_shafts.cpp check that they are.
inline constexpr std::size_t bounds_on_grid = 2048;
inline constexpr std::size_t shafts_on_grid = 8;

/// As classify() gives them.
struct GridAnswers {
  std::vector<std::uint64_t> kept;
  std::vector<std::uint64_t> inside;  ///< empty if it was not asked for
};

/// A box around both boxes of a shaft, larger by 2^doublings than it must be.
inline Box frame_around(const CompiledShaft& shaft, unsigned doublings) {
  const Box a = shaft.a();
  const Box b = shaft.b();
  const auto finite = [](double x) {  // a hull without end has an infinite box
    constexpr auto most = static_cast<double>(std::numeric_limits<float>::max());
    return std::clamp(x, -most, most);
  };
  double lo[3];
  double hi[3];
  double size = 0;
  for (std::size_t k = 0; k != 3; ++k) {
    lo[k] = finite(static_cast<double>(std::min(a.lo[k], b.lo[k])));
    hi[k] = finite(static_cast<double>(std::max(a.hi[k], b.hi[k])));
    size = std::max(size, hi[k] - lo[k]);
  }
  const double beyond = 0.5 * size * static_cast<double>((1U << doublings) - 1U);
  Box frame{};
  for (std::size_t k = 0; k != 3; ++k) {
    frame.lo[k] = static_cast<float>(finite(lo[k] - beyond));
    frame.hi[k] = static_cast<float>(finite(hi[k] + beyond));
  }
  return frame;
}

/// Bits 0, apart, 2 · apart, …, `count` of them, side by side.
inline std::vector<std::uint64_t> every_bit(const std::vector<std::uint64_t>& row, std::size_t apart,
                                            std::size_t count) {
  std::vector<std::uint64_t> bits(bit_words(count));
  for (std::size_t i = 0; i != count; ++i) bits[i / 64] |= (row[i * apart / 64] >> i * apart % 64 & 1U) << i % 64;
  return bits;
}

/// The grid's steps double with `doublings`. At most `bounds_on_grid` bounds, that many places `apart`, which decides
/// how many share a word.
template <class View>
GridAnswers grid_answers(const CompiledShaft& shaft, const View& few, unsigned doublings, std::size_t apart = 1) {
  constexpr std::size_t streams = std::tuple_size_v<decltype(View::stream)>;
  constexpr bool boxes = streams == 6;
  std::vector<float> memory(streams * bounds_on_grid);
  View tile;
  tile.count = bounds_on_grid;
  for (std::size_t s = 0; s != streams; ++s) {
    // The rest is empty boxes, or spheres with a negative radius: outside of everything.
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const float nowhere = boxes ? (s < 3 ? infinity : -infinity) : (s < 3 ? 0.0F : -1.0F);
    float* const stream = memory.data() + s * bounds_on_grid;
    std::fill_n(stream, bounds_on_grid, nowhere);
    for (std::size_t i = 0; i != few.count; ++i) stream[i * apart] = few.stream[s][i];
    tile.stream[s] = stream;
  }
  const Box frame = frame_around(shaft, doublings);
  std::vector<CompiledShaft> group(shafts_on_grid, compile(frame, frame));
  group.front() = shaft;
  GridAnswers rows;
  rows.kept.resize(group.size() * bit_words(bounds_on_grid));
  rows.inside.resize(rows.kept.size());
  classify_many(group, tile, rows.kept, rows.inside);
  rows.kept = every_bit(rows.kept, apart, few.count);
  rows.inside = every_bit(rows.inside, apart, few.count);
  return rows;
}

}  // namespace shaftcull
