/// Shafts on a grid: the slab constraints in 16-bit integers, for groups of shafts that are tested against the same
/// bounds.
///
/// A frame around a group's shafts has 2¹⁵ steps an axis. Bounds are snapped to it once, rounded outwards, so that a
/// test takes half of the arithmetic of floats and half of the memory. What it says is certain; what it cannot say, the
/// floats decide. docs/exactness.md has the proof.
///
/// On a grid every constraint has the same form. A hi face is compared with the lo coordinate of a bound; for a lo face
/// and the hi coordinate both are negated. Then all constraints are x ≤ middle + way · v, where v runs from −½ at a to
/// ½ at b.
#pragma once

#include <cstddef>
#include <cstdint>

#include "compiled/shaft_data.hpp"
#include "kernels/forming/slab.hpp"
#include "support/mutant.hpp"

namespace shaftcull::kernel {

/// Coordinate x on axis k is (x − origin[k]) · steps[k] on the grid.
struct GridFrame {
  float origin[3];
  float steps[3];  ///< in a unit of length; 0 if these shafts have no grid
  bool suits_spheres;

  [[nodiscard]] bool exists() const noexcept { return steps[0] != 0; }
};

/// A shaft on a grid. t is the position of the leading face, which moves least of those that do not stand, so that its
/// constraint x ≤ t needs no arithmetic. It comes first, then the constraints that bound t from above, then the others
/// that bound it from below, and last those of faces that stand: they move too little to bound t.
struct alignas(64) GridShaft {
  std::int16_t scale[6];  ///< in 2⁻¹⁵: way of the leading face / way, negative for constraints from above
  std::int16_t shift[6];  ///< leading middle − scale · middle, moved to the permissive side; for standing faces where
                          ///< they are most permissive
  std::int16_t begin;  ///< of t
  std::int16_t end;
  std::uint8_t near_stream[6];
  std::uint8_t uppers;
  std::uint8_t standing;
  std::uint8_t limit;  ///< bounds with more room than this, which is an integer, are certainly not outside
  bool exists;         ///< if not, the other members say nothing
};

inline constexpr float grid_top =
    16383.0F;  ///< where coordinates are cut off, either way: sums of two fit into 16 bits
inline constexpr float grid_edge = 14500.0F;   ///< steps from a frame's origin to its outermost face
inline constexpr float standing_way = 100.0F;  ///< faces that move fewer steps stand

// What computed values are off by, and by how much they are moved to the permissive side.
inline constexpr float float_slack = 0.0625F;             ///< roundings of floats
inline constexpr float snap_slack = 0.5F + float_slack;   ///< a coordinate is moved by so much, and off by half a step
inline constexpr float bound_error = 1.0F + float_slack;  ///< a product and the shift are off by half a step each
inline constexpr float bound_slack =
    0.5F + float_slack;  ///< less than half a step is left, less than one for two bounds

static_assert(standing_way + bound_slack + bound_error + 2 * snap_slack <= 126,
              "GridShaft::limit is compared with signed bytes");
static_assert(2 * (bound_slack + bound_error + 2 * grid_edge * 0x1p-15F + 2 * snap_slack) <= 126,
              "likewise, for any scale");

/// The frame around shafts.
template <class L>
[[nodiscard]] GridFrame grid_frame(const ShaftData* shafts, std::size_t count) noexcept {
  float least[6];  // of all faces' coordinates, and from 3 on of their negatives
  for (float& each : least) each = __builtin_inff();
  float reach = 0;
  for (std::size_t s = 0; s < count; ++s) {
    if (shafts[s].reach > fused_regular_limit) continue;
    reach = shafts[s].reach > reach ? shafts[s].reach : reach;
    const float* const boxes[2] = {shafts[s].a, shafts[s].b};
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
  frame.suits_spheres = reach * most_steps * (2 * float_unit) <= 0.5F * float_slack;
  return frame;
}

/// Makes grid[lane] of shaft[lane], for a whole vector of shafts: one a lane, so that nothing branches on what a face
/// is, which would be mispredicted several times a shaft.
template <class L>
void form_grid_vector(const ShaftData* const (&shaft)[L::width], const GridFrame& frame,
                      GridShaft* const (&grid)[L::width]) noexcept {
  using Vector = typename L::Vector;
  constexpr unsigned faces = 6;
  const Vector zero = L::all(0.0F);
  const Vector one = L::all(1.0F);
  const Vector half = L::all(0.5F);

  alignas(64) float column[2 * faces + 1][L::width];
  for (unsigned lane = 0; lane < L::width; ++lane) {
    for (unsigned f = 0; f < faces; ++f) {
      column[f][lane] = shaft[lane]->a[f];
      column[f + faces][lane] = shaft[lane]->b[f];
    }
    column[2 * faces][lane] = shaft[lane]->reach;
  }
  Vector middle[faces];
  Vector way[faces];
  Vector size[faces];
  Vector leading_size = L::all(__builtin_inff());
  Vector leading_way = zero;
  Vector leading_middle = zero;
  Vector leading = L::all(faces);  // none
  Vector standings = zero;
  for (unsigned f = 0; f < faces; ++f) {
    const Vector origin = L::all(frame.origin[f % 3]);
    const float step = f < 3 ? -frame.steps[f % 3] : frame.steps[f % 3];
    const Vector a = L::load(column[f]);
    const Vector b = L::load(column[f + faces]);
    middle[f] = L::multiply(L::add(L::subtract(a, origin), L::subtract(b, origin)), L::all(0.5F * step));
    way[f] = L::multiply(L::subtract(b, a), L::all(step));
    size[f] = L::magnitude(way[f]);
    const auto stands = L::less(size[f], L::all(standing_way));
    const Vector moving_size = L::choose(stands, L::all(__builtin_inff()), size[f]);
    const auto leads = L::less(moving_size, leading_size);
    leading_size = L::choose(leads, moving_size, leading_size);
    leading_way = L::choose(leads, way[f], leading_way);
    leading_middle = L::choose(leads, middle[f], leading_middle);
    leading = L::choose(leads, L::all(static_cast<float>(f)), leading);
    standings = L::add(standings, L::choose(stands, one, zero));
  }
  const auto any_moves = L::less(leading, L::all(faces));
  leading_size = L::choose(any_moves, leading_size, zero);
  const Vector way_out = L::add(L::multiply(half, leading_size), L::all(float_slack));
  const Vector top = L::all(grid_top);  // if all faces stand: room for anything
  const Vector begin = L::choose(any_moves, L::floor(L::subtract(leading_middle, way_out)), L::subtract(zero, top));
  const Vector minus_end =
      L::choose(any_moves, L::floor(L::subtract(L::subtract(zero, leading_middle), way_out)), L::subtract(zero, top));

  Vector uppers = zero;
  for (unsigned f = 0; f < faces; ++f) {
    const auto is_upper =
        L::both(L::less_equal(L::all(standing_way), size[f]), L::less(L::multiply(way[f], leading_way), zero));
    uppers = L::add(uppers, L::choose(is_upper, one, zero));
  }

  // What an upper and a lower bound on t may be off by together: first the ends of t, and the coordinate in the leading
  // face's constraint.
  Vector upper_error = L::all(1 + 2 * float_slack);
  Vector lower_error = L::all(2 * snap_slack);
  Vector limit = zero;
  Vector largest = zero;  // of what constraints may compute
  Vector next_upper = one;
  Vector next_lower = L::add(one, uppers);
  Vector next_standing = L::subtract(L::all(faces), standings);
  alignas(64) float position[faces][L::width];
  alignas(64) float scales[faces][L::width];
  alignas(64) float shifts[faces][L::width];
  for (unsigned f = 0; f < faces; ++f) {
    const Vector number = L::all(static_cast<float>(f));
    const auto stands = L::less(size[f], L::all(standing_way));
    const auto leads = L::both(L::less_equal(leading, number), L::less_equal(number, leading));
    const auto is_upper =
        L::both(L::less_equal(L::all(standing_way), size[f]), L::less(L::multiply(way[f], leading_way), zero));
    const auto of_moving = [&](auto upper, auto lower) {
      return L::choose(is_upper, upper, L::choose(leads, zero, lower));
    };

    const Vector ratio = L::divide(leading_size, L::choose(stands, one, size[f]));
    const Vector exact_scale = L::choose(is_upper, L::subtract(zero, ratio), ratio);
    const Vector nearest = L::floor(L::add(L::multiply(exact_scale, L::all(0x1p15F)), half));
    const Vector scale = L::minimum(nearest, L::all(0x1p15F - 1));
    const Vector short_scale = L::multiply(scale, L::all(0x1p-15F));
    // Whatever the scale is rounded to, the constraint goes through the middle of the face's way.
    const Vector scale_error =
        L::multiply(L::multiply(L::magnitude(L::subtract(short_scale, exact_scale)), half), size[f]);
    const Vector slack = L::multiply(L::add(L::all(bound_slack), scale_error), L::all(grid_slack_factor));
    const Vector moving_shift = L::add(L::subtract(leading_middle, L::multiply(short_scale, middle[f])),
                                       L::choose(is_upper, slack, L::subtract(zero, slack)));
    const Vector standing_shift =
        L::add(L::add(middle[f], L::multiply(half, size[f])), L::all(bound_slack * grid_slack_factor));
    const Vector error = L::add(L::add(L::all(bound_slack + bound_error), L::add(scale_error, scale_error)),
                                L::multiply(L::all(2 * snap_slack), ratio));
    const Vector room = L::add(size[f], L::all(bound_slack + bound_error + 2 * snap_slack));
    const Vector most = L::add(L::multiply(L::magnitude(short_scale), top), L::magnitude(moving_shift));

    limit = L::maximum(L::choose(stands, room, zero), limit);
    upper_error = L::maximum(L::choose(is_upper, error, zero), upper_error);
    lower_error = L::maximum(L::choose(stands, zero, of_moving(zero, error)), lower_error);
    largest = L::maximum(L::choose(stands, zero, of_moving(most, most)), largest);
    L::store(position[f], L::choose(stands, next_standing, of_moving(next_upper, next_lower)));
    L::store(scales[f], scale);
    L::store(shifts[f], L::floor(L::add(L::choose(stands, standing_shift, moving_shift), half)));
    next_standing = L::add(next_standing, L::choose(stands, one, zero));
    next_upper = L::add(next_upper, L::choose(is_upper, one, zero));
    next_lower = L::add(next_lower, L::choose(stands, zero, of_moving(zero, one)));
  }
  limit = L::multiply(L::maximum(L::add(upper_error, lower_error), limit), L::all(grid_limit_factor));
  const std::uint64_t exist = L::bits(L::both(L::less_equal(L::load(column[2 * faces]), L::all(fused_regular_limit)),
                                              L::less_equal(largest, L::all(0x1p15F - 4))));

  enum { begins, minus_ends, counts_of_uppers, counts_of_standing, limits, numbers };
  alignas(64) float number[numbers][L::width];
  L::store(number[begins], begin);
  L::store(number[minus_ends], minus_end);
  L::store(number[counts_of_uppers], uppers);
  L::store(number[counts_of_standing], standings);
  L::store(number[limits], limit);
  for (unsigned lane = 0; lane < L::width; ++lane) {
    GridShaft& out = *grid[lane];
    out.exists = (exist >> lane & 1U) != 0;
    if (!out.exists) continue;
    const auto integer = [](float x) { return static_cast<std::int32_t>(x); };
    out.begin = static_cast<std::int16_t>(integer(number[begins][lane]));
    out.end = static_cast<std::int16_t>(-integer(number[minus_ends][lane]));
    out.uppers = static_cast<std::uint8_t>(integer(number[counts_of_uppers][lane]));
    out.standing = static_cast<std::uint8_t>(integer(number[counts_of_standing][lane]));
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
void form_grid_shafts(const ShaftData* shafts, std::size_t count, const GridFrame& frame, GridShaft* out) noexcept {
  for (std::size_t s = 0; s < count; s += L::width) {
    const ShaftData* shaft[L::width];
    GridShaft* grid[L::width];
    for (unsigned lane = 0; lane < L::width; ++lane) {  // the last one as often as it takes
      const std::size_t i = s + lane < count ? s + lane : count - 1;
      shaft[lane] = shafts + i;
      grid[lane] = out + i;
    }
    form_grid_vector<L>(shaft, frame, grid);
  }
}

}  // namespace shaftcull::kernel
