// SPDX-License-Identifier: MIT
/// The order in which joining planes are tested: those that decide most bounds first.
#pragma once

#include <span>

#include "shaftcull/paper.hpp"

namespace shaftcull::kernel {

/// Sorts the joining planes of the shaft between `a` and `b`; planes that are equally good keep their order.
void sort_planes(const Box& a, const Box& b, PlaneOrder order, std::span<JoiningPlane> planes) noexcept;

}  // namespace shaftcull::kernel
