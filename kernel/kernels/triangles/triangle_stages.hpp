// SPDX-License-Identifier: MIT
/// The stages of a triangle's tests: the box around it, added planes at its vertices, and all separating axes.
#pragma once

#include <cfloat>
#include <cmath>

#include "exact/triangle.hpp"
#include "kernels/boxes/box_contact.hpp"
#include "kernels/boxes/slab_stages.hpp"
#include "kernels/hulls/hull_stages.hpp"
#include "kernels/hulls/hull_triangles.hpp"
#include "kernels/shared/survivors.hpp"
#include "kernels/shared/word.hpp"
#include "kernels/triangles/boxes_around_triangles.hpp"
#include "kernels/triangles/separating_axes.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

inline constexpr unsigned triangle_streams = 9;

/// Triangles in a block: few, so that they and the boxes around them, 30 KB, are in the level 1 cache for all stages,
/// and many, so that what is left of them fills vectors.
inline constexpr unsigned triangle_block = 512;

/// Times the magnitudes of a vertex' coordinates and of an offset: a plane's value at a vertex is off by less
/// (docs/exactness.md).
inline constexpr float vertex_value_margin = 8 * 0x1p-24F;

/// The added planes of a shaft as vertices are compared with them: with normals of length 1, so that one margin holds
/// for all of them.
template <class L>
struct PlanesAtVertices {
  using Vector = typename L::Vector;
  float normal[max_added_planes][3];
  float minus_offset[max_added_planes];
  float largest_offset = 0;
  unsigned count;

  explicit PlanesAtVertices(const ShaftData& shaft) noexcept : count(shaft.added_count) {
    for (unsigned i = 0; i < count; ++i) {
      const ShaftData::AddedPlane& plane = shaft.added[i];
      // A plane that no margin holds for is 0 everywhere: undecided.
      const float scale = plane.margin <= FLT_MAX ? 1 / plane.length : 0;
      for (unsigned k = 0; k < 3; ++k) normal[i][k] = plane.normal[k] * scale;
      minus_offset[i] = plane.minus_offset * scale;
      const float offset = fabsf(minus_offset[i]);
      largest_offset = largest_offset < offset ? offset : largest_offset;
    }
  }

  /// Of a triangle, by the magnitudes of all coordinates: infinite or NaN if one of them is not finite, or if a value
  /// may overflow on the way.
  [[nodiscard]] Vector margin(const Vector (&x)[9]) const noexcept {
    Vector size = L::all(largest_offset);
    for (unsigned k = 0; k < 3; ++k) {
      size = L::add(size, L::add(L::magnitude(x[k]), L::add(L::magnitude(x[k + 3]), L::magnitude(x[k + 6]))));
    }
    return L::multiply_add(size, L::all(vertex_value_margin), L::all(triangle_denormals));
  }
  /// How far the vertex nearest to the inner side of a plane is beyond it: the largest of all planes.
  [[nodiscard]] Vector distance_beyond(const Vector (&x)[9]) const noexcept {
    Vector distance = L::all(-INFINITY);
    SHAFTCULL_UNROLL(1)
    for (unsigned i = 0; i < count; ++i) {
      const Vector at_origin = L::all(minus_offset[i]);
      Vector value[3] = {at_origin, at_origin, at_origin};
      for (unsigned k = 0; k < 3; ++k) {
        const Vector component = L::all(normal[i][k]);
        for (unsigned v = 0; v < 3; ++v) value[v] = L::multiply_add(x[3 * v + k], component, value[v]);
      }
      distance = L::maximum(L::minimum(value[0], L::minimum(value[1], value[2])), distance);
    }
    return distance;
  }
};

/// Clears the bits of triangles all of whose vertices are beyond one added plane.
template <class L>
void triangle_added_stage(const ShaftData& shaft, const float* const* stream, std::size_t words,
                          std::uint64_t* kept) noexcept {
  using Vector = typename L::Vector;
  const PlanesAtVertices<L> planes(shaft);
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t beyond = 0;
    std::uint64_t decided = 0;
    for (unsigned lane = 0; lane < word_bits; lane += L::width) {
      if ((kept[w] & lanes_of<L>(lane)) == 0) continue;
      Vector x[9];
      for (unsigned s = 0; s < triangle_streams; ++s) x[s] = L::load(stream[s] + w * word_bits + lane);
      const Vector distance = planes.distance_beyond(x);
      const Vector margin = planes.margin(x);
      beyond |= L::bits(L::less(margin, distance)) << lane;
      decided |= L::bits(L::less(margin, L::magnitude(distance))) << lane;
    }
    const std::uint64_t undecided = kept[w] & ~decided;
    kept[w] &= ~beyond;
    if (undecided != 0) [[unlikely]] {
      kept[w] &= ~decide_lanes<L>(undecided, [&](unsigned lane) {
        return triangle_beyond_plane(shaft, BoundAt<L, triangle_streams>(stream, w * word_bits + lane).value);
      });
    }
  }
}

/// Clears the bits of triangles with a vertex that is certainly in the shaft: a point is a flat box, whose slab form is
/// tested without an exact step. With open contact not for shafts with faces that do not move, as what touches these is
/// not in the shaft.
template <class L, ShaftData::SlabForm form>
void vertex_in_shaft_stage(const ShaftData& shaft, const float* const* stream, std::size_t words,
                           std::uint64_t* left) noexcept {
  const Slab<L, any_uppers, form> slab(shaft, shaft.slab_margin, true);
  const float* x[3][6];  // what the constraints read of each vertex
  for (unsigned v = 0; v < 3; ++v) {
    for (unsigned i = 0; i < 6; ++i) x[v][i] = stream[3 * v + shaft.slab_near[i] % 3];
  }
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t met = 0;
    for (unsigned lane = 0; lane < word_bits; lane += L::width) {
      if ((left[w] & lanes_of<L>(lane)) == 0) continue;
      const std::size_t at = w * word_bits + lane;
      const auto length = [&](unsigned v) {
        return slab.interval_length([&](unsigned i) { return L::load(x[v][i] + at); });
      };
      const auto longest = L::maximum(length(0), L::maximum(length(1), length(2)));
      met |= L::bits(L::less(slab.two_margins, longest)) << lane;
    }
    left[w] &= ~met;
  }
}

/// Clears the bits of triangles that meet the shaft.
template <class L>
void triangle_gaps_stage(const ShaftData& shaft, const MovingBox<L>& box, const float* const* stream, std::size_t words,
                         std::uint64_t* left) noexcept {
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t missed = 0;
    std::uint64_t undecided = 0;
    for (unsigned lane = 0; lane < word_bits; lane += L::width) {
      const std::uint64_t asked = left[w] >> lane & lanes_of<L>(0);
      if (asked == 0) continue;
      const TriangleGaps<L> gaps(box, TriangleAxes<L>(box, stream, w * word_bits + lane));
      const auto time = gaps.middle();
      const std::uint64_t not_met = asked & ~gaps.met(time);
      const std::uint64_t missed_here = not_met & gaps.missed(time);
      missed |= missed_here << lane;
      undecided |= (not_met & ~missed_here) << lane;
    }
    left[w] = missed;
    if (undecided != 0) [[unlikely]] {
      left[w] |= decide_lanes<L>(undecided, [&](unsigned lane) {
        return triangle_misses(shaft, BoundAt<L, triangle_streams>(stream, w * word_bits + lane).value);
      });
    }
  }
}

/// Writes the bits of `count` triangles of a block, at most triangle_block, the boxes around which meet the shaft.
template <class L>
SHAFTCULL_NOINLINE void cull_boxes_around(const ShaftData& shaft, const float* const* stream, std::size_t count,
                                          std::uint64_t* kept) noexcept {
  alignas(64) float box[6][triangle_block];
  boxes_around_triangles<L>(stream, count, box);
  const float* boxes[6];
  for (unsigned s = 0; s < 6; ++s) boxes[s] = box[s];
  if (shaft.is_hull()) [[unlikely]]
    return HullStages<L>::cull_boxes(shaft, boxes, count, kept);
  const ConsecutiveWords<L> position{.rest = static_cast<unsigned>(count % word_bits)};
  box_slab_stage<L>(shaft, boxes, count / word_bits, kept, position);
  if (shaft.still_faces != 0) [[unlikely]]
    box_contact_stage<L>(shaft, shaft.still_faces, boxes, words_of(count), kept);
}

/// Runs a stage on what is left of a block.
template <class L, class Stage>
void run_on_triangles(const float* const* stream, std::size_t count, std::uint64_t* bits, Stage stage) noexcept {
  run_on_survivors<L, triangle_streams, triangle_block / dense_share>(stream, count, bits, stage);
}

// Stages of a block, on what is left. Not inlined, so that their memory is not on the stack at the same time.

template <class L>
SHAFTCULL_NOINLINE void cull_by_added_planes(const ShaftData& shaft, const float* const* stream, std::size_t count,
                                             std::uint64_t* kept) noexcept {
  run_on_triangles<L>(stream, count, kept, [&](const float* const* some, std::size_t n, std::uint64_t* bits) {
    triangle_added_stage<L>(shaft, some, n, bits);
  });
}

/// Clears the bits of triangles with a vertex that is certainly in the shaft: most of those that meet it.
template <class L>
SHAFTCULL_NOINLINE void clear_those_with_a_vertex_in(const ShaftData& shaft, const float* const* stream,
                                                     std::size_t count, std::uint64_t* left) noexcept {
  using enum ShaftData::SlabForm;
  using Stage = void(const ShaftData&, const float* const*, std::size_t, std::uint64_t*) noexcept;
  const auto stage_of = [](ShaftData::SlabForm form) -> Stage* {
    switch (form) {
      case fused:
        return vertex_in_shaft_stage<L, fused>;
      case difference:
        return vertex_in_shaft_stage<L, difference>;
      case relative:
        return vertex_in_shaft_stage<L, relative>;
      case endless:
        return vertex_in_shaft_stage<L, endless>;
      case exact:
      case hull:
      case open_hull:
        return nullptr;
    }
    return nullptr;
  };
  Stage* const stage = stage_of(shaft.slab_form);
  if (stage == nullptr || shaft.still_faces != 0) return;
  run_on_triangles<L>(stream, count, left, [&](const float* const* some, std::size_t n, std::uint64_t* bits) {
    stage(shaft, some, n, bits);
  });
}

/// The same for a convex hull.
template <class L>
SHAFTCULL_NOINLINE void cull_by_planes_of_hull(const ShaftData& shaft, const float* const* stream, std::size_t count,
                                               std::uint64_t* kept) noexcept {
  run_on_triangles<L>(stream, count, kept, [&](const float* const* some, std::size_t n, std::uint64_t* bits) {
    hull_triangles_stage<L>(*shaft.hull, shaft.contact, some, n, bits);
  });
}

/// Those with a vertex in the shaft are found first, which takes a tenth as long as all axes: few are left for these.
template <class L>
SHAFTCULL_NOINLINE void cull_by_axes(const ShaftData& shaft, const float* const* stream, std::size_t count,
                                     std::uint64_t* kept) noexcept {
  std::uint64_t left[triangle_block / word_bits];
  for (std::size_t w = 0; w < words_of(count); ++w) left[w] = kept[w];
  clear_those_with_a_vertex_in<L>(shaft, stream, count, left);
  std::uint64_t any = 0;
  for (std::size_t w = 0; w < words_of(count); ++w) any |= left[w];
  if (any == 0) return;
  const MovingBox<L> box(triangle_shaft(shaft));
  run_on_triangles<L>(stream, count, left, [&](const float* const* some, std::size_t n, std::uint64_t* bits) {
    triangle_gaps_stage<L>(shaft, box, some, n, bits);
  });
  for (std::size_t w = 0; w < words_of(count); ++w) kept[w] &= ~left[w];
}

template <class L>
void test_triangle_blocks(const ShaftData& shaft, bool exactly, const float* const* stream, std::size_t count,
                          std::uint64_t* kept) noexcept {
  const float* at[triangle_streams];
  for (unsigned s = 0; s < triangle_streams; ++s) at[s] = stream[s];
  while (count != 0) {
    const std::size_t block = count < triangle_block ? count : triangle_block;
    cull_boxes_around<L>(shaft, at, block, kept);
    if (shaft.added_count != 0) cull_by_added_planes<L>(shaft, at, block, kept);
    if (exactly) {
      if (shaft.is_hull()) [[unlikely]] {
        cull_by_planes_of_hull<L>(shaft, at, block, kept);
      } else {
        cull_by_axes<L>(shaft, at, block, kept);
      }
    }
    count -= block;
    for (const float*& s : at) s += block;
    kept += words_of(block);
  }
}

// As Kernels has them.

template <class L>
void test_triangles_by_vertices(const ShaftData& shaft, const float* const* stream, std::size_t count,
                                std::uint64_t* kept, std::uint64_t* /*inside*/) noexcept {
  test_triangle_blocks<L>(shaft, false, stream, count, kept);
}

template <class L>
void test_triangles_exactly(const ShaftData& shaft, const float* const* stream, std::size_t count, std::uint64_t* kept,
                            std::uint64_t* /*inside*/) noexcept {
  test_triangle_blocks<L>(shaft, true, stream, count, kept);
}

}  // namespace shaftcull::kernel
