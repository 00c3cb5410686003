// SPDX-License-Identifier: MIT
/// What a CompiledShaft holds, as kernels read it: coefficients and corner selectors, in the order in which they are
/// read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <type_traits>

#include "compiled/hull_data.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/paper.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// The data of a CompiledShaft. Arrays are plain so that kernels touch no inline function of the standard library.
///
/// *Slab form.* The shaft is the union of boxes box(t) on the way from a to b. A bound meets it iff some t satisfies
/// six constraints lo_k(t) ≤ hi_k and hi_k(t) ≥ lo_k, each a bound on t from above or below that depends on a single
/// coordinate of the bound. In the fused form t is the position of the reference face, the lo x face of box(t), from
/// a[0] to b[0], so that its own constraint is t ≤ x; in the difference form it runs from 0 to 1. In the relative
/// form it runs from 0, at whichever of the two boxes is nearer to the origin, to the largest slope of a face. What is
/// computed is off relatively to the distance from that box, however far away the other one is.
///
/// *Plane form.* v = n0·x + n1·y + minus_offset at the corner that the selectors name; v > 0 is beyond the plane.
/// The near corner has the smallest v (outside iff v > 0 there), the far corner the largest (inside iff v ≤ 0).
/// A selector is the number of a stream of BoxView.
///
/// A computed value within its margin of 0 is undecided, and the kernel asks the exact predicates, which
/// start again from the boxes a and b.
///
/// Faces of a box come in the order of a BoxView's streams.
struct alignas(64) ShaftData {
  /// How the slab constraints are evaluated.
  enum class SlabForm : std::uint8_t {
    fused,       ///< t = x · scale + shift, and t = x for the first constraint, that of the reference face
    difference,  ///< t = (x − p) · scale; shift holds p. For purple faces, and where shifts are too large
    relative,    ///< likewise, but slab_margin is relative to the bounds on t. For boxes much farther apart than one is
                 ///< from the origin
    endless,     ///< likewise, of a box that moves without end: t is how far the first constraint's face has moved
    exact,  ///< not at all: coordinates so large or slopes so small that floats overflow; the exact predicate decides
    hull,   ///< nor this: all answers are those of `hull`
    open_hull,  ///< likewise, with open contact
  };

  /// What moves: face f of box(t) is at a[f] + t · slope[f], t from 0 to an end. MovingFaces has the slopes, unrounded.
  enum class Kind : std::uint8_t {
    between,             ///< from box a to box b, to t = 1
    swept,               ///< box a by a displacement, motion, to t = 1
    swept_infinite,      ///< likewise, but t has no end
    shadow,              ///< away from the corners of a light, motion, to t = reach − 1; a is the occluder
    shadow_without_end,  ///< likewise, but t has no end
    hull,                ///< nothing: a convex hull, and slab_form says so, too
  };

  // First cache line: the slab constraints, bounds on t from above first.
  float slab_scale[6];        ///< slope of t over the slope of the face; ±∞ for a purple face
  float slab_margin;          ///< bound on the error of (largest lower − smallest upper); +∞ if none holds
  float largest_coordinate;   ///< largest magnitude of a coordinate of a or b
  float slab_shift[6];        ///< see SlabForm
  std::uint8_t slab_near[6];  ///< stream that the constraint reads
  std::uint8_t slab_uppers;   ///< how many of the six bound t from above
  SlabForm slab_form;

  // Second cache line: what the shaft is.
  float a[6];  ///< faces of box a; of a hull, a and b are its box
  float b[6];  ///< faces of box b; of other kinds, where the box ends, rounded, or on its way if it never does
  std::uint8_t joining_count;  ///< planes_pending until completed
  std::uint8_t added_count;
  bool formed;
  Kind kind;
  Contact contact : 4;
  Form form : 4;             ///< which decides *outside*
  std::uint8_t still_faces;  ///< with open contact, the faces that do not move, bit f for face f; else 0

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

  // The shaft box and joining planes; not written while they are pending, but for the faces of kinds other than
  // `between`.
  float face[6];         ///< of the shaft box; if that is no float, the next one inside it
  float joining_margin;  ///< for all joining planes
  float joining_normal0[max_joining_planes];
  float joining_normal1[max_joining_planes];
  float joining_minus_offset[max_joining_planes];
  std::uint8_t joining_near0[max_joining_planes];
  std::uint8_t joining_near1[max_joining_planes];
  std::uint8_t joining_far0[max_joining_planes];
  std::uint8_t joining_far1[max_joining_planes];

  // Not written in a shaft between two boxes.
  float motion[6];  ///< swept: the displacement, once for each face. Shadow: the light's face that faces of a move from
  float reach;      ///< of a shadow that ends: the end of t, and 1

  const HullData* hull;  ///< for SlabForm::hull alone; not this shaft's own

  /// Value of joining_count in a shaft whose planes nobody has asked for yet, from compile_batch() or two boxes.
  static constexpr std::uint8_t planes_pending = 0xff;

  // Inlined wherever they are called: a unit of an instruction set must not leave a copy that the linker may keep.
  SHAFTCULL_ALWAYS_INLINE [[nodiscard]] bool is_hull() const noexcept { return slab_form >= SlabForm::hull; }
  SHAFTCULL_ALWAYS_INLINE [[nodiscard]] bool is_open_hull() const noexcept { return slab_form == SlabForm::open_hull; }
  SHAFTCULL_ALWAYS_INLINE [[nodiscard]] bool has_planes() const noexcept { return joining_count != planes_pending; }
  SHAFTCULL_ALWAYS_INLINE [[nodiscard]] bool is_formed() const noexcept { return formed; }
  SHAFTCULL_ALWAYS_INLINE [[nodiscard]] bool is_endless() const noexcept {
    return kind == Kind::swept_infinite || kind == Kind::shadow_without_end;
  }
};

/// Parts of a shaft that are read and written at once: rows of eight floats, each six of a member and what follows it,
/// and the eight bytes of selectors. Their values are where they begin.
enum class ShaftRow : std::size_t {
  scale = offsetof(ShaftData, slab_scale),  ///< and slab_margin and largest_coordinate
  shift = offsetof(ShaftData, slab_shift),  ///< and the selectors
  selectors = offsetof(ShaftData, slab_near),
  a = offsetof(ShaftData, a),  ///< and the first two faces of b, so it is written before the row of b
  b = offsetof(ShaftData, b),  ///< and the counts and what follows them
};

/// The bytes of a row.
SHAFTCULL_ALWAYS_INLINE [[nodiscard]] inline const void* row_of(const ShaftData& shaft, ShaftRow row) noexcept {
  return static_cast<const std::byte*>(static_cast<const void*>(&shaft)) + static_cast<std::size_t>(row);
}
SHAFTCULL_ALWAYS_INLINE [[nodiscard]] inline void* row_of(ShaftData& shaft, ShaftRow row) noexcept {
  return static_cast<std::byte*>(static_cast<void*>(&shaft)) + static_cast<std::size_t>(row);
}

static_assert(offsetof(ShaftData, slab_margin) == offsetof(ShaftData, slab_scale) + 6 * sizeof(float));
static_assert(offsetof(ShaftData, largest_coordinate) == offsetof(ShaftData, slab_scale) + 7 * sizeof(float));
static_assert(offsetof(ShaftData, slab_near) == offsetof(ShaftData, slab_shift) + 6 * sizeof(float));
static_assert(offsetof(ShaftData, slab_form) == offsetof(ShaftData, slab_near) + 7);
static_assert(offsetof(ShaftData, b) == offsetof(ShaftData, a) + 6 * sizeof(float));
static_assert(offsetof(ShaftData, joining_count) == offsetof(ShaftData, b) + 6 * sizeof(float));
static_assert(offsetof(ShaftData, added) >= offsetof(ShaftData, b) + 8 * sizeof(float));

// The storage of a CompiledShaft is an array of std::byte, in which a ShaftData lives from the beginning: such arrays
// create implicitly what their bytes are used as, and copies of the bytes copy it.
static_assert(sizeof(ShaftData) == sizeof(CompiledShaft) && alignof(ShaftData) == alignof(CompiledShaft));
static_assert(std::is_aggregate_v<ShaftData> && std::is_trivially_destructible_v<ShaftData>, "implicit lifetime");
static_assert(std::is_trivially_copyable_v<ShaftData> && std::is_trivially_copyable_v<CompiledShaft>);
static_assert(std::is_trivially_default_constructible_v<ShaftData>, "kernels have some on the stack");
static_assert(std::is_standard_layout_v<CompiledShaft>, "its address is that of its storage");

/// The data of a shaft: the one place where a CompiledShaft is looked into.
SHAFTCULL_ALWAYS_INLINE [[nodiscard]] inline const ShaftData& data_of(const CompiledShaft& shaft) noexcept {
  return *std::launder(reinterpret_cast<const ShaftData*>(&shaft));
}
SHAFTCULL_ALWAYS_INLINE [[nodiscard]] inline ShaftData& data_of(CompiledShaft& shaft) noexcept {
  return *std::launder(reinterpret_cast<ShaftData*>(&shaft));
}

/// Likewise of shafts side by side, whose data are side by side. A span that is empty or null gives one that is null.
[[nodiscard]] inline std::span<const ShaftData> data_of(std::span<const CompiledShaft> shafts) noexcept {
  return {shafts.empty() || shafts.data() == nullptr ? nullptr : &data_of(*shafts.data()), shafts.size()};
}
[[nodiscard]] inline std::span<ShaftData> data_of(std::span<CompiledShaft> shafts) noexcept {
  return {shafts.empty() || shafts.data() == nullptr ? nullptr : &data_of(*shafts.data()), shafts.size()};
}

}  // namespace shaftcull::kernel

namespace shaftcull {

/// What the header of CompiledShaft says in numbers of the data in it.
struct CompiledShaftLayout {
  static_assert(offsetof(kernel::ShaftData, joining_count) == CompiledShaft::state_at &&
                    offsetof(kernel::ShaftData, formed) < CompiledShaft::state_at + CompiledShaft::state_size,
                "what its constructor writes");
};

}  // namespace shaftcull
