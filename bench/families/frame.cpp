// SPDX-License-Identifier: MIT
/// frame/…: all boxes move, then shafts are asked: with a tree, which is updated and refitted, and with a flat scan.
///
/// The boxes' user keeps them in tree order, as it was when the tree was built (frame/S/tree), or in an order that has
/// nothing to do with where they are (frame/S/tree_shuffled).
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "harness/suite.hpp"
#include "harness/threads.hpp"
#include "scenes/swept_boxes.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/tree.hpp"

namespace shaftcull::bench {
namespace {

/// Boxes at two times, between which they shake by a tenth of their size.
struct Frames {
  explicit Frames(std::size_t count) : shuffled{small_boxes(count), {}} {
    shuffled[1] = shuffled[0];
    Random random(4100);
    for (Box& box : shuffled[1]) {
      for (std::size_t k = 0; k != 3; ++k) {
        const float step = random.uniform(-0.002F, 0.002F);
        box.lo[k] += step;
        box.hi[k] += step;
      }
    }
    const BoxTree tree{std::span<const Box>(shuffled[0])};
    for (std::size_t t = 0; t != 2; ++t) {
      for (const std::uint32_t i : tree.order()) sorted[t].push_back(shuffled[t][i]);
    }
  }
  std::vector<Box> shuffled[2];
  std::vector<Box> sorted[2];
};

class Frame {
 public:
  Frame(const std::shared_ptr<std::unique_ptr<Frames>>& frames, std::size_t bounds, std::size_t shafts)
      : frames_(frames),
        bounds_(bounds),
        swept_(shafts, swept_settings[1], std::cbrt(1e6F / static_cast<float>(bounds))) {}

  void with_tree(benchmark::State& state, bool sorted) const {
    const auto& boxes = sorted ? frames().sorted : frames().shuffled;
    BoxTree tree{std::span<const Box>(boxes[0])};
    run(state, tree, [&](std::size_t time) { tree.update(std::span<const Box>(boxes[time])); });
  }
  void with_flat_scan(benchmark::State& state) const {
    const auto& boxes = frames().shuffled;
    BoxStream stream{std::span<const Box>(boxes[0])};
    run(state, stream, [&](std::size_t time) {
      for_chunks(bounds_, std::size_t{1} << 14, [&](std::size_t first, std::size_t size) {
        stream.update(first, std::span<const Box>(boxes[time]).subspan(first, size));
      });
    });
  }

 private:
  const Frames& frames() const {
    if (!*frames_) *frames_ = std::make_unique<Frames>(bounds_);
    return **frames_;
  }

  template <class Move>
  void run(benchmark::State& state, const Bounds& bounds, const Move& move) const {
    select_isa(available_isas().back());
    std::vector<CompiledShaft> shafts(swept_.from.size());
    std::vector<std::uint64_t> counts(shafts.size());
    std::size_t time = 0;
    for (auto _ : state) {
      time = 1 - time;
      move(time);
      compile_batch(swept_.from.view(), swept_.to.view(), shafts);
      count_many(shafts, bounds, counts);
      benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations());
  }

  std::shared_ptr<std::unique_ptr<Frames>> frames_;
  std::size_t bounds_;
  SweptBoxes swept_;
};

}  // namespace

void declare_frame(Suite& suite, const Workload& workload) {
  const auto frames = std::make_shared<std::unique_ptr<Frames>>();
  const RunOptions options{.threads = std::min(2U, all_threads()), .wall_clock = true, .brief = true};
  for (const std::size_t shafts : {64U, 1024U}) {
    const auto frame = std::make_shared<const Frame>(frames, workload.boxes.size(), shafts);
    const std::string name = fmt::format("frame/{}/", shafts);
    suite.add(
        name + "tree", "", [=](benchmark::State& state) { frame->with_tree(state, true); }, options);
    suite.add(
        name + "tree_shuffled", "", [=](benchmark::State& state) { frame->with_tree(state, false); }, options);
    suite.add(
        name + "flat", "", [=](benchmark::State& state) { frame->with_flat_scan(state); }, options);
    suite.add_target(name + "tree", name + "flat", shafts == 64 ? 1.5 : 8.0);
  }
}

}  // namespace shaftcull::bench
