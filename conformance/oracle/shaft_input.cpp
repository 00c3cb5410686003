// SPDX-License-Identifier: MIT
#include "oracle/shaft_input.hpp"

#include <cstdio>

namespace shaftcull {

std::string source_text(float x) {
  char text[40];
  const int length = std::snprintf(text, sizeof text, "%aF", static_cast<double>(x));
  return {text, static_cast<std::size_t>(length)};
}

std::string source_text(const Vec3& v) {
  return "{" + source_text(v[0]) + ", " + source_text(v[1]) + ", " + source_text(v[2]) + "}";
}

std::string source_text(const Box& box) { return "Box{" + source_text(box.lo) + ", " + source_text(box.hi) + "}"; }

std::string source_text(const Sphere& sphere) {
  return "Sphere{" + source_text(sphere.centre) + ", " + source_text(sphere.radius) + "}";
}

std::string source_text(const ShaftInput& input) {
  std::string text = "ShaftInput{" + source_text(input.a) + ", " + source_text(input.b) + ", {";
  for (const Plane& plane : input.added) {
    text += "Plane{" + source_text(plane.normal) + ", " + source_text(plane.offset) + "}, ";
  }
  return text + (input.contact == Contact::open ? "}, Contact::open}" : "}}");
}

const char* text(Answer answer) {
  return answer == Answer::outside ? "outside" : answer == Answer::inside ? "inside" : "overlap";
}

}  // namespace shaftcull
