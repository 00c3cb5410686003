// SPDX-License-Identifier: MIT
/// The paper's tool: a shaft as planes, with every way to form it and to sort its planes. Queries do not need it:
/// compile() in compiled.hpp makes shafts of two boxes at once. It is here to show, to draw and to compare.
///
/// Colour each face of the shaft box by the object box that touches it: red (the first), blue (the second) or
/// purple (both). A joining plane is formed for every edge between a red and a blue face.
/// E. Haines and J. Wallace, "Shaft Culling for Efficient Ray-Traced Radiosity", 1991;
/// E. Haines, "A Shaft Culling Tool", Journal of Graphics Tools 5(1), 2000.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// How the edges that need a joining plane are found. All give the same shaft.
enum class Formation : std::uint8_t {
  search,    ///< compares all pairs of faces (the paper's Listing 1)
  table64,   ///< looks up two colours a face, then drops edges of purple faces
  table729,  ///< looks up three colours a face
};

/// The order in which a shaft's joining planes are tested (it changes speed, never answers).
enum class PlaneOrder : std::uint8_t {
  unsorted,         ///< as they are formed
  by_volume,        ///< the plane that cuts most volume off the shaft box first
  by_added_volume,  ///< greedily the plane that cuts most volume not cut by those before it
};

/// How a shaft is formed. All choices give the same shaft.
struct ShaftOptions {
  Formation formation = Formation::table729;  ///< how edges are found
  PlaneOrder order = PlaneOrder::unsorted;    ///< how joining planes are sorted
};

/// A face of a box: 0, 1, 2 are lo x, lo y, lo z; 3, 4, 5 are hi x, hi y, hi z.
using Face = std::uint8_t;

/// A plane that joins an edge of one object box with the corresponding edge of the other: it cuts the
/// edge between two neighbouring faces off the shaft box. The normal has a zero component, on the axis along the edge.
struct JoiningPlane {
  Plane plane;  ///< the normal points out of the shaft; it has any length
  Face red;     ///< the face that only the first box touches
  Face blue;    ///< the face that only the second box touches
};

/// Most joining planes a shaft can have.
inline constexpr std::size_t max_joining_planes = 8;

/// The convex hull of two boxes, as planes: the shaft box's six faces, up to eight joining planes,
/// and planes added by the user. A value: no heap memory, and nothing here allocates but the message of an exception.
/// Const members and culled_volume() are safe to call from many threads; nobody may use a shaft while another thread
/// adds a plane to it. Different shafts are independent.
class SHAFTCULL_EXPORT Shaft {
 public:
  /// The shaft between boxes `a` and `b`. Both must be finite with lo ≤ hi; points, flat, equal, nested and
  /// touching boxes are legal. Throws InvalidArgument otherwise, or if an option is no enumerator of its type.
  Shaft(const Box& a, const Box& b, const ShaftOptions& options = {});

  /// Adds a half-space that bounds must also meet: an emitter's or receiver's plane, a clip plane. A bound
  /// fully outside any one added plane is outside. Throws InvalidArgument if the plane is not finite, its
  /// normal is zero, or max_added_planes are there already.
  void add_plane(const Plane& plane);

  /// The boxes that it is between, as they were given.
  [[nodiscard]] const Box& a() const noexcept { return a_; }
  [[nodiscard]] const Box& b() const noexcept { return b_; }
  /// The shaft box: the smallest box around a and b.
  [[nodiscard]] const Box& box() const noexcept { return box_; }
  /// In the order in which they are tested.
  [[nodiscard]] std::span<const JoiningPlane> joining_planes() const noexcept {
    return {joining_.data(), joining_count_};
  }
  /// In the order in which they were added.
  [[nodiscard]] std::span<const Plane> added_planes() const noexcept { return {added_.data(), added_count_}; }
  /// How it was formed.
  [[nodiscard]] const ShaftOptions& options() const noexcept { return options_; }

 private:
  Box a_;
  Box b_;
  Box box_;
  ShaftOptions options_;
  std::array<JoiningPlane, max_joining_planes> joining_;
  std::array<Plane, max_added_planes> added_;
  std::uint8_t joining_count_ = 0;
  std::uint8_t added_count_ = 0;
};

/// Compiles a shaft, joining planes included, with closed contact and in slab form. Never fails. Forming a Shaft and
/// compiling it take about 180 ns together. No allocation; safe to call from many threads.
[[nodiscard]] SHAFTCULL_EXPORT CompiledShaft compile(const Shaft& shaft) noexcept;

/// Volume of the part of box `box` that `plane` (one zero normal component) cuts off, in the coordinates' unit cubed; 0
/// if it cuts off nothing. Throws InvalidArgument if its faces are not two neighbouring ones of 0 to 5. O(1).
[[nodiscard]] SHAFTCULL_EXPORT double culled_volume(const Box& box, const JoiningPlane& plane);

}  // namespace shaftcull
