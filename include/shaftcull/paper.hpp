// SPDX-License-Identifier: MIT
/// The paper's tool: a shaft as planes, with every way to form it and to sort its planes. It serves to show, to draw
/// and to compare shafts. Queries do not need it: compile() in compiled.hpp forms and compiles a shaft in one step.
///
/// The object box that touches a face of the shaft box gives the face its colour: red (the first box), blue (the second
/// box) or purple (both). Every edge between a red and a blue face gets a joining plane.
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

/// The way to find the edges that need a joining plane. All ways give the same shaft.
enum class Formation : std::uint8_t {
  search,    ///< compares all pairs of faces (the paper's Listing 1)
  table64,   ///< looks up the edges by two colours per face, then drops edges of purple faces
  table729,  ///< looks up the edges by three colours per face
};

/// The order in which a shaft's joining planes are tested. It changes the speed, never the answers.
enum class PlaneOrder : std::uint8_t {
  unsorted,         ///< in the order of formation
  by_volume,        ///< by the volume that each plane cuts off the shaft box, largest first
  by_added_volume,  ///< greedy: next comes the plane that cuts off most of the volume that is left
};

/// Options of forming a shaft. All choices give the same shaft.
struct ShaftOptions {
  Formation formation = Formation::table729;  ///< the way to find edges
  PlaneOrder order = PlaneOrder::unsorted;    ///< the order of the joining planes
};

/// A face of a box: 0, 1, 2 are lo x, lo y, lo z; 3, 4, 5 are hi x, hi y, hi z.
using Face = std::uint8_t;

/// A plane through an edge of one object box and the corresponding edge of the other box. It cuts the edge between two
/// neighbouring faces off the shaft box. The component of the normal along that edge is zero.
struct JoiningPlane {
  Plane plane;  ///< the normal points out of the shaft; it has any length
  Face red;     ///< the face that only the first box touches
  Face blue;    ///< the face that only the second box touches
};

/// The largest number of joining planes of a shaft.
inline constexpr std::size_t max_joining_planes = 8;

/// The convex hull of two boxes, as planes: the six faces of the shaft box, up to eight joining planes, and the planes
/// that the user adds. It has no heap memory: only the message of an exception is allocated. Const members and
/// culled_volume() are safe to call from many threads. No thread may use a shaft while another thread adds a plane to
/// it.
class SHAFTCULL_EXPORT Shaft {
 public:
  /// Forms the shaft between boxes `a` and `b`. Points, flat, equal, nested and touching boxes are legal. Throws
  /// InvalidArgument for a box that is not finite or has lo > hi, and for an option that is not an enumerator of its
  /// type.
  Shaft(const Box& a, const Box& b, const ShaftOptions& options = {});

  /// Adds a half-space that bounds must also meet: the plane of an emitter or a receiver, or a clip plane. A bound that
  /// is fully outside any added half-space is outside. Throws InvalidArgument for a plane that is not finite or whose
  /// normal is zero, and if the shaft has max_added_planes already.
  void add_plane(const Plane& plane);

  /// The boxes that the shaft is between, as they were given.
  [[nodiscard]] const Box& a() const noexcept { return a_; }
  [[nodiscard]] const Box& b() const noexcept { return b_; }
  /// The shaft box: the smallest box around a and b.
  [[nodiscard]] const Box& box() const noexcept { return box_; }
  /// The joining planes, in the order in which they are tested.
  [[nodiscard]] std::span<const JoiningPlane> joining_planes() const noexcept {
    return {joining_.data(), joining_count_};
  }
  /// The added planes, in the order in which they were added.
  [[nodiscard]] std::span<const Plane> added_planes() const noexcept { return {added_.data(), added_count_}; }
  /// The options with which the shaft was formed.
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

/// Returns the volume that `plane` cuts off `box`, in cubed units of the coordinates; 0 if it cuts off nothing. One
/// component of the normal is zero. Throws InvalidArgument unless the plane's faces are two neighbouring faces from
/// 0 to 5. O(1).
[[nodiscard]] SHAFTCULL_EXPORT double culled_volume(const Box& box, const JoiningPlane& plane);

}  // namespace shaftcull
