#include "workload.hpp"

#include <algorithm>
#include <cstdint>
#include <random>
#include <span>

namespace shaftcull::bench {
namespace {

/// Uniform numbers. std::mt19937 is the same everywhere, std::uniform_real_distribution is not.
class Dice {
 public:
  explicit Dice(std::uint32_t seed) : generator_(seed) {}

  [[nodiscard]] float uniform(float low, float high) {
    const float unit = static_cast<float>(generator_() >> 8) * 0x1p-24F;  // the bits that a float holds
    return low + unit * (high - low);
  }
  [[nodiscard]] Box box(float least_half, float most_half) {
    Box box{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float centre = uniform(-5.0F, 5.0F);
      const float half = uniform(least_half, most_half);
      box.lo[axis] = centre - half;
      box.hi[axis] = centre + half;
    }
    return box;
  }
  [[nodiscard]] Sphere sphere(float least_radius, float most_radius) {
    Sphere sphere{};
    for (float& coordinate : sphere.centre) coordinate = uniform(-5.0F, 5.0F);
    sphere.radius = uniform(least_radius, most_radius);
    return sphere;
  }

 private:
  std::mt19937 generator_;
};

/// Seeds of their own keep each part the same whatever the size of the others.
constexpr std::uint32_t box_seed = 2000;
constexpr std::uint32_t sphere_seed = 2001;
constexpr std::uint32_t pair_seed = 2002;

template <class Bound>
std::vector<Bound> first_of(const std::vector<Bound>& bounds, std::size_t count) {
  return {bounds.begin(), bounds.begin() + static_cast<std::ptrdiff_t>(std::min(count, bounds.size()))};
}

}  // namespace

Workload::Workload(std::size_t bounds) {
  {
    Dice dice(box_seed);
    std::vector<Box> all(bounds);
    for (Box& box : all) box = dice.box(0.01F, 0.11F);
    boxes = BoxStream(std::span<const Box>(all));
    box_records = first_of(all, records);
  }
  {
    Dice dice(sphere_seed);
    std::vector<Sphere> all(bounds);
    for (Sphere& sphere : all) sphere = dice.sphere(0.01F, 0.11F);
    spheres = SphereStream(std::span<const Sphere>(all));
    sphere_records = first_of(all, records);
  }
  Dice dice(pair_seed);
  for (std::size_t i = 0; i < pairs; ++i) {
    a.push_back(dice.box(0.2F, 1.0F));
    b.push_back(dice.box(0.2F, 1.0F));
  }
}

}  // namespace shaftcull::bench
