// SPDX-License-Identifier: MIT
/// exact/…: what exact answers cost, on AVX2, against the same kernel without its filter.
///
/// Each setting is measured twice on the same bounds and shafts, in tiles that stay in the L1 cache:
/// exact/SETTING/exact as the library ships it, exact/SETTING/unfiltered believes rounded arithmetic.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/suite.hpp"
#include "peers/unfiltered.hpp"
#include "scenes/random.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull::bench {
namespace {

constexpr std::size_t bounds = 16384;
constexpr std::size_t shafts = 64;
constexpr std::size_t tile = 1024;

/// Bounds and shafts of one setting.
struct Setting {
  BoxStream boxes;
  std::vector<CompiledShaft> compiled;
  std::vector<std::uint64_t> kept = std::vector<std::uint64_t>(shafts * bit_words(bounds));
};

/// `bound` and `pair` make one box and one pair of object boxes.
template <class Bound, class Pair>
std::shared_ptr<Setting> make(std::uint32_t seed, Bound bound, Pair pair) {
  Random random(seed);
  auto setting = std::make_shared<Setting>();
  std::vector<Box> boxes(bounds);
  for (Box& box : boxes) box = bound(random);
  setting->boxes = BoxStream(std::span<const Box>(boxes));
  for (std::size_t s = 0; s < shafts; ++s) {
    const auto [a, b] = pair(random);
    setting->compiled.push_back(compile(a, b));
  }
  return setting;
}

/// A box with integer corners in 0 … 32 and sides of up to `side`.
Box grid_box(Random& random, unsigned side) {
  Box box{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const unsigned lo = random.below(33);
    box.lo[axis] = static_cast<float>(lo);
    box.hi[axis] = static_cast<float>(std::min(lo + random.below(side + 1), 32U));
  }
  return box;
}

Box moved(Box box, float offset) {
  for (float& x : box.lo) x += offset;
  for (float& x : box.hi) x += offset;
  return box;
}

/// A pair that is far apart on the x axis, and equal but for a hundred-thousandth on the others.
std::pair<Box, Box> nearly_coincident(Random& random) {
  const Box a = random.box(0.2F, 1.0F);
  Box b = a;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    b.lo[axis] *= 1 + random.uniform(-1e-5F, 1e-5F);
    b.hi[axis] = std::max(b.lo[axis], b.hi[axis] * (1 + random.uniform(-1e-5F, 1e-5F)));
  }
  const float step = a.lo[0] < 0 ? 4.0F : -4.0F;
  b.lo[0] += step;
  b.hi[0] += step;
  return {a, b};
}

void declare_setting(Suite& suite, const std::string& name, const std::shared_ptr<Setting>& setting, double ratio) {
  constexpr auto items = static_cast<std::int64_t>(bounds * shafts);
  suite.add("exact/" + name + "/exact", "", [setting](benchmark::State& state) {
    select_isa(Isa::avx2);
    for (auto _ : state) cull_many(setting->compiled, setting->boxes.view(), setting->kept);
    state.SetItemsProcessed(state.iterations() * items);
  });
  suite.add("exact/" + name + "/unfiltered", "", [setting](benchmark::State& state) {
    for (auto _ : state) {
      for (std::size_t first = 0; first < bounds; first += tile) {
        const BoxView part = setting->boxes.view().slice(first, tile);
        for (std::size_t s = 0; s < shafts; ++s) {
          cull_unfiltered_avx2(setting->compiled[s], part, tile / 64,
                               &setting->kept[s * bit_words(bounds) + first / 64]);
        }
      }
      benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * items);
  });
  suite.add_target("exact/" + name + "/exact", "exact/" + name + "/unfiltered", ratio);
}

}  // namespace

void declare_exact(Suite& suite, const Workload& /*workload*/) {
  const std::vector<Isa> available = available_isas();
  if (std::find(available.begin(), available.end(), Isa::avx2) == available.end()) {
    suite.note("exact/… is not measured: this machine does not have avx2");
    return;
  }

  const auto small = [](Random& random) { return random.box(0.01F, 0.11F); };
  const auto object = [](Random& random) { return random.box(0.2F, 1.0F); };
  declare_setting(suite, "uniform",
                  make(3000, small, [&](Random& random) { return std::pair(object(random), object(random)); }), 0.8);
  declare_setting(suite, "grid",
                  make(
                      3001, [](Random& random) { return grid_box(random, 3); },
                      [](Random& random) { return std::pair(grid_box(random, 6), grid_box(random, 6)); }),
                  0.3);
  declare_setting(suite, "coincident", make(3002, small, nearly_coincident), 0.4);
  declare_setting(
      suite, "far",
      make(
          3003, [&](Random& random) { return moved(small(random), 1e6F); },
          [&](Random& random) { return std::pair(moved(object(random), 1e6F), moved(object(random), 1e6F)); }),
      0.4);
}

}  // namespace shaftcull::bench
