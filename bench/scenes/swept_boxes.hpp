// SPDX-License-Identifier: MIT
/// Swept boxes among many small ones: what trees are measured on, as a broad phase sees it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "scenes/random.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/streams.hpp"

namespace shaftcull::bench {

/// A box of half size `half` that travels up to `travel` per axis.
struct SweptSetting {
  const char* name;
  float half;
  float travel;
};

/// For a million boxes with half extents of 0.005–0.035 in ±5. The last finds most by far.
inline constexpr std::array swept_settings{SweptSetting{"tiny_short", 0.05F, 0.5F},
                                           SweptSetting{"tiny_long", 0.05F, 5.0F},
                                           SweptSetting{"big_short", 0.5F, 0.5F}, SweptSetting{"big_long", 0.5F, 5.0F}};

/// Boxes uniform in ±5, a million of half extents 0.005–0.035; more are smaller and fewer larger, so that together they
/// fill as much.
inline std::vector<Box> small_boxes(std::size_t count) {
  const float scale = std::cbrt(1e6F / static_cast<float>(count));
  Random random(4000);
  std::vector<Box> boxes(count);
  for (Box& box : boxes) box = random.box(0.005F * scale, 0.035F * scale);
  return boxes;
}

/// The start and the end of each of some swept boxes.
struct SweptBoxes {
  BoxStream from;
  BoxStream to;

  /// Small boxes in ±5, each swept so far in a direction of its own.
  SweptBoxes(std::size_t count, float length) {
    Random random(4002);
    std::vector<Box> start(count);
    std::vector<Box> end(count);
    for (std::size_t i = 0; i != count; ++i) {
      start[i] = random.box(0.05F, 0.05F);
      for (std::size_t k = 0; k != 3; ++k) {
        const float travel = random.uniform(-1.0F, 1.0F) * length;
        end[i].lo[k] = start[i].lo[k] + travel;
        end[i].hi[k] = start[i].hi[k] + travel;
      }
    }
    from = BoxStream(std::span<const Box>(start));
    to = BoxStream(std::span<const Box>(end));
  }

  SweptBoxes(std::size_t count, const SweptSetting& setting, float scale = 1.0F) {
    Random random(4001);
    std::vector<Box> start(count);
    std::vector<Box> end(count);
    const float half = setting.half * scale;
    for (std::size_t i = 0; i != count; ++i) {
      for (std::size_t k = 0; k != 3; ++k) {
        const float centre = random.uniform(-5.0F, 5.0F);
        const float goal = centre + random.uniform(-setting.travel, setting.travel) * scale;
        start[i].lo[k] = centre - half;
        start[i].hi[k] = centre + half;
        end[i].lo[k] = goal - half;
        end[i].hi[k] = goal + half;
      }
    }
    from = BoxStream(std::span<const Box>(start));
    to = BoxStream(std::span<const Box>(end));
  }
};

}  // namespace shaftcull::bench
