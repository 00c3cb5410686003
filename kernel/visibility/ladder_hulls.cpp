// SPDX-License-Identifier: MIT
/// Solid hulls in the ladder: the box around a hull says which lanes it may hide, and the planes of the hull itself
/// decide about these.
#include <algorithm>
#include <cstddef>

#include "exact/hull_cone.hpp"
#include "exact/polygon.hpp"
#include "visibility/cone_planes.hpp"
#include "visibility/ladder_parts.hpp"
#include "visibility/lanes.hpp"
#include "visibility/solid_bounds.hpp"

namespace shaftcull::kernel {
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
  asked = boxes_may_meet(hull, fixed.get(), asked);
  if (asked == 0) return 0;
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

/// Siblings of `asked` such that no segment between some corners of their boxes and of an end certainly misses a hull.
std::uint64_t Ladder::boxes_may_meet(std::uint32_t hull, std::span<const Vec3> fixed, std::uint64_t asked) const {
  // Every other corner of a box: if it is flat, these are all.
  constexpr unsigned some = 4;
  const float* corner[3 * some];
  for (unsigned k = 0; k != 3; ++k) {
    corner[k] = siblings_.other[k];
    for (unsigned c = 1; c != some; ++c) corner[3 * c + k] = siblings_.other[k + 1 == c ? k : k + 3];
  }
  const SolidBounds bounds = solid_bounds(job_.solids[hull], job_.occluders.hulls[hull].radius(), job_.a.coordinate);
  return job_.kernels.may_meet_solid(bounds, fixed.data(), static_cast<unsigned>(fixed.size()), corner, some,
                                     siblings_.count, asked);
}

/// Lanes of `asked` that a hull hides from a patch, between their corners.
std::uint64_t Ladder::occluded_by_hull(std::uint32_t hull, std::span<const Vec3> fixed, const Side& columns,
                                       std::uint64_t asked) {
  if (asked == 0) return 0;
  const HullMesh& mesh = job_.occluders.hulls[hull];
  if (const OwnFaces* const own = own_faces_.of(columns.set.tree, columns.first, columns.count, hull, mesh,
                                                job_.solids[hull], job_.a.tolerance, job_.a.coordinate)) {
    asked &= ~job_.kernels.planes_behind_points(own->normal, own->limit, columns.count, fixed.data(), fixed.size(),
                                                asked & own->lanes);
    if (asked == 0) return 0;
  }
  const Side::CornersOfLanes corners(columns);
  asked = job_.kernels.may_meet_solid(solid_bounds(job_.solids[hull], mesh.radius(), job_.a.coordinate), fixed.data(),
                                      static_cast<unsigned>(fixed.size()), corners.stream, corners.corners,
                                      columns.count, asked);
  if (asked == 0) return 0;
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
