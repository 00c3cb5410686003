// SPDX-License-Identifier: MIT
/// What numbers bounds.
#pragma once

#include <concepts>
#include <cstdint>

namespace shaftcull {

/// Indices of bounds: 32 bits, or 64 for more bounds than 32 bits can number.
template <class T>
concept BoundIndex = std::same_as<T, std::uint32_t> || std::same_as<T, std::uint64_t>;

}  // namespace shaftcull
