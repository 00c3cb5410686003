// SPDX-License-Identifier: MIT
/// A scene of cubes, and `shaftcull cull` of it.
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "cli/program.hpp"

namespace shaftcull::test {

struct Cube {
  std::string name;
  double x;
  double y;
  double half_extent;
};

/// An OBJ file of cubes, twelve triangles each.
inline std::string obj_of(const std::vector<Cube>& cubes) {
  std::ostringstream obj;
  obj.precision(17);
  int first = 1;
  for (const Cube& cube : cubes) {
    obj << "o " << cube.name << '\n';
    for (int corner = 0; corner < 8; ++corner) {
      const auto side = [&](int axis) { return (corner >> axis & 1) != 0 ? cube.half_extent : -cube.half_extent; };
      obj << "v " << cube.x + side(0) << ' ' << cube.y + side(1) << ' ' << side(2) << '\n';
    }
    constexpr int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& quad : quads) {
      obj << 'f';
      for (const int corner : quad) obj << ' ' << first + corner;
      obj << '\n';
    }
    first += 8;
  }
  return obj.str();
}

/// Three cubes in a row, a small one between them and one to the side.
class CliCull : public testing::Test {
 protected:
  [[nodiscard]] Outcome cull(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"cull", "--scene", row_});
    return run_program(arguments);
  }

  ScratchFolder folder_;
  std::string row_ = folder_.write(
      "row.obj",
      obj_of({{"left", 0, 0, 1}, {"middle", 5, 0, 2}, {"small", 5, 0, 0.5}, {"right", 10, 0, 1}, {"aside", 5, 9, 1}}));
};

}  // namespace shaftcull::test
