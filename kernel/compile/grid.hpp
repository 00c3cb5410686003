/// Shafts on a grid: the slab constraints in 16-bit integers, for groups of shafts that are tested against the same bounds.
///
/// A frame around a group's shafts has 2¹⁶ steps an axis. Bounds are snapped to it once, rounded outwards, so that a test takes half of the
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

/// A shaft on a grid. Constraints that bound t = length · v from above come first, then those that bound it from below, and last those
/// of faces that stand: they move too little to bound t.
struct alignas(64) GridShaft {
  std::int16_t scale[6];  ///< in 2⁻¹⁵: length / way, at most ½, negative for constraints from above; ½ for standing faces
  std::int16_t shift[6];  ///< −scale · middle, moved to the permissive side; for standing faces ½ of where they are most permissive
  std::int16_t begin;     ///< of t
  std::int16_t end;
  std::uint8_t near_stream[6];
  std::uint8_t uppers;
  std::uint8_t standing;
  std::uint8_t limit;     ///< bounds with more room than this, which is an integer, are certainly not outside
  bool exists;            ///< if not, the other members say nothing
};

inline constexpr float grid_edge = 27000.0F;   ///< steps from a frame's origin to its outermost face
inline constexpr float standing_way = 200.0F;  ///< faces that move fewer steps stand

// What computed values are off by, and by how much they are moved to the permissive side.
inline constexpr float float_slack = 0.0625F;                 ///< roundings of floats
inline constexpr float snap_slack = 0.5F + float_slack;       ///< a coordinate is moved by so much, and off by half a step
inline constexpr float bound_error = 2 * 0.5F + float_slack;  ///< a product and the shift are off by half a step each
inline constexpr float bound_slack = 0.5F + float_slack;      ///< less than half a step is left, less than one for two bounds
inline constexpr float scale_slack = 0x1p-17F;                ///< and what the scale is off by, over half the way of a face

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
  float length = 2 * grid_edge;
  float longest = 0;
  unsigned standing = 0;
  unsigned uppers = 0;
  for (unsigned f = 0; f < 6; ++f) {
    const float size = __builtin_fabsf(way[f]);
    const bool stands = size < standing_way;
    standing |= (stands ? 1U : 0U) << f;
    uppers |= (!stands && way[f] < 0 ? 1U : 0U) << f;
    length = !stands && size < length ? size : length;
    longest = size > longest ? size : longest;
  }
  length *= 0.5F;

  const auto rank = [](unsigned set, unsigned i) { return static_cast<unsigned>(__builtin_popcount(set & ((1U << i) - 1))); };
  const unsigned lowers = 0x3fU & ~(standing | uppers);
  grid.uppers = static_cast<std::uint8_t>(__builtin_popcount(uppers));
  grid.standing = static_cast<std::uint8_t>(__builtin_popcount(standing));
  grid.begin = static_cast<std::int16_t>(__builtin_floorf(-0.5F * length));
  grid.end = static_cast<std::int16_t>(-grid.begin);
  // Of two bounds on t and the coordinates in them; and of a standing face.
  float limit = 2 * (bound_slack + bound_error + 2 * scale_slack * longest + snap_slack);
  for (unsigned f = 0; f < 6; ++f) {
    const bool stands = (standing >> f & 1) != 0;
    const bool is_upper = (uppers >> f & 1) != 0;
    const float size = __builtin_fabsf(way[f]);
    // Whatever the scale is rounded to, the constraint goes through the middle of the face's way.
    const float scale = __builtin_floorf((stands ? 0.5F : length / way[f]) * 0x1p15F + 0.5F);
    const float slack = (bound_slack + scale_slack * size) * grid_slack_factor;
    float shift;
    unsigned position;
    if (stands) {
      shift = 0.5F * (middle[f] + 0.5F * size) + slack;
      position = 6U - grid.standing + rank(standing, f);
      const float room = 0.5F * size + bound_slack + bound_error + snap_slack;
      limit = room > limit ? room : limit;
    } else {
      shift = (is_upper ? slack : -slack) - scale * 0x1p-15F * middle[f];
      position = is_upper ? rank(uppers, f) : grid.uppers + rank(lowers, f);
    }
    grid.scale[position] = static_cast<std::int16_t>(scale);
    grid.shift[position] = static_cast<std::int16_t>(__builtin_floorf(shift + 0.5F));
    grid.near_stream[position] = near_stream[f];
  }
  grid.limit = static_cast<std::uint8_t>(limit * grid_limit_factor);
}

/// Makes out[i] of shafts[i].
template <class L>
void form_grid_shafts(const CompiledShaft* shafts, std::size_t count, const GridFrame& frame, GridShaft* out) noexcept {
  const FloatEnvironment<L> environment;
  for (std::size_t s = 0; s < count; ++s) form_grid_shaft<L>(shafts[s], frame, out[s]);
}

}  // namespace shaftcull::kernel
