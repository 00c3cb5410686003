/// What `shaftcull draw` shows: a shaft, what it is made of, and boxes with the answers that they get.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "region.hpp"
#include "shaft_choice.hpp"
#include "shaftcull/cull.hpp"

namespace shaftcull::cli {

/// A box that the user asks about.
struct DrawnBound {
  Box box;
  Answer answer;
  bool blocks;                ///< as a solid box it hides one end of the shaft from the other
  std::optional<float> time;  ///< when the moving box reaches it, if that was asked and it does
};

/// "overlap from 0.25": what a bound's label says.
[[nodiscard]] std::string label_of(const DrawnBound& bound);

struct ShaftDrawing {
  ShaftChoice choice;
  std::optional<Box> a;  ///< what the shaft starts from: the first box, the body, the light
  std::optional<Box> b;  ///< the second box, where the body ends, the occluder
  FormedShaft shaft;
  std::vector<DrawnBound> bounds;
  Region region;
  ShownSpace frame;
};

/// An SVG file: the drawing as seen along the third axis.
[[nodiscard]] std::string svg_of(const ShaftDrawing& drawing, std::size_t across, std::size_t up);

}  // namespace shaftcull::cli
