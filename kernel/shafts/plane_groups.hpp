// SPDX-License-Identifier: MIT
/// The planes of a hull once more, side by side.
#pragma once

#include <limits>

#include "compiled/hull_data.hpp"

namespace shaftcull::kernel {

/// Writes planes into the lanes of groups, one after the other.
class PlaneGroupWriter {
 public:
  explicit PlaneGroupWriter(HullData& hull) noexcept : hull_(hull) {}

  /// Planes [first, last).
  void add(unsigned first, unsigned last) noexcept {
    for (unsigned p = first; p < last; ++p) add(p);
  }
  /// Fills the last group with what everything is behind.
  void end_group() noexcept {
    while (lanes_ % Group::planes != 0) {
      Group& group = next();
      for (auto& inward : group.inward) inward[lane()] = 0;
      group.offset[lane()] = std::numeric_limits<float>::infinity();
      group.length[lane()] = group.magnitude[lane()] = 0;
    }
  }
  [[nodiscard]] std::uint8_t lanes() const noexcept { return static_cast<std::uint8_t>(lanes_); }

 private:
  using Group = HullData::PlaneGroup;

  void add(unsigned number) noexcept {
    const HullData::Plane& plane = hull_.plane[number];
    Group& group = next();
    if (number < hull_.faces) {
      for (unsigned k = 0; k < 3; ++k) group.inward[k][lane()] = plane.inward[k];
    } else {
      group.inward[plane.axis][lane()] = 0;
      group.inward[plane.axis == 2 ? 0 : plane.axis + 1][lane()] = plane.inward[0];
      group.inward[plane.axis == 0 ? 2 : plane.axis - 1][lane()] = plane.inward[1];
    }
    group.offset[lane()] = plane.offset;
    group.length[lane()] = plane.length;
    group.magnitude[lane()] = plane.magnitude;
  }
  /// The group that holds the next lane, which lane() is from now on.
  [[nodiscard]] Group& next() noexcept { return hull_.group[lanes_++ / Group::planes]; }
  [[nodiscard]] unsigned lane() const noexcept { return (lanes_ - 1) % Group::planes; }

  HullData& hull_;
  unsigned lanes_ = 0;
};

/// Writes the groups of a hull whose planes are known.
inline void write_plane_groups(HullData& hull) noexcept {
  PlaneGroupWriter writer(hull);
  const unsigned planes = hull.faces + hull.edges;
  if (hull.is_conservative) {
    const unsigned other_edges = hull.faces + hull.face_edges;
    writer.add(0, hull.apart);
    writer.add(hull.faces, other_edges);
    writer.end_group();
    hull.culling_lanes = writer.lanes();
    writer.add(hull.apart, hull.faces);
    writer.add(other_edges, planes);
  } else {
    writer.add(0, planes);
    hull.culling_lanes = static_cast<std::uint8_t>(planes);
  }
  hull.lanes = writer.lanes();
  writer.end_group();
}

}  // namespace shaftcull::kernel
