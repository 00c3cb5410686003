// A street: floor, two walls of houses, and a lamp post between them. Which part of the
// radiation of each facet arrives at each other one, and which part goes to the sky?
#include <cstdio>
#include <shaftcull/shaftcull.hpp>
#include <vector>

namespace sc = shaftcull;

int main() {
  // Corners of each facet, counterclockwise as seen from where it radiates.
  const std::vector<sc::Vec3> corners{
      {0, 0, 0},  {10, 0, 0}, {10, 20, 0}, {0, 20, 0},    // the street
      {0, 0, 0},  {0, 20, 0}, {0, 20, 9},  {0, 0, 9},     // houses on the left
      {10, 0, 0}, {10, 0, 9}, {10, 20, 9}, {10, 20, 0}};  // and on the right
  const std::vector<std::size_t> first_corner{0, 4, 8, 12};
  const sc::PatchSet facets(corners, first_corner);

  sc::Occluders between;
  between.add_solids(std::vector<sc::Box>{{{4, 9, 0}, {6, 11, 7}}});

  const sc::ViewFactors factors = sc::view_factors(facets, between);
  for (std::size_t i = 0; i != factors.size(); ++i) {
    for (std::size_t j = 0; j != factors.size(); ++j) std::printf("%.3f ", factors(i, j));
    std::printf("  sky %.3f\n", 1 - factors.sum[i]);
  }
  std::printf(
      "in the open, from wall to wall: %.3f\n",
      sc::view_factor(std::span(corners).subspan(4, 4), std::span(corners).subspan(8, 4)));
}
