// SPDX-License-Identifier: MIT
/// Boxes against a convex hull: outside by near corners, inside by far ones, exactly.
#pragma once

#include "exact/convex_hull.hpp"
#include "kernels/hulls/hull_depths.hpp"
#include "kernels/shared/word.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// Clears the bits in `kept` of boxes that miss the hull, for hulls that floats do not suit.
template <class L>
SHAFTCULL_COLD std::uint64_t hull_outside_by_predicate(const HullData& hull, const float* const* stream, std::size_t at,
                                                       std::uint64_t lanes) noexcept {
  return decide_lanes<L>(lanes,
                         [&](unsigned lane) { return hull_box_outside(hull, BoundAt<L, 6>(stream, at + lane).value); });
}

/// Which boxes of a vector are empty, or padding, or `by_box` beyond the hull's box.
template <class L, bool by_box = true>
SHAFTCULL_ALWAYS_INLINE [[nodiscard]] inline typename L::Mask beyond_hull_box(const HullData& hull,
                                                                              const float* const* stream,
                                                                              std::size_t at) noexcept {
  const auto is_beyond = [&](unsigned k) {
    const auto lo = L::load(stream[k] + at);
    const auto hi = L::load(stream[k + 3] + at);
    const auto is_empty = L::less(hi, lo);
    if constexpr (!by_box) return is_empty;
    return L::either(is_empty, L::either(L::less(hi, L::all(hull.box[k])), L::less(L::all(hull.box[k + 3]), lo)));
  };
  return L::either(is_beyond(0), L::either(is_beyond(1), is_beyond(2)));
}

/// Bits of the boxes of the word at `at` that are empty, or `by_box` do not meet the hull's box.
template <class L, bool by_box>
SHAFTCULL_ALWAYS_INLINE [[nodiscard]] inline std::uint64_t hull_box_word(const HullData& hull,
                                                                         const float* const* stream,
                                                                         std::size_t at) noexcept {
  std::uint64_t outside = 0;
  for (unsigned lane = 0; lane < word_bits; lane += L::width) {
    outside |= L::bits(beyond_hull_box<L, by_box>(hull, stream, at + lane)) << lane;
  }
  return outside;
}

/// Bits of the boxes of the word at `at` that are beyond a face of the hull that is apart from others, or an edge that
/// is a face; of a conservative hull, which has no second stage, those that hull_box_word() finds as well.
template <class L, bool bounded, bool conservative>
SHAFTCULL_ALWAYS_INLINE [[nodiscard]] inline std::uint64_t hull_faces_word(const HullData& hull,
                                                                           const float* const* stream,
                                                                           std::size_t at) noexcept {
  // So many vectors share what a plane takes to prepare.
  constexpr unsigned vectors = word_bits / L::width < 8 ? word_bits / L::width : 8;
  std::uint64_t outside = 0;
  std::uint64_t undecided = 0;
  for (unsigned first = 0; first < word_bits; first += vectors * L::width) {
    HullDepths<L, vectors, bounded> depths;
    depths.template add_boxes<3, HullCorner::near>(hull, 0, hull.apart, stream, at + first);
    depths.template add_boxes<2, HullCorner::near>(hull, hull.faces, hull.faces + hull.face_edges, stream, at + first);
    for (unsigned v = 0; v < vectors; ++v) {
      const auto zero = L::all(0.0F);
      const unsigned lane = first + v * L::width;
      outside |= L::bits(L::less(depths.most[v], zero)) << lane;
      if constexpr (bounded) {
        undecided |= L::bits(L::less_equal(depths.most[v], L::all(2 * hull_margin))) << lane;
      } else {
        undecided |= (L::bits(L::less(zero, depths.least[v])) ^ lanes_of<L>(0)) << lane;
      }
    }
  }
  undecided &= ~outside;
  if (undecided != 0) [[unlikely]]
    outside |= hull_outside_by_predicate<L>(hull, stream, at, undecided);
  if constexpr (conservative) {
    if (~outside != 0) {
      outside |=
          hull.culls_by_box ? hull_box_word<L, true>(hull, stream, at) : hull_box_word<L, false>(hull, stream, at);
    }
  }
  return outside;
}

/// First stage: writes the kept bits of `words` words, clear for boxes that are beyond such a face. The only stage of a
/// conservative hull that floats suit.
template <class L, bool conservative, class Words>
void hull_faces_stage(const HullData& hull, const float* const* stream, std::size_t words, std::uint64_t* kept,
                      const Words& position) noexcept {
  for (std::size_t w = 0; w < words; ++w) {
    if (!conservative && !hull.suits_floats) {
      kept[w] = ~hull_outside_by_predicate<L>(hull, stream, position(w), ~std::uint64_t{0});
    } else if (hull.is_bounded) {
      kept[w] = ~hull_faces_word<L, true, conservative>(hull, stream, position(w));
    } else {
      kept[w] = ~hull_faces_word<L, false, conservative>(hull, stream, position(w));
    }
  }
}

/// Whether one stage decides.
[[nodiscard]] inline bool has_one_stage(const HullData& hull) noexcept {
  return hull.is_conservative || !hull.suits_floats;
}

/// That stage, or the first one.
template <class L, class Words>
void first_hull_stage(const HullData& hull, const float* const* stream, std::size_t words, std::uint64_t* kept,
                      const Words& position) noexcept {
  if (hull.is_conservative && hull.suits_floats) [[unlikely]]
    return hull_faces_stage<L, true>(hull, stream, words, kept, position);
  hull_faces_stage<L, false>(hull, stream, words, kept, position);
}

/// Which boxes of some vectors are beyond the hull's box, an edge or another face, or empty. If only their boxes were
/// compared before, those that the first stage finds as well, but not by their boxes. Returns the lanes that are
/// undecided, too.
template <class L, bool bounded, unsigned vectors, bool of_both_stages = false>
SHAFTCULL_ALWAYS_INLINE [[nodiscard]] inline std::uint64_t hull_edges_vectors(const HullData& hull,
                                                                              const float* const* stream,
                                                                              std::size_t at,
                                                                              std::uint64_t& beyond) noexcept {
  const auto zero = L::all(0.0F);
  HullDepths<L, vectors, bounded> depths;
  depths.template add_boxes<3, HullCorner::near>(hull, of_both_stages ? 0 : hull.apart, hull.faces, stream, at);
  depths.template add_boxes<2, HullCorner::near>(hull, hull.faces + (of_both_stages ? 0 : hull.face_edges),
                                                 hull.faces + hull.edges, stream, at);
  std::uint64_t undecided = 0;
  for (unsigned v = 0; v < vectors; ++v) {
    auto is_beyond = L::less(depths.most[v], zero);
    if constexpr (!of_both_stages)
      is_beyond = L::either(is_beyond, beyond_hull_box<L>(hull, stream, at + v * L::width));
    beyond |= L::bits(is_beyond) << v * L::width;
    if constexpr (bounded) {
      undecided |= L::bits(L::less_equal(depths.most[v], L::all(2 * hull_margin))) << v * L::width;
    } else {
      undecided |= (L::bits(L::less(zero, depths.least[v])) ^ lanes_of<L>(0)) << v * L::width;
    }
  }
  return undecided;
}

/// Second stage: clears the bits of boxes that are beyond the hull's box, its edges or its other faces.
template <class L>
void hull_edges_stage(const HullData& hull, const float* const* stream, std::size_t words,
                      std::uint64_t* kept) noexcept {
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t undecided = 0;
    const auto test = [&]<unsigned vectors>(unsigned lane) {
      const std::size_t at = w * word_bits + lane;
      std::uint64_t beyond = 0;
      undecided |= (hull.is_bounded ? hull_edges_vectors<L, true, vectors>(hull, stream, at, beyond)
                                    : hull_edges_vectors<L, false, vectors>(hull, stream, at, beyond))
                   << lane;
      kept[w] &= ~(beyond << lane);
    };
    for (unsigned four = 0; four < word_bits; four += 4 * L::width) {
      unsigned with_any = 0;
      for (unsigned v = 0; v < 4; ++v) with_any += (kept[w] & lanes_of<L>(four + v * L::width)) != 0 ? 1 : 0;
      if (with_any == 4) {
        test.template operator()<4>(four);
        continue;
      }
      for (unsigned lane = four; lane < four + 4 * L::width; lane += L::width) {
        if ((kept[w] & lanes_of<L>(lane)) != 0) test.template operator()<1>(lane);
      }
    }
    undecided &= kept[w];
    if (undecided != 0) [[unlikely]] {
      kept[w] &= ~hull_outside_by_predicate<L>(hull, stream, w * word_bits, undecided);
    }
  }
}

/// Most boxes that are tested by both stages at once: so few that lanes of a word would be idle.
template <class L>
inline constexpr std::size_t few_boxes_of_hull = 2 * std::size_t{L::width};

/// Bits of the boxes of some vectors that meet the hull's box, if they do, in a face of it alone.
template <class L, unsigned vectors>
[[nodiscard]] std::uint64_t touching_hull_box(const HullData& hull, const float* const* stream,
                                              std::size_t at) noexcept {
  std::uint64_t touching = 0;
  for (unsigned v = 0; v < vectors; ++v) {
    const std::size_t first = at + v * L::width;
    const auto touches = [&](unsigned k) {
      return L::either(L::less_equal(L::load(stream[k + 3] + first), L::all(hull.box[k])),
                       L::less_equal(L::all(hull.box[k + 3]), L::load(stream[k] + first)));
    };
    touching |= L::bits(L::either(touches(0), L::either(touches(1), touches(2)))) << v * L::width;
  }
  return touching;
}

/// Writes the kept bits of `count` boxes, which fill all of some vectors but the last one.
template <class L, Contact contact, unsigned vectors>
void few_boxes_in_vectors(const HullData& hull, const float* const* stream, std::size_t count,
                          std::uint64_t* kept) noexcept {
  constexpr unsigned streams = 6;
  alignas(64) float bound[streams][std::size_t{vectors} * L::width];
  const float* few[streams];
  const PartialWord<L> word{static_cast<unsigned>(count)};
  for (unsigned s = 0; s < streams; ++s) {
    for (unsigned v = 0; v + 1 < vectors; ++v) L::store(&bound[s][v * L::width], L::load(stream[s] + v * L::width));
    constexpr std::size_t last = std::size_t{vectors - 1} * L::width;
    L::store(&bound[s][last], word.load(stream[s], 0, last));
    few[s] = bound[s];
  }
  std::uint64_t beyond = 0;
  for (unsigned v = 0; v < vectors; ++v) {
    beyond |= L::bits(beyond_hull_box<L>(hull, few, std::size_t{v} * L::width)) << v * L::width;
  }
  *kept = word.lanes() & ~beyond;
  if (*kept == 0) return;
  std::uint64_t undecided = hull.is_bounded ? hull_edges_vectors<L, true, vectors, true>(hull, few, 0, beyond)
                                            : hull_edges_vectors<L, false, vectors, true>(hull, few, 0, beyond);
  *kept &= ~beyond;
  if constexpr (contact == Contact::open) undecided |= touching_hull_box<L, vectors>(hull, few, 0);
  undecided &= *kept;
  if (undecided == 0) [[likely]]
    return;
  *kept &= ~decide_lanes<L>(undecided, [&](unsigned lane) {
    const BoundAt<L, streams> box(few, lane);
    return contact == Contact::open ? hull_box_outside_openly(hull, box.value) : hull_box_outside(hull, box.value);
  });
}

/// Writes the kept bits of `count` boxes, at most few_boxes_of_hull.
template <class L, Contact contact>
void few_boxes_stage(const HullData& hull, const float* const* stream, std::size_t count,
                     std::uint64_t* kept) noexcept {
  if (count <= L::width) return few_boxes_in_vectors<L, contact, 1>(hull, stream, count, kept);
  few_boxes_in_vectors<L, contact, 2>(hull, stream, count, kept);
}

/// Clears the bits of boxes that are not inside the hull.
template <class L>
void hull_inside_stage(const HullData& hull, const float* const* stream, std::size_t words,
                       std::uint64_t* inside) noexcept {
  const auto zero = L::all(0.0F);
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t candidates = 0;
    std::uint64_t certain = 0;
    for (unsigned lane = 0; lane < word_bits; lane += L::width) {
      if ((inside[w] & lanes_of<L>(lane)) == 0) continue;
      const std::size_t at = w * word_bits + lane;
      auto within = L::less_equal(L::load(stream[0] + at), L::load(stream[3] + at));  // not the empty box
      for (unsigned k = 0; k < 3; ++k) {
        within = L::both(within, L::less_equal(L::all(hull.box[k]), L::load(stream[k] + at)));
        within = L::both(within, L::less_equal(L::load(stream[k + 3] + at), L::all(hull.box[k + 3])));
      }
      if (!hull.suits_floats) {
        candidates |= (L::bits(within) << lane) & inside[w];
        continue;
      }
      const auto note = [&](auto depths) {
        depths.template add_boxes<3, HullCorner::far>(hull, 0, hull.faces, stream, at);
        depths.template add_boxes<2, HullCorner::far>(hull, hull.faces, hull.faces + hull.edges, stream, at);
        candidates |= (L::bits(L::both(within, L::less_equal(zero, depths.most[0]))) << lane) & inside[w];
        return depths;
      };
      if (hull.is_bounded) {
        const auto depths = note(HullDepths<L, 1, true>());
        certain |= L::bits(L::less(L::all(2 * hull_margin), depths.most[0])) << lane;
      } else {
        const auto depths = note(HullDepths<L, 1, false>());
        certain |= L::bits(L::less(zero, depths.least[0])) << lane;
      }
    }
    inside[w] = candidates & certain;
    const std::uint64_t undecided = candidates & ~certain;
    if (undecided != 0) [[unlikely]] {
      inside[w] |= decide_lanes<L>(undecided, [&](unsigned lane) {
        return hull_box_inside(hull, BoundAt<L, 6>(stream, w * word_bits + lane).value);
      });
    }
  }
}

}  // namespace shaftcull::kernel
