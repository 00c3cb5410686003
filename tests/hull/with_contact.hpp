// SPDX-License-Identifier: MIT
/// Hulls with either contact.
#pragma once

#include "shaftcull/hull.hpp"

namespace shaftcull {

[[nodiscard]] inline CompiledShaft with_contact(const ConvexHull& hull, Contact contact) {
  CompiledShaft shaft = hull;
  set_contact(shaft, contact);
  return shaft;
}

}  // namespace shaftcull
