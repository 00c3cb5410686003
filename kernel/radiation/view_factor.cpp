// SPDX-License-Identifier: MIT
#include "shaftcull/view_factors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "radiation/exchange.hpp"
#include "radiation/flat_polygon.hpp"
#include "shaftcull/error.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"

namespace shaftcull {
namespace {

using kernel::Point;
using kernel::Polygon;

void require_polygon(const char* name, std::span<const Vec3> corners) {
  kernel::require_memory(name, corners, "corners");
  if (corners.size() < 3 || corners.size() > Polygon::most_given) {
    kernel::fail(InvalidArgument("polygon \"" + std::string(name) + "\" has " +
                                 kernel::counted(corners.size(), "corner") + "; a view factor takes 3 to " +
                                 std::to_string(Polygon::most_given)));
  }
  for (std::size_t i = 0; i != corners.size(); ++i) {
    if (!std::all_of(corners[i].begin(), corners[i].end(), [](float x) { return std::isfinite(x); })) {
      kernel::fail(
          InvalidArgument("corner " + std::to_string(i) + " of polygon \"" + std::string(name) + "\" is not finite"));
    }
  }
}

/// What makes coordinates about 1 at most, exactly.
struct Placing {
  Point origin{};
  double scale = 1;

  Placing(std::span<const Vec3> some, std::span<const Vec3> others) noexcept {
    double largest = 0;
    for (std::size_t k = 0; k != 3; ++k) {
      double lo = some[0][k];
      double hi = lo;
      for (const std::span<const Vec3> corners : {some, others}) {
        for (const Vec3& corner : corners) {
          lo = std::min(lo, double{corner[k]});
          hi = std::max(hi, double{corner[k]});
        }
      }
      origin[k] = lo + (hi - lo) / 2;
      largest = std::max(largest, hi - lo);
    }
    if (largest > 0) scale = std::ldexp(1.0, -std::ilogb(largest));
  }
};

double factor(std::span<const Vec3> from, std::span<const Vec3> to) {
  require_polygon("from", from);
  require_polygon("to", to);
  const Placing placing(from, to);
  const Polygon first(from, placing.origin, placing.scale);
  const Polygon second(to, placing.origin, placing.scale);
  const Point normal = first.normal();
  const double area = std::sqrt(kernel::dot(normal, normal)) / 2;
  if (!(area > 0)) kernel::fail(InvalidArgument("polygon \"from\" has no area"));
  return std::min(1.0, kernel::exchange_area(first.in_front_of(second), second.in_front_of(first)) / area);
}

}  // namespace

double view_factor(std::span<const Vec3> from, std::span<const Vec3> to) {
  return kernel::in_float_environment([&] { return factor(from, to); });
}

}  // namespace shaftcull
