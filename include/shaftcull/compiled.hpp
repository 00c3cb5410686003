// SPDX-License-Identifier: MIT
/// Compiled shafts, which are ready for queries. The shaft between two boxes is the convex hull of both: all segments
/// from a point of one box to a point of the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "shaftcull/bounds.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/streams.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Whether a shaft keeps a bound that touches it without reaching into it (set_contact()).
enum class Contact : std::uint8_t {
  closed,  ///< The bound is kept.
  /// The bound is outside. A bound is kept only if its relative interior and that of the shaft have a point in common.
  /// So the wall that a patch lies on is not kept, and neither is the floor beside it. The relative interior of a flat
  /// box is the rectangle without its edges; that of a segment is the segment without its ends; that of a point is the
  /// point. So a sheet of glass across the shaft is kept, and so is a flat box that reaches into the shaft from the
  /// side.
  open,
};

/// The form of a shaft by which queries decide whether boxes and spheres are outside (set_form()). Both forms give the
/// same answers, at different speeds.
enum class Form : std::uint8_t {
  slab,    ///< the shaft as a moving box: always faster
  planes,  ///< planes, as in the paper, each tested with one corner of a box
};

/// The largest number of planes that can be added to a shaft.
inline constexpr std::size_t max_added_planes = 16;

class ConvexHull;

/// A shaft that is ready for queries. It takes 832 bytes and no heap memory, and can be copied freely; queries never
/// change it. A shaft that is copied from a ConvexHull (hull.hpp) refers to that hull, which must live as long as the
/// copy is used.
///
/// A default-constructed shaft was *never formed*. It can be copied, assigned to and passed to complete(). Every query
/// refuses it with InvalidArgument; among many shafts, the message gives its position. So an array or a vector of
/// shafts can be made first and filled later.
///
/// The content of the bytes is private to the library, and may differ between versions and between processors: store
/// the boxes, not the bytes. Members take a few nanoseconds, never fail and allocate nothing. Const members are safe to
/// call from many threads.
class SHAFTCULL_EXPORT CompiledShaft {
 public:
  /// Makes a shaft that was never formed. Writes 8 of the bytes; the others have no meaning until the shaft is formed.
  CompiledShaft() noexcept {
    for (std::size_t i = 0; i != state_size; ++i) storage_[state_at + i] = std::byte{0};
  }

  // A shaft that is copied from a temporary hull would refer to memory that is gone. Calls do take temporary hulls.
  CompiledShaft(const ConvexHull&& hull) = delete;  // NOLINT(google-explicit-constructor)
  CompiledShaft& operator=(const ConvexHull&& hull) = delete;

  /// Whether a call formed this shaft, or the shaft of which it is a copy.
  [[nodiscard]] bool formed() const noexcept;

  /// The boxes that the shaft is between, as they were given; empty boxes, lo = +∞ and hi = −∞, if the shaft was never
  /// formed. For a moving box (volumes.hpp), a() is the box at the start, which is the body or the occluder, and b() is
  /// the box at the end, rounded to nearest. If the box moves without end, b() is the box at some place on its way. A
  /// shadow does not store its light. For a convex hull, a() and b() are the box around the hull.
  [[nodiscard]] Box a() const noexcept;
  [[nodiscard]] Box b() const noexcept;

  /// Whether the joining planes (paper.hpp) are computed: after complete(), and in a shaft compiled from a Shaft
  /// (paper.hpp). False if the shaft was never formed.
  [[nodiscard]] bool has_planes() const noexcept;

  /// Whether bounds that only touch the shaft are kept. Contact::closed if the shaft was never formed.
  [[nodiscard]] Contact contact() const noexcept;

  /// The form by which queries decide *outside*. Form::slab for a convex hull and for a shaft that was never formed.
  [[nodiscard]] Form form() const noexcept;

 private:
  friend struct CompiledShaftLayout;  // checks the numbers below against the data that the library keeps there

  static constexpr std::size_t size = 832;
  static constexpr std::size_t state_at = 112;  ///< where bytes begin that are 0 in a shaft that was never formed
  static constexpr std::size_t state_size = 8;

  alignas(64) std::byte storage_[size];
};

/// Forms and compiles the shaft between boxes `a` and `b`, in about 12 ns with AVX2. Points are legal, and so are flat,
/// equal, nested and touching boxes. Throws InvalidArgument if a box is not finite or has lo > hi. No allocation; safe
/// to call from many threads.
///
/// The shaft is ready for queries in slab form. Its joining planes are *pending*: neither this call nor compile_batch()
/// computes them. classify() of one box does not need them: it takes 14 ns for a box outside, and 41 to 50 ns for one
/// within the box around the shaft, where a completed shaft takes 29. A query of a tree can skip all tests below a node
/// that is inside only if the shaft has its joining planes: complete() shafts that keep many bounds.
///
/// `planes` are up to max_added_planes half-spaces that a kept bound must also meet, for example the plane of an
/// emitter or receiver, or a clip plane. A bound that lies fully outside any of these half-spaces is outside. Each
/// plane takes a few nanoseconds. Throws InvalidArgument for more planes, and, with its position, for a plane that is
/// not finite or whose normal is zero.
///
/// `contact` is the contact of the shaft (set_contact()).
[[nodiscard]] SHAFTCULL_EXPORT CompiledShaft compile(const Box& a, const Box& b, std::span<const Plane> planes = {},
                                                     Contact contact = Contact::closed);

/// The same without planes.
[[nodiscard]] SHAFTCULL_EXPORT CompiledShaft compile(const Box& a, const Box& b, Contact contact);

/// Planes that compile_batch() adds to each shaft: the planes of its box a, then the planes of its box b. Examples are
/// the planes of a patch and of the patch that it faces.
///
/// All boxes of a view have the same number of planes, k = a.size() / (number of boxes). Box i has planes k · i to
/// k · i + k − 1. An empty span adds no planes.
struct BatchPlanes {
  std::span<const Plane> a{};  ///< planes of the boxes a
  std::span<const Plane> b{};  ///< planes of the boxes b
};

/// Forms and compiles the shaft of every pair (a[i], b[i]) into out[i], several pairs at once with SIMD.
///
/// The shafts equal those of compile(a[i], b[i], planes). Joining planes are left pending. They are needed by queries
/// in plane form, by queries that find bounds inside, and for spheres in three cases: if both boxes of the shaft touch,
/// or nearly touch, the same face of the shaft; if the boxes are much farther apart than one of them is from the
/// origin; and if the boxes have coordinates above 2⁶⁰. A query that needs pending planes computes them once per shaft
/// or, for many shafts against a view, once per shaft and tile of about 1,000 to 2,500 bounds. complete() a shaft that
/// answers more than one such query.
///
/// Throws InvalidArgument if the three sizes differ, if boxes do not have equally many planes, if a shaft would have
/// more than max_added_planes in all, or if a plane is not finite or has no normal. Throws BadBound for the first pair
/// with a box that is not finite or has lo > hi. If the call throws, it writes nothing. O(pairs and planes); no
/// allocation; safe to call from many threads.
///
/// `contact` is the contact of all shafts (set_contact()).
SHAFTCULL_EXPORT void compile_batch(const BoxView& a, const BoxView& b, std::span<CompiledShaft> out,
                                    const BatchPlanes& planes = {}, Contact contact = Contact::closed);

/// Two boxes, by their positions in views.
struct IndexPair {
  std::uint32_t a;  ///< position in the view of the boxes a
  std::uint32_t b;  ///< position in the view of the boxes b
  friend bool operator==(const IndexPair&, const IndexPair&) = default;
};

/// Forms and compiles the shafts of the pairs (a[pairs[i].a], b[pairs[i].b]), as above. Both views may be the same
/// view; then pass its planes twice: {.a = planes, .b = planes}. Boxes that no pair names are not read and may have any
/// values, but all planes are checked. Throws InvalidArgument as above, if `pairs` and `out` differ in size, and for
/// the first pair with an index that is not below the number of boxes.
SHAFTCULL_EXPORT void compile_batch(const BoxView& a, const BoxView& b, std::span<const IndexPair> pairs,
                                    std::span<CompiledShaft> out, const BatchPlanes& planes = {},
                                    Contact contact = Contact::closed);

/// Computes pending joining planes, in about 65 ns. Does nothing to a shaft that already has them or was never formed.
/// No allocation. The call writes to the shaft, so no other thread may use the shaft during the call.
SHAFTCULL_EXPORT void complete(CompiledShaft& shaft) noexcept;

/// Chooses whether a shaft of any kind keeps bounds that only touch it. The choice holds for all queries, in both
/// forms, for views and for trees. Answers are exact; hull.hpp defines which spheres a convex hull keeps. For a
/// ConvexHull, set the contact of a copy of its compiled().
///
/// With Contact::open
/// * a box is outside iff its relative interior has no point in common with that of the shaft. In other words: iff some
///   plane has the box on one side and the shaft on the other, and does not contain both of them;
/// * a sphere is outside iff its centre is at least its radius away from the shaft. A sphere of radius 0 gets the
///   answer of the box that is this point;
/// * a bound is beyond an added plane iff none of its points is strictly on the inner side of the plane;
/// * the same bounds are inside as with Contact::closed, except flat bounds in the surface of the shaft, which are
///   outside;
/// * first_contact() and entry_times() report only bounds that are kept; the times of these bounds stay the same.
/// occluded() gives the same answers for both contacts, since it depends on the relative interiors of the ends.
///
/// About 10 ns per shaft. May be called at any time, and again. Throws InvalidArgument, and writes nothing, for a shaft
/// that was never formed, with its position, and if `contact` is not an enumerator. No allocation. The call writes to
/// the shaft, so no other thread may use the shaft during the call.
SHAFTCULL_EXPORT void set_contact(CompiledShaft& shaft, Contact contact);
/// The same for all of `shafts`.
SHAFTCULL_EXPORT void set_contact(std::span<CompiledShaft> shafts, Contact contact);

/// Chooses the form by which queries decide whether boxes and spheres are outside the shaft. Answers stay the same.
/// Form::planes is slower, and serves for comparisons with the paper; choosing it computes pending planes at once.
/// Queries about occlusion, *inside* and triangles do not use the form. Convex hulls have only one form, and the call
/// does not change them.
///
/// May be called at any time, and again. Throws InvalidArgument, and writes nothing, for a shaft that was never formed,
/// with its position, and if `form` is not an enumerator. No allocation. The call writes to the shaft, so no other
/// thread may use the shaft during the call.
SHAFTCULL_EXPORT void set_form(CompiledShaft& shaft, Form form);
/// The same for all of `shafts`.
SHAFTCULL_EXPORT void set_form(std::span<CompiledShaft> shafts, Form form);

}  // namespace shaftcull
