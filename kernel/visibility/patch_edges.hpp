// SPDX-License-Identifier: MIT
/// The edges of a patch, by the numbers of its corners.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "kernels/siblings/siblings.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

class PatchEdges {
 public:
  /// Those of a polygon with corners in order around it.
  static PatchEdges of_polygon(unsigned corners) noexcept {
    PatchEdges edges;
    for (unsigned c = 0; c != corners; ++c) edges.add(c, c + 1 == corners ? 0 : c + 1);
    return edges;
  }
  /// Those of a box with such corners, all of which differ: along axes. A plane through a diagonal that has the box on
  /// one side has a face in it.
  static PatchEdges of_box(std::span<const Vec3> corners) noexcept {
    PatchEdges edges;
    for (unsigned i = 0; i != corners.size(); ++i) {
      for (unsigned j = i + 1; j != corners.size(); ++j) {
        unsigned differing = 0;
        for (unsigned k = 0; k != 3; ++k) differing += corners[i][k] != corners[j][k] ? 1 : 0;
        if (differing == 1) edges.add(i, j);
      }
    }
    return edges;
  }
  /// Those of a box with eight corners, bit k of whose numbers says on which side of axis k they are. If it is flat,
  /// some edges have no length.
  static PatchEdges of_any_box() noexcept {
    PatchEdges edges;
    for (unsigned c = 0; c != 8; ++c) {
      for (unsigned k = 0; k != 3; ++k) {
        if ((c >> k & 1U) == 0) edges.add(c, c | 1U << k);
      }
    }
    return edges;
  }

  [[nodiscard]] const PatchEdge* data() const noexcept { return edge_.data(); }
  [[nodiscard]] unsigned size() const noexcept { return size_; }

 private:
  void add(unsigned from, unsigned to) noexcept {
    edge_[size_++] = {static_cast<std::uint8_t>(from), static_cast<std::uint8_t>(to)};
  }

  std::array<PatchEdge, 12> edge_{};
  unsigned size_ = 0;
};

}  // namespace shaftcull::kernel
