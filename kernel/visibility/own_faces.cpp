// SPDX-License-Identifier: MIT
#include "visibility/own_faces.hpp"

#include <algorithm>

#include "support/exact_floats.hpp"
#include "visibility/cone_planes.hpp"
#include "visibility/corner_lists.hpp"
#include "visibility/lanes.hpp"

namespace shaftcull::kernel {
namespace {

bool touch(const Box& box, const BoxRow& around) noexcept {
  for (unsigned k = 0; k != 3; ++k) {
    if (box.lo[k] > around.face[k + 3] || box.hi[k] < around.face[k]) return false;
  }
  return true;
}

/// Whether no corner is behind a face by more than the tolerance: then the patch is not behind it (HullCone).
bool is_none_behind(const NearPlane& face, const PatchCorners& corners, float tolerance) noexcept {
  return std::none_of(corners.all().begin(), corners.all().end(),
                      [&](const Vec3& x) { return face.is_behind(x, tolerance); });
}

}  // namespace

const OwnFaces* OwnFacesCache::of(const PatchTree& tree, std::uint32_t first, unsigned count, std::uint32_t hull,
                                  const HullMesh& mesh, const BoxRow& around, float tolerance, float coordinate) {
  constexpr std::size_t size = std::size_t{1} << 12;
  constexpr std::size_t most_faces = 256;
  if (known_.empty()) known_.resize(size);
  Known& known = known_[(first * 0x9e3779b1U ^ hull * 0x85ebca6bU) >> 20U];
  if (known.tree == &tree && known.first == first && known.hull == hull) {
    return known.at == none ? nullptr : &faces_[known.at];
  }
  if (faces_.size() == most_faces) {
    faces_.clear();
    std::fill(known_.begin(), known_.end(), Known{});
  }
  known = {&tree, first, hull, none};
  OwnFaces found;
  for (unsigned lane = 0; lane != count; ++lane) {
    const PatchCorners corners = tree.corners_of(first + lane);
    if (!touch(box_around_corners(corners.all()), around)) continue;
    const auto face = std::find_if(mesh.faces().begin(), mesh.faces().end(),
                                   [&](const NearPlane& plane) { return is_none_behind(plane, corners, tolerance); });
    if (face == mesh.faces().end()) continue;
    const ConePlane plane = plane_in_lanes(*face, coordinate);
    for (unsigned k = 0; k != 3; ++k) found.normal[k][lane] = plane.normal[k];
    found.limit[lane] = plane.offset + plane.possible.highest;
    found.lanes |= bit(lane);
  }
  if (found.lanes == 0) return nullptr;
  known.at = static_cast<std::uint32_t>(faces_.size());
  faces_.push_back(found);
  return &faces_.back();
}

}  // namespace shaftcull::kernel
