/// The stages of a triangle's tests: the box around it, added planes at its vertices, and all separating axes.
#pragma once

#include "exact/triangle.hpp"
#include "kernels/boxes/contact.hpp"
#include "kernels/boxes/slab.hpp"
#include "kernels/hulls/stages.hpp"
#include "kernels/shared/survivors.hpp"
#include "kernels/shared/word.hpp"
#include "kernels/triangles/boxes_around.hpp"
#include "kernels/triangles/separating_axes.hpp"

namespace shaftcull::kernel {

inline constexpr unsigned triangle_streams = 9;

/// Triangles in a block: few enough for the boxes around them to be on the stack, and many, so that what is left of
/// them fills vectors.
inline constexpr unsigned triangle_block = 768;

/// An added plane's value at a vertex: four roundings, relative to what it is a sum of, and as much again to spare.
inline constexpr float vertex_value_margin = 8 * 0x1p-24F;

/// Clears the bits of triangles all of whose vertices are beyond one added plane.
template <class L>
void triangle_added_stage(const ShaftData& shaft, const float* const* stream, std::size_t words,
                          std::uint64_t* kept) noexcept {
  using Vector = typename L::Vector;
  const Vector zero = L::all(0.0F);
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t undecided = 0;
    for (unsigned lane = 0; lane < word_bits; lane += L::width) {
      if ((kept[w] & lanes_of<L>(lane)) == 0) continue;
      const std::size_t at = w * word_bits + lane;
      Vector x[9];
      for (unsigned s = 0; s < triangle_streams; ++s) x[s] = L::load(stream[s] + at);
      Vector size[3];  // as large as each vertex' coordinate, and NaN or infinite if one of them is
      for (unsigned k = 0; k < 3; ++k) {
        size[k] = L::add(L::magnitude(x[k]), L::add(L::magnitude(x[k + 3]), L::magnitude(x[k + 6])));
      }
      auto beyond = L::less(zero, zero);
      auto decided = L::less_equal(zero, zero);
      for (unsigned i = 0; i < shaft.added_count; ++i) {
        const ShaftData::AddedPlane& plane = shaft.added[i];
        const Vector minus_offset = L::all(plane.minus_offset);
        Vector value[3] = {minus_offset, minus_offset, minus_offset};
        Vector terms = L::magnitude(minus_offset);
        for (unsigned k = 0; k < 3; ++k) {
          const Vector normal = L::all(plane.normal[k]);
          for (unsigned v = 0; v < 3; ++v) value[v] = L::multiply_add(x[3 * v + k], normal, value[v]);
          terms = L::multiply_add(size[k], L::magnitude(normal), terms);
        }
        // Where something is not finite, the margin is not: nothing is certain there.
        const Vector margin = L::multiply_add(terms, L::all(vertex_value_margin), L::all(triangle_denormals));
        const Vector lowest = L::minimum(value[0], L::minimum(value[1], value[2]));
        const auto is_beyond = L::less(margin, lowest);
        beyond = L::either(beyond, is_beyond);
        decided = L::both(decided, L::either(is_beyond, L::less(L::add(lowest, margin), zero)));
      }
      kept[w] &= ~(L::bits(beyond) << lane);
      undecided |= (L::bits(decided) ^ lanes_of<L>(0)) << lane;
    }
    undecided &= kept[w];
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
void triangle_vertices_stage(const ShaftData& shaft, const float* const* stream, std::size_t words,
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

/// Clears the bits of triangles that certainly meet the shaft.
template <class L>
void triangle_glance_stage(const MovingBox<L>& box, const float* const* stream, std::size_t words,
                           std::uint64_t* left) noexcept {
  for (std::size_t w = 0; w < words; ++w) {
    for (unsigned lane = 0; lane < word_bits; lane += L::width) {
      if ((left[w] & lanes_of<L>(lane)) == 0) continue;
      const TriangleAxes<L> axes(box, stream, w * word_bits + lane);
      left[w] &= ~(meet_in_the_middle<L>(box, axes) << lane);
    }
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
[[gnu::noinline]] void cull_boxes_around(const ShaftData& shaft, const float* const* stream, std::size_t count,
                                         std::uint64_t* kept) noexcept {
  alignas(64) float box[6][triangle_block];
  float* row[6];
  const float* boxes[6];
  for (unsigned s = 0; s < 6; ++s) boxes[s] = row[s] = box[s];
  boxes_around_triangles<L>(stream, count, row);
  if (shaft.is_hull()) [[unlikely]]
    return HullStages<L>::cull_boxes(*shaft.hull, boxes, count, kept);
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
[[gnu::noinline]] void cull_by_added_planes(const ShaftData& shaft, const float* const* stream, std::size_t count,
                                            std::uint64_t* kept) noexcept {
  run_on_triangles<L>(stream, count, kept, [&](const float* const* some, std::size_t n, std::uint64_t* bits) {
    triangle_added_stage<L>(shaft, some, n, bits);
  });
}

/// Clears the bits of triangles with a vertex that is certainly in the shaft: most of those that meet it.
template <class L>
[[gnu::noinline]] void clear_those_with_a_vertex_in(const ShaftData& shaft, const float* const* stream,
                                                    std::size_t count, std::uint64_t* left) noexcept {
  using enum ShaftData::SlabForm;
  using Stage = void(const ShaftData&, const float* const*, std::size_t, std::uint64_t*) noexcept;
  const auto stage_of = [](ShaftData::SlabForm form) -> Stage* {
    switch (form) {
      case fused: return triangle_vertices_stage<L, fused>;
      case difference: return triangle_vertices_stage<L, difference>;
      case relative: return triangle_vertices_stage<L, relative>;
      case endless: return triangle_vertices_stage<L, endless>;
      case exact:
      case hull: return nullptr;
    }
    return nullptr;
  };
  Stage* const stage = stage_of(shaft.slab_form);
  if (stage == nullptr || shaft.still_faces != 0) return;
  run_on_triangles<L>(stream, count, left, [&](const float* const* some, std::size_t n, std::uint64_t* bits) {
    stage(shaft, some, n, bits);
  });
}

/// Those with a vertex in the shaft are found first, which takes a tenth as long as all axes: few are left for these.
template <class L>
[[gnu::noinline]] void cull_by_axes(const ShaftData& shaft, const float* const* stream, std::size_t count,
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
    if (exactly) cull_by_axes<L>(shaft, at, block, kept);
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
