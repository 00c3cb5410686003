// SPDX-License-Identifier: MIT
#include "scenes/city_blocks.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "scenes/random.hpp"

namespace shaftcull::bench {
namespace {

constexpr unsigned lots = 100;  // along each side
constexpr unsigned lots_of_block = 4;
constexpr unsigned district = 20;  // lots along each side of those whose buildings have patches
constexpr double lot = 22;
constexpr double street = 14;
constexpr double block = lots_of_block * lot + street;
constexpr unsigned blocks = lots / lots_of_block;
constexpr double side = blocks * block;

/// The middle of lot i along a side of the city, whose own middle is at 0.
double lot_middle(unsigned i) {
  const unsigned blocks_before = i / lots_of_block;
  return blocks_before * block + (i % lots_of_block + 0.5) * lot + street / 2 - side / 2;
}

}  // namespace

PatchScene city_blocks(PatchSize size, std::uint32_t seed) {
  PatchSceneMaker maker(size);
  Random random(seed);
  const auto between = [&random](float low, float high) { return static_cast<double>(random.uniform(low, high)); };
  constexpr auto half_side = static_cast<float>(side / 2);
  maker.add_box({{-half_side, -half_side, -1}, {half_side, half_side, 0}});
  constexpr unsigned first = (lots - district) / 2;
  for (unsigned i = 0; i != lots; ++i) {
    for (unsigned j = 0; j != lots; ++j) {
      const std::array<double, 2> middle{lot_middle(i), lot_middle(j)};
      // Towers in the middle, houses at the edge.
      const double distance = std::sqrt(middle[0] * middle[0] + middle[1] * middle[1]) / 300;
      const double tallest = 15 + 100 / (1 + distance * distance);
      const double top = 6 + (tallest - 6) * between(0, 1);
      const std::array<double, 2> half{between(5, 7.5F), between(5, 7.5F)};
      const bool with_patches = i - first < district && j - first < district;
      if (random.below(3) == 0) {
        const Turn turn(between(0, 1));
        const TurnedBox box = turned_box(middle, half, 0, top, turn);
        maker.add_turned(box);
        if (!with_patches) continue;
        for (std::size_t axis = 0; axis != 3; ++axis) {
          if (axis != 2) maker.cut_face(box, turn, axis, false, 0);
          maker.cut_face(box, turn, axis, true, 0);
        }
        continue;
      }
      const Box box{
          {static_cast<float>(middle[0] - half[0]), static_cast<float>(middle[1] - half[1]), 0},
          {static_cast<float>(middle[0] + half[0]), static_cast<float>(middle[1] + half[1]), static_cast<float>(top)}};
      maker.add_box(box);
      if (!with_patches) continue;
      for (std::size_t axis = 0; axis != 3; ++axis) {
        if (axis != 2) maker.cut_face(box, axis, false, 0);
        maker.cut_face(box, axis, true, 0);
      }
    }
  }
  return maker.take();
}

}  // namespace shaftcull::bench
