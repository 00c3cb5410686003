// SPDX-License-Identifier: MIT
/// Shafts on a grid: the slab constraints in 16-bit integers, for groups of shafts that are tested against the same
/// bounds.
///
/// A frame around a group's shafts has 2¹⁵ steps an axis. Bounds are snapped to it once, rounded outwards, so that a
/// test takes half of the arithmetic of floats and half of the memory. What a test on the grid decides is certain; the
/// rest is tested again in floats. docs/exactness.md has the proof.
///
/// On a grid every constraint has the same form. A hi face is compared with the lo coordinate of a bound; for a lo face
/// and the hi coordinate both are negated. Then all constraints are x ≤ middle + travel · v, where v runs from −½ at a
/// to ½ at b.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "compiled/shaft_data.hpp"
#include "kernels/forming/slab_constraints.hpp"
#include "kernels/kernel_table.hpp"

namespace shaftcull::kernel {

/// Coordinate x on axis k is (x − origin[k]) · steps[k] on the grid.
struct GridFrame {
  float origin[3];
  float steps[3];  ///< in a unit of length; 0 if these shafts have no grid
  bool suits_spheres;

  [[nodiscard]] bool exists() const noexcept { return steps[0] != 0; }
};

/// A shaft on a grid. t is the position of the reference face: of the faces that are not stationary, the one that moves
/// least. So its constraint x ≤ t needs no arithmetic. It comes first, then the constraints that bound t from above,
/// then the others that bound it from below, and last those of stationary faces, which move too little to bound t.
struct alignas(64) GridShaft {
  std::int16_t scale[6];  ///< in 2⁻¹⁵: travel of the reference face / travel, negative for constraints from above
  std::int16_t shift[6];  ///< the reference face's middle − scale · middle, moved to the permissive side; for
                          ///< stationary faces where they are most permissive
  std::int16_t begin;     ///< of t
  std::int16_t end;
  std::uint8_t near_stream[6];
  std::uint8_t uppers;
  std::uint8_t stationary;
  std::uint8_t limit;  ///< bounds whose interval is longer than this, an integer, are certainly not outside
  bool exists;         ///< if not, the other members are not written

  /// Where a shaft without end was cut off, if any shaft of its group has none: a tile whose coordinates of this stream
  /// are all at least this has no bounds beyond. If the shaft leaves the frame before, the tile must have no bounds
  /// there either (TileExtent::any_above). Forming leaves it to the caller.
  struct {
    std::uint8_t stream;
    bool leaves_frame;
    std::int16_t least;
  } cut;
};

inline constexpr float grid_top = 16383.0F;   ///< coordinates are clamped to ± this: sums of two fit into 16 bits
inline constexpr float grid_edge = 14500.0F;  ///< steps from a frame's origin to its outermost face
inline constexpr float most_on_grid = 0x1p15F - 4;       ///< what constraints and ends of t compute
inline constexpr float most_limit = 126;                 ///< GridShaft::limit is compared with signed bytes
inline constexpr float most_stationary_travel = 100.0F;  ///< faces that move fewer steps are stationary

// What computed values are off by, and by how much they are moved to the permissive side.
inline constexpr float float_slack = 0.0625F;             ///< roundings of floats
inline constexpr float snap_slack = 0.5F + float_slack;   ///< a coordinate is moved by so much, and off by half a step
inline constexpr float bound_error = 1.0F + float_slack;  ///< a product and the shift are off by half a step each
inline constexpr float bound_slack =
    0.5F + float_slack;  ///< less than half a step is left, less than one for two bounds

static_assert(most_stationary_travel + bound_slack + bound_error + 2 * snap_slack <= most_limit);
static_assert(2 * (bound_slack + bound_error + 2 * grid_edge * 0x1p-15F + 2 * snap_slack) <= most_limit,
              "for any scale, if faces stay in the frame");

/// Where shaft `s` of several ends on a grid; null if it has no place there.
template <class L>
[[nodiscard]] const float* end_on_grid(const ShaftData* shafts, std::size_t s, const ClippedEnd* clipped) noexcept {
  if (!shafts[s].is_endless()) [[likely]]
    return shafts[s].b;
  return clipped == nullptr ? nullptr : clipped[s].face;
}

/// The largest coordinate of a shaft on a grid that ends at `end`.
template <class L>
[[nodiscard]] float largest_on_grid(const ShaftData& shaft, const float* end) noexcept {
  if (!shaft.is_endless()) [[likely]]
    return shaft.largest_coordinate;
  float largest = 0;
  for (unsigned f = 0; f < 6; ++f) {
    largest = fabsf(shaft.a[f]) > largest ? fabsf(shaft.a[f]) : largest;
    largest = fabsf(end[f]) > largest ? fabsf(end[f]) : largest;
  }
  return rounded_end_factor * largest;
}

/// The frame around shafts.
template <class L>
[[nodiscard]] GridFrame grid_frame(const ShaftData* shafts, std::size_t count, const ClippedEnd* clipped) noexcept {
  float least[6];  // of all faces' coordinates, and from 3 on of their negatives
  for (float& each : least) each = INFINITY;
  float largest_coordinate = 0;
  for (std::size_t s = 0; s < count; ++s) {
    const float* end = end_on_grid<L>(shafts, s, clipped);
    if (end == nullptr) continue;
    if (shafts[s].is_endless()) [[unlikely]]
      end = clipped[s].in_frame;
    const float largest = largest_on_grid<L>(shafts[s], end);
    if (largest > fused_regular_limit) continue;
    largest_coordinate = largest > largest_coordinate ? largest : largest_coordinate;
    const float* const boxes[2] = {shafts[s].a, end};
    for (unsigned k = 0; k < 3; ++k) {
      for (const float* face : boxes) {
        least[k] = face[k] < least[k] ? face[k] : least[k];
        least[k + 3] = -face[k + 3] < least[k + 3] ? -face[k + 3] : least[k + 3];
      }
    }
  }
  GridFrame frame{};
  float half[3];
  float longest = 0;
  for (unsigned k = 0; k < 3; ++k) {
    frame.origin[k] = 0.5F * (least[k] - least[k + 3]);
    const float below = frame.origin[k] - least[k];  // differs from `above` where the origin was rounded
    const float above = -least[k + 3] - frame.origin[k];
    half[k] = below > above ? below : above;
    longest = half[k] > longest ? half[k] : longest;
  }
  if (!(longest >= 1 / fused_regular_limit)) return frame;
  constexpr float flattest = 0x1p-10F;  // flat frames keep steps that are finite
  float most_steps = 0;
  for (unsigned k = 0; k < 3; ++k) {
    const float size = half[k] > flattest * longest ? half[k] : flattest * longest;
    frame.steps[k] = grid_edge / size;
    most_steps = frame.steps[k] > most_steps ? frame.steps[k] : most_steps;
  }
  // Corners of boxes around spheres are rounded relatively to where they are.
  frame.suits_spheres = largest_coordinate * most_steps * (2 * float_unit) <= 0.5F * float_slack;
  return frame;
}

/// Makes grid[lane] of shaft[lane], which ends at end[lane] if that is not null, for a whole vector of shafts: one a
/// lane, so that nothing branches on what a face is, which would be mispredicted several times a shaft.
template <class L>
void form_grid_vector(const ShaftData* const (&shaft)[L::width], const float* const (&end)[L::width],
                      const GridFrame& frame, GridShaft* const (&grid)[L::width]) noexcept {
  using Vector = typename L::Vector;
  constexpr unsigned faces = 6;
  const Vector zero = L::all(0.0F);
  const Vector one = L::all(1.0F);
  const Vector half = L::all(0.5F);

  alignas(64) float column[2 * faces + 1][L::width];
  for (unsigned lane = 0; lane < L::width; ++lane) {
    const float* const b = end[lane] != nullptr ? end[lane] : shaft[lane]->b;
    for (unsigned f = 0; f < faces; ++f) {
      column[f][lane] = shaft[lane]->a[f];
      column[f + faces][lane] = b[f];
    }
    // Where a moving box ends may be rounded, as corners of spheres are.
    const bool suits = shaft[lane]->kind == ShaftData::Kind::between || (frame.suits_spheres && end[lane] != nullptr);
    column[2 * faces][lane] = suits ? largest_on_grid<L>(*shaft[lane], b) : INFINITY;
  }
  Vector middle[faces];
  Vector travel[faces];
  Vector size[faces];
  Vector reference_size = L::all(INFINITY);
  Vector reference_travel = zero;
  Vector reference_middle = zero;
  Vector reference = L::all(faces);  // none
  Vector stationary_count = zero;
  for (unsigned f = 0; f < faces; ++f) {
    const Vector origin = L::all(frame.origin[f % 3]);
    const float step = f < 3 ? -frame.steps[f % 3] : frame.steps[f % 3];
    const Vector a = L::load(column[f]);
    const Vector b = L::load(column[f + faces]);
    middle[f] = L::multiply(L::add(L::subtract(a, origin), L::subtract(b, origin)), L::all(0.5F * step));
    travel[f] = L::multiply(L::subtract(b, a), L::all(step));
    size[f] = L::magnitude(travel[f]);
    const auto is_stationary = L::less(size[f], L::all(most_stationary_travel));
    const Vector moving_size = L::choose(is_stationary, L::all(INFINITY), size[f]);
    const auto is_reference = L::less(moving_size, reference_size);
    reference_size = L::choose(is_reference, moving_size, reference_size);
    reference_travel = L::choose(is_reference, travel[f], reference_travel);
    reference_middle = L::choose(is_reference, middle[f], reference_middle);
    reference = L::choose(is_reference, L::all(static_cast<float>(f)), reference);
    stationary_count = L::add(stationary_count, L::choose(is_stationary, one, zero));
  }
  const auto any_moves = L::less(reference, L::all(faces));
  reference_size = L::choose(any_moves, reference_size, zero);
  const Vector half_range = L::add(L::multiply(half, reference_size), L::all(float_slack));
  const Vector top = L::all(grid_top);  // if all faces are stationary: t may be anything
  const Vector begin =
      L::choose(any_moves, L::floor(L::subtract(reference_middle, half_range)), L::subtract(zero, top));
  const Vector minus_end = L::choose(any_moves, L::floor(L::subtract(L::subtract(zero, reference_middle), half_range)),
                                     L::subtract(zero, top));

  Vector uppers = zero;
  for (unsigned f = 0; f < faces; ++f) {
    const auto is_upper = L::both(L::less_equal(L::all(most_stationary_travel), size[f]),
                                  L::less(L::multiply(travel[f], reference_travel), zero));
    uppers = L::add(uppers, L::choose(is_upper, one, zero));
  }

  // What an upper and a lower bound on t may be off by together: first the ends of t, and the coordinate in the
  // reference face's constraint.
  Vector upper_error = L::all(1 + 2 * float_slack);
  Vector lower_error = L::all(2 * snap_slack);
  Vector limit = zero;
  Vector largest = zero;  // of what constraints may compute
  Vector next_upper = one;
  Vector next_lower = L::add(one, uppers);
  Vector next_stationary = L::subtract(L::all(faces), stationary_count);
  alignas(64) float position[faces][L::width];
  alignas(64) float scales[faces][L::width];
  alignas(64) float shifts[faces][L::width];
  for (unsigned f = 0; f < faces; ++f) {
    const Vector number = L::all(static_cast<float>(f));
    const auto is_stationary = L::less(size[f], L::all(most_stationary_travel));
    const auto is_reference = L::both(L::less_equal(reference, number), L::less_equal(number, reference));
    const auto is_upper = L::both(L::less_equal(L::all(most_stationary_travel), size[f]),
                                  L::less(L::multiply(travel[f], reference_travel), zero));
    const auto of_moving = [&](auto upper, auto lower) {
      return L::choose(is_upper, upper, L::choose(is_reference, zero, lower));
    };

    const Vector ratio = L::divide(reference_size, L::choose(is_stationary, one, size[f]));
    const Vector exact_scale = L::choose(is_upper, L::subtract(zero, ratio), ratio);
    const Vector nearest = L::floor(L::add(L::multiply(exact_scale, L::all(0x1p15F)), half));
    const Vector scale = L::minimum(nearest, L::all(0x1p15F - 1));
    const Vector short_scale = L::multiply(scale, L::all(0x1p-15F));
    // Whatever the scale is rounded to, the constraint is exact at the middle of the face's travel.
    const Vector scale_error =
        L::multiply(L::multiply(L::magnitude(L::subtract(short_scale, exact_scale)), half), size[f]);
    const Vector slack = L::add(L::all(bound_slack), scale_error);
    const Vector moving_shift = L::add(L::subtract(reference_middle, L::multiply(short_scale, middle[f])),
                                       L::choose(is_upper, slack, L::subtract(zero, slack)));
    const Vector stationary_shift = L::add(L::add(middle[f], L::multiply(half, size[f])), L::all(bound_slack));
    const Vector error = L::add(L::add(L::all(bound_slack + bound_error), L::add(scale_error, scale_error)),
                                L::multiply(L::all(2 * snap_slack), ratio));
    const Vector stationary_limit = L::add(size[f], L::all(bound_slack + bound_error + 2 * snap_slack));
    const Vector most = L::add(L::multiply(L::magnitude(short_scale), top), L::magnitude(moving_shift));

    limit = L::maximum(L::choose(is_stationary, stationary_limit, zero), limit);
    upper_error = L::maximum(L::choose(is_upper, error, zero), upper_error);
    lower_error = L::maximum(L::choose(is_stationary, zero, of_moving(zero, error)), lower_error);
    largest = L::maximum(L::choose(is_stationary, zero, of_moving(most, most)), largest);
    L::store(position[f], L::choose(is_stationary, next_stationary, of_moving(next_upper, next_lower)));
    L::store(scales[f], scale);
    L::store(shifts[f], L::floor(L::add(L::choose(is_stationary, stationary_shift, moving_shift), half)));
    next_stationary = L::add(next_stationary, L::choose(is_stationary, one, zero));
    next_upper = L::add(next_upper, L::choose(is_upper, one, zero));
    next_lower = L::add(next_lower, L::choose(is_stationary, zero, of_moving(zero, one)));
  }
  limit = L::maximum(L::add(upper_error, lower_error), limit);
  largest = L::maximum(L::maximum(L::magnitude(begin), L::magnitude(minus_end)), largest);
  const std::uint64_t exist =
      L::bits(L::both(L::less_equal(L::load(column[2 * faces]), L::all(fused_regular_limit)),
                      L::both(L::less_equal(largest, L::all(most_on_grid)), L::less_equal(limit, L::all(most_limit)))));

  enum { begins, minus_ends, counts_of_uppers, counts_of_stationary, limits, numbers };
  alignas(64) float number[numbers][L::width];
  L::store(number[begins], begin);
  L::store(number[minus_ends], minus_end);
  L::store(number[counts_of_uppers], uppers);
  L::store(number[counts_of_stationary], stationary_count);
  L::store(number[limits], limit);
  for (unsigned lane = 0; lane < L::width; ++lane) {
    GridShaft& out = *grid[lane];
    out.exists = (exist >> lane & 1U) != 0;
    if (!out.exists) continue;
    const auto integer = [](float x) { return static_cast<std::int32_t>(x); };
    out.begin = static_cast<std::int16_t>(integer(number[begins][lane]));
    out.end = static_cast<std::int16_t>(-integer(number[minus_ends][lane]));
    out.uppers = static_cast<std::uint8_t>(integer(number[counts_of_uppers][lane]));
    out.stationary = static_cast<std::uint8_t>(integer(number[counts_of_stationary][lane]));
    out.limit = static_cast<std::uint8_t>(integer(number[limits][lane]));
    for (unsigned f = 0; f < faces; ++f) {
      const auto at = static_cast<unsigned>(integer(position[f][lane]));
      out.scale[at] = static_cast<std::int16_t>(integer(scales[f][lane]));
      out.shift[at] = static_cast<std::int16_t>(integer(shifts[f][lane]));
      out.near_stream[at] = near_stream[f];
    }
  }
}

/// Makes out[i] of shafts[i].
template <class L>
void form_grid_shafts(const ShaftData* shafts, std::size_t count, const ClippedEnd* clipped, const GridFrame& frame,
                      GridShaft* out) noexcept {
  for (std::size_t s = 0; s < count; s += L::width) {
    const ShaftData* shaft[L::width];
    const float* end[L::width];
    GridShaft* grid[L::width];
    for (unsigned lane = 0; lane < L::width; ++lane) {  // the last one as often as it takes
      const std::size_t i = s + lane < count ? s + lane : count - 1;
      shaft[lane] = shafts + i;
      end[lane] = end_on_grid<L>(shafts, i, clipped);
      grid[lane] = out + i;
    }
    form_grid_vector<L>(shaft, end, frame, grid);
  }
}

}  // namespace shaftcull::kernel
