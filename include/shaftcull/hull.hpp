// SPDX-License-Identifier: MIT
/// Convex hulls in the place of shafts: view frusta, what casts shadows into view, volumes between polygons.
///
/// A hull goes where a compiled shaft goes, alone or among shafts, on views, streams and trees. Refused with
/// InvalidArgument are set_contact(), calls for times (first_contact.hpp), calls for what blocks (occluded.hpp), and
/// the exact test of triangles, which is the default there: pass TriangleTest::vertices.
///
/// A *box* is outside a hull iff the two have no point in common, and inside iff all of it lies in the hull: exactly,
/// for the floats that were given, whatever way the points lie. The usual test of a frustum by its six planes keeps
/// large boxes behind its corners; this one does not.
///
/// A *sphere* is outside if it is beyond a plane that the boxes' answers depend on: those of the hull's faces, of the
/// edges that the hull shows along x, y and z, and the faces of its box. It is inside if it is behind all of these by
/// its radius at least. So spheres near a corner or an edge may be kept though they are outside. Rounding errs to the
/// safe side, by some 2⁻²⁸ of the largest coordinate: none that meets the hull is outside, none that leaves it is
/// inside. All machines give the same answers.
///
/// Contact is closed: what touches a hull is not outside, and set_contact() refuses hulls.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/geometry.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// The convex hull of up to 32 points, ready for queries. With directions it has no end: it is all that is reached from
/// one of the points' hull along these.
///
/// Const members are safe to call from many threads, copies are deep. Forming one allocates some 7 KB; copies do, too.
class SHAFTCULL_EXPORT ConvexHull {
 public:
  static constexpr std::size_t max_vertices = 32;  ///< points and directions together

  /// Repeated points, flat, straight and single ones are legal. Throws InvalidArgument if there is no point, if there
  /// are more than max_vertices, if one is not finite, or if a direction is zero. Takes some 3 µs for 8 points, and
  /// some 150 µs for 32: O(n³) planes, each of which is compared with points until one is beyond it.
  explicit ConvexHull(std::span<const Vec3> points, std::span<const Vec3> directions = {});

  ConvexHull(const ConvexHull& other);
  ConvexHull& operator=(const ConvexHull& other);
  /// What is moved from was never formed: queries refuse it, points() is empty, and it can be copied, assigned to and
  /// destroyed.
  ConvexHull(ConvexHull&& other) noexcept;
  ConvexHull& operator=(ConvexHull&& other) noexcept;
  ~ConvexHull();

  /// For queries. Copies of it refer to this hull: they are valid until it is assigned to, moved from or destroyed. Its
  /// a() and b() are box().
  [[nodiscard]] const CompiledShaft& compiled() const noexcept { return compiled_; }
  operator const CompiledShaft&() const noexcept { return compiled_; }  // NOLINT(google-explicit-constructor)

  /// The box around the hull: the least box of all points, infinite where directions lead.
  [[nodiscard]] Box box() const noexcept;
  /// As they were given: points, then directions.
  [[nodiscard]] std::span<const Vec3> points() const noexcept;
  [[nodiscard]] std::span<const Vec3> directions() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
  CompiledShaft compiled_;  // refers to the parts
};

// Each of the following forms a ConvexHull, with its time, allocation and std::bad_alloc, and is safe to call from many
// threads. Form views once a frame, not once a query.

/// What a view-projection matrix shows: the hull of its eight corners. Of a projection without a far plane, that of the
/// four near corners and the four directions in which the view goes on.
///
/// The matrix is as for view_planes(). Corners are computed in doubles and rounded to the nearest floats; the hull is
/// exact for these. Throws InvalidArgument if the matrix is not finite or not invertible, if a corner is not a float or
/// not in front of the eye, if a plane of the matrix leaves nothing in view, or if `depth` is no enumerator.
[[nodiscard]] SHAFTCULL_EXPORT ConvexHull frustum(std::span<const float, 16> matrix, ClipDepth depth);

/// What can cast a shadow into `view` by a light at a point: the hull of both. Throws InvalidArgument if the light is
/// not finite, or if the view has max_vertices already or was never formed.
[[nodiscard]] SHAFTCULL_EXPORT ConvexHull casters(const ConvexHull& view, const Vec3& light);

/// What can cast a shadow into `view` by a sun: the view and all that lies from it towards the sun. Throws
/// InvalidArgument if the direction is not finite or zero, or if the view has max_vertices already or was never formed.
[[nodiscard]] SHAFTCULL_EXPORT ConvexHull casters_towards(const ConvexHull& view, const Vec3& towards_sun);

}  // namespace shaftcull
