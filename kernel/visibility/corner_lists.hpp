// SPDX-License-Identifier: MIT
/// Lists of corners, of hulls, polygons and patches, one after another: checks, and boxes around them.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

inline constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();

[[nodiscard]] bool is_finite(const Vec3& point) noexcept;

/// The box around finite corners; an empty one around none.
[[nodiscard]] Box box_around_corners(std::span<const Vec3> corners) noexcept;

/// The parts of a list, of which part i begins at first[i] and ends where the next one begins. Throws unless they
/// ascend from 0 to `size`.
void require_parts(std::span<const std::size_t> first, std::size_t size, const char* name, const char* noun);

/// Throws unless `first` has such parts of `corners`, each of `fewest` to `most` corners, and all are finite.
void require_corner_lists(std::span<const Vec3> corners, std::span<const std::size_t> first, const char* noun,
                          std::size_t fewest, std::size_t most);

}  // namespace shaftcull::kernel
