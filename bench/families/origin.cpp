// SPDX-License-Identifier: MIT
/// origin/…: bounds of a world in doubles become floats relative to an origin. An item is a bound. `boxes_cast`
/// converts the same boxes by subtraction and a cast: floats nearest to the coordinates, so parts of a box may lie
/// outside its float box.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "harness/suite.hpp"
#include "scenes/random.hpp"
#include "shaftcull/origin.hpp"

namespace shaftcull::bench {
namespace {

constexpr WorldVec3 city{4512345.25, 5821007.5, 112.0};
constexpr double half_city = 5000;
constexpr std::size_t count = 65536;

struct World {
  std::vector<WorldBox> boxes;
  std::vector<WorldSphere> spheres;
};

World make_world() {
  Random random(11);
  World world;
  for (std::size_t i = 0; i != count; ++i) {
    WorldBox box;
    WorldVec3 centre;
    for (std::size_t k = 0; k != 3; ++k) {
      const auto half = static_cast<double>(random.uniform(0.1F, 20.0F));
      centre[k] = city[k] + half_city * static_cast<double>(random.uniform(-1.0F, 1.0F));
      box.lo[k] = centre[k] - half;
      box.hi[k] = centre[k] + half;
    }
    world.boxes.push_back(box);
    world.spheres.push_back({centre, static_cast<double>(random.uniform(0.1F, 20.0F))});
  }
  return world;
}

void cast(std::span<const WorldBox> boxes, std::span<Box> to) {
  for (std::size_t i = 0; i != boxes.size(); ++i) {
    for (std::size_t k = 0; k != 3; ++k) {
      to[i].lo[k] = static_cast<float>(boxes[i].lo[k] - city[k]);
      to[i].hi[k] = static_cast<float>(boxes[i].hi[k] - city[k]);
    }
  }
}

}  // namespace

void declare_origin(Suite& suite, const Workload& /*workload*/) {
  const auto world = std::make_shared<World>();
  const auto add = [&](const std::string& name, const std::function<void(const Origin&, std::span<Box>)>& convert) {
    suite.add("origin/" + name, "", [=](benchmark::State& state) {
      if (world->boxes.empty()) *world = make_world();
      const Origin origin(city);
      std::vector<Box> to(count);
      for (auto _ : state) {
        convert(origin, to);
        benchmark::ClobberMemory();
      }
      state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
    });
  };
  add("boxes_around", [world](const Origin& origin, std::span<Box> to) { origin.around(world->boxes, to); });
  add("boxes_within", [world](const Origin& origin, std::span<Box> to) { origin.within(world->boxes, to); });
  add("boxes_cast", [world](const Origin&, std::span<Box> to) { cast(world->boxes, to); });
  suite.add("origin/spheres_around", "", [=](benchmark::State& state) {
    if (world->boxes.empty()) *world = make_world();
    const Origin origin(city);
    std::vector<Sphere> to(count);
    for (auto _ : state) {
      origin.around(world->spheres, to);
      benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
  });
}

}  // namespace shaftcull::bench
