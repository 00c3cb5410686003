// SPDX-License-Identifier: MIT
/// Solids: how to find them in the triangles of a mesh, to join many boxes into larger ones, and to find a box inside a
/// turned solid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/triangles.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Returns larger boxes, which cover exactly the space that the given boxes cover. Two boxes are joined if they agree
/// to the bit on two axes and touch or overlap on the third: pieces of a wall become one box. Nothing is rounded. Where
/// two walls cross, each becomes whole, so boxes of the result may overlap. A box that lies in another box is left out.
/// The order is not that of `boxes`.
///
/// O(n log n) for the walls of a building. A grid of many small boxes takes more time and temporary memory, as there
/// are many ways to join them. Allocates the result and O(n) temporary memory. Throws BadBound, with the position, for
/// a box that is not finite or has lo > hi. Throws InvalidArgument for a null span, and std::bad_alloc if memory runs
/// out.
[[nodiscard]] SHAFTCULL_EXPORT std::vector<Box> merged_boxes(std::span<const Box> boxes);

/// Returns a large box inside the convex hull of 4 to 32 points. A search finds the box, so a larger one may exist. For
/// the same points, the result is the same on every machine. The box lies in the hull exactly: no coordinate is rounded
/// outwards. If the hull is flat, or too thin for floats, the result is one of `corners`, as a box.
///
/// O(n³): about 10 µs for 8 points, 0.5 ms for 32. Allocates temporary memory. Throws InvalidArgument for another
/// number of points, and for a point that is not finite. Throws std::bad_alloc if memory runs out.
[[nodiscard]] SHAFTCULL_EXPORT Box inscribed_box(std::span<const Vec3> corners);

/// Solids found in triangles: bodies, polygons and boxes, each proven to hide only what the triangles hide.
/// Occluders::add_found() (visibility.hpp) takes them.
struct FoundSolids {
  /// Corners of convex bodies, body after body. Body i has hull_corners[first_hull_corner[i] …
  /// first_hull_corner[i + 1]), 4 to 256 of them.
  std::vector<Vec3> hull_corners;
  std::vector<std::size_t> first_hull_corner{0};  ///< where each body's corners begin; then the end of the last
  /// Corners of flat convex polygons, polygon after polygon: 3 or more per polygon, counterclockwise as seen from the
  /// front.
  std::vector<Vec3> polygon_corners;
  std::vector<std::size_t> first_polygon_corner{0};  ///< where each polygon's corners begin; then the end of the last
  /// As many as polygon_corners: of each polygon, the corners of a second one, or the same corners again. A polygon
  /// with a second one is a *plate*: triangles lie between both, and what passes through both passes through a
  /// triangle. Empty if no polygon is a plate.
  std::vector<Vec3> back_corners;
  std::vector<Box> inner_boxes;  ///< boxes inside bodies that are not convex

  /// The number of convex bodies.
  [[nodiscard]] std::size_t hulls() const noexcept { return first_hull_corner.size() - 1; }
  /// The number of polygons.
  [[nodiscard]] std::size_t polygons() const noexcept { return first_polygon_corner.size() - 1; }
  friend bool operator==(const FoundSolids&, const FoundSolids&) = default;
};

/// Options of find_solids().
struct SolidSearch {
  /// Solids narrower than this are left out, since they hide nothing if all patches are larger. The width of a body or
  /// box is its second largest extent. The width of a polygon is its area divided by the diagonal of its box.
  float least_width = 0;
  /// Whether closed surfaces are the surfaces of bodies. Set it to false if patches see on both sides, or if triangles
  /// have no reliable orientation: then only polygons are found.
  bool bodies = true;
  /// The box in which all patches lie; for two sets joined(a.box(), b.box()). Each body may be open on or beyond one
  /// face of it, as buildings without a bottom are on level ground. A patch outside the region may be reported as
  /// occluded although it is not. By default, patches may lie anywhere, and bodies must be closed;
  /// so they must with the empty box, that of no patches. Rays of lit_fractions() leave the region: let it contain the
  /// mesh.
  Box region{{-unbounded, -unbounded, -unbounded}, {unbounded, unbounded, unbounded}};

  std::uint64_t reserved[4] = {};  ///< for options of later versions

  static constexpr float unbounded = std::numeric_limits<float>::infinity();  ///< where a region has no end
};

/// Finds the solids that the triangles of a mesh form, so that the caller need not mark which objects are solid.
/// Vertices at the same position are one vertex, so a mesh may be one object or many, with shared vertices or without.
///
/// A *part* is a set of triangles that are connected across edges. A part is *closed* if each of its edges has a
/// triangle on both sides, and both run along it in opposite directions. An edge on or beyond a face of
/// SolidSearch::region needs no second triangle, as long as one face serves all such edges of the part. Triangles on or
/// beyond one face, usually the ground, are left out of the search, since they hide nothing within the region. Of the
/// faces on which most triangles stand, it is the one that gives the most closed parts. If no triangle stands on a
/// face, none is left out.
///
/// * A closed part whose faces look outwards is the surface of a body of matter. If it is convex, it is found as a hull
///   with all of its corners, or 256 of them; corners that stick out by no more than rounding may be missing. Corners
///   of a turned body are rounded, so few such bodies are exactly convex. The corners of the hull are then moved
///   towards the middle, by at most a 250th of the way, so that the hull lies within the body. A slanted body that is a
///   thousand times as long as it is thick may not be found.
/// * If such a part is not convex, up to 16 of the larger boxes inside it are found. There may be still larger ones.
/// * A closed part that has another part wholly inside it is a shell, such as that of a building with rooms, and not a
///   body. A room, whose faces look inwards, is not a body, and neither is a part that is not closed.
/// * In parts that are not convex bodies, neighbouring triangles in one plane that form a convex polygon are found as
///   that polygon. If they form another polygon, it is cut into convex ones. A triangle that is not joined is a polygon
///   as well.
/// * Triangles whose vertices lie in one plane up to rounding, 2⁻²⁰ of their largest coordinate, as in a turned
///   wall, are found as plates: one for a convex wall of at most 64 corners, up to 16 for another one. Plates of one
///   wall may overlap. They are smaller than the convex part of the wall in which they are, by a 256th at most. What no
///   plate covers is joined in pairs.
///
/// Everything found is proven in exact arithmetic, whatever the triangles are. A segment within the region that passes
/// through a found polygon from one side to the other, or through both polygons of a plate, passes through a triangle.
/// So does a segment that passes through the interior of a found hull or box and has an end outside the body. An end in
/// the body, on its surface or on its open side is not outside. Triangles without area, slivers, duplicates and
/// T-junctions can keep a part from being closed, and then fewer solids are found.
///
/// The result is the same on every machine for the same triangles in the same order. O(n log n): about 0.3 s for
/// 100,000 triangles; two or three times as much for turned walls with many holes. Allocates about 500 bytes per
/// triangle while it runs. Throws BadBound, with the position, for a triangle that is not finite. Throws
/// InvalidArgument as TriangleStream does, for 2³⁰ triangles or more, and for options out of range. Throws
/// std::bad_alloc if memory runs out.
[[nodiscard]] SHAFTCULL_EXPORT FoundSolids find_solids(const TriangleView& triangles, const SolidSearch& search = {});
[[nodiscard]] SHAFTCULL_EXPORT FoundSolids find_solids(const MeshView& mesh, const SolidSearch& search = {});

/// Bodies that are upright boxes, and the triangles that lie on their surfaces.
struct FoundBoxes {
  static constexpr std::uint32_t none = 0xFFFFFFFF;  ///< the triangle lies on no box
  std::vector<Box> boxes;                            ///< all of them, in the order of the bodies
  /// For each triangle, the position in `boxes` of one box that it lies on, or `none`.
  std::vector<std::uint32_t> box_of_triangle;
};

/// Moves bodies that are upright boxes out of solids, except for those into which some triangle reaches. `found` is the
/// unchanged result of find_solids() for the same triangles. Such a box can stand for all triangles that lie on it, and
/// tests of the box take less time. A call of Occluders::add_mesh() (visibility.hpp) does this. O(n log n); allocates.
/// Throws InvalidArgument for null streams, and std::bad_alloc if memory runs out; then `found` is as it was.
[[nodiscard]] SHAFTCULL_EXPORT FoundBoxes take_boxes(FoundSolids& found, const TriangleView& triangles);

}  // namespace shaftcull
