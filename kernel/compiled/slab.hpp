// SPDX-License-Identifier: MIT
/// The slab form of a compiled shaft: the order of its constraints, and the error margins of its three forms.
///
/// docs/exactness.md derives the margins.
#pragma once

#include <cstddef>
#include <cstdint>

#include "compiled/shaft_data.hpp"
#include "support/exact_floats.hpp"

namespace shaftcull::kernel {

/// The order of a compiled shaft's constraints: those that bound t from above come first.
struct SlabOrder {
  std::uint32_t face[8];  ///< the last two stay where they are: what follows the faces in a row
  struct {
    std::uint8_t near[6];
    std::uint8_t uppers;
    ShaftData::SlabForm form;
  } selectors;  ///< as they are in ShaftRow::selectors
};

/// The stream that holds the corner of a bound nearest to face f of a shaft: the opposite face of the bound.
inline constexpr std::uint8_t near_stream[6] = {3, 4, 5, 0, 1, 2};

/// By the set of faces whose scale is negative (bit f for face f). A lo face bounds t from above if it moves in the
/// direction of the reference face, a hi face if it moves in the other. So the reference face itself is always the
/// first.
inline constexpr auto slab_orders = [] {
  struct {
    SlabOrder by_negative[64];
  } orders{};
  for (unsigned negative = 0; negative < 64; ++negative) {
    SlabOrder& order = orders.by_negative[negative];
    unsigned next = 0;
    for (const bool upper : {true, false}) {
      for (unsigned f = 0; f < 6; ++f) {
        const bool moves_along = (negative >> f & 1) == 0;
        if ((moves_along == (f < 3)) != upper) continue;
        order.face[next] = f;
        order.selectors.near[next++] = near_stream[f];
      }
      if (upper) order.selectors.uppers = static_cast<std::uint8_t>(next);
    }
    order.face[6] = 6;
    order.face[7] = 7;
    order.selectors.form = ShaftData::SlabForm::fused;
  }
  return orders;
}();

/// Counts and flags of every shaft that compile_batch() makes, as the two floats that follow box b in a row of its
/// columns.
struct BatchFlags {
  std::uint8_t joining_count = ShaftData::planes_pending;
  std::uint8_t added_count = 0;
  bool formed = true;
  ShaftData::Kind kind = ShaftData::Kind::between;
  Contact contact = Contact::closed;
  std::uint8_t still_faces = 0;
  std::uint8_t unused[2] = {};
};
struct TwoFloats {
  float of[2];
};
constexpr TwoFloats flags_of(ShaftData::Kind kind) noexcept {
  BatchFlags flags;
  flags.kind = kind;
  return __builtin_bit_cast(TwoFloats, flags);
}
inline constexpr TwoFloats batch_flags = flags_of(ShaftData::Kind::between);

static_assert(offsetof(ShaftData, formed) == offsetof(ShaftData, joining_count) + offsetof(BatchFlags, formed));
static_assert(offsetof(ShaftData, kind) == offsetof(ShaftData, joining_count) + offsetof(BatchFlags, kind));
static_assert(offsetof(ShaftData, still_faces) ==
              offsetof(ShaftData, joining_count) + offsetof(BatchFlags, still_faces));

/// Half the distance from 1 to the next float: what a rounding may be off by, relatively.
inline constexpr float float_unit = 0x1p-24F;

/// Coordinates above this could overflow in a difference, slopes below its inverse in a quotient: such
/// shafts get a margin that leaves every lane to the exact predicates.
inline constexpr float regular_limit = 0x1p125F;

/// Likewise for the fused form, where two slopes are divided by each other.
inline constexpr float fused_regular_limit = 0x1p60F;

/// The fused form is used while no position of the reference face and no shift is larger than this many times the
/// travel of the reference face. Above that its margin leaves so many lanes undecided that the difference form is
/// faster, though it takes a third more time.
inline constexpr float fused_limit = 4096.0F;

inline constexpr float margin_slack = 1.0F + 0x1p-10F;  // terms of second order, and the margin's own rounding
inline constexpr float fused_margin_per_position =
    20 * float_unit * margin_slack;  // of the reference face, and of shifts
inline constexpr float fused_margin_per_travel = 12 * float_unit * margin_slack;
inline constexpr float difference_margin = 16 * float_unit * margin_slack;
inline constexpr float relative_margin = 12 * float_unit;  // 1 ± this is a float
inline constexpr float relative_denormals = 0x1p-124F;     // far above what underflow may take away

// The endless form. Lower bounds on t are lowered by the margin; what exceeds them by the second factor, and by three
// of the denormals, is not outside.
inline constexpr float endless_margin = 16 * float_unit;        // 1 − this is a float
inline constexpr float endless_kept_per_margin = 2.5F;          // 1 + 40 units is a float
inline constexpr float endless_corner_margin = 4 * float_unit;  // of the start of the box, for corners of spheres
inline constexpr float endless_limit = 0x1p100F;                // coordinates above it, and slopes, have no such form
inline constexpr float endless_start_limit = 0x1p120F;          // nor have starts above it, as the first face moves,
inline constexpr float least_endless_scale = 0x1p-120F;         // or faces so much faster than that one

/// How far a box that moves without end is followed for certain acceptances of spheres: so many times its largest
/// coordinate.
inline constexpr double endless_followed = 16;

/// The rounding of where a moving box ends adds less than a quarter to the margins of the fused form, and to what
/// depends on the largest coordinate.
inline constexpr float rounded_end_factor = 1.25F;

/// The relative form is used where the farther box has a coordinate above the first, and the nearer one no coordinate
/// above that times the second: a sweep through a scene and far beyond it. Margins of the other forms grow with the
/// distance between the boxes.
inline constexpr float largest_plain_coordinate = 0x1p20F;
inline constexpr float far_apart = 0x1p-14F;

}  // namespace shaftcull::kernel
