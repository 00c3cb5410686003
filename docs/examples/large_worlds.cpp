// A world in doubles: bounds go to floats relative to the camera, rounded outwards.
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <shaftcull/shaftcull.hpp>
#include <vector>

namespace sc = shaftcull;

namespace {

using Vec3d = std::array<double, 3>;
struct WorldBox {
  Vec3d lo;
  Vec3d hi;
};

// A float that is at most x, or at least x. The cast errs by half a step at most, and the
// difference in doubles by far less than the other half.
float down(double x) {
  return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}
float up(double x) {
  return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
}

// The box as seen from the origin: it holds the true one.
sc::Box relative(const WorldBox& box, const Vec3d& origin) {
  sc::Box result{};
  for (std::size_t axis = 0; axis != 3; ++axis) {
    result.lo[axis] = down(box.lo[axis] - origin[axis]);
    result.hi[axis] = up(box.hi[axis] - origin[axis]);
  }
  return result;
}

}  // namespace

int main() {
  // Two crates far from the sun, where a float has steps of 64 km, and two walls of 20 cm: one
  // beside the line between the crates, one across it.
  const double away = 7.8e11;
  const WorldBox crate{{away, away, 0}, {away + 1, away + 1, 1}};
  const WorldBox other{{away + 9, away, 0}, {away + 10, away + 1, 1}};
  const std::vector<WorldBox> walls = {{{away + 4, away + 1.2, 0}, {away + 5, away + 1.4, 3}},
                                       {{away + 6, away + 0.5, 0}, {away + 6.2, away + 2, 3}}};

  for (const Vec3d& origin : {Vec3d{away + 3, away, 2}, Vec3d{0, 0, 0}}) {
    const sc::CompiledShaft shaft =
        sc::compile(relative(crate, origin), relative(other, origin));
    std::printf("%s:", origin[0] == 0 ? "relative to the sun" : "relative to the camera");
    for (const WorldBox& wall : walls) {
      std::printf(" %s", keeps(shaft, relative(wall, origin)) ? "may" : "cannot");
    }
    std::printf("\n");
  }
}
