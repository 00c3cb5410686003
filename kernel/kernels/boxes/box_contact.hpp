// SPDX-License-Identifier: MIT
/// Boxes that touch a face of a shaft with open contact: comparisons that the other stages decide as for closed
/// contact, where a tie is not undecided.
#pragma once

#include "exact/predicates.hpp"
#include "kernels/shared/word.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

inline constexpr unsigned all_faces = 0x3f;

/// Some faces of the shaft box, and the coordinates of boxes that may touch them.
template <class L>
class TouchableFaces {
 public:
  using Vector = typename L::Vector;

  /// Of the faces in the set `faces`, bit f for face f.
  TouchableFaces(const ShaftData& shaft, unsigned faces, const float* const* stream) noexcept {
    for (unsigned f = 0; f < 6; ++f) {
      if ((faces >> f & 1U) == 0) continue;
      // On an axis on which the shaft does not leave a plane, boxes in that plane are not outside. Where a moving box
      // ends may lie between floats.
      const unsigned k = f % 3;
      const bool is_flat =
          (shaft.still_faces >> k & shaft.still_faces >> (k + 3) & 1U) != 0 && shaft.a[k] == shaft.a[k + 3];
      const bool is_certain =
          !is_flat && (shaft.kind == ShaftData::Kind::between || (shaft.still_faces >> f & 1U) != 0);
      Group& group = is_certain ? outside_ : asked_;
      const float sign = f < 3 ? 1.0F : -1.0F;
      group.x[group.count] = stream[(f + 3U) % 6U];
      group.sign[group.count] = L::all(sign);
      group.face[group.count++] = L::all(sign * face_of(shaft, f));
    }
  }

  /// Lanes of the vector at `at` that touch a face where that is outside, and those that only an exact predicate knows.
  /// They are not beyond a face.
  [[nodiscard]] std::uint64_t outside(std::size_t at) const noexcept { return touching(outside_, at); }
  [[nodiscard]] std::uint64_t asked(std::size_t at) const noexcept { return touching(asked_, at); }

 private:
  struct Group {
    unsigned count = 0;
    const float* x[6];
    Vector sign[6];
    Vector face[6];
  };

  [[nodiscard]] static float face_of(const ShaftData& shaft, unsigned f) noexcept {
    if (shaft.kind != ShaftData::Kind::between) return shaft.face[f];
    return (shaft.a[f] < shaft.b[f]) == (f < 3) ? shaft.a[f] : shaft.b[f];
  }

  [[nodiscard]] static std::uint64_t touching(const Group& group, std::size_t at) noexcept {
    std::uint64_t bits = 0;
    for (unsigned i = 0; i < group.count; ++i) {
      bits |= L::bits(L::less_equal(L::multiply(L::load(group.x[i] + at), group.sign[i]), group.face[i]));
    }
    return bits;
  }

  Group outside_;
  Group asked_;
};

/// Clears the kept bits of boxes that touch one of the faces in `faces`, of a shaft with open contact, unless they lie
/// in one plane with it and meet it there. Boxes beyond these faces have no kept bits.
template <class L>
SHAFTCULL_NOINLINE void box_contact_stage(const ShaftData& shaft, unsigned faces, const float* const* stream,
                                          std::size_t words, std::uint64_t* kept) noexcept {
  const TouchableFaces<L> touchable(shaft, faces, stream);
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t outside = 0;
    std::uint64_t asked = 0;
    for (unsigned lane = 0; lane < word_bits; lane += L::width) {
      if ((kept[w] & lanes_of<L>(lane)) == 0) continue;
      outside |= touchable.outside(w * word_bits + lane) << lane;
      asked |= touchable.asked(w * word_bits + lane) << lane;
    }
    kept[w] &= ~outside;
    asked &= kept[w];
    if (asked != 0) [[unlikely]] {
      const SlabPredicate exact(shaft);
      kept[w] &= ~decide_lanes<L>(
          asked, [&](unsigned lane) { return exact.outside(BoundAt<L, 6>(stream, w * word_bits + lane).value); });
    }
  }
}

}  // namespace shaftcull::kernel
