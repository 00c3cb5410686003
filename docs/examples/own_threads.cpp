// Your own threads in the place of oneTBB's: each thread asks about a chunk of the bounds.
#include <algorithm>
#include <cstdio>
#include <shaftcull/shaftcull.hpp>
#include <thread>
#include <vector>

namespace sc = shaftcull;

int main() {
  std::vector<sc::Box> scene;
  for (int i = 0; i != 100'000; ++i) {
    const float x = static_cast<float>(i);
    scene.push_back({{x / 256, x / 512, 0}, {x / 256 + 1, x / 512 + 1, 1}});
  }
  const sc::BoxStream boxes(scene);
  std::vector<sc::CompiledShaft> shafts;
  for (int s = 0; s != 8; ++s) {
    const float x = 40 * static_cast<float>(s);
    shafts.push_back(sc::compile(sc::Box{{x, 0, 0}, {x + 2, 2, 1}},
                                 sc::Box{{300 - x, 300, 0}, {302 - x, 302, 1}}));
  }

  // A row of words for each shaft. Chunks begin at multiples of 64 bounds, so that no two
  // threads write the same word.
  const std::size_t row = sc::bit_words(boxes.size());
  std::vector<std::uint64_t> kept(shafts.size() * row);
  const std::size_t threads = 4;
  const std::size_t chunk = (row + threads - 1) / threads * 64;
  std::vector<std::thread> crew;
  for (std::size_t first = 0; first < boxes.size(); first += chunk) {
    crew.emplace_back([&, first] {
      const sc::BoxView part = boxes.view().slice(first, std::min(chunk, boxes.size() - first));
      for (std::size_t s = 0; s != shafts.size(); ++s) {
        cull(shafts[s], part,
             std::span(kept).subspan(s * row + first / 64, sc::bit_words(part.count)));
      }
    });
  }
  for (std::thread& each : crew) each.join();

  // The same bits as one call gives, however work is shared.
  std::vector<std::uint64_t> at_once(kept.size());
  sc::cull_many(shafts, boxes, at_once);
  std::printf("%zu threads: %s\n", crew.size(),
              kept == at_once ? "the same bits" : "other bits");
}
