// SPDX-License-Identifier: MIT
/// What a query leaves out, for one shaft: bounds by index, by a mask of bits, and by layers.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "kernels/kernel_table.hpp"
#include "query/options.hpp"
#include "support/compiler.hpp"
#include "support/prefetch.hpp"
#include "tree/leaf_indices.hpp"
#include "tree/parts.hpp"

namespace shaftcull::kernel {

/// The layers of a tree that one shaft asks for.
class LayerFilter {
 public:
  LayerFilter() noexcept = default;  // lets everything through
  LayerFilter(const TreeLayers& layers, const TreeLevel* level, std::uint32_t mask, const Kernels& kernels) noexcept
      : leaf_(layers.leaves.data()),
        block_(layers.blocks),
        node_(layers.nodes.data()),
        level_(level),
        keep_(kernels.keep_layers),
        mask_(mask) {}

  [[nodiscard]] bool is_on() const noexcept { return keep_ != nullptr; }

  /// Of the word of leaves from `first` on, those of `asked` that are in a layer asked for.
  [[nodiscard]] std::uint64_t leaves(std::size_t first, std::uint64_t asked) const noexcept {
    return is_empty() ? 0 : kept(at(first), asked);
  }
  /// Of a word of entries of level k, those of `asked` with such leaves below.
  [[nodiscard]] std::uint64_t nodes(std::size_t k, std::size_t first, std::uint64_t asked) const noexcept {
    return is_empty() ? 0 : kept(node_ + level_[k].first + first, asked);
  }
  SHAFTCULL_ALWAYS_INLINE void prefetch(std::size_t first) const noexcept {
    if (!is_empty()) prefetch_to_second_level(at(first), fanout);
  }

 private:
  /// Fewer bounds are looked at one by one: that reads less memory, and is no slower.
  static constexpr int few = 8;

  [[nodiscard]] std::uint64_t kept(const std::uint32_t* layers, std::uint64_t asked) const noexcept {
    if (popcount_anywhere(asked) > few) return asked & keep_(layers, mask_);
    std::uint64_t bits = 0;
    for (std::uint64_t left = asked; left != 0; left &= left - 1) {
      const bool is_in = (layers[std::countr_zero(left)] & mask_) != 0;
      bits |= is_in ? left & -left : 0;
    }
    return bits;
  }

  /// Whether there are no layers: then no bound is in any of none.
  [[nodiscard]] bool is_empty() const noexcept { return node_ == nullptr && leaf_ == nullptr; }
  [[nodiscard]] const std::uint32_t* at(std::size_t leaf) const noexcept {
    return block_ == nullptr ? leaf_ + leaf : block_[leaf / block_leaves] + leaf % block_leaves;
  }

  const std::uint32_t* leaf_ = nullptr;
  const std::uint32_t* const* block_ = nullptr;
  const std::uint32_t* node_ = nullptr;
  const TreeLevel* level_ = nullptr;
  KeepLayers* keep_ = nullptr;
  std::uint32_t mask_ = 0;
};

class Exclusion {
 public:
  Exclusion(const LeafIndices& indices, const ExcludedIndices& excluded, const LayerFilter& layers) noexcept
      : indices_(indices), excluded_(excluded), layers_(layers) {}

  [[nodiscard]] bool is_on() const noexcept { return layers_.is_on() || excluded_.is_on(); }
  [[nodiscard]] const LeafIndices& indices() const noexcept { return indices_; }

  /// Leaves first … first + 63 will be asked about.
  SHAFTCULL_ALWAYS_INLINE void prefetch(std::size_t first) const noexcept {
    indices_.prefetch(first);
    if (layers_.is_on()) layers_.prefetch(first);
  }
  /// Of the word of leaves from `first` on, those of `asked` that are not left out.
  [[nodiscard]] std::uint64_t leaves(std::size_t first, std::uint64_t asked) const noexcept {
    if (layers_.is_on()) asked = layers_.leaves(first, asked);
    return excluded_.is_on() ? asked & ~left_out_by_index(first, asked) : asked;
  }
  /// Of a word of entries of level k, from `first` on, those of `asked` below which something is not left out. It may
  /// keep others.
  [[nodiscard]] std::uint64_t nodes(std::size_t k, std::size_t first, std::uint64_t asked) const noexcept {
    return layers_.is_on() ? layers_.nodes(k, first, asked) : asked;
  }

 private:
  [[nodiscard]] std::uint64_t left_out_by_index(std::size_t first, std::uint64_t asked) const noexcept {
    std::uint64_t out = 0;
    for (std::uint64_t left = asked; left != 0; left &= left - 1) {
      if (excluded_.has(indices_[first + static_cast<std::size_t>(std::countr_zero(left))])) out |= left & -left;
    }
    return out;
  }

  LeafIndices indices_;
  ExcludedIndices excluded_;
  LayerFilter layers_;
};

}  // namespace shaftcull::kernel
