// SPDX-License-Identifier: MIT
#include "visibility/turned_groups.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "visibility/patch_tree.hpp"

namespace shaftcull::kernel {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Makes the groups of one tree.
class TurnedGroupsOf {
 public:
  explicit TurnedGroupsOf(const PatchTree& tree) : tree_(tree) {
    planes_.reserve(tree.order().size());
    for (std::uint32_t i = 0; i != tree.order().size(); ++i) planes_.push_back(facing_planes(tree.corners_of(i).all()));
  }

  [[nodiscard]] TurnedGroup of(const PatchGroup& group) const {
    const FacingPlanes planes = planes_of(group);
    const PatchCorners first = tree_.corners_of(group.first);
    std::vector<Double3> edges;
    for (std::size_t i = 0; i != first.all().size(); ++i) {
      const Vec3& from = first.all()[i];
      const Vec3& to = first.all()[(i + 1) % first.all().size()];
      edges.push_back({double{to[0]} - from[0], double{to[1]} - from[1], double{to[2]} - from[2]});
    }
    std::vector<Vec3> corners;
    for_each_patch(group, [&](std::uint32_t i) {
      const PatchCorners of_patch = tree_.corners_of(i);
      corners.insert(corners.end(), of_patch.all().begin(), of_patch.all().end());
    });
    return {turned_box(corners, planes.mean, edges), planes};
  }

 private:
  template <class Visit>
  static void for_each_patch(const PatchGroup& group, const Visit& visit) {
    for (std::uint32_t i = group.first; i != group.first + group.count; ++i) visit(i);
  }

  [[nodiscard]] FacingPlanes planes_of(const PatchGroup& group) const {
    Double3 sum{};
    for_each_patch(group, [&](std::uint32_t i) {
      for (std::size_t k = 0; k != 3; ++k) sum[k] += planes_[i].mean[k];
    });
    FacingPlanes planes{unit(sum), unbounded, -unbounded, 0};
    for_each_patch(group, [&](std::uint32_t i) {
      const double along = component(planes.mean, tree_.corners_of(i).all().front());
      planes.least = std::min(planes.least, along);
      planes.largest = std::max(planes.largest, along);
      planes.spread = std::max(planes.spread, planes_[i].spread + length(planes.mean - planes_[i].mean));
    });
    return planes;
  }

  const PatchTree& tree_;
  std::vector<FacingPlanes> planes_;
};

}  // namespace

FacingPlanes facing_planes(std::span<const Vec3> corners) noexcept {
  const PatchNormals normals(corners);
  if (normals.all().empty()) return {{0, 0, 0}, 0, 0, unbounded};
  FacingPlanes planes{normals.all().front(), 0, 0, 0};
  for (const Double3& normal : normals.all()) planes.spread = std::max(planes.spread, length(normal - planes.mean));
  planes.spread += 0x1p-26;  // the error of computed normals, and of their distances
  planes.least = planes.largest = component(planes.mean, corners.front());
  return planes;
}

double farthest_of(std::span<const Vec3> points, const Double3& direction) noexcept {
  double farthest = component(direction, points.front());
  for (const Vec3& point : points.subspan(1)) farthest = std::max(farthest, component(direction, point));
  return farthest;
}

double reach_of(const float (&a)[6], const float (&b)[6]) noexcept {
  double square = 0;
  for (unsigned k = 0; k != 3; ++k) {
    const double length = double{std::max(a[k + 3], b[k + 3])} - std::min(a[k], b[k]);
    square += length * length;
  }
  return std::sqrt(square) * (1 + 0x1p-40);
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
  const Double3& m = planes.mean;
  const double sum = std::fabs(m[0]) + std::fabs(m[1]) + std::fabs(m[2]);
  const double allowed = tolerance * std::max(0.0, sum - 2 * planes.spread);
  const double rounding = 0x1p-40 * (coordinate + tolerance);
  return farthest - planes.least + planes.spread * reach + rounding <= allowed;  // false for NaN
}

}  // namespace shaftcull::kernel
