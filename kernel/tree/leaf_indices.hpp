/// The user's indices of leaves.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "fetch.hpp"
#include "test/kernels.hpp"
#include "tree/parts.hpp"

namespace shaftcull::kernel {

template <class Index>
class LeafIndices {
 public:
  LeafIndices(const std::vector<Index>& order, const Kernels& kernels) noexcept
      : order_(order.data()), in_whole_words_(order.size() / fanout * fanout), pick_(kernels.pick) {}

  [[nodiscard]] Index operator[](std::size_t leaf) const noexcept { return order_[leaf]; }

  /// Fetches the indices of the word of leaves from `first` on.
  [[gnu::always_inline]] void fetch(std::size_t first) const noexcept {
    if (first >= in_whole_words_) return;
    fetch_to_second_level(order_ + first, fanout);
    fetch_to_second_level(order_ + first + fanout - 1, 1);  // a vector does not begin with a cache line
  }

  /// Writes those of the leaves `first` + i, for every set bit i, ascending. There must be room for 64, and the rest of it may
  /// be scribbled on. Returns how many.
  std::size_t pick(std::size_t first, std::uint64_t bits, Index* out) const noexcept {
    if constexpr (std::is_same_v<Index, std::uint32_t>) {
      if (first < in_whole_words_) return pick_(order_ + first, bits, out);
    }
    Index* end = out;
    for (; bits != 0; bits &= bits - 1) *end++ = order_[first + static_cast<std::size_t>(std::countr_zero(bits))];
    return static_cast<std::size_t>(end - out);
  }

 private:
  const Index* order_;
  std::size_t in_whole_words_;  // leaves
  Pick* pick_;
};

}  // namespace shaftcull::kernel
