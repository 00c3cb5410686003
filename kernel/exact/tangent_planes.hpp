// SPDX-License-Identifier: MIT
/// Planes that have two patches on one side: whether one of them has an occluder on the other.
///
/// The convex hull of two patches is the shaft between them. Each of its faces that joins both lies in a plane through
/// an edge of one patch and a corner of the other. An occluder all of whose corners lie behind such a plane does not
/// reach into the shaft.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "exact/patch_plane.hpp"
#include "exact/plane_of_points.hpp"
#include "exact/turned_box.hpp"
#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"

namespace shaftcull::kernel {

/// All planes through an edge of one of two patches and a corner of the other that have no corner of either behind
/// them, and at least one in front. An edge joins consecutive corners, or the last one and the first. Planes are worked
/// out when they are needed, those first that parted points of pairs before: neighbours are parted by like planes.
/// Memory is kept from one pair of patches to the next.
class TangentPlanes {
 public:
  /// The planes of two patches, by their corners in order. A box has those of its eight corners that differ, and as
  /// edges all lines between two of them.
  struct Patch {
    std::span<const Vec3> corners;
    bool is_box;
  };
  /// The corners must stay until the next pair.
  void begin(const Patch& a, const Patch& b);

  /// Points, and a box around them, or null: the box spares a look at many points.
  struct Points {
    std::span<const Vec3> all;
    const TurnedBox* around;
  };
  /// Whether moving the coordinates of points by the tolerance at most can bring them all behind one of the planes;
  /// with open contact, on it or behind it.
  [[nodiscard]] bool separate(const Points& points, Contact contact, float tolerance);

 private:
  /// Corners i and j of the first patch, or of the second, and corner k of the other one.
  struct Place {
    bool is_of_second;
    std::uint8_t i;
    std::uint8_t j;
    std::uint8_t k;
  };
  /// All places of pairs of patches with so many corners, and the order in which they are looked at.
  struct Places {
    std::vector<Place> all;
    std::vector<std::uint16_t> order;

    void add_edges_of(const Patch& edges, std::size_t corners, bool is_of_second);
  };
  enum class State : std::uint8_t { unknown, no_tangent, tangent };

  [[nodiscard]] bool is_tangent(std::size_t place);
  [[nodiscard]] std::optional<PlaneOfPoints> tangent_at(const Place& place) const noexcept;

  static constexpr std::size_t most_kinds = 2 * (most_patch_corners + 1);  ///< of a patch, by its corners

  Patch a_{};
  Patch b_{};
  std::array<Places, most_kinds * most_kinds> places_of_kinds_;
  Places* places_ = nullptr;           ///< of the pair at hand
  std::vector<State> states_;          ///< of each place
  std::vector<PlaneOfPoints> planes_;  ///< likewise
};

}  // namespace shaftcull::kernel
