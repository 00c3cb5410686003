// SPDX-License-Identifier: MIT
/// origin/…: bounds of a world in doubles become floats relative to an origin. An item is a bound. `boxes_cast`
/// converts the same boxes by subtraction and a cast: floats nearest to the coordinates, so parts of a box may lie
/// outside its float box.
#include <cstddef>
#include <cstdint>
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
  const auto add = [&]<class To>(const std::string& name, void (*convert)(const Origin&, const World&, std::span<To>)) {
    suite.add("origin/" + name, "", [=](benchmark::State& state) {
      if (world->boxes.empty()) *world = make_world();
      const Origin origin(city);
      std::vector<To> to(count);
      for (auto _ : state) {
        convert(origin, *world, to);
        benchmark::ClobberMemory();
      }
      state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
    });
  };
  add.operator()<Box>("boxes_around", [](auto& origin, auto& from, auto to) { origin.around(from.boxes, to); });
  add.operator()<Box>("boxes_within", [](auto& origin, auto& from, auto to) { origin.within(from.boxes, to); });
  add.operator()<Box>("boxes_cast", [](auto&, auto& from, auto to) { cast(from.boxes, to); });
  add.operator()<Sphere>("spheres_around", [](auto& origin, auto& from, auto to) { origin.around(from.spheres, to); });
}

}  // namespace shaftcull::bench
