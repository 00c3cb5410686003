/// Words of bits as a count and as a list of positions.
#pragma once

#include <cstddef>
#include <cstdint>

namespace shaftcull::kernel {

/// Number of set bits in `count` words.
[[nodiscard]] std::size_t count_set_bits(const std::uint64_t* words, std::size_t count) noexcept;

/// Positions that write_set_bits() may scribble on past the last one it is asked for.
inline constexpr std::size_t set_bits_slack = 16;

/// Writes 64 w + i for every set bit i of every word w, ascending. `set` is how many there are, and `out` must have room
/// for that and set_bits_slack more. Not for more than 2²⁶ words.
void write_set_bits(const std::uint64_t* words, std::size_t count, std::size_t set, std::uint32_t* out) noexcept;

}  // namespace shaftcull::kernel
