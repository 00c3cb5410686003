// SPDX-License-Identifier: MIT
/// A group of shafts on a grid.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>

#include "compiled/moving_faces.hpp"
#include "compiled/shaft_data.hpp"
#include "flat/tiling.hpp"
#include "kernels/grid/forming.hpp"
#include "kernels/table.hpp"

namespace shaftcull::kernel {

/// The least coordinate of each of a tile's six streams on a grid.
struct LeastOnGrid {
  std::int16_t of[6];
};

/// Whether a tile may have bounds beyond where a shaft was cut off.
[[nodiscard]] inline bool may_pass_cut(const GridShaft& shaft, const LeastOnGrid& tile) noexcept {
  return tile.of[shaft.cut.stream] < shaft.cut.least;
}

/// The box around some bounds of a view, a bit larger: more or less where all are.
struct SampledBox {
  float face[6];
  bool exists;  ///< if not, there are hardly any bounds that are finite

  template <class View>
  explicit SampledBox(const View& bounds) noexcept {
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
        if constexpr (std::tuple_size_v<decltype(View::stream)> == 6) {
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
  template <class View>
  void form(const GridKernels& kernels, std::span<const ShaftData> shafts, const View& bounds, std::size_t tested,
            bool spheres) noexcept {
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
  }

  /// Cuts shafts without end off where the first of the faces that follow their box leaves all bounds behind. If others
  /// are far away by then, the frame would be too large for all: such shafts are tested in floats.
  [[gnu::noinline]] void form_cut_off(const GridKernels& kernels, std::span<const ShaftData> shafts,
                                      const SampledBox& around_bounds, bool spheres) noexcept {
    if (!around_bounds.exists) return form_with(kernels, shafts, nullptr, spheres);
    ClippedEnd clipped[group_shafts];
    constexpr unsigned none = 6;
    unsigned first_face[group_shafts];
    float size = 0;
    for (unsigned k = 0; k < 3; ++k) size = std::max(size, around_bounds.face[k + 3] - around_bounds.face[k]);
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
      for (unsigned f = 0; f < 6; ++f) {
        constexpr auto most = double{std::numeric_limits<float>::max()};
        clipped[s].face[f] = static_cast<float>(std::clamp(faces.p[f] + end * faces.slope(f), -most, most));
      }
      bool is_near = true;
      for (unsigned f = 0; f < 6; ++f) {
        const unsigned k = f % 3;
        is_near = is_near && clipped[s].face[f] >= around_bounds.face[k] - size &&
                  clipped[s].face[f] <= around_bounds.face[k + 3] + size;
      }
      if (is_near) continue;
      first_face[s] = none;
      for (unsigned f = 0; f < 6; ++f) clipped[s].face[f] = shafts[s].a[f];
    }
    form_with(kernels, shafts, clipped, spheres);
    if (!exists()) return;
    has_cuts = true;
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      auto& cut = shaft[s].cut;
      cut = {0, std::numeric_limits<std::int16_t>::min()};  // nothing is beyond
      if (!shafts[s].is_endless() || !shaft[s].exists) continue;
      const unsigned f = first_face[s];
      if (f == none) {
        cut.least = std::numeric_limits<std::int16_t>::max();  // all may be beyond
        continue;
      }
      const float steps = f < 3 ? -frame.steps[f] : frame.steps[f - 3];
      const float at = (clipped[s].face[f] - frame.origin[f % 3]) * steps;
      // Coordinates on the grid are rounded down, so that one step more is certainly on this side of the cut.
      cut = {near_stream[f], static_cast<std::int16_t>(std::ceil(at) + 1)};
    }
  }
};

}  // namespace shaftcull::kernel
