// SPDX-License-Identifier: MIT
#include "shaftcull/view_factors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "radiation/radiating_patch.hpp"
#include "shaftcull/error.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"

namespace shaftcull {
namespace {

void require_polygon(const char* name, std::span<const Vec3> corners) {
  kernel::require_memory(name, corners, "corners");
  if (corners.size() < 3 || corners.size() > kernel::Polygon::most_given) {
    kernel::fail(InvalidArgument("polygon \"" + std::string(name) + "\" has " +
                                 kernel::counted(corners.size(), "corner") + "; a view factor takes 3 to " +
                                 std::to_string(kernel::Polygon::most_given)));
  }
  for (std::size_t i = 0; i != corners.size(); ++i) {
    if (!std::all_of(corners[i].begin(), corners[i].end(), [](float x) { return std::isfinite(x); })) {
      kernel::fail(
          InvalidArgument("corner " + std::to_string(i) + " of polygon \"" + std::string(name) + "\" is not finite"));
    }
  }
}

double factor(std::span<const Vec3> from, std::span<const Vec3> to) {
  require_polygon("from", from);
  require_polygon("to", to);
  const kernel::RadiatingPatch first(from);
  if (!(first.area > 0)) kernel::fail(InvalidArgument("polygon \"from\" has no area"));
  return std::min(
      1.0, kernel::exchange_between(first, kernel::RadiatingPatch(to), kernel::Accuracy::eight_digits) / first.area);
}

}  // namespace

double view_factor(std::span<const Vec3> from, std::span<const Vec3> to) {
  return kernel::in_float_environment([&] { return factor(from, to); });
}

}  // namespace shaftcull
