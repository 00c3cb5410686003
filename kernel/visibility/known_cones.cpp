// SPDX-License-Identifier: MIT
#include "visibility/known_cones.hpp"

#include <algorithm>

#include "visibility/cone_planes.hpp"

namespace shaftcull::kernel {

void KnownCones::turn_to(const ConeEnd& end, std::span<const Vec3> points, std::uint32_t solid) {
  points_ = points;
  formed_ = Formed::nothing;
  if (planes_.size() >= most_planes || known_.empty()) {
    planes_.clear();
    known_.assign(most_cones, {});
  }
  const std::uint32_t kind = 2 * static_cast<std::uint32_t>(end.kind) + static_cast<std::uint32_t>(end.counting);
  here_ = &known_[((8 * end.at + kind) * 0x9e3779b1U ^ solid * 0x85ebca6bU) >> 20U];
  if (here_->end != end || here_->solid != solid) *here_ = {end, solid, {}, {}};
}

void KnownCones::form_faces() {
  if (formed_ != Formed::nothing) return;
  const std::vector<HullMesh>& hulls = job_.occluders.hulls;
  const bool is_hull = here_->solid < hulls.size();
  if (!is_hull) {
    const float(&row)[8] = job_.solids[here_->solid].face;
    box_mesh_.become({row[0], row[1], row[2], row[3], row[4], row[5]});
  }
  cone_.begin(is_hull ? hulls[here_->solid] : box_mesh_, points_, here_->end.counting, is_hull ? job_.a.tolerance : 0);
  formed_ = Formed::faces;
}

void KnownCones::form_edges() {
  form_faces();
  if (formed_ != Formed::all) cone_.add_edges();
  formed_ = Formed::all;
}

/// Keeps the planes of cone_ from one on.
KnownCones::Planes KnownCones::kept(std::size_t first_plane) {
  const auto first = static_cast<std::uint32_t>(planes_.size());
  const float tolerance = here_->solid < job_.occluders.hulls.size() ? job_.a.tolerance : 0;
  for (const HullCone::Plane& plane : cone_.planes().subspan(first_plane)) {
    planes_.push_back(plane_in_lanes(plane, here_->end.counting, tolerance, job_.a.coordinate));
  }
  return {first, static_cast<std::uint32_t>(planes_.size()) - first};
}

std::span<const ConePlane> KnownCones::faces() {
  if (here_->faces.first == Planes::none) {
    form_faces();
    here_->faces = kept(0);
  }
  return planes(here_->faces);
}

std::span<const ConePlane> KnownCones::edges() {
  if (here_->edges.first == Planes::none) {
    form_faces();
    const std::size_t faces = cone_.planes().size();
    form_edges();
    here_->edges = kept(faces);
  }
  return planes(here_->edges);
}

bool KnownCones::hides(std::span<const Vec3> other) {
  form_edges();
  return cone_.hides(other);
}

}  // namespace shaftcull::kernel
