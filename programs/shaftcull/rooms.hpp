// SPDX-License-Identifier: MIT
/// Rooms with doors and furniture: a scene for those who have no mesh file at hand.
#pragma once

#include <cstddef>
#include <cstdint>

#include "mesh.hpp"

namespace shaftcull::cli {

inline constexpr std::size_t most_rooms = 10'000;

/// Rooms in rows, as near to a square as their number has divisors. Walls are boxes, with a door between neighbours;
/// furniture is boxes, turned ones, and balls. There is no ceiling. Objects are "floor", "wall 1", …, "table 1", …,
/// "cupboard 1", …, "ball 1", …; the z axis points up, and a unit is a metre. The same seed makes the same rooms on
/// every machine.
[[nodiscard]] MeshScene make_rooms(std::size_t rooms, std::uint64_t seed);

}  // namespace shaftcull::cli
