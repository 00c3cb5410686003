// SPDX-License-Identifier: MIT
/// Convex hulls in place of shafts: view frusta, shadow casters of a view, volumes between polygons.
///
/// A hull can be used wherever a compiled shaft can, alone or among shafts, with views, streams and trees. There are
/// two exceptions. Calls for times (first_contact.hpp) throw InvalidArgument for a hull. Calls for occluders
/// (occluded.hpp) throw it for a hull that was not made by between_polygons().
///
/// A *box* is outside a hull iff the two have no point in common, and inside iff all of it lies in the hull. Both are
/// exact for the floats given, wherever the points lie. The usual test of a frustum by its six planes keeps large boxes
/// beyond its corners; this test does not. HullTest::conservative is the usual test.
///
/// A *sphere* is outside if it is beyond a plane that decides answers for boxes: the plane of a face of the hull, of an
/// outline edge as seen along x, y or z, or of a face of the hull's box. It is inside if it is behind all of these
/// planes by at least its radius. So a sphere near a corner or an edge may be kept although it is outside. Rounding
/// errs to the safe side, by about 2⁻²⁸ of the largest coordinate: no sphere that meets the hull is outside, and no
/// sphere that leaves it is inside. All machines give the same answers.
///
/// *Planes* cannot be added to hulls. The planes of two polygons that face each other cut nothing off the hull between
/// them, since all of it is in front of both planes. Where planes do matter, query a second shaft that has the planes,
/// and keep the bounds that both keep: `compile(hull.box(), hull.box(), planes)` keeps the bounds that meet the box
/// around the hull and are beyond no plane. The result is exactly that of a hull with added planes, and costs less than
/// a second test of the hull.
///
/// Contact is closed: bounds that touch a hull are not outside. A copy of the shaft can have open contact, as in
/// `CompiledShaft shaft = hull; set_contact(shaft, Contact::open);`. Then
/// * a box is outside iff its relative interior has no point in common with that of the hull, exactly. The relative
///   interior of a flat hull is the hull without its rim; of a segment, the segment without its ends; of a point, the
///   point. With HullTest::conservative a box is outside iff it is beyond one of the faces that the test uses, or
///   touches that face from outside;
/// * a sphere of radius above 0 is also outside if it touches a face of the box around the hull from outside. A sphere
///   that touches another plane may be kept. A sphere of radius 0 gets the exact answer of the box that is this point;
/// * of the bounds that are not outside, the same ones are inside as with closed contact.
///
/// *Triangles* are tested as triangles.hpp defines, exactly with either contact. For hulls with an interior, floats
/// decide nearly all answers. For flat hulls, exact arithmetic decides the answers for triangles whose boxes meet the
/// box of the hull, in microseconds each.
///
/// keeps() and classify() of one bound take about 10 to 20 ns for a view (Zen 4), and as long for a hull with
/// directions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/geometry.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// How hulls cull boxes. Answers for spheres, and answers about *inside*, are the same for both tests.
enum class HullTest : std::uint8_t {
  /// Boxes are outside iff they have no point in common with the hull.
  exact,
  /// Boxes are outside iff they are beyond one face of the hull: the usual test of a frustum by its planes. It keeps
  /// every box that the exact test keeps, and also boxes, most of them large, beside edges and corners of the hull. Of
  /// several faces that are parallel within a third of a degree, the test uses one. If a face is perpendicular to x, y
  /// or z, or if the hull has fewer than four faces, boxes that miss the box around the hull are outside, too. Times:
  /// docs/measurements.md, *Convex hulls*.
  conservative,
};

/// The convex hull of up to 32 points, ready for queries. With directions, the hull has no end: it contains all points
/// that are reached from the hull of the points along the directions.
///
/// Const members are safe to call from many threads. Copies are deep. Forming or copying a hull allocates about 17 KB.
class SHAFTCULL_EXPORT ConvexHull {
 public:
  static constexpr std::size_t max_vertices = 32;  ///< the most points and directions together

  /// Forms the hull. Repeated, coplanar, collinear and single points are legal. Throws InvalidArgument if there is no
  /// point, if points and directions are more than max_vertices, if one is not finite, if a direction is zero, or if
  /// `test` is not an enumerator. Takes about 1.4 µs for 8 points, and about 10 µs for 32 on a sphere: O(n²). Flat
  /// hulls, and those with directions on all sides, take O(n³).
  explicit ConvexHull(std::span<const Vec3> points, std::span<const Vec3> directions = {},
                      HullTest test = HullTest::exact);

  ConvexHull(const ConvexHull& other);
  ConvexHull& operator=(const ConvexHull& other);
  /// A moved-from hull counts as never formed: queries refuse it, points() is empty, and it can be copied, assigned to
  /// and destroyed.
  ConvexHull(ConvexHull&& other) noexcept;
  ConvexHull& operator=(ConvexHull&& other) noexcept;
  ~ConvexHull();

  /// The hull as a shaft for queries. Copies of the shaft refer to this hull, and are valid until the hull is assigned
  /// to, moved from or destroyed. So shafts cannot be copied from temporary hulls. The shaft's a() and b() are box().
  [[nodiscard]] const CompiledShaft& compiled() const& noexcept { return compiled_; }
  const CompiledShaft& compiled() const&& = delete;
  operator const CompiledShaft&() const& noexcept { return compiled_; }  // NOLINT(google-explicit-constructor)

  /// The smallest box around all points, infinite on the sides to which directions lead.
  [[nodiscard]] Box box() const noexcept;
  /// The points and the directions, as they were given.
  [[nodiscard]] std::span<const Vec3> points() const noexcept;
  [[nodiscard]] std::span<const Vec3> directions() const noexcept;
  /// The test, as it was given; exact for a moved-from hull.
  [[nodiscard]] HullTest test() const noexcept;

 private:
  friend SHAFTCULL_EXPORT ConvexHull casters(const ConvexHull& view, const Vec3& light);
  friend SHAFTCULL_EXPORT ConvexHull casters_towards(const ConvexHull& view, const Vec3& towards_sun);
  friend SHAFTCULL_EXPORT ConvexHull between_polygons(std::span<const Vec3> p, std::span<const Vec3> q, HullTest test);

  /// The hull of a view and one more point or direction.
  ConvexHull(const ConvexHull& view, const Vec3& light, bool is_direction);
  /// The first `first_end` points are the first of two ends, the others the second; 0 if the hull has no two ends.
  ConvexHull(std::span<const Vec3> points, std::span<const Vec3> directions, HullTest test, std::size_t first_end);
  void refer() noexcept;

  struct Parts;
  std::unique_ptr<Parts> parts_;
  CompiledShaft compiled_;  // refers to parts_
};

// Each function below forms a ConvexHull: it takes the time and the allocation of the constructor, throws
// std::bad_alloc if memory runs out, and is safe to call from many threads. Form a view once per frame, not once per
// query.

/// Returns the hull of two ends, such as polygons or turned boxes. Each end is the convex hull of its corners, in any
/// order. The result is the shaft between the ends, and occluded(), find_occluder() and list_occluders() accept it: a
/// solid blocks it if every segment between the relative interiors of the two ends passes through the solid
/// (occluded.hpp). Otherwise, it is a ConvexHull of the corners of both.
///
/// Throws InvalidArgument if an end has no corner, if both together have more than ConvexHull::max_vertices, if a
/// corner is not finite, or if `test` is not an enumerator.
[[nodiscard]] SHAFTCULL_EXPORT ConvexHull between_polygons(std::span<const Vec3> p, std::span<const Vec3> q,
                                                           HullTest test = HullTest::exact);

/// Returns the volume that a view-projection matrix shows: the hull of its eight corners. For a projection without a
/// far plane it is the hull of the four near corners and the four directions in which the view continues.
///
/// The matrix is as for view_planes(). Corners are computed in doubles and rounded to the nearest floats; the hull is
/// exact for these floats. Throws InvalidArgument if the matrix is not finite or not invertible, if a corner overflows
/// a float or is not in front of the eye, if a plane of the matrix leaves nothing in view, or if `depth` or `test` is
/// not an enumerator.
[[nodiscard]] SHAFTCULL_EXPORT ConvexHull frustum(std::span<const float, 16> matrix, ClipDepth depth,
                                                  HullTest test = HullTest::exact);

/// Returns the hull of `view` and a light at a point, which contains all points that can cast a shadow into the view.
/// The hull has the test of the view. Throws InvalidArgument if the light is not finite, or if the view has
/// max_vertices already or was never formed. The call starts from the faces of the view, unless the view has directions
/// or is flat. Starting from faces takes half the time of a hull of all points, or a sixth if the light is within the
/// view. So form a view once for all of its lights.
[[nodiscard]] SHAFTCULL_EXPORT ConvexHull casters(const ConvexHull& view, const Vec3& light);

/// Returns the hull of `view` and all points that lie from it towards the sun, which contains all points that can cast
/// the sun's shadow into the view. The hull has the test of the view. Throws InvalidArgument if the direction is not
/// finite or zero, or if the view has max_vertices already or was never formed.
[[nodiscard]] SHAFTCULL_EXPORT ConvexHull casters_towards(const ConvexHull& view, const Vec3& towards_sun);

}  // namespace shaftcull
