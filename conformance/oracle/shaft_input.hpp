// SPDX-License-Identifier: MIT
/// What a test is about: a shaft, given as its boxes and added planes, and how to print it.
#pragma once

#include <string>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"

namespace shaftcull {

/// A shaft as its two boxes and added planes.
struct ShaftInput {
  Box a;
  Box b;
  std::vector<Plane> added{};
  Contact contact = Contact::closed;
};

/// The shaft that the input describes, with its joining planes.
inline CompiledShaft shaft_of(const ShaftInput& input) {
  CompiledShaft shaft = compile(input.a, input.b, input.added);
  complete(shaft);
  set_contact(shaft, input.contact);
  return shaft;
}

/// C++ source text that makes the same values again, to the bit.
std::string source_text(float x);
std::string source_text(const Vec3& v);
std::string source_text(const Box& box);
std::string source_text(const Sphere& sphere);
std::string source_text(const ShaftInput& input);

/// "outside", "overlap" or "inside".
const char* text(Answer answer);

}  // namespace shaftcull
