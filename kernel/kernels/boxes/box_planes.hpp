// SPDX-License-Identifier: MIT
/// Boxes against planes: outside by near corners, inside by far corners, and added planes.
#pragma once

#include <cmath>

#include "exact/predicates.hpp"
#include "kernels/shared/word.hpp"

namespace shaftcull::kernel {

/// The joining planes of a shaft with coefficients in whole vectors and selectors resolved to streams, for stages that
/// evaluate them for most bounds. Stages that rarely do save the preparation and call largest_joining_value().
template <class L>
class JoiningPlanes {
 public:
  using Vector = typename L::Vector;

  JoiningPlanes(const ShaftData& shaft, const std::uint8_t* corner0, const std::uint8_t* corner1,
                const float* const* stream) noexcept
      : count_(shaft.joining_count) {
    for (unsigned i = 0; i < count_; ++i) {
      x_[i] = stream[corner0[i]];
      y_[i] = stream[corner1[i]];
      normal0_[i] = L::all(shaft.joining_normal0[i]);
      normal1_[i] = L::all(shaft.joining_normal1[i]);
      minus_offset_[i] = L::all(shaft.joining_minus_offset[i]);
    }
  }

  /// Largest value of all planes for the bounds at `at`: positive if beyond any. −∞ without planes.
  [[nodiscard]] Vector largest_value(std::size_t at) const noexcept {
    Vector largest[1];
    largest_values(at, largest);
    return largest[0];
  }

  /// Likewise for several vectors side by side, which share the loads of coefficients: loads are the limit.
  template <unsigned vectors>
  void largest_values(std::size_t at, Vector (&largest)[vectors]) const noexcept {
    for (Vector& each : largest) each = L::all(-INFINITY);
    for (unsigned i = 0; i < count_; ++i) {
      for (unsigned v = 0; v < vectors; ++v) {
        const std::size_t here = at + v * L::width;
        const Vector partial = L::multiply_add(L::load(y_[i] + here), normal1_[i], minus_offset_[i]);
        largest[v] = L::maximum(L::multiply_add(L::load(x_[i] + here), normal0_[i], partial), largest[v]);
      }
    }
  }

 private:
  unsigned count_;
  const float* x_[max_joining_planes];
  const float* y_[max_joining_planes];
  Vector normal0_[max_joining_planes];
  Vector normal1_[max_joining_planes];
  Vector minus_offset_[max_joining_planes];
};

/// As JoiningPlanes::largest_value(), straight from the compiled shaft.
template <class L>
typename L::Vector largest_joining_value(const ShaftData& shaft, const std::uint8_t* corner0,
                                         const std::uint8_t* corner1, const float* const* stream,
                                         std::size_t at) noexcept {
  auto largest = L::all(-INFINITY);
  for (unsigned i = 0; i < shaft.joining_count; ++i) {
    const auto partial = L::multiply_add(L::load(stream[corner1[i]] + at), L::all(shaft.joining_normal1[i]),
                                         L::all(shaft.joining_minus_offset[i]));
    const auto value = L::multiply_add(L::load(stream[corner0[i]] + at), L::all(shaft.joining_normal0[i]), partial);
    largest = L::maximum(value, largest);
  }
  return largest;
}

/// A corner of a bound, as an added plane sees it.
enum class Corner : std::uint8_t { near, far };

/// Value of an added plane at a corner.
template <class L, Corner corner>
typename L::Vector added_value(const ShaftData::AddedPlane& plane, const float* const* stream,
                               std::size_t at) noexcept {
  auto value = L::all(plane.minus_offset);
  for (unsigned k = 0; k < 3; ++k) {
    const unsigned s = corner == Corner::near ? plane.near[k] : (plane.near[k] + 3U) % 6U;
    value = L::multiply_add(L::load(stream[s] + at), L::all(plane.normal[k]), value);
  }
  return value;
}

/// First stage of the plane form: shaft box, then joining planes where any lane is left. Writes the kept bits.
template <class L>
void box_planes_stage(const ShaftData& shaft, const float* const* stream, std::size_t words,
                      std::uint64_t* kept) noexcept {
  const auto margin = L::all(shaft.joining_margin);
  const auto minus_margin = L::all(-shaft.joining_margin);
  const JoiningPlanes<L> planes(shaft, shaft.joining_near0, shaft.joining_near1, stream);
  constexpr unsigned at_once = L::width < 8 ? 1 : 4;
  typename L::Vector face[6];
  for (unsigned f = 0; f < 6; ++f) face[f] = L::all(shaft.face[f]);

  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t outside = 0;
    std::uint64_t undecided = 0;
    for (unsigned lane = 0; lane < word_bits; lane += L::width) {
      const std::size_t at = w * word_bits + lane;
      auto beyond_box = L::either(L::less(L::load(stream[3] + at), face[0]), L::less(face[3], L::load(stream[0] + at)));
      for (unsigned k = 1; k < 3; ++k) {
        beyond_box = L::either(beyond_box, L::less(L::load(stream[k + 3] + at), face[k]));
        beyond_box = L::either(beyond_box, L::less(face[k + 3], L::load(stream[k] + at)));
      }
      outside |= L::bits(beyond_box) << lane;
    }
    kept[w] = ~outside;
    if (kept[w] == 0) continue;
    for (unsigned lane = 0; lane < word_bits; lane += at_once * L::width) {
      // Wide vectors nearly always have a lane left, and a mispredicted branch costs more than the planes.
      if (L::width < 8 && (kept[w] & lanes_of<L>(lane)) == 0) continue;
      typename L::Vector value[at_once];
      planes.largest_values(w * word_bits + lane, value);
      for (unsigned v = 0; v < at_once; ++v) {
        const unsigned here = lane + v * L::width;
        const std::uint64_t positive = L::bits(L::less(margin, value[v])) << here;
        const std::uint64_t negative = L::bits(L::less(value[v], minus_margin)) << here;
        outside |= positive;
        undecided |= ~(positive | negative) & lanes_of<L>(here);
      }
    }
    undecided &= ~outside;
    if (undecided != 0) [[unlikely]] {
      outside |= decide_lanes<L>(undecided, [&](unsigned lane) {
        return box_outside(shaft, BoundAt<L, 6>(stream, w * word_bits + lane).value);
      });
    }
    kept[w] = ~outside;
  }
}

/// What added planes say of vectors of boxes, bit by lane.
struct AddedVerdict {
  std::uint64_t beyond;     ///< some plane, for certain
  std::uint64_t undecided;  ///< all lanes that are not behind all planes for certain
};

/// Of `vectors` vectors of boxes side by side, which share the loads of a plane's coefficients.
template <class L, unsigned vectors>
AddedVerdict added_verdict(const ShaftData& shaft, const float* const* stream, std::size_t at) noexcept {
  typename L::Mask is_beyond[vectors];
  typename L::Mask is_behind[vectors];
  for (unsigned v = 0; v < vectors; ++v) {
    is_beyond[v] = L::less(L::all(0.0F), L::all(0.0F));
    is_behind[v] = L::less_equal(L::all(0.0F), L::all(0.0F));
  }
  for (unsigned i = 0; i < shaft.added_count; ++i) {
    const ShaftData::AddedPlane& plane = shaft.added[i];
    const auto margin = L::all(plane.margin);
    const auto minus_margin = L::all(-plane.margin);
    const auto minus_offset = L::all(plane.minus_offset);
    const float* x[3];
    typename L::Vector normal[3];
    for (unsigned k = 0; k < 3; ++k) {
      x[k] = stream[plane.near[k]] + at;
      normal[k] = L::all(plane.normal[k]);
    }
    for (unsigned v = 0; v < vectors; ++v) {
      auto value = minus_offset;
      for (unsigned k = 0; k < 3; ++k) value = L::multiply_add(L::load(x[k] + v * L::width), normal[k], value);
      is_beyond[v] = L::either(is_beyond[v], L::less(margin, value));
      is_behind[v] = L::both(is_behind[v], L::less(value, minus_margin));
    }
  }
  AddedVerdict verdict{};
  for (unsigned v = 0; v < vectors; ++v) {
    verdict.beyond |= L::bits(is_beyond[v]) << v * L::width;
    verdict.undecided |= (L::bits(is_behind[v]) ^ lanes_of<L>(0)) << v * L::width;
  }
  return verdict;
}

/// Clears the kept bits of boxes beyond an added plane.
template <class L>
void box_added_stage(const ShaftData& shaft, const float* const* stream, std::size_t words,
                     std::uint64_t* kept) noexcept {
  constexpr unsigned four = 4 * L::width;
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t undecided = 0;
    const auto note = [&](const AddedVerdict& verdict, unsigned lane) {
      kept[w] &= ~(verdict.beyond << lane);
      undecided |= verdict.undecided << lane;
    };
    for (unsigned first = 0; first < word_bits; first += four) {
      unsigned with_any = 0;
      for (unsigned v = 0; v < 4; ++v) with_any += (kept[w] & lanes_of<L>(first + v * L::width)) != 0 ? 1 : 0;
      const std::size_t at = w * word_bits + first;
      if (with_any == 4) {
        note(added_verdict<L, 4>(shaft, stream, at), first);
        continue;
      }
      for (unsigned lane = 0; lane < four; lane += L::width) {
        if ((kept[w] & lanes_of<L>(first + lane)) == 0) continue;
        note(added_verdict<L, 1>(shaft, stream, at + lane), first + lane);
      }
    }
    undecided &= kept[w];
    if (undecided != 0) [[unlikely]] {
      kept[w] &= ~decide_lanes<L>(undecided, [&](unsigned lane) {
        return box_outside(shaft, BoundAt<L, 6>(stream, w * word_bits + lane).value);
      });
    }
  }
}

/// Clears the bits of boxes that are not inside.
template <class L>
void box_inside_stage(const ShaftData& shaft, const float* const* stream, std::size_t words,
                      std::uint64_t* inside) noexcept {
  const auto minus_margin = L::all(-shaft.joining_margin);
  const auto margin = L::all(shaft.joining_margin);
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t candidates = 0;  // within the shaft box and not beyond any plane for certain
    std::uint64_t undecided = 0;
    for (unsigned lane = 0; lane < word_bits; lane += L::width) {
      if ((inside[w] & lanes_of<L>(lane)) == 0) continue;
      const std::size_t at = w * word_bits + lane;
      // The empty box is within all faces, and inside of nothing.
      auto within_box = L::less_equal(L::load(stream[0] + at), L::load(stream[3] + at));
      for (unsigned k = 0; k < 3; ++k) {
        within_box = L::both(within_box, L::less_equal(L::all(shaft.face[k]), L::load(stream[k] + at)));
      }
      for (unsigned k = 3; k < 6; ++k) {
        within_box = L::both(within_box, L::less_equal(L::load(stream[k] + at), L::all(shaft.face[k])));
      }
      std::uint64_t within = L::bits(within_box) << lane & inside[w];
      if (within == 0) continue;
      const auto value = largest_joining_value<L>(shaft, shaft.joining_far0, shaft.joining_far1, stream, at);
      std::uint64_t certain = L::bits(L::less(value, minus_margin)) << lane;
      within &= ~(L::bits(L::less(margin, value)) << lane);
      for (unsigned i = 0; i < shaft.added_count; ++i) {
        const ShaftData::AddedPlane& plane = shaft.added[i];
        const auto added = added_value<L, Corner::far>(plane, stream, at);
        certain &= L::bits(L::less(added, L::all(-plane.margin))) << lane;
        within &= ~(L::bits(L::less(L::all(plane.margin), added)) << lane);
      }
      candidates |= within;
      undecided |= within & ~certain;
    }
    inside[w] = candidates & ~undecided;
    if (undecided != 0) [[unlikely]] {
      inside[w] |= decide_lanes<L>(undecided, [&](unsigned lane) {
        return box_inside(shaft, BoundAt<L, 6>(stream, w * word_bits + lane).value);
      });
    }
  }
}

}  // namespace shaftcull::kernel
