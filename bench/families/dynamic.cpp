// SPDX-License-Identifier: MIT
/// dynamic/…: frames of bounds that come, go and move, by a dynamic tree, a new tree per frame, and the trees of
/// Bullet, FCL and Boost; and what queries cost after many such frames.
///
/// A frame of dynamic/S/frame replaces one bound in a hundred by bounds elsewhere, moves as many others by a tenth of
/// their size, and commits. dynamic/S/ten replaces ten and moves ten others; dynamic/S/ten_moved moves ten.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "harness/suite.hpp"
#include "harness/threads.hpp"
#include "scenes/random.hpp"
#include "scenes/swept_boxes.hpp"
#include "scenes/tree_scene.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/many.hpp"

#ifdef SHAFTCULL_BENCH_WITH_BULLET
#include "peers/bullet.hpp"
#endif
#ifdef SHAFTCULL_BENCH_WITH_BOOST
#include "peers/boost_tree.hpp"
#endif
#ifdef SHAFTCULL_BENCH_WITH_FCL
#include "peers/fcl.hpp"
#endif

namespace shaftcull::bench {
namespace {

/// What one frame does: boxes are replaced by others, and others move.
struct FrameChanges {
  std::vector<std::uint32_t> replaced;  ///< each once
  std::vector<Box> replaced_before;
  std::vector<Box> by;
  std::vector<std::uint32_t> moved;  ///< others
  std::vector<Box> moved_before;
  std::vector<Vec3> displacement;
};

/// How many bounds each frame changes.
struct FrameSize {
  std::size_t replaced;
  std::size_t moved;
};

/// Boxes, and changes of a frame after the other.
class Crowd {
 public:
  explicit Crowd(std::size_t count) : boxes(small_boxes(count)), used_(count), random_(4200) {}

  FrameChanges next(FrameSize size) {
    const float scale = std::cbrt(1e6F / static_cast<float>(boxes.size()));
    FrameChanges frame;
    const auto unused = [&] {
      for (;;) {
        const auto i = static_cast<std::uint32_t>(random_.uniform(0, static_cast<float>(boxes.size())));
        if (i < boxes.size() && used_[i] != frame_) {
          used_[i] = frame_;
          return i;
        }
      }
    };
    ++frame_;
    for (std::size_t c = 0; c != size.replaced; ++c) {
      frame.replaced.push_back(unused());
      frame.replaced_before.push_back(boxes[frame.replaced.back()]);
      frame.by.push_back(random_.box(0.005F * scale, 0.035F * scale));
      boxes[frame.replaced.back()] = frame.by.back();
    }
    for (std::size_t c = 0; c != size.moved; ++c) {
      frame.moved.push_back(unused());
      const float step = 0.002F * scale;
      frame.displacement.push_back(
          {random_.uniform(-step, step), random_.uniform(-step, step), random_.uniform(-step, step)});
      Box& box = boxes[frame.moved.back()];
      frame.moved_before.push_back(box);
      for (std::size_t k = 0; k != 3; ++k) {
        box.lo[k] += frame.displacement.back()[k];
        box.hi[k] += frame.displacement.back()[k];
      }
    }
    return frame;
  }

  std::vector<Box> boxes;

 private:
  std::vector<std::uint32_t> used_;
  Random random_;
  std::uint32_t frame_ = 0;
};

/// The dynamic tree of a crowd, by its indices.
class DynamicCrowd {
 public:
  explicit DynamicCrowd(std::span<const Box> boxes) : ids_(boxes.size()) {
    tree.insert(boxes, ids_);
    tree.commit();
  }
  void make(const FrameChanges& frame) {
    const std::vector<BoundId> gone = ids_of(frame.replaced);
    const std::vector<BoundId> moved = ids_of(frame.moved);
    come_.resize(gone.size());
    tree.erase(gone);
    tree.insert(frame.by, come_);
    tree.move_by(moved, frame.displacement);
    tree.commit();
    for (std::size_t i = 0; i != come_.size(); ++i) ids_[frame.replaced[i]] = come_[i];
  }
  /// Inserts boxes, so many before each commit.
  void stream_in(std::span<const Box> boxes, std::size_t each) {
    for (std::size_t first = 0; first < boxes.size(); first += each) {
      const std::size_t size = std::min(each, boxes.size() - first);
      come_.resize(size);
      tree.insert(boxes.subspan(first, size), come_);
      tree.commit();
    }
  }
  DynamicBoxTree tree;

 private:
  [[nodiscard]] std::vector<BoundId> ids_of(const std::vector<std::uint32_t>& indices) const {
    std::vector<BoundId> ids;
    for (const std::uint32_t i : indices) ids.push_back(ids_[i]);
    return ids;
  }
  std::vector<BoundId> ids_;
  std::vector<BoundId> come_;
};

/// Makes frames, without the time that it takes to think of them.
template <class Make>
void run_frames(benchmark::State& state, std::size_t count, FrameSize changes, const Make& make) {
  select_isa(available_isas().back());
  Crowd crowd(count);
  auto scene = make(crowd.boxes);
  for (auto _ : state) {
    state.PauseTiming();
    const FrameChanges frame = crowd.next(changes);
    state.ResumeTiming();
    scene(crowd.boxes, frame);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations());
}

void add_frames(Suite& suite, const std::string& name, std::size_t count, FrameSize changes,
                const RunOptions& options) {
  suite.add(
      name, "",
      [=](benchmark::State& state) {
        run_frames(state, count, changes, [](std::span<const Box> boxes) {
          return [tree = std::make_shared<DynamicCrowd>(boxes)](const auto&, const FrameChanges& frame) {
            tree->make(frame);
          };
        });
      },
      options);
}

/// Frames by a tree that replaces and moves single boxes.
template <class Tree>
void add_peer(Suite& suite, const std::string& name, std::size_t count, FrameSize changes, const RunOptions& options) {
  suite.add(
      name, "",
      [=](benchmark::State& state) {
        run_frames(state, count, changes, [](std::span<const Box> boxes) {
          return [tree = std::make_shared<Tree>(boxes)](const auto& after, const FrameChanges& frame) {
            for (const std::uint32_t i : frame.replaced) tree->replace(i, after[i]);
            for (const std::uint32_t i : frame.moved) tree->move(i, after[i]);
            tree->end_frame();
          };
        });
      },
      options);
}

void add_peers(Suite& suite, const std::string& name, std::size_t count, FrameSize changes, const RunOptions& options) {
#ifdef SHAFTCULL_BENCH_WITH_BULLET
  add_peer<BulletTree>(suite, name + "_bullet", count, changes, options);
#endif
#ifdef SHAFTCULL_BENCH_WITH_FCL
  add_peer<FclTree>(suite, name + "_fcl", count, changes, options);
#endif
#ifdef SHAFTCULL_BENCH_WITH_BOOST
  suite.add(
      name + "_boost", "",
      [=](benchmark::State& state) {
        run_frames(state, count, changes, [](std::span<const Box> boxes) {
          return [tree = std::make_shared<BoostTree>(boxes)](const auto& after, const FrameChanges& frame) {
            for (std::size_t i = 0; i != frame.replaced.size(); ++i) {
              tree->replace(frame.replaced[i], frame.replaced_before[i], after[frame.replaced[i]]);
            }
            for (std::size_t i = 0; i != frame.moved.size(); ++i) {
              tree->replace(frame.moved[i], frame.moved_before[i], after[frame.moved[i]]);
            }
          };
        });
      },
      options);
#endif
}

/// Boxes that all move there and back, frame by frame: by a dynamic tree, and by one that is updated.
template <class Move>
void run_all_moving(benchmark::State& state, std::size_t count, const Move& move) {
  select_isa(available_isas().back());
  std::vector<Box> boxes[2] = {small_boxes(count), {}};
  boxes[1] = boxes[0];
  Random random(4201);
  const float step = 0.002F * std::cbrt(1e6F / static_cast<float>(count));
  for (Box& box : boxes[1]) {
    for (std::size_t k = 0; k != 3; ++k) {
      const float by = random.uniform(-step, step);
      box.lo[k] += by;
      box.hi[k] += by;
    }
  }
  auto scene = move(boxes[0]);
  std::size_t time = 0;
  for (auto _ : state) {
    time = 1 - time;
    scene(boxes[time]);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations());
}

void add_all_moving(Suite& suite, const std::string& name, std::size_t count, const RunOptions& options) {
  suite.add(
      name, "",
      [=](benchmark::State& state) {
        run_all_moving(state, count, [](std::span<const Box> first) {
          const auto tree = std::make_shared<DynamicBoxTree>();
          std::vector<BoundId> ids(first.size());
          tree->insert(first, ids);
          tree->commit();
          return [tree, ids = std::move(ids)](std::span<const Box> boxes) {
            tree->move(ids, boxes);
            tree->commit();
          };
        });
      },
      options);
  suite.add(
      name + "_box_tree", "",
      [=](benchmark::State& state) {
        run_all_moving(state, count, [](std::span<const Box> first) {
          return [tree = std::make_shared<BoxTree>(first)](std::span<const Box> boxes) { tree->update(boxes); };
        });
      },
      options);
}

/// Lists of swept boxes, of a dynamic tree that has seen many frames, and of new trees of the same boxes.
class AfterFrames {
 public:
  enum class Tree { used, rebuilt, fresh };

  /// `streamed`: the frames insert the boxes, a hundredth each; otherwise they replace and move some.
  AfterFrames(std::size_t count, std::size_t frames, bool streamed)
      : count_(count), frames_(frames), streamed_(streamed) {}

  void query(benchmark::State& state, const SweptSetting& setting, Tree tree) {
    select_isa(available_isas().back());
    Scene& scene = scene_.get([&] { return Scene(count_, frames_, streamed_); });
    const SweptBoxes swept(queries, setting, std::cbrt(1e6F / static_cast<float>(count_)));
    std::vector<CompiledShaft> shafts(queries);
    compile_batch(swept.from.view(), swept.to.view(), shafts);
    std::vector<std::uint32_t> hits(count_ + count_ / 8);
    const Bounds bounds = tree == Tree::used      ? Bounds(scene.used.tree)
                          : tree == Tree::rebuilt ? Bounds(scene.rebuilt.tree)
                                                  : Bounds(scene.fresh);
    for (auto _ : state) {
      for (const CompiledShaft& shaft : shafts) benchmark::DoNotOptimize(list(shaft, bounds, std::span(hits)));
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(queries));
  }

 private:
  static constexpr std::size_t queries = 1024;
  struct Scene {
    Scene(std::size_t count, std::size_t frames, bool streamed)
        : crowd(count), used(streamed ? std::span<const Box>() : std::span<const Box>(crowd.boxes)) {
      if (streamed) used.stream_in(crowd.boxes, count / 100 + 1);
      for (std::size_t f = 0; f != frames && !streamed; ++f) used.make(crowd.next({count / 100, count / 100}));
      fresh = BoxTree{std::span<const Box>(crowd.boxes)};
      if (!streamed) rebuilt = DynamicCrowd(crowd.boxes);
    }
    Crowd crowd;
    DynamicCrowd used;
    DynamicCrowd rebuilt{{}};
    BoxTree fresh;
  };
  std::size_t count_;
  std::size_t frames_;
  bool streamed_;
  Lazy<Scene> scene_;
};

}  // namespace

void declare_dynamic(Suite& suite, const Workload& /*workload*/) {
  const RunOptions alone{.wall_clock = true, .brief = true};
  const RunOptions two{.threads = std::min(2U, all_threads()), .wall_clock = true, .brief = true};
  std::vector<std::pair<std::string, std::size_t>> sizes{{"64k", std::size_t{1} << 16}};
  if (!suite.quick()) sizes.emplace_back("1m", 1000000);
  for (const auto& [size, count] : sizes) {
    const std::string name = "dynamic/" + size + "/";
    const FrameSize hundredth{count / 100, count / 100};
    const FrameSize ten{10, 10};
    const FrameSize ten_moved{0, 10};
    add_frames(suite, name + "frame", count, hundredth, alone);
    add_frames(suite, name + "frame_two_threads", count, hundredth, two);
    add_frames(suite, name + "ten", count, ten, alone);
    add_frames(suite, name + "ten_moved", count, ten_moved, alone);
    add_peers(suite, name + "frame", count, hundredth, alone);
    add_peers(suite, name + "ten", count, ten, alone);
    add_peers(suite, name + "ten_moved", count, ten_moved, alone);
    suite.add(
        name + "new_tree", "",
        [count = count, hundredth](benchmark::State& state) {
          run_frames(state, count, hundredth, [](std::span<const Box> boxes) {
            return [tree = std::make_shared<BoxTree>(boxes)](const auto& after, const FrameChanges&) {
              *tree = BoxTree{std::span<const Box>(after)};
            };
          });
        },
        alone);
    suite.add_target(name + "frame", name + "new_tree", 3);
    add_all_moving(suite, name + "all", count, alone);
    for (const bool streamed : {false, true}) {
      const auto after = std::make_shared<AfterFrames>(count, suite.quick() ? 50 : 300, streamed);
      for (const SweptSetting& setting : swept_settings) {
        const std::string query = name + (streamed ? "streamed/" : "query/") + setting.name;
        const auto add = [&](const char* suffix, AfterFrames::Tree tree) {
          suite.add(query + suffix, "", [=](benchmark::State& state) { after->query(state, setting, tree); },
                    {.brief = true});
        };
        add("", AfterFrames::Tree::used);
        add("_fresh", AfterFrames::Tree::fresh);
        if (streamed) continue;
        add("_rebuilt", AfterFrames::Tree::rebuilt);
        suite.add_time_ratio_target(query, query + "_fresh", 1.3);
      }
    }
  }
}

}  // namespace shaftcull::bench
