// SPDX-License-Identifier: MIT
/// What a job asks of each of its shafts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "shaftcull/compiled.hpp"

namespace shaftcull::batch {

/// What a row of the shafts' file describes.
enum class ShaftKind : std::uint8_t {
  between,  ///< two boxes
  shadow,   ///< a light and an occluder, two boxes
  swept,    ///< a box and the displacement that it moves by
  sun,      ///< a box and the direction that it moves in without end
};

/// What is told of each shaft.
enum class Answer : std::uint8_t {
  count,     ///< how many bounds it keeps
  list,      ///< which ones, ascending
  classify,  ///< which overlap it and which are inside, each ascending
  first,     ///< which one it reaches first, and when
  occluded,  ///< whether one of the bounds, taken for solid, blocks it
};

/// What bounds are.
enum class BoundKind : std::uint8_t { box, sphere, triangle };

struct Question {
  ShaftKind kind = ShaftKind::between;
  Answer answer = Answer::count;
  Contact contact = Contact::closed;
};

// Names are in the order of the enumerations.
[[nodiscard]] constexpr const char* name_of(ShaftKind kind) noexcept {
  constexpr std::array names{"between", "shadow", "swept", "sun"};
  return names[static_cast<std::size_t>(kind)];
}
[[nodiscard]] constexpr const char* name_of(Answer answer) noexcept {
  constexpr std::array names{"count", "list", "classify", "first", "occluded"};
  return names[static_cast<std::size_t>(answer)];
}
[[nodiscard]] constexpr const char* name_of(BoundKind kind) noexcept {
  constexpr std::array names{"box", "sphere", "triangle"};
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace shaftcull::batch
