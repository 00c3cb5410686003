/// Words of bits as a count and as a list of positions.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/table.hpp"

namespace shaftcull::kernel {

/// Positions that SetBits::write() may scribble on past the last one it is asked for.
inline constexpr std::size_t set_bits_slack = 16;

struct SetBits {
  /// Number of set bits in `count` words.
  std::size_t (*count)(const std::uint64_t* words, std::size_t count) noexcept;

  /// Writes 64 w + i for every set bit i of every word w, ascending. `set` is how many there are, and `out` must have
  /// room for that and set_bits_slack more. Not for more than 2²⁶ words.
  void (*write)(const std::uint64_t* words, std::size_t count, std::size_t set, std::uint32_t* out) noexcept;
};

/// The loops for calls that run on these kernels: without vectors the portable ones, else the quickest that this
/// processor has and that are not wider than the kernels' vectors.
[[nodiscard]] const SetBits& set_bits_of(const Kernels& kernels) noexcept;

}  // namespace shaftcull::kernel
