// SPDX-License-Identifier: MIT
/// A shaft made ready for testing.
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

/// The form of a shaft that decides whether boxes and spheres are outside (set_form()). Answers are the same, speed is
/// not.
enum class Form : std::uint8_t {
  slab,    ///< the shaft as a moving box: always faster
  planes,  ///< the paper's planes with near corners
};

/// Most planes that can be added to a shaft.
inline constexpr std::size_t max_added_planes = 16;

class ConvexHull;

/// A test-ready shaft: 832 bytes, no heap memory, freely copied, never changed by a test. One that is copied from a
/// ConvexHull (hull.hpp) refers to that hull, which must live as long as the copy is used.
///
/// A default one was *never formed*: it is valid to copy, to assign to and to complete(), and every query refuses it
/// with InvalidArgument, by its position among many. So an array or a vector of them can be made first and filled
/// later.
///
/// What it holds is the library's own affair, and may change with any version and any processor: keep the boxes, not
/// the bytes. Its members take some nanoseconds, never fail and allocate nothing; const ones are safe to call from many
/// threads.
class SHAFTCULL_EXPORT CompiledShaft {
 public:
  /// Never formed. Writes 8 of the bytes: the others mean nothing until then.
  CompiledShaft() noexcept {
    for (std::size_t i = 0; i != state_size; ++i) storage_[state_at + i] = std::byte{0};
  }

  // A shaft that is copied from a temporary hull would refer to memory that is gone. Calls do take temporary hulls.
  CompiledShaft(const ConvexHull&& hull) = delete;  // NOLINT(google-explicit-constructor)
  CompiledShaft& operator=(const ConvexHull&& hull) = delete;

  /// Whether a call made this shaft, or the one that it is a copy of.
  [[nodiscard]] bool formed() const noexcept;

  /// The boxes that the shaft is between, as they were given; empty boxes, lo = +∞ and hi = −∞, if it was never formed.
  /// For a moving box (volumes.hpp), a() is the body or the occluder, where the box starts, and b() is where it ends,
  /// rounded to nearest. If it moves without end, b() is a place on its way. A shadow does not keep its light. For a
  /// convex hull, both are the box around it.
  [[nodiscard]] Box a() const noexcept;
  [[nodiscard]] Box b() const noexcept;

  /// Whether the joining planes are there: from complete() on, and in a shaft made of a Shaft (paper.hpp). False if the
  /// shaft was never formed.
  [[nodiscard]] bool has_planes() const noexcept;

  /// Whether bounds that only touch the shaft are kept. Contact::closed if it was never formed.
  [[nodiscard]] Contact contact() const noexcept;

  /// The form that decides *outside*. Form::slab for a convex hull and for a shaft that was never formed.
  [[nodiscard]] Form form() const noexcept;

 private:
  friend struct CompiledShaftLayout;  // checks the numbers below against what the library keeps there

  static constexpr std::size_t size = 832;
  static constexpr std::size_t state_at = 112;  ///< of bytes that are 0 in a shaft that was never formed
  static constexpr std::size_t state_size = 8;

  alignas(64) std::byte storage_[size];
};

/// Forms and compiles the shaft between boxes `a` and `b`: about 12 ns with AVX2. Points, flat, equal, nested and
/// touching boxes are legal. Throws InvalidArgument if a box is not finite or has lo > hi. No allocation; safe to call
/// from many threads.
///
/// The shaft is ready for queries in slab form. Joining planes are left pending, as those of compile_batch() are.
/// classify() of one box does not need them: it costs 14 ns for a box outside, and 41 to 50 ns for one within the box
/// around the shaft, where a completed shaft takes 29. A walk through a tree stops above nodes that are inside only for
/// shafts with planes: complete() shafts that keep much.
///
/// `planes` are up to max_added_planes half-spaces that bounds must also meet: the plane of an emitter or receiver, a
/// clip plane. A bound that is fully outside any one of them is outside. Each takes a few nanoseconds. Throws
/// InvalidArgument for a plane that is not finite or whose normal is zero, by its position, and for more planes.
///
/// `contact` is what set_contact() would choose.
[[nodiscard]] SHAFTCULL_EXPORT CompiledShaft compile(const Box& a, const Box& b, std::span<const Plane> planes = {},
                                                     Contact contact = Contact::closed);

/// The same without planes.
[[nodiscard]] SHAFTCULL_EXPORT CompiledShaft compile(const Box& a, const Box& b, Contact contact);

/// Planes that compile_batch() adds to its shafts: those of the shaft's box a, then those of its box b. Examples are
/// the planes of a patch and of the patch that it faces.
///
/// All boxes of a view have equally many planes, k = a.size() / (number of boxes). Box i has planes k · i to
/// k · i + k − 1. An empty span adds none.
struct BatchPlanes {
  std::span<const Plane> a{};  ///< of the boxes a
  std::span<const Plane> b{};  ///< of the boxes b
};

/// Forms and compiles the shaft of every pair (a[i], b[i]) into out[i], several pairs at once with SIMD.
///
/// The shafts equal those of compile(a[i], b[i], planes). Joining planes are left pending. Queries in plane form, about
/// inside, and about some spheres need them. These are spheres against a shaft with a face that both boxes touch, or
/// nearly touch, against a shaft whose boxes are much farther apart than one of them is from the origin, and against
/// boxes with coordinates above 2⁶⁰. A query computes planes that are pending: once per shaft, or, for many shafts
/// against a view, once per shaft and tile of about 1,000 to 2,500 bounds. complete() a shaft that answers such queries
/// more than once.
///
/// Throws InvalidArgument if the three sizes differ, if planes are not equally many for each box, more than
/// max_added_planes in all, not finite or without a normal; BadBound for the first pair with a box that is not finite
/// or has lo > hi. Nothing is written then. O(pairs and planes); no allocation; safe to call from many threads.
///
/// `contact` is the contact of all shafts (set_contact()).
SHAFTCULL_EXPORT void compile_batch(const BoxView& a, const BoxView& b, std::span<CompiledShaft> out,
                                    const BatchPlanes& planes = {}, Contact contact = Contact::closed);

/// Two boxes, by their positions in views.
struct IndexPair {
  std::uint32_t a;  ///< of the view that holds the boxes a
  std::uint32_t b;  ///< of the view that holds the boxes b
  friend bool operator==(const IndexPair&, const IndexPair&) = default;
};

/// As above for the pairs (a[pairs[i].a], b[pairs[i].b]). Both views may be the same one, and then `planes` has the
/// same planes twice: {.a = planes, .b = planes}. Boxes that no pair names are not looked at, and may be anything;
/// planes may not. Throws InvalidArgument if `pairs` and `out` differ in size, for the first pair with an index that is
/// not below the number of boxes, and as above.
SHAFTCULL_EXPORT void compile_batch(const BoxView& a, const BoxView& b, std::span<const IndexPair> pairs,
                                    std::span<CompiledShaft> out, const BatchPlanes& planes = {},
                                    Contact contact = Contact::closed);

/// Computes pending joining planes, in about 65 ns. Does nothing to a shaft that has them, or that was never formed. No
/// allocation. The call writes to the shaft, so no other thread may use the shaft meanwhile.
SHAFTCULL_EXPORT void complete(CompiledShaft& shaft) noexcept;

/// Chooses whether a shaft of any kind keeps bounds that only touch it. All queries follow the choice, in both forms,
/// for views and for trees. Answers are exact. hull.hpp says which spheres a convex hull keeps: of a ConvexHull, set
/// the contact of a copy of its compiled().
///
/// With Contact::open
/// * a box is outside iff its relative interior has no point in common with that of the shaft. In other words: iff some
///   plane has the box on one side and the shaft on the other, and does not hold both;
/// * a sphere is outside iff its centre is at least its radius away from the shaft. One of radius 0 is answered as the
///   box that is this point;
/// * a bound is beyond an added plane iff none of its points is on the inner side, off the plane;
/// * the same bounds are inside as with Contact::closed, except flat ones in the shaft's surface, which are outside;
/// * first_contact() and entry_times() report the bounds that are kept, and their times stay the same.
/// occluded() is the same for both: it is about the relative interiors of the ends.
///
/// Some 10 ns a shaft; may be done at any time, and again. Throws InvalidArgument, and writes nothing, for a shaft that
/// was never formed, by its position; and if `contact` is none of Contact. No allocation. It writes to the shaft, so no
/// other thread may use that shaft meanwhile.
SHAFTCULL_EXPORT void set_contact(CompiledShaft& shaft, Contact contact);
/// The same for all of `shafts`.
SHAFTCULL_EXPORT void set_contact(std::span<CompiledShaft> shafts, Contact contact);

/// Chooses the form in which a shaft decides whether boxes and spheres are outside. Answers stay the same. Form::planes
/// is for comparisons with the paper, and slower; pending planes are computed at once. Occlusion, *inside* and
/// triangles do not depend on the form. Convex hulls have one form and stay as they are.
///
/// May be done at any time, and again. Throws InvalidArgument, and writes nothing, for a shaft that was never formed,
/// by its position; and if `form` is neither of Form. No allocation. It writes to the shaft, so no other thread may use
/// that shaft meanwhile.
SHAFTCULL_EXPORT void set_form(CompiledShaft& shaft, Form form);
/// The same for all of `shafts`.
SHAFTCULL_EXPORT void set_form(std::span<CompiledShaft> shafts, Form form);

}  // namespace shaftcull
