// SPDX-License-Identifier: MIT
/// What `shaftcull draw` shows: a shaft, what it is made of, and boxes and triangles with the answers that they get.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "region.hpp"
#include "shaft_choice.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::cli {

/// A box that the user asks about.
struct DrawnBound {
  Box box;
  Answer answer;
  bool blocks;                ///< as a solid box it hides one end of the shaft from the other
  std::optional<float> time;  ///< when the moving box reaches it, if that was asked and it does
};

/// A triangle that the user asks about, with the answer of the exact test.
struct DrawnTriangle {
  Triangle triangle;
  Answer answer;
};

/// "overlap from 0.25": what the label says.
[[nodiscard]] std::string label_of(const DrawnBound& bound);
[[nodiscard]] std::string label_of(const DrawnTriangle& triangle);

struct ShaftDrawing {
  ShaftChoice choice;
  std::optional<Box> a;  ///< what the shaft starts from: the first box, the body, the light
  std::optional<Box> b;  ///< the second box, where the body ends, the occluder
  FormedShaft shaft;
  std::vector<DrawnBound> bounds;
  std::vector<DrawnTriangle> triangles;
  Region region;
  ShownSpace frame;
};

/// An SVG file: the drawing as seen along the third axis.
[[nodiscard]] std::string svg_of(const ShaftDrawing& drawing, std::size_t across, std::size_t up);

}  // namespace shaftcull::cli
