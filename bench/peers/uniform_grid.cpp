// SPDX-License-Identifier: MIT
#include "peers/uniform_grid.hpp"

#include <algorithm>

namespace shaftcull::bench {
namespace {

float centre_of(const Box& box, std::size_t axis) { return 0.5F * (box.lo[axis] + box.hi[axis]); }

}  // namespace

UniformGrid::UniformGrid(std::span<const Box> boxes, float cell) : inverse_cell(1 / cell) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto by_centre = [k](const Box& a, const Box& b) { return centre_of(a, k) < centre_of(b, k); };
    const auto [least, most] = std::minmax_element(boxes.begin(), boxes.end(), by_centre);
    half[k] = 0.5F * (boxes[0].hi[k] - boxes[0].lo[k]);
    origin[k] = centre_of(*least, k);
    cells[k] = static_cast<int>((centre_of(*most, k) - origin[k]) * inverse_cell) + 1;
  }
  const auto cell_of = [this](const Box& box) {
    int at[3];
    for (std::size_t k = 0; k < 3; ++k) at[k] = static_cast<int>((centre_of(box, k) - origin[k]) * inverse_cell);
    const int number = (at[2] * cells[1] + at[1]) * cells[0] + at[0];
    return static_cast<std::size_t>(number);
  };
  first.assign(
      static_cast<std::size_t>(cells[0]) * static_cast<std::size_t>(cells[1]) * static_cast<std::size_t>(cells[2]) + 1,
      0);
  for (const Box& box : boxes) ++first[cell_of(box) + 1];
  for (std::size_t c = 1; c < first.size(); ++c) first[c] += first[c - 1];
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::vector<float>& stream : centre) stream.resize(boxes.size() + most_written_more);
  index.resize(boxes.size() + most_written_more);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const std::uint32_t place = next[cell_of(boxes[i])]++;
    for (std::size_t k = 0; k < 3; ++k) centre[k][place] = centre_of(boxes[i], k);
    index[place] = static_cast<std::uint32_t>(i);
  }
}

#ifdef SHAFTCULL_BENCH_WITH_AVX2
extern SweepGrid* const avx2_sweep_grid;
#endif
#ifdef SHAFTCULL_BENCH_WITH_AVX512
extern SweepGrid* const avx512_sweep_grid;
#endif

SweepGrid* sweep_grid(Isa isa) noexcept {
  const std::vector<Isa> available = available_isas();
  if (std::find(available.begin(), available.end(), isa) == available.end()) return nullptr;
#ifdef SHAFTCULL_BENCH_WITH_AVX2
  if (isa == Isa::avx2) return avx2_sweep_grid;
#endif
#ifdef SHAFTCULL_BENCH_WITH_AVX512
  if (isa == Isa::avx512) return avx512_sweep_grid;
#endif
  return nullptr;
}

}  // namespace shaftcull::bench
