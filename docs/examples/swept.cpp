// Bodies move through a scene for one frame. What does each hit first, and when? There it
// stops.
#include <array>
#include <cstdio>
#include <shaftcull/shaftcull.hpp>
#include <vector>

namespace sc = shaftcull;

int main() {
  // Ten pillars and two bodies. Bodies are in the tree, too, since they may hit each other.
  std::vector<sc::Box> boxes;
  for (int i = 0; i != 10; ++i) {
    const float x = 4 * static_cast<float>(i);
    boxes.push_back({{x, 0, 0}, {x + 1, 5, 1}});
  }
  const std::array<std::uint32_t, 2> moving = {10, 11};
  boxes.push_back({{-3, 1, 0}, {-2, 2, 1}});
  boxes.push_back({{9, 8, 0}, {10, 9, 1}});
  const std::array<sc::Vec3, 2> travel = {{{10, 0, 0}, {0, 2, 0}}};
  const sc::BoxTree tree(boxes);

  // Every frame a shaft for each body. It leaves out the body itself.
  std::vector<sc::Box> bodies;
  for (const std::uint32_t index : moving) bodies.push_back(boxes[index]);
  std::vector<sc::CompiledShaft> shafts(bodies.size());
  sc::swept_batch(sc::BoxStream(bodies), travel, shafts);
  std::vector<sc::FirstContact> contacts(shafts.size());
  sc::first_contact_many(shafts, tree, contacts, {.exclude_each = moving});

  for (std::size_t i = 0; i != moving.size(); ++i) {
    if (contacts[i]) {
      std::printf("body %u hits box %u after %.2f of its way\n", moving[i], contacts[i].index,
                  contacts[i].time);
    } else {
      std::printf("body %u hits nothing\n", moving[i]);
    }
  }

  // All that a body would meet if it went on, and when.
  std::vector<std::uint32_t> met;
  list(shafts[0], tree, met, {.exclude = {moving[0]}});
  std::vector<float> times(met.size());
  entry_times(shafts[0], tree, met, times);
  for (std::size_t i = 0; i != met.size(); ++i) {
    std::printf("  box %u at %.2f\n", met[i], times[i]);
  }
}
