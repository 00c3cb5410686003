// SPDX-License-Identifier: MIT
#include "scenes/workload.hpp"

#include <algorithm>
#include <cstdint>
#include <span>

#include "scenes/random.hpp"

namespace shaftcull::bench {
namespace {

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
    Random random(box_seed);
    std::vector<Box> all(bounds);
    for (Box& box : all) box = random.box(0.01F, 0.11F);
    boxes = BoxStream(std::span<const Box>(all));
    box_records = first_of(all, records);
  }
  {
    Random random(sphere_seed);
    std::vector<Sphere> all(bounds);
    for (Sphere& sphere : all) sphere = random.sphere(0.01F, 0.11F);
    spheres = SphereStream(std::span<const Sphere>(all));
    sphere_records = first_of(all, records);
  }
  Random random(pair_seed);
  for (std::size_t i = 0; i < pairs; ++i) {
    a.push_back(random.box(0.2F, 1.0F));
    b.push_back(random.box(0.2F, 1.0F));
  }
}

}  // namespace shaftcull::bench
