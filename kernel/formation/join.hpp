/// The plane that joins an edge of one box with the corresponding edge of the other.
#pragma once

#include "formation/rule.hpp"

namespace shaftcull::kernel {

/// The joining plane of `edge` between boxes with faces at `a` and `b`: through both boxes' edges, parallel to them,
/// with both boxes inside. Computed in double, rounded once.
///
/// The normal has unit length if `unit`; else its length is whatever saves a root and divisions. Only a unit plane
/// farther than the largest float from the origin is scaled down, so that its offset stays finite.
[[nodiscard]] JoiningPlane join(const Faces6& a, const Faces6& b, JoinedEdge edge, bool unit) noexcept;

}  // namespace shaftcull::kernel
