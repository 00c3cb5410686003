// SPDX-License-Identifier: MIT
/// Bounds as streams have them, and back.
#pragma once

#include "tree/parts.hpp"

namespace shaftcull::kernel {

/// A bound as streams have it.
template <class Bound>
struct Row {
  float value[rows_of<Bound>];
};
[[nodiscard]] inline Row<Box> row_of(const Box& box) noexcept {
  return {{box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2]}};
}
[[nodiscard]] inline Row<Sphere> row_of(const Sphere& sphere) noexcept {
  return {{sphere.centre[0], sphere.centre[1], sphere.centre[2], sphere.radius}};
}
[[nodiscard]] inline Box bound_of(const float (&row)[6]) noexcept {
  return {{row[0], row[1], row[2]}, {row[3], row[4], row[5]}};
}
[[nodiscard]] inline Sphere bound_of(const float (&row)[4]) noexcept { return {{row[0], row[1], row[2]}, row[3]}; }

}  // namespace shaftcull::kernel
