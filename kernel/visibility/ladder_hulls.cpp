// SPDX-License-Identifier: MIT
/// Solid hulls in the ladder: the box around a hull says which lanes it may hide, and the planes of the hull itself
/// decide about these.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "exact/hull_cone.hpp"
#include "exact/orientation.hpp"
#include "exact/polygon.hpp"
#include "visibility/ladder_parts.hpp"
#include "visibility/lanes.hpp"

namespace shaftcull::kernel {
namespace {

/// A normal in doubles, and the sum of the errors of its components.
struct NearNormal {
  double component[3];
  double error;
};

NearNormal normal_of(const HullCone::Plane& plane) noexcept {
  NearNormal normal{{0, 0, 0}, 0};
  if (plane.face != nullptr) {
    for (unsigned k = 0; k != 3; ++k) {
      normal.component[k] = plane.face->normal(k);
      normal.error += 0x1p-28 * std::fabs(normal.component[k]);
    }
    return normal;
  }
  const auto u = [&](unsigned k) { return double{plane.q[k]} - double{plane.p[k]}; };
  const auto v = [&](unsigned k) { return double{plane.r[k]} - double{plane.p[k]}; };
  for (unsigned k = 0; k != 3; ++k) {
    const double left = u((k + 1) % 3) * v((k + 2) % 3);
    const double right = u((k + 2) % 3) * v((k + 1) % 3);
    normal.component[k] = left - right;
    normal.error += 8 * 0x1p-53 * (std::fabs(left) + std::fabs(right));
  }
  return normal;
}

/// For points with coordinates of at most `coordinate`. Let n be the normal, scaled to a largest component of 1. Each
/// component rounds, three products and three sums round, and so does the offset: each by 2⁻²⁴ of what is at most
/// |n|·|p| + |offset| in sum. Underflow adds less than 2⁻¹⁴⁰.
ConePlane plane_in_lanes(const HullCone::Plane& plane, float tolerance, float coordinate) noexcept {
  NearNormal normal = normal_of(plane);
  ConePlane in_lanes{};
  in_lanes.in_front = std::numeric_limits<float>::infinity();
  in_lanes.behind = std::numeric_limits<float>::infinity();
  in_lanes.in_plane = std::numeric_limits<float>::infinity();
  const double largest =
      std::max({std::fabs(normal.component[0]), std::fabs(normal.component[1]), std::fabs(normal.component[2])});
  if (largest == 0) return in_lanes;
  const double scale = 1 / largest;
  double offset = 0;
  double length = 0;
  for (unsigned k = 0; k != 3; ++k) {
    const double component = normal.component[k] * scale;
    offset += component * double{plane.p[k]};
    length += std::fabs(component);
    in_lanes.normal[k] = static_cast<float>(component);
  }
  const double farthest = double{coordinate} + double{tolerance};
  const double error = (10 * 0x1p-24 * length + 2 * scale * normal.error) * farthest + 0x1p-120;
  if (!(length * farthest < 0x1p120) || !(error < 0x1p120)) return in_lanes;
  in_lanes.offset = static_cast<float>(offset);
  in_lanes.in_front = static_cast<float>(error);
  const double thickness = plane.face != nullptr ? double{tolerance} * length : 0;
  in_lanes.behind = static_cast<float>(error + thickness);
  if (plane.face != nullptr) in_lanes.in_plane = static_cast<float>(error - thickness);
  return in_lanes;
}

}  // namespace

/// The number of hulls in a list of solids: they come first.
std::size_t Ladder::hulls_in(const std::uint32_t* solids, std::size_t count) const noexcept {
  const auto hulls = static_cast<std::uint32_t>(job_.occluders.hulls.size());
  return static_cast<std::size_t>(std::lower_bound(solids, solids + count, hulls) - solids);
}

/// Siblings of `asked` that a solid of a list hides; may_block[i] are those that solid i may. Boxes come first, which
/// decide many lanes at once.
std::uint64_t Ladder::occluded_by_solids(const std::uint32_t* solids, std::size_t count, const std::uint64_t* may_block,
                                         std::uint64_t asked) {
  const std::size_t hulls = hulls_in(solids, count);
  std::uint64_t occluded =
      job_.kernels.block(siblings_, job_.solids.data(), solids + hulls, count - hulls, may_block + hulls, asked);
  for (std::size_t i = 0; i != hulls && (asked & ~occluded) != 0; ++i) {
    occluded |= occluded_by_hull(solids[i], may_block[i], asked & ~occluded);
  }
  return occluded;
}

/// Siblings of `asked` that a hull hides, by all of their boxes.
std::uint64_t Ladder::occluded_by_hull(std::uint32_t hull, std::uint64_t may_block, std::uint64_t asked) {
  asked &= may_block;
  // Where a box that reaches around an end is to block nothing, the hull in it still may.
  if (job_.solids_around_ends) {
    asked = job_.kernels.block(siblings_, job_.solids.data(), &hull, 1, nullptr, asked);
  }
  if (asked == 0) return 0;
  const HullMesh& mesh = job_.occluders.hulls[hull];
  const BoxCorners fixed(fixed_);
  if (!job_.solids_around_ends && !are_in_front_of_a_face(mesh, fixed.get())) return 0;
  // The relative interior of a patch may lie in the surface of its group.
  const bool are_groups = siblings_.are_groups;
  const BehindCone behind = behind_cone(
      mesh, fixed.get(), are_groups ? EndPoints::all : EndPoints::of_relative_interior, job_.a.tolerance, asked,
      [&](std::span<const ConePlane> planes, std::uint64_t lanes) {
        return job_.kernels.boxes_behind_cone(planes.data(), planes.size(), siblings_.other, siblings_.count, lanes);
      });
  std::uint64_t occluded = job_.solids_around_ends ? behind.certain : 0;
  for_each_lane(behind.possible & ~occluded, [&](unsigned lane) {
    float other[6];
    for (unsigned f = 0; f != 6; ++f) other[f] = siblings_.other[f][lane];
    const BoxCorners of_other(other);
    if (!job_.solids_around_ends && !are_in_front_of_a_face(mesh, of_other.get())) return;
    if (cone_.hides(of_other.get())) occluded |= bit(lane);
  });
  return occluded;
}

/// Lanes of `asked` that a hull hides from a patch, between their corners.
std::uint64_t Ladder::occluded_by_hull(std::uint32_t hull, std::span<const Vec3> fixed, const Side& columns,
                                       std::uint64_t asked) {
  if (asked == 0) return 0;
  const HullMesh& mesh = job_.occluders.hulls[hull];
  if (!job_.solids_around_ends && !are_in_front_of_a_face(mesh, fixed)) return 0;
  if (!job_.solids_around_ends) {
    for_each_lane(asked, [&](unsigned lane) {
      if (!are_in_front_of_a_face(mesh, columns.corners(lane).all())) asked &= ~bit(lane);
    });
  }
  return corners_behind_cone(mesh, fixed, job_.a.tolerance, columns, asked);
}

/// Likewise of a solid box that is not flat.
std::uint64_t Ladder::occluded_by_box(const float (&solid)[6], std::span<const Vec3> fixed, const Side& columns,
                                      std::uint64_t asked) {
  if (asked == 0) return 0;
  box_mesh_.become(solid);
  return corners_behind_cone(box_mesh_, fixed, 0, columns, asked);
}

/// Lanes of `asked` behind the planes of what a solid hides from an end; behind(planes, lanes) are those behind some of
/// them. Few are behind those of faces: only where some may be, more planes are formed, through edges last. Groups are
/// not asked exactly, so of these all that may be are certain.
template <class Behind>
BehindCone Ladder::behind_cone(const HullMesh& mesh, std::span<const Vec3> fixed, EndPoints counting, float tolerance,
                               std::uint64_t asked, const Behind& behind) {
  BehindCone all{asked, asked};
  const auto test_from = [&](std::size_t first) {
    cone_planes_.clear();
    for (const HullCone::Plane& plane : cone_.planes().subspan(first)) {
      cone_planes_.push_back(plane_in_lanes(plane, tolerance, job_.a.coordinate));
    }
    const BehindCone of_some = behind(std::span<const ConePlane>(cone_planes_), all.possible);
    all = {of_some.possible, all.certain & of_some.certain};
    if (counting == EndPoints::all) all.possible = all.certain;
  };
  cone_.begin(mesh, fixed, counting, tolerance);
  for (bool are_left = true; are_left && all.possible != 0;) {
    const std::size_t first = cone_.planes().size();
    are_left = cone_.add_some_faces();
    test_from(first);
  }
  if (all.possible == 0) return all;
  const std::size_t faces = cone_.planes().size();
  cone_.add_edges();
  test_from(faces);
  return all;
}

/// Lanes of `asked` that a solid hides from a patch, by their corners.
std::uint64_t Ladder::corners_behind_cone(const HullMesh& mesh, std::span<const Vec3> fixed, float tolerance,
                                          const Side& columns, std::uint64_t asked) {
  const Side::CornersOfLanes corners(columns);
  BehindCone behind =
      behind_cone(mesh, fixed, EndPoints::of_relative_interior, tolerance, asked,
                  [&](std::span<const ConePlane> planes, std::uint64_t lanes) {
                    return job_.kernels.corners_behind_cone(planes.data(), planes.size(), corners.stream,
                                                            corners.corners, columns.count, lanes);
                  });
  for_each_lane(behind.possible & ~behind.certain, [&](unsigned lane) {
    if (cone_.hides(columns.corners(lane).all())) behind.certain |= bit(lane);
  });
  return behind.certain;
}

}  // namespace shaftcull::kernel
