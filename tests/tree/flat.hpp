// SPDX-License-Identifier: MIT
/// What a flat scan answers, as lists to compare those of a tree with.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "columns.hpp"
#include "shaftcull/cull.hpp"

namespace shaftcull {

using Indices = std::vector<std::uint32_t>;

/// Ascending indices of bounds that overlap and that are inside.
struct FlatAnswers {
  Indices overlap;
  Indices inside;

  template <class Bound>
  FlatAnswers(const CompiledShaft& shaft, const std::vector<Bound>& bounds) {
    const auto memory = columns(bounds);
    std::vector<std::uint64_t> kept_bits(bit_words(bounds.size()));
    std::vector<std::uint64_t> inside_bits(kept_bits.size());
    classify(shaft, memory.view(), kept_bits, inside_bits);
    for (std::uint32_t i = 0; i != bounds.size(); ++i) {
      if ((kept_bits[i / 64] >> i % 64 & 1) == 0) continue;
      ((inside_bits[i / 64] >> i % 64 & 1) != 0 ? inside : overlap).push_back(i);
    }
  }
  [[nodiscard]] Indices kept() const {
    Indices all;
    std::merge(overlap.begin(), overlap.end(), inside.begin(), inside.end(), std::back_inserter(all));
    return all;
  }
};

/// The bits of ascending indices of `bounds` bounds.
inline std::vector<std::uint64_t> bits_of(const Indices& indices, std::size_t bounds) {
  std::vector<std::uint64_t> bits(bit_words(bounds));
  for (const std::uint32_t index : indices) bits[index / 64] |= std::uint64_t{1} << index % 64;
  return bits;
}

/// Ascending indices.
template <class List>
Indices sorted(const List& indices) {
  Indices all(indices.begin(), indices.end());
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace shaftcull
