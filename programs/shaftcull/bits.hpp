// SPDX-License-Identifier: MIT
/// Answers as bits: that of bound i is bit i % 64 of word i / 64.
#pragma once

#include <cstddef>
#include <cstdint>

namespace shaftcull::cli {

/// The bit of bound i, in its word. BitView reads bits.
constexpr std::uint64_t bit_of(std::size_t i) noexcept { return std::uint64_t{1} << i % 64; }

}  // namespace shaftcull::cli
