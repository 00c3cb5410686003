// SPDX-License-Identifier: MIT
/// Shafts of one moving box, formed and compiled in registers: its six faces in the lanes of one vector.
///
/// Each kernel forms nearly all shafts. If a shaft ends, its bits are those that kernel/shafts/moving_shaft.cpp would
/// write, which forms the rest. The kernel returns false for the rest, and for arguments that are refused: what `out`
/// holds then means nothing.
#pragma once

#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "compiled/shaft_data.hpp"
#include "compiled/slab.hpp"
#include "kernels/forming/slab_of_pair.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

static_assert(offsetof(ShaftData, reach) == offsetof(ShaftData, motion) + 6 * sizeof(float));
static_assert(offsetof(ShaftData, motion) + 8 * sizeof(float) <= sizeof(ShaftData), "written as eight floats");

/// The vectors of a moving box. The last two lanes repeat faces 4 and 5.
template <class L>
struct BoxMotion {
  using EightFloats = typename L::EightFloats;
  using Vector = typename EightFloats::Vector;

  /// A vector for each face: lo and hi faces move alike.
  SHAFTCULL_ALWAYS_INLINE static Vector for_faces(const float* vector) noexcept {
    static constexpr std::uint32_t x_y_z[8] = {0, 1, 6, 0, 1, 6, 1, 6};
    return EightFloats::permuted(
        EightFloats::with_last_two(EightFloats::pair_in_all(vector[0], vector[1]), EightFloats::all(vector[2])), x_y_z);
  }
  /// The opposite faces of a box.
  SHAFTCULL_ALWAYS_INLINE static Vector opposite_faces(const void* box) noexcept {
    static constexpr std::uint32_t opposite[8] = {3, 4, 5, 0, 1, 2, 1, 2};
    return EightFloats::permuted(EightFloats::load_faces(box), opposite);
  }
  /// What moves, and the end of t, 1. What is behind says nothing unless the shaft is a hull.
  SHAFTCULL_ALWAYS_INLINE static void write_motion(Vector motion, ShaftData& out) noexcept {
    void* const row = static_cast<std::byte*>(static_cast<void*>(&out)) + offsetof(ShaftData, motion);
    EightFloats::store(row, EightFloats::with_last_two(motion, EightFloats::pair_in_all(1, 0)));
  }
};

/// A box that moves by a displacement.
template <class L>
bool compile_swept(const void* body, const float* displacement, ShaftData& out) noexcept {
  using EightFloats = typename L::EightFloats;
  using Vector = typename EightFloats::Vector;
  const Vector start = EightFloats::load_faces(body);
  const Vector motion = BoxMotion<L>::for_faces(displacement);
  // Sums of floats are rounded once, and what that leaves out is a float: two_sum().
  const Vector end = EightFloats::add(start, motion);
  const Vector motion_virtual = EightFloats::subtract(end, start);
  const Vector start_virtual = EightFloats::subtract(end, motion_virtual);
  const Vector left_out =
      EightFloats::add(EightFloats::subtract(start, start_virtual), EightFloats::subtract(motion, motion_virtual));
  const SlabOfPair<L> slab(start, end);
  if (!(slab.is_finite && slab.is_plain())) [[unlikely]]
    return false;
  slab.write(flags_of(ShaftData::Kind::swept), rounded_end_factor, out);
  BoxMotion<L>::write_motion(motion, out);

  float first[8];
  float last[8];
  float error[8];
  float way[8];
  EightFloats::store(first, start);
  EightFloats::store(last, end);
  EightFloats::store(error, left_out);
  EightFloats::store(way, motion);
  float face[8];
  for (unsigned f = 0; f < 8; ++f) {
    // The last float that is not further out than the end, of faces that move outwards.
    const auto bits = __builtin_bit_cast(std::int32_t, last[f]);
    const std::int32_t upwards = bits < 0 ? -1 : 1;
    const std::int32_t step = f < 3 ? (error[f] > 0 ? upwards : 0) : (error[f] < 0 ? -upwards : 0);
    const float within = __builtin_bit_cast(float, bits + step);
    face[f] = (f < 3 ? way[f] < 0 : way[f] > 0) ? within : first[f];
  }
  std::memcpy(out.face, face, sizeof out.face);
  return true;
}

/// The largest of eight.
template <class Number>
SHAFTCULL_ALWAYS_INLINE inline Number largest_of(const Number (&of)[8]) noexcept {
  const auto larger = [](Number a, Number b) { return a < b ? b : a; };
  Number four[4];
  for (unsigned i = 0; i < 4; ++i) four[i] = larger(of[i], of[i + 4]);
  return larger(larger(four[0], four[2]), larger(four[1], four[3]));
}

/// Writes where a box is when it was followed, and the shaft box. Returns the largest coordinate, or +∞ if the box left
/// the floats.
SHAFTCULL_ALWAYS_INLINE inline float write_followed(const float (&start)[8], const float (&minuend)[8],
                                                    const float (&subtrahend)[8], TwoFloats flags,
                                                    ShaftData& out) noexcept {
  double way[8];
  double size[8];
  double distance[8];
  for (unsigned f = 0; f < 8; ++f) {
    way[f] = double{minuend[f]} - double{subtrahend[f]};
    size[f] = fabs(way[f]);
    distance[f] = fabs(double{start[f]});
  }
  const double speed = largest_of(size);
  const double largest = largest_of(distance);
  const double t = (largest == 0 ? speed : endless_followed * largest) / speed;
  float end[8];
  float face[8];
  for (unsigned f = 0; f < 8; ++f) {
    end[f] = static_cast<float>(start[f] + t * way[f]);
    const float edge = f < 3 ? -FLT_MAX : FLT_MAX;
    face[f] = (f < 3 ? way[f] < 0 : way[f] > 0) ? edge : start[f];
  }
  // Rounding may swap what is as good as equal.
  for (unsigned k = 0; k < 3; ++k) end[k + 3] = end[k] < end[k + 3] ? end[k + 3] : end[k];
  end[6] = flags.of[0];
  end[7] = flags.of[1];
  std::memcpy(row_of(out, ShaftRow::b), end, sizeof end);
  std::memcpy(out.face, face, sizeof out.face);
  float reached = static_cast<float>(largest);
  for (unsigned f = 0; f < 6; ++f) reached = fabsf(end[f]) > reached ? fabsf(end[f]) : reached;
  return reached;
}

/// A box that moves without end, each face from `start` by minuend − subtrahend. It must be ordered.
template <class L>
SHAFTCULL_ALWAYS_INLINE inline bool compile_endless(ShaftData::Kind kind, typename L::EightFloats::Vector start,
                                                    typename L::EightFloats::Vector minuend,
                                                    typename L::EightFloats::Vector subtrahend,
                                                    ShaftData& out) noexcept {
  using EightFloats = typename L::EightFloats;
  using Vector = typename EightFloats::Vector;
  const Vector slope = EightFloats::subtract(minuend, subtrahend);
  // The first constraint is that of the face that moves fastest of those that follow the box. It bounds t from above,
  // wherever the bound is.
  const Vector following = EightFloats::negate_hi(EightFloats::with_last_two(slope, EightFloats::all(-FLT_MAX)));
  const float speed = EightFloats::largest_of_three(following, following, following).of[0];
  const unsigned fastest = EightFloats::signs(EightFloats::choose(
      EightFloats::less_equal(EightFloats::all(speed), following), EightFloats::all(-1), EightFloats::all(1)));
  const Vector quotient = EightFloats::divide(EightFloats::all(speed), slope);

  float from[8];
  float to[8];
  float ways[8];
  float starts[8];
  float scale[8];
  EightFloats::store(starts, start);
  EightFloats::store(ways, slope);
  EightFloats::store(scale, quotient);
  int suits = 1;
  for (unsigned f = 0; f < 8; ++f) {
    // A denormal has fewer bits than the margin supposes: a face that is as much faster than all that follow the box.
    // What the corner of a sphere is rounded by counts for so much of t, and must not overflow.
    const float travel = fabsf(ways[f]);
    const float size = fabsf(scale[f]);
    const int moves_well = (travel >= 1 / endless_limit) & (travel <= endless_limit) & (size <= FLT_MAX) &
                           (size >= least_endless_scale) & (fabsf(starts[f] * scale[f]) <= endless_start_limit);
    suits &= (moves_well | (ways[f] == 0)) & (fabsf(starts[f]) <= endless_limit);
    // A face that does not move bounds t from above, by +∞ (met) or −∞ (not met).
    scale[f] = ways[f] == 0 ? (f < 3 ? INFINITY : -INFINITY) : scale[f];
  }
  if (!(suits != 0 && speed > 0)) [[unlikely]]
    return false;

  EightFloats::store(row_of(out, ShaftRow::a), start);
  EightFloats::store(from, subtrahend);
  EightFloats::store(to, minuend);
  const float reached = write_followed(starts, to, from, flags_of(kind), out);
  if (!(reached <= FLT_MAX)) [[unlikely]]
    return false;
  const Vector scales = EightFloats::load(scale);
  const SlabOrder& order = slab_orders.by_negative[EightFloats::signs(scales) & 0x3f];
  EightFloats::store(
      row_of(out, ShaftRow::scale),
      EightFloats::permuted(
          EightFloats::with_last_two(scales, EightFloats::pair_in_all(endless_margin, reached * rounded_end_factor)),
          order.face));
  EightFloats::store(row_of(out, ShaftRow::shift), EightFloats::permuted(start, order.face));
  std::memcpy(row_of(out, ShaftRow::selectors), &order.selectors, sizeof order.selectors);
  out.slab_form = ShaftData::SlabForm::endless;
  const auto first = static_cast<unsigned>(trailing_zeros(fastest));
  unsigned at = 0;
  for (unsigned i = 0; i < 6; ++i) at = order.face[i] == first ? i : at;
  const auto swap_with_first = [&](auto& of) {
    const auto moved = of[0];
    of[0] = of[at];
    of[at] = moved;
  };
  swap_with_first(out.slab_scale);
  swap_with_first(out.slab_shift);
  swap_with_first(out.slab_near);
  return true;
}

/// A box that moves in a direction.
template <class L>
bool compile_swept_infinite(const void* body, const float* direction, ShaftData& out) noexcept {
  using EightFloats = typename L::EightFloats;
  const auto start = EightFloats::load_faces(body);
  const auto motion = BoxMotion<L>::for_faces(direction);
  BoxMotion<L>::write_motion(motion, out);
  return EightFloats::is_ordered(start) &&
         compile_endless<L>(ShaftData::Kind::swept_infinite, start, motion, EightFloats::all(0), out);
}

/// A box that moves away from a light. No face follows it where they touch.
template <class L>
bool compile_endless_shadow(const void* light, const void* occluder, ShaftData& out) noexcept {
  using EightFloats = typename L::EightFloats;
  const auto start = EightFloats::load_faces(occluder);
  const auto motion = BoxMotion<L>::opposite_faces(light);
  BoxMotion<L>::write_motion(motion, out);
  return EightFloats::is_ordered(start) && EightFloats::is_ordered(EightFloats::load_faces(light)) &&
         compile_endless<L>(ShaftData::Kind::shadow_without_end, start, start, motion, out);
}

}  // namespace shaftcull::kernel
