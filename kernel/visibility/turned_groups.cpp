// SPDX-License-Identifier: MIT
#include "visibility/turned_groups.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "visibility/patch_tree.hpp"

namespace shaftcull::kernel {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double dot(const Direction& a, const Direction& b) noexcept { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double along(const Direction& a, const Vec3& p) noexcept { return a[0] * p[0] + a[1] * p[1] + a[2] * p[2]; }

Direction cross(const Direction& a, const Direction& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Of unit length, or 0 if the sum of squares is not a normal number.
Direction unit(const Direction& a) noexcept {
  const double length = std::sqrt(dot(a, a));
  if (!(length > 0x1p-500)) return {0, 0, 0};
  return {a[0] / length, a[1] / length, a[2] / length};
}

double distance(const Direction& a, const Direction& b) noexcept {
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

/// A direction across `normal`, towards `to` as far as that goes. Far enough from it that the two are orthogonal but
/// for 2⁻⁴⁶; else 0.
Direction across(const Direction& normal, const Direction& to) noexcept {
  const Direction unit_to = unit(to);
  const double share = dot(unit_to, normal);
  Direction rest{};
  for (std::size_t k = 0; k != 3; ++k) rest[k] = unit_to[k] - share * normal[k];
  return dot(rest, rest) > 1.0 / 64 ? unit(rest) : Direction{0, 0, 0};
}

/// Components of corners along three axes.
struct Extents {
  Direction lo{infinity, infinity, infinity};
  Direction hi{-infinity, -infinity, -infinity};

  void add(const std::array<Direction, 3>& axis, const Vec3& p) noexcept {
    for (std::size_t k = 0; k != 3; ++k) {
      const double at = along(axis[k], p);
      lo[k] = std::min(lo[k], at);
      hi[k] = std::max(hi[k], at);
    }
  }
};

/// Makes the groups of one tree.
class TurnedGroupsOf {
 public:
  explicit TurnedGroupsOf(const PatchTree& tree) : tree_(tree) {
    planes_.reserve(tree.order().size());
    for (std::uint32_t i = 0; i != tree.order().size(); ++i) planes_.push_back(facing_planes(tree.corners_of(i).all()));
  }

  [[nodiscard]] TurnedGroup of(const PatchGroup& group) const {
    TurnedGroup turned{};
    turned.planes = planes_of(group);
    turned.axis = axes_of(group, turned.planes.mean);
    Extents extents;
    for_each_patch(group, 1, [&](std::uint32_t i) {
      for (const Vec3& corner : tree_.corners_of(i).all()) extents.add(turned.axis, corner);
    });
    turned.lo = extents.lo;
    turned.hi = extents.hi;
    return turned;
  }

 private:
  template <class Visit>
  static void for_each_patch(const PatchGroup& group, std::uint32_t step, const Visit& visit) {
    for (std::uint32_t i = group.first; i < group.first + group.count; i += step) visit(i);
  }

  [[nodiscard]] FacingPlanes planes_of(const PatchGroup& group) const {
    Direction sum{};
    for_each_patch(group, 1, [&](std::uint32_t i) {
      for (std::size_t k = 0; k != 3; ++k) sum[k] += planes_[i].mean[k];
    });
    FacingPlanes planes{unit(sum), infinity, 0};
    for_each_patch(group, 1, [&](std::uint32_t i) {
      planes.least = std::min(planes.least, along(planes.mean, tree_.corners_of(i).all().front()));
      planes.spread = std::max(planes.spread, planes_[i].spread + distance(planes.mean, planes_[i].mean));
    });
    return planes;
  }

  /// One axis is the way that patches face. Of those across it, that along an edge of the first patch whose rectangle
  /// around some of the corners is smallest.
  [[nodiscard]] std::array<Direction, 3> axes_of(const PatchGroup& group, const Direction& mean) const {
    if (dot(mean, mean) == 0) return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    constexpr std::uint32_t some = 32;
    const PatchCorners first = tree_.corners_of(group.first);
    std::array<Direction, 3> best{};
    double smallest = infinity;
    const auto try_axis = [&](const Direction& to) {
      const Direction one = across(mean, to);
      if (dot(one, one) == 0) return;
      const std::array<Direction, 3> axis{one, cross(mean, one), mean};
      Extents extents;
      for_each_patch(group, group.count / some + 1, [&](std::uint32_t i) {
        for (const Vec3& corner : tree_.corners_of(i).all()) extents.add(axis, corner);
      });
      const double size = (extents.hi[0] - extents.lo[0]) * (extents.hi[1] - extents.lo[1]);
      if (size < smallest) {
        smallest = size;
        best = axis;
      }
    };
    const std::span<const Vec3> corners = first.all();
    for (std::size_t i = 0; i != corners.size(); ++i) {
      const Vec3& from = corners[i];
      const Vec3& to = corners[(i + 1) % corners.size()];
      try_axis({double{to[0]} - from[0], double{to[1]} - from[1], double{to[2]} - from[2]});
    }
    for (std::size_t k = 0; k != 3 && smallest == infinity; ++k) {
      Direction to{};
      to[k] = 1;
      try_axis(to);
    }
    return best;
  }

  const PatchTree& tree_;
  std::vector<FacingPlanes> planes_;
};

}  // namespace

double TurnedGroup::farthest(const Direction& direction) const noexcept {
  double sum = 0;
  for (std::size_t k = 0; k != 3; ++k) {
    const double share = dot(direction, axis[k]);
    sum += std::max(share * lo[k], share * hi[k]);
  }
  return sum;
}

FacingPlanes facing_planes(std::span<const Vec3> corners) noexcept {
  const PatchNormals normals(corners);
  if (normals.all().empty()) return {{0, 0, 0}, 0, infinity};
  FacingPlanes planes{normals.all().front(), 0, 0};
  for (const Direction& normal : normals.all()) planes.spread = std::max(planes.spread, distance(normal, planes.mean));
  planes.spread += 0x1p-26;  // the error of computed normals, and of their distances
  planes.least = along(planes.mean, corners.front());
  return planes;
}

std::vector<TurnedGroup> turned_groups(const PatchTree& tree) {
  const TurnedGroupsOf of(tree);
  std::vector<TurnedGroup> turned;
  turned.reserve(tree.groups().size());
  for (const PatchGroup& group : tree.groups()) turned.push_back(of.of(group));
  return turned;
}

bool are_behind(const FacingPlanes& planes, double farthest, double reach, double coordinate,
                double tolerance) noexcept {
  const Direction& m = planes.mean;
  const double sum = std::fabs(m[0]) + std::fabs(m[1]) + std::fabs(m[2]);
  const double allowed = tolerance * std::max(0.0, sum - 2 * planes.spread);
  const double rounding = 0x1p-40 * (coordinate + tolerance);
  return farthest - planes.least + planes.spread * reach + rounding <= allowed;  // false for NaN
}

}  // namespace shaftcull::kernel
