// A world in doubles: bounds go to floats relative to a point near the camera.
#include <cstdio>
#include <shaftcull/shaftcull.hpp>
#include <vector>

namespace sc = shaftcull;

int main() {
  // Two crates far from the sun, where a float has steps of 64 km, and two walls of 20 cm: one
  // beside the line between the crates, one across it.
  const double away = 7.8e11;
  const sc::WorldBox crate{{away, away, 0}, {away + 1, away + 1, 1}};
  const sc::WorldBox other{{away + 9, away, 0}, {away + 10, away + 1, 1}};
  const std::vector<sc::WorldBox> walls = {
      {{away + 4, away + 1.2, 0}, {away + 5, away + 1.4, 3}},
      {{away + 6, away + 0.5, 0}, {away + 6.2, away + 2, 3}}};

  const sc::Origin camera({away + 3, away, 2});
  const sc::Origin sun;
  for (const sc::Origin& origin : {camera, sun}) {
    const sc::CompiledShaft shaft = sc::compile(origin.around(crate), origin.around(other));
    std::vector<sc::Box> boxes(walls.size());
    origin.around(walls, boxes);
    std::printf("%s:", origin == sun ? "relative to the sun" : "relative to the camera");
    for (const sc::Box& box : boxes) std::printf(" %s", keeps(shaft, box) ? "may" : "cannot");
    std::printf("\n");
  }
}
