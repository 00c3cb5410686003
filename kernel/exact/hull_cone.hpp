// SPDX-License-Identifier: MIT
/// Whether a solid hull hides two ends of segments from each other, exactly (docs/exactness.md, "Solid hulls").
///
/// What a hull hides from one end lies behind some planes: those of faces that the end is not behind, and those through
/// an edge of the hull and a corner of the end. These planes are the same for all other ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/hull_mesh.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

/// Which points of an end count: those of its relative interior, or all. Then the answer is true of all ends within it.
enum class EndPoints : unsigned char { of_relative_interior, all };

class HullCone {
 public:
  /// A plane through three points, behind which the other end must lie. Its front is where they run counterclockwise.
  struct Plane {
    Vec3 p;
    Vec3 q;
    Vec3 r;
    const NearPlane* face;  ///< null if it is none of the hull's; else the other end must not lie in it, either
    bool takes_in_end;      ///< all of this end lies in the plane: not all of the other one must
  };

  /// Begins with the planes of faces, for one end, the hull of finite points; there is at least one. The hull has an
  /// interior. Both stay the caller's, for the calls below. Memory is kept from one end to the next.
  void begin(const HullMesh& hull, std::span<const Vec3> end, EndPoints counting, float tolerance);
  /// Adds the planes through edges.
  void add_edges();

  [[nodiscard]] std::span<const Plane> planes() const noexcept { return planes_; }
  /// Whether the hull hides this end and another one from each other, after add_edges(). The same points of both count.
  [[nodiscard]] bool hides(std::span<const Vec3> other) const noexcept;

 private:
  void add_face(std::size_t face);
  void add_edge(const Vec3& from, const Vec3& to, std::uint32_t front, std::uint32_t back);
  [[nodiscard]] bool is_behind(const Plane& plane, std::span<const Vec3> other) const noexcept;

  const HullMesh* hull_ = nullptr;
  std::span<const Vec3> end_;
  EndPoints counting_ = EndPoints::all;
  float tolerance_ = 0;
  std::vector<Plane> planes_;
  std::vector<std::int8_t> sides_;        ///< of each face, those of the end's points
  std::vector<unsigned char> is_behind_;  ///< of each face, whether the end is behind it
};

/// Whether all points lie on or in front of one face of a hull. Then their hull does not reach into it.
[[nodiscard]] bool are_in_front_of_a_face(const HullMesh& hull, std::span<const Vec3> points) noexcept;

}  // namespace shaftcull::kernel
