// SPDX-License-Identifier: MIT
/// occluded() by one box or polygon. occluded() by many: counts.cpp; find_occluder() and list_occluders(): lists.cpp.
#include "shaftcull/occluded.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "compiled/answers.hpp"
#include "exact/blocking.hpp"
#include "exact/polygon.hpp"
#include "shaftcull/error.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

bool occluded(const CompiledShaft& shaft, const Box& solid) {
  const kernel::ShaftData& data = kernel::data_of(shaft);
  kernel::require_two_ends(data, 0);
  const float bound[6] = {solid.lo[0], solid.lo[1], solid.lo[2], solid.hi[0], solid.hi[1], solid.hi[2]};
  return kernel::in_float_environment([&] { return kernel::box_blocks(data, bound); });
}

bool occluded(const CompiledShaft& shaft, std::span<const Vec3> polygon) {
  const kernel::ShaftData& data = kernel::data_of(shaft);
  kernel::require_two_ends(data, 0);
  kernel::require_memory("polygon", polygon, "corners");
  if (polygon.size() < 3) {
    kernel::fail(
        InvalidArgument("polygon has " + kernel::counted(polygon.size(), "corner") + "; it takes three or more"));
  }
  return kernel::in_float_environment([&] {
    for (std::size_t i = 0; i != polygon.size(); ++i) {
      const Vec3& corner = polygon[i];
      if (std::all_of(corner.begin(), corner.end(), [](float x) { return std::isfinite(x); })) continue;
      kernel::fail(InvalidArgument("polygon[" + std::to_string(i) + "] is not finite; corners are points"));
    }
    return kernel::polygon_blocks(data, polygon);
  });
}

}  // namespace shaftcull
