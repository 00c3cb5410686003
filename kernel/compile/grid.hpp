/// Shafts on a grid: the slab constraints in 16-bit integers, for groups of shafts that are tested against the same bounds.
///
/// A frame around a group's shafts has 2¹⁵ steps an axis. Bounds are snapped to it once, rounded outwards, so that a test takes half of the
/// arithmetic of floats and half of the memory. What it says is certain; what it cannot say, the floats decide. docs/exactness.md has the proof.
///
/// On a grid every constraint has the same form. A hi face is compared with the lo coordinate of a bound; for a lo face and the hi coordinate
/// both are negated. Then all constraints are x ≤ middle + way · v, where v runs from −½ at a to ½ at b.
#pragma once

#include <cstddef>
#include <cstdint>

#include "compile/slab.hpp"
#include "shaftcull/compiled.hpp"
#include "simd/float_environment.hpp"
#include "mutant.hpp"

namespace shaftcull::kernel {

/// Coordinate x on axis k is (x − origin[k]) · steps[k] on the grid.
struct GridFrame {
  float origin[3];
  float steps[3];  ///< in a unit of length; 0 if these shafts have no grid
  bool suits_spheres;

  [[nodiscard]] bool exists() const noexcept { return steps[0] != 0; }
};

/// A shaft on a grid. t is the position of the leading face, which moves least of those that do not stand, so that its constraint x ≤ t needs
/// no arithmetic. It comes first, then the constraints that bound t from above, then the others that bound it from below, and last
/// those of faces that stand: they move too little to bound t.
struct alignas(64) GridShaft {
  std::int16_t scale[6];  ///< in 2⁻¹⁵: way of the leading face / way, negative for constraints from above
  std::int16_t shift[6];  ///< leading middle − scale · middle, moved to the permissive side; for standing faces where they are most permissive
  std::int16_t begin;     ///< of t
  std::int16_t end;
  std::uint8_t near_stream[6];
  std::uint8_t uppers;
  std::uint8_t standing;
  std::uint8_t limit;     ///< bounds with more room than this, which is an integer, are certainly not outside
  bool exists;            ///< if not, the other members say nothing
};

inline constexpr float grid_top = 16383.0F;    ///< where coordinates are cut off, either way: sums of two fit into 16 bits
inline constexpr float grid_edge = 14500.0F;   ///< steps from a frame's origin to its outermost face
inline constexpr float standing_way = 100.0F;  ///< faces that move fewer steps stand

// What computed values are off by, and by how much they are moved to the permissive side.
inline constexpr float float_slack = 0.0625F;                ///< roundings of floats
inline constexpr float snap_slack = 0.5F + float_slack;      ///< a coordinate is moved by so much, and off by half a step
inline constexpr float bound_error = 1.0F + float_slack;     ///< a product and the shift are off by half a step each
inline constexpr float bound_slack = 0.5F + float_slack;     ///< less than half a step is left, less than one for two bounds

static_assert(standing_way + bound_slack + bound_error + 2 * snap_slack <= 126, "GridShaft::limit is compared with signed bytes");
static_assert(2 * (bound_slack + bound_error + 2 * grid_edge * 0x1p-15F + 2 * snap_slack) <= 126, "likewise, for any scale");

/// The frame around shafts.
template <class L>
[[nodiscard]] GridFrame grid_frame(const CompiledShaft* shafts, std::size_t count) noexcept {
  const FloatEnvironment<L> environment;
  float least[6];  // of all faces' coordinates, and from 3 on of their negatives
  for (float& each : least) each = __builtin_inff();
  float reach = 0;
  for (std::size_t s = 0; s < count; ++s) {
    if (shafts[s].reach > fused_regular_limit) continue;
    reach = shafts[s].reach > reach ? shafts[s].reach : reach;
    const Box* const both[2] = {&shafts[s].a, &shafts[s].b};
    for (unsigned k = 0; k < 3; ++k) {
      for (const Box* box : both) {
        const float* const face = reinterpret_cast<const float*>(box);
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

template <class L>
void form_grid_shaft(const CompiledShaft& shaft, const GridFrame& frame, GridShaft& grid) noexcept {
  const float* const a = reinterpret_cast<const float*>(&shaft.a);
  const float* const b = reinterpret_cast<const float*>(&shaft.b);
  grid.exists = shaft.reach <= fused_regular_limit;
  if (!grid.exists) return;

  float middle[6];
  float way[6];
  for (unsigned f = 0; f < 6; ++f) {
    const float origin = frame.origin[f % 3];
    const float steps = f < 3 ? -frame.steps[f % 3] : frame.steps[f % 3];
    middle[f] = ((a[f] - origin) + (b[f] - origin)) * (0.5F * steps);
    way[f] = (b[f] - a[f]) * steps;
  }
  constexpr unsigned none = 6;
  unsigned leading = none;
  unsigned standing = 0;
  unsigned falling = 0;
  for (unsigned f = 0; f < 6; ++f) {
    const float size = __builtin_fabsf(way[f]);
    if (size < standing_way) {
      standing |= 1U << f;
    } else if (leading == none || size < __builtin_fabsf(way[leading])) {
      leading = f;
    }
    falling |= (way[f] < 0 ? 1U : 0U) << f;
  }
  const unsigned moving = 0x3fU & ~standing;
  const unsigned uppers = leading == none ? 0 : moving & ((falling >> leading & 1U) != 0 ? ~falling : falling);
  const unsigned lowers = leading == none ? 0 : moving & ~(uppers | 1U << leading);
  const auto rank = [](unsigned set, unsigned i) { return static_cast<unsigned>(__builtin_popcount(set & ((1U << i) - 1))); };
  grid.uppers = static_cast<std::uint8_t>(__builtin_popcount(uppers));
  grid.standing = static_cast<std::uint8_t>(__builtin_popcount(standing));
  if (leading == none) {  // room for anything
    grid.begin = static_cast<std::int16_t>(-grid_top);
    grid.end = static_cast<std::int16_t>(grid_top);
  } else {
    const float half = 0.5F * __builtin_fabsf(way[leading]);
    grid.begin = static_cast<std::int16_t>(__builtin_floorf(middle[leading] - half - float_slack));
    grid.end = static_cast<std::int16_t>(__builtin_ceilf(middle[leading] + half + float_slack));
  }

  // What an upper and a lower bound on t may be off by together: first the ends of t, and the coordinate in the leading face's constraint.
  float upper_error = 1 + 2 * float_slack;
  float lower_error = 2 * snap_slack;
  float limit = 0;
  for (unsigned f = 0; f < 6; ++f) {
    const unsigned bit = 1U << f;
    const float size = __builtin_fabsf(way[f]);
    unsigned position = 0;
    if ((standing & bit) != 0) {
      position = 6U - grid.standing + rank(standing, f);
      const float shift = middle[f] + 0.5F * size + bound_slack * grid_slack_factor;
      grid.shift[position] = static_cast<std::int16_t>(__builtin_floorf(shift + 0.5F));
      const float room = size + bound_slack + bound_error + 2 * snap_slack;
      limit = room > limit ? room : limit;
    } else if (f != leading) {
      const bool is_upper = (uppers & bit) != 0;
      position = is_upper ? 1 + rank(uppers, f) : 1U + grid.uppers + rank(lowers, f);
      const float exact_scale = (is_upper ? -1.0F : 1.0F) * __builtin_fabsf(way[leading]) / size;
      const float nearest = __builtin_floorf(exact_scale * 0x1p15F + 0.5F);
      const float scale = nearest < 0x1p15F ? nearest : 0x1p15F - 1;
      // Whatever the scale is rounded to, the constraint goes through the middle of the face's way.
      const float scale_error = __builtin_fabsf(scale * 0x1p-15F - exact_scale) * 0.5F * size;
      const float slack = (bound_slack + scale_error) * grid_slack_factor;
      const float shift = middle[leading] - scale * 0x1p-15F * middle[f] + (is_upper ? slack : -slack);
      if (__builtin_fabsf(scale * 0x1p-15F) * grid_top + __builtin_fabsf(shift) > 0x1p15F - 4) grid.exists = false;
      grid.scale[position] = static_cast<std::int16_t>(scale);
      grid.shift[position] = static_cast<std::int16_t>(__builtin_floorf(shift + 0.5F));
      const float error = bound_slack + bound_error + 2 * scale_error + 2 * snap_slack * __builtin_fabsf(exact_scale);
      float& worst = is_upper ? upper_error : lower_error;
      worst = error > worst ? error : worst;
    }
    grid.near_stream[position] = near_stream[f];
  }
  limit = upper_error + lower_error > limit ? upper_error + lower_error : limit;
  grid.limit = static_cast<std::uint8_t>(limit * grid_limit_factor);
}

/// Makes out[i] of shafts[i].
template <class L>
void form_grid_shafts(const CompiledShaft* shafts, std::size_t count, const GridFrame& frame, GridShaft* out) noexcept {
  const FloatEnvironment<L> environment;
  for (std::size_t s = 0; s < count; ++s) form_grid_shaft<L>(shafts[s], frame, out[s]);
}

}  // namespace shaftcull::kernel
