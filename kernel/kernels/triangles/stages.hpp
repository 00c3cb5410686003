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

/// Few are left by the first stage, so that the second, which takes twice as long, is run on those, side by side.
template <class L>
[[gnu::noinline]] void cull_by_axes(const ShaftData& shaft, const TriangleShaft& moving, const float* const* stream,
                                    std::size_t count, std::uint64_t* kept) noexcept {
  std::uint64_t left[triangle_block / word_bits];
  std::uint64_t any = 0;
  for (std::size_t w = 0; w < words_of(count); ++w) any |= left[w] = kept[w];
  if (any == 0) return;
  const MovingBox<L> box(moving);
  run_on_triangles<L>(stream, count, left, [&](const float* const* some, std::size_t n, std::uint64_t* bits) {
    triangle_glance_stage<L>(box, some, n, bits);
  });
  run_on_triangles<L>(stream, count, left, [&](const float* const* some, std::size_t n, std::uint64_t* bits) {
    triangle_gaps_stage<L>(shaft, box, some, n, bits);
  });
  for (std::size_t w = 0; w < words_of(count); ++w) kept[w] &= ~left[w];
}

template <class L>
void test_triangle_blocks(const ShaftData& shaft, const TriangleShaft* moving, const float* const* stream,
                          std::size_t count, std::uint64_t* kept) noexcept {
  const float* at[triangle_streams];
  for (unsigned s = 0; s < triangle_streams; ++s) at[s] = stream[s];
  while (count != 0) {
    const std::size_t block = count < triangle_block ? count : triangle_block;
    cull_boxes_around<L>(shaft, at, block, kept);
    if (shaft.added_count != 0) cull_by_added_planes<L>(shaft, at, block, kept);
    if (moving != nullptr) cull_by_axes<L>(shaft, *moving, at, block, kept);
    count -= block;
    for (const float*& s : at) s += block;
    kept += words_of(block);
  }
}

// As Kernels has them.

template <class L>
void test_triangles_by_vertices(const ShaftData& shaft, const float* const* stream, std::size_t count,
                                std::uint64_t* kept, std::uint64_t* /*inside*/) noexcept {
  test_triangle_blocks<L>(shaft, nullptr, stream, count, kept);
}

template <class L>
void test_triangles_exactly(const ShaftData& shaft, const float* const* stream, std::size_t count, std::uint64_t* kept,
                            std::uint64_t* /*inside*/) noexcept {
  const TriangleShaft moving = triangle_shaft(shaft);
  test_triangle_blocks<L>(shaft, &moving, stream, count, kept);
}

}  // namespace shaftcull::kernel
