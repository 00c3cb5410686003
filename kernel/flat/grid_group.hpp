/// A group of shafts on a grid.
#pragma once

#include <cstddef>
#include <span>

#include "compiled/shaft_data.hpp"
#include "flat/tiling.hpp"
#include "kernels/grid/forming.hpp"
#include "kernels/table.hpp"

namespace shaftcull::kernel {

/// A group's shafts on a grid, if there are enough of them to pay for bringing tiles there, and enough bounds to pay
/// for bringing shafts there.
struct GroupOnGrid {
  GridFrame frame{};
  GridShaft shaft[group_shafts];  // not written if there is no frame

  /// For tests of `bounds` bounds.
  void form(const GridKernels& kernels, std::span<const ShaftData> shafts, std::size_t bounds, bool spheres) noexcept {
    if (kernels.frame == nullptr || !kernels.pays(shafts.size(), bounds)) return;
    const GridFrame around = kernels.frame(shafts.data(), shafts.size());
    if (!around.exists() || (spheres && !around.suits_spheres)) return;
    frame = around;
    kernels.form_shafts(shafts.data(), shafts.size(), frame, shaft);
  }
  [[nodiscard]] bool exists() const noexcept { return frame.exists(); }
};

}  // namespace shaftcull::kernel
