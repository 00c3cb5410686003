/// A group of shafts on a grid.
#pragma once

#include <cstddef>
#include <span>

#include "compile/grid.hpp"
#include "run/cut.hpp"
#include "shaftcull/compiled.hpp"
#include "test/kernels.hpp"

namespace shaftcull::kernel {

/// A group's shafts on a grid, if there are enough of them to pay for bringing tiles there.
struct GroupOnGrid {
  static constexpr std::size_t fewest = 8;
  GridFrame frame{};
  GridShaft shaft[group_shafts];  // not written if there is no frame

  void form(const GridKernels& kernels, std::span<const CompiledShaft> shafts, bool spheres) noexcept {
    if (shafts.size() < fewest || kernels.frame == nullptr) return;
    const GridFrame around = kernels.frame(shafts.data(), shafts.size());
    if (!around.exists() || (spheres && !around.suits_spheres)) return;
    frame = around;
    kernels.form_shafts(shafts.data(), shafts.size(), frame, shaft);
  }
  [[nodiscard]] bool exists() const noexcept { return frame.exists(); }
};

}  // namespace shaftcull::kernel
