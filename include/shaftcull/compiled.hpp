/// A shaft made ready for testing: coefficients and corner selectors in the order in which kernels read them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "shaftcull/bounds.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/shaft.hpp"
#include "shaftcull/streams.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// A test-ready shaft: 832 bytes, no heap memory, freely copied, never changed by a test.
///
/// A default one was *never formed*: it is valid to copy, to assign to and to complete(), and every query refuses it
/// with InvalidArgument, by its position among many. So an array or a vector of them can be made first and filled
/// later.
///
/// The members are the kernels' own format: read them out of interest, do not depend on them.
/// Arrays are plain so that kernels touch no inline function of the standard library.
///
/// *Slab form.* The shaft is the union of boxes box(t) on the way from a to b. A bound meets it iff some t satisfies
/// six constraints lo_k(t) ≤ hi_k and hi_k(t) ≥ lo_k, each a bound on t from above or below that depends on a single
/// coordinate of the bound. In the fused form t is the position of the leading face, the lo x face of box(t), from
/// a.lo[0] to b.lo[0], so that its own constraint is t ≤ x; in the difference form it runs from 0 to 1. In the relative
/// form it runs from 0, at whichever of the two boxes is nearer to the origin, to the largest slope of a face. What is
/// computed is off relatively to the distance from that box, however far away the other one is.
///
/// *Plane form.* v = n0·x + n1·y + minus_offset at the corner that the selectors name; v > 0 is beyond the plane.
/// The near corner has the smallest v (outside iff v > 0 there), the far corner the largest (inside iff v ≤ 0).
/// A selector is the number of a stream of BoxView.
///
/// A computed value within its margin of 0 is undecided, and the kernel asks the exact predicates, which
/// start again from the boxes a and b.
struct alignas(64) CompiledShaft {
  /// Never formed. Coefficients are not written.
#if defined(__GNUC__)
  [[gnu::always_inline]]  // or units of different instruction sets would each have a copy that the linker may keep
#endif
  CompiledShaft() noexcept
      : joining_count(0), added_count(0), answers_outside(false), answers_inside(false), answers_spheres(false) {
  }

  /// How the slab constraints are evaluated.
  enum class SlabForm : std::uint8_t {
    fused,       ///< t = x · scale + shift, and t = x for the first constraint, that of the leading face
    difference,  ///< t = (x − p) · scale; shift holds p. For purple faces, and where shifts are too large
    relative,    ///< likewise, but slab_margin is relative to the bounds on t. For boxes much farther apart than one is
                 ///< from the origin
    exact,  ///< not at all: coordinates so large or slopes so small that floats overflow; the exact predicate decides
  };

  // First cache line: the slab constraints, bounds on t from above first.
  float slab_scale[6];        ///< slope of t over the slope of the face; ±∞ for a purple face
  float slab_margin;          ///< bound on the error of (largest lower − smallest upper); +∞ if none holds
  float reach;                ///< largest magnitude of a coordinate of a or b
  float slab_shift[6];        ///< see SlabForm
  std::uint8_t slab_near[6];  ///< stream that the constraint reads
  std::uint8_t slab_uppers;   ///< how many of the six bound t from above
  SlabForm slab_form;

  // Second cache line: what the shaft is.
  Box a;
  Box b;
  std::uint8_t joining_count;  ///< planes_pending until completed
  std::uint8_t added_count;
  bool answers_outside;
  bool answers_inside;
  bool answers_spheres;

  /// A plane that was added. Two of them fill a cache line.
  struct alignas(32) AddedPlane {
    float normal[3];
    float minus_offset;
    float margin;
    float length;          ///< of the normal, for spheres
    float slack;           ///< growth of the margin with a sphere's radius
    std::uint8_t near[4];  ///< stream of the near corner on each axis, and a byte that says nothing
  };
  AddedPlane added[max_added_planes];

  // The shaft box and joining planes; not written while they are pending.
  float face[6];         ///< the shaft box, in the order of a BoxView's streams
  float joining_margin;  ///< for all joining planes
  float joining_normal0[max_joining_planes];
  float joining_normal1[max_joining_planes];
  float joining_minus_offset[max_joining_planes];
  std::uint8_t joining_near0[max_joining_planes];
  std::uint8_t joining_near1[max_joining_planes];
  std::uint8_t joining_far0[max_joining_planes];
  std::uint8_t joining_far1[max_joining_planes];

  /// Value of joining_count in a shaft whose planes nobody has asked for yet, from compile_batch() or two boxes.
  static constexpr std::uint8_t planes_pending = 0xff;
  [[nodiscard]] bool has_planes() const noexcept { return joining_count != planes_pending; }
};
static_assert(sizeof(CompiledShaft) <= 1024);

/// Compiles a formed shaft, joining planes included. Never fails. Forming a Shaft and compiling it take some 180 ns
/// together. No allocation; safe to call from many threads.
[[nodiscard]] CompiledShaft compile(const Shaft& shaft) noexcept;

/// Forms and compiles the shaft between boxes `a` and `b`, ready for queries in slab form: some 12 ns with AVX2.
///
/// It answers everything and equals compile(Shaft(a, b)), but for joining planes, which are left pending as those of
/// compile_batch() are. Throws InvalidArgument as the constructor of Shaft does, if a box is not finite or has lo > hi.
/// No allocation; safe to call from many threads.
[[nodiscard]] CompiledShaft compile(const Box& a, const Box& b);

/// Planes that compile_batch() adds to its shafts as Shaft::add_plane() would: those of a shaft's box a, then those of
/// its box b. The planes of a patch and of what it faces, say.
///
/// Each box has as many as all others of its view, k = a.size() / (number of boxes), and box i has planes k · i to
/// k · i + k − 1. Empty: none.
struct BatchPlanes {
  std::span<const Plane> a{};
  std::span<const Plane> b{};
};

/// Forms and compiles the shaft of every pair (a[i], b[i]) into out[i], several pairs at once with SIMD.
///
/// The shafts answer everything and equal compile(Shaft(a[i], b[i])) with planes added, but for joining planes, which
/// are left pending: tests in plane form, every question about inside, and spheres against a shaft whose slab_form is
/// not fused need them, and compute them on the fly, once a call. complete() a shaft that is to answer many such small
/// calls. Throws InvalidArgument if the three sizes differ, if planes are not equally many for each box, more than
/// max_added_planes in all, not finite or without a normal; BadBound for the first pair with a box that is not finite
/// or has lo > hi. Nothing is written then. O(pairs and planes); no allocation; safe to call from many threads.
void compile_batch(const BoxView& a, const BoxView& b, std::span<CompiledShaft> out, const BatchPlanes& planes = {});

/// Two boxes, by their positions in views.
struct IndexPair {
  std::uint32_t a;
  std::uint32_t b;
  friend bool operator==(const IndexPair&, const IndexPair&) = default;
};

/// As above for the pairs (a[pairs[i].a], b[pairs[i].b]). Both views may be the same one, and then `planes` has the
/// same planes twice: {.a = planes, .b = planes}. Boxes that no pair names are not looked at, and may be anything;
/// planes may not. Throws InvalidArgument if `pairs` and `out` differ in size, for the first pair with an index that is
/// not below the number of boxes, and as above.
void compile_batch(const BoxView& a, const BoxView& b, std::span<const IndexPair> pairs, std::span<CompiledShaft> out,
                   const BatchPlanes& planes = {});

/// Computes pending joining planes, some 65 ns; does nothing to a shaft that has them, or that was never formed. No
/// allocation. It writes to the shaft, so no other thread may use that shaft meanwhile.
void complete(CompiledShaft& shaft) noexcept;

}  // namespace shaftcull
