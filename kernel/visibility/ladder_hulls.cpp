// SPDX-License-Identifier: MIT
/// Solid hulls in the ladder: the box around a hull says which lanes it may hide, and the planes of the hull itself
/// decide about these.
#include <algorithm>
#include <cstddef>

#include "exact/hull_cone.hpp"
#include "exact/polygon.hpp"
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
    std::uint64_t may = 0;
    job_.kernels.may_block(siblings_, job_.solids.data(), &hull, 1, nullptr, asked, &may);
    asked = may;
  }
  if (asked == 0) return 0;
  const HullMesh& mesh = job_.occluders.hulls[hull];
  const BoxCorners fixed(fixed_);
  if (!job_.solids_around_ends && !are_in_front_of_a_face(mesh, fixed.get())) return 0;
  // The relative interior of a patch may lie in the surface of its group.
  const EndPoints counting = siblings_.are_groups ? EndPoints::all : EndPoints::of_relative_interior;
  fixed_end_.counting = counting;
  cones_.turn_to(fixed_end_, fixed.get(), hull);
  const BehindCone behind = behind_cone(counting, asked, [&](std::span<const ConePlane> planes, std::uint64_t lanes) {
    return job_.kernels.boxes_behind_cone(planes.data(), planes.size(), siblings_.other, siblings_.count, lanes);
  });
  std::uint64_t occluded = job_.solids_around_ends ? behind.certain : 0;
  for_each_lane(behind.possible & ~occluded, [&](unsigned lane) {
    float other[6];
    for (unsigned f = 0; f != 6; ++f) other[f] = siblings_.other[f][lane];
    const BoxCorners of_other(other);
    if (!job_.solids_around_ends && !are_in_front_of_a_face(mesh, of_other.get())) return;
    if (cones_.hides(of_other.get())) occluded |= bit(lane);
  });
  return occluded;
}

/// Lanes of `asked` that a hull hides from a patch, between their corners.
std::uint64_t Ladder::occluded_by_hull(std::uint32_t hull, const Side& rows, unsigned row, const Side& columns,
                                       std::uint64_t asked) {
  if (asked == 0) return 0;
  const HullMesh& mesh = job_.occluders.hulls[hull];
  const PatchCorners corners_of_row = rows.corners(row);
  const std::span<const Vec3> fixed = corners_of_row.all();
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
  return corners_behind_cone(hull, rows, row, columns, asked);
}

/// Lanes of `asked` behind the planes of the cone turned to; behind(planes, lanes) are those behind some of them. Few
/// are behind those of faces: only where some may be, planes through edges are asked. Groups are not asked exactly, so
/// of these all that may be are certain.
template <class Behind>
BehindCone Ladder::behind_cone(EndPoints counting, std::uint64_t asked, const Behind& behind) {
  const bool are_groups = counting == EndPoints::all;
  const auto of_groups = [&](const BehindCone& of) { return are_groups ? BehindCone{of.certain, of.certain} : of; };
  const BehindCone of_faces = of_groups(behind(cones_.faces(), asked));
  if (of_faces.possible == 0) return of_faces;
  const BehindCone of_edges = of_groups(behind(cones_.edges(), of_faces.possible));
  return {of_edges.possible, of_faces.certain & of_edges.certain};
}

/// Lanes of `asked` that a solid with an interior hides from a patch, by their corners.
std::uint64_t Ladder::corners_behind_cone(std::uint32_t solid, const Side& rows, unsigned row, const Side& columns,
                                          std::uint64_t asked) {
  if (asked == 0) return 0;
  const Side::CornersOfLanes corners(columns);
  const PatchCorners fixed = rows.corners(row);
  constexpr EndPoints counting = EndPoints::of_relative_interior;
  cones_.turn_to({&rows.set.tree, rows.first + row, ConeEnd::Kind::patch, counting}, fixed.all(), solid);
  BehindCone behind = behind_cone(counting, asked, [&](std::span<const ConePlane> planes, std::uint64_t lanes) {
    return job_.kernels.corners_behind_cone(planes.data(), planes.size(), corners.stream, corners.corners,
                                            columns.count, lanes);
  });
  for_each_lane(behind.possible & ~behind.certain, [&](unsigned lane) {
    if (cones_.hides(columns.corners(lane).all())) behind.certain |= bit(lane);
  });
  return behind.certain;
}

}  // namespace shaftcull::kernel
