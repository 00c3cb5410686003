// SPDX-License-Identifier: MIT
/// A group of shafts on a grid.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "compiled/moving_faces.hpp"
#include "compiled/shaft_data.hpp"
#include "flat/tiling.hpp"
#include "kernels/grid/forming.hpp"
#include "kernels/kernel_table.hpp"
#include "query/bound_streams.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// Whether a tile may have bounds beyond where a shaft was cut off, or where it is outside of the frame.
[[nodiscard]] inline bool may_pass_cut(const GridShaft& shaft, const TileExtent& tile) noexcept {
  return tile.least[shaft.cut.stream] < shaft.cut.least || (shaft.cut.leaves_frame && tile.any_above);
}

/// The box around some bounds, a bit larger: more or less where all are.
struct SampledBox {
  float face[6];
  bool exists;  ///< if not, there are hardly any bounds that are finite

  explicit SampledBox(const BoundStreams& bounds) noexcept {
    constexpr std::size_t most = 64;
    constexpr std::size_t fewest = 8;
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float wider = 0.125F;
    for (unsigned f = 0; f < 6; ++f) face[f] = f < 3 ? infinity : -infinity;
    const std::size_t apart = std::max<std::size_t>(bounds.count / most, 1);
    std::size_t counted = 0;
    for (std::size_t i = 0; i < bounds.count; i += apart) {
      float corner[6];
      bool is_usable = true;
      for (unsigned k = 0; k < 3; ++k) {
        if (bounds.kind == BoundKind::boxes) {
          corner[k] = bounds.stream[k][i];
          corner[k + 3] = bounds.stream[k + 3][i];
        } else {
          corner[k] = bounds.stream[k][i] - bounds.stream[3][i];
          corner[k + 3] = bounds.stream[k][i] + bounds.stream[3][i];
        }
        is_usable = is_usable && corner[k] >= -fused_regular_limit && corner[k + 3] <= fused_regular_limit &&
                    corner[k] <= corner[k + 3];
      }
      if (!is_usable) continue;
      ++counted;
      for (unsigned f = 0; f < 6; ++f) face[f] = f < 3 ? std::min(face[f], corner[f]) : std::max(face[f], corner[f]);
    }
    exists = counted >= fewest;
    if (!exists) return;
    for (unsigned k = 0; k < 3; ++k) {
      const float by = wider * (face[k + 3] - face[k]);
      face[k] -= by;
      face[k + 3] += by;
    }
  }
};

/// A group's shafts on a grid, if there are enough of them to pay for bringing tiles there, and enough bounds to pay
/// for bringing shafts there.
struct GroupOnGrid {
  GridFrame frame{};
  bool has_cuts = false;          ///< whether some shaft has no end
  GridShaft shaft[group_shafts];  // not written if there is no frame

  /// For tests of `tested` of the bounds.
  void form(const GridKernels& kernels, std::span<const ShaftData> shafts, const BoundStreams& bounds,
            std::size_t tested) noexcept {
    const bool spheres = bounds.are_spheres();
    if (kernels.frame == nullptr || !kernels.pays(shafts.size(), tested)) return;
    bool any_endless = false;
    for (const ShaftData& data : shafts) any_endless = any_endless || data.is_endless();
    if (any_endless) [[unlikely]] {
      form_cut_off(kernels, shafts, SampledBox(bounds), spheres);
    } else {
      form_with(kernels, shafts, nullptr, spheres);
    }
  }
  [[nodiscard]] bool exists() const noexcept { return frame.exists(); }

 private:
  void form_with(const GridKernels& kernels, std::span<const ShaftData> shafts, const ClippedEnd* clipped,
                 bool spheres) noexcept {
    const GridFrame around = kernels.frame(shafts.data(), shafts.size(), clipped);
    if (!around.exists() || (spheres && !around.suits_spheres)) return;
    frame = around;
    kernels.form_shafts(shafts.data(), shafts.size(), clipped, frame, shaft);
    for (std::size_t s = 0; s != shafts.size(); ++s) shaft[s].exists = shaft[s].exists && shafts[s].form == Form::slab;
  }

  /// Cuts shafts without end off where the first of the faces that follow their box leaves all bounds behind. The frame
  /// holds of them what is among the bounds: other faces may have left it by then.
  SHAFTCULL_NOINLINE void form_cut_off(const GridKernels& kernels, std::span<const ShaftData> shafts,
                                       const SampledBox& around_bounds, bool spheres) noexcept {
    if (!around_bounds.exists) return form_with(kernels, shafts, nullptr, spheres);
    // Shafts of which two faces that move about as fast start at an edge of the frame have no place in it, as sums do
    // not fit into 16 bits. In a frame that is this much wider than bounds are, 2 of 1,000 have none; without, 20.
    constexpr float frame_margin = 0.1875F;
    ClippedEnd clipped[group_shafts];
    constexpr unsigned none = 6;
    unsigned first_face[group_shafts];
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      if (!shafts[s].is_endless()) continue;
      const MovingFaces faces(shafts[s]);
      double end = std::numeric_limits<double>::infinity();
      first_face[s] = none;
      for (unsigned f = 0; f < 6; ++f) {
        if (faces.is_purple(f) || faces.is_blue(f)) continue;
        const double behind_all = around_bounds.face[f < 3 ? f + 3 : f - 3];
        const double t = std::max((behind_all - double{faces.p[f]}) / faces.slope(f), 0.0);
        if (!(t < end)) continue;
        end = t;
        first_face[s] = f;
      }
      if (first_face[s] == none) end = 0;
      for (unsigned f = 0; f < 6; ++f) {
        constexpr auto most = double{std::numeric_limits<float>::max()};
        const unsigned k = f % 3;
        const float more = frame_margin * (around_bounds.face[k + 3] - around_bounds.face[k]);
        clipped[s].face[f] = static_cast<float>(std::clamp(faces.p[f] + end * faces.slope(f), -most, most));
        clipped[s].in_frame[f] =
            std::clamp(clipped[s].face[f], around_bounds.face[k] - more, around_bounds.face[k + 3] + more);
      }
    }
    form_with(kernels, shafts, clipped, spheres);
    if (!exists()) return;
    has_cuts = true;
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      auto& cut = shaft[s].cut;
      cut = {0, false, std::numeric_limits<std::int16_t>::min()};  // nothing is beyond
      if (!shafts[s].is_endless() || !shaft[s].exists) continue;
      const unsigned first = first_face[s];  // NOLINT(clang-analyzer-core.uninitialized.Assign): each was written
      if (first == none) {
        cut.least = std::numeric_limits<std::int16_t>::max();  // all may be beyond
        continue;
      }
      const auto at = [&](unsigned f) {
        const float steps = f < 3 ? -frame.steps[f] : frame.steps[f - 3];
        return (clipped[s].face[f] - frame.origin[f % 3]) * steps;
      };
      // Coordinates on the grid are rounded down, so that one step more is certainly on this side of the cut.
      cut.stream = near_stream[first];
      cut.least = static_cast<std::int16_t>(std::ceil(at(first)) + 1);
      for (unsigned f = 0; f < 6; ++f) cut.leaves_frame = cut.leaves_frame || at(f) > grid_edge + 1;
    }
  }
};

}  // namespace shaftcull::kernel
