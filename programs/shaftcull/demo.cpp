// SPDX-License-Identifier: MIT
/// `shaftcull demo`: millions of bounds that move, culled against moving shafts in every frame.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "city.hpp"
#include "crowd.hpp"
#include "instruction_set.hpp"
#include "interrupt.hpp"
#include "moving_scene.hpp"
#include "number.hpp"
#include "progress.hpp"
#include "rooms.hpp"
#include "sees.hpp"
#include "shaftcull/shaftcull.hpp"
#include "sphereflake.hpp"
#include "subcommand.hpp"
#include "table.hpp"
#include "workers.hpp"

namespace shaftcull::cli {
namespace {

struct DemoOptions {
  std::string scene = "all";
  std::size_t bounds = 0;  ///< 0: as many as the scene has
  std::size_t shafts = 64;
  std::size_t frames = 100;
  double seconds = 6;  ///< a scene; 0: no limit
  int threads = 0;
  InstructionSet isa;
};

/// Each scene is shown with its bounds in streams, which are scanned, in a tree, and in two.
constexpr int ways = 3;
/// Rooms whose patches are asked what they see.
constexpr std::size_t most_demo_rooms = 9;
/// A median needs a few frames, however slow they are.
constexpr std::size_t fewest_frames = 3;

/// Milliseconds that a frame and its parts took.
struct FrameTime {
  double total;
  double move;
  double cull;
};

struct SceneResult {
  std::vector<FrameTime> frames;
  std::uint64_t kept = 0;  ///< over all frames and shafts
};

double milliseconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double tests(const MovingScene& scene, std::size_t shafts) {
  return static_cast<double>(scene.bounds()) * static_cast<double>(shafts);
}

double time_of(std::size_t frame) { return static_cast<double>(frame) / frames_per_second; }

/// Runs the frames of one scene. Everything that a frame needs is allocated before the first.
class FrameLoop {
 public:
  FrameLoop(MovingScene& scene, std::size_t shafts)
      : scene_(scene),
        ends_a_(shafts),
        ends_b_(shafts),
        stream_a_(shafts),
        stream_b_(shafts),
        shafts_(shafts),
        kept_(shafts) {}
  virtual ~FrameLoop() = default;
  FrameLoop(const FrameLoop&) = delete;
  FrameLoop& operator=(const FrameLoop&) = delete;

  virtual FrameTime run_frame(std::size_t number) {
    const double move = move_to(number);
    const double cull = ask_about(number);
    return {move + cull, move, cull};
  }

  /// What all shafts kept in the last frame.
  [[nodiscard]] std::uint64_t kept() const { return std::accumulate(kept_.begin(), kept_.end(), std::uint64_t{0}); }

 protected:
  /// Both return the milliseconds that they took.
  double move_to(std::size_t frame) {
    const auto begin = std::chrono::steady_clock::now();
    scene_.move_to(time_of(frame));
    return milliseconds_since(begin);
  }
  double ask_about(std::size_t frame) {
    const auto begin = std::chrono::steady_clock::now();
    scene_.place_shafts(time_of(frame), ends_a_, ends_b_);
    stream_a_.update(0, ends_a_);
    stream_b_.update(0, ends_b_);
    compile_batch(stream_a_.view(), stream_b_.view(), shafts_);
    count_many(shafts_, scene_.asked(), kept_);
    return milliseconds_since(begin);
  }
  MovingScene& scene() noexcept { return scene_; }

 private:
  MovingScene& scene_;
  std::vector<Box> ends_a_;
  std::vector<Box> ends_b_;
  BoxStream stream_a_;
  BoxStream stream_b_;
  std::vector<CompiledShaft> shafts_;
  std::vector<std::uint64_t> kept_;
};

/// Asks about a frame while the next one is made: nothing waits, and answers come a frame later.
class OverlappedFrameLoop final : public FrameLoop {
 public:
  using FrameLoop::FrameLoop;

  /// Numbers follow each other; the first call also makes the frame that it asks about.
  FrameTime run_frame(std::size_t number) override {
    const auto begin = std::chrono::steady_clock::now();
    FrameTime time{};
    if (made_ != number) make(number);
    Workers::do_both([&] { time.cull = ask_about(number); }, [&] { time.move = move_to(number + 1); });
    scene().swap_trees();
    made_ = number + 1;
    time.total = milliseconds_since(begin);
    return time;
  }

 private:
  void make(std::size_t frame) {
    move_to(frame);
    scene().swap_trees();
  }

  std::optional<std::size_t> made_;  ///< the frame that can be asked about
};

/// What tells the user how far a run is, and what lets him end it.
struct Console {
  Progress progress;
  InterruptWatch interrupt;
};

/// At least one frame, even if there is an interrupt, so that there is something to show.
SceneResult run_frames(FrameLoop& loop, const MovingScene& scene, const DemoOptions& options, Console& console) {
  // The first frame meets cold caches and threads that are not started yet; it is not counted.
  loop.run_frame(0);
  SceneResult result;
  const auto begin = std::chrono::steady_clock::now();
  for (std::size_t frame = 1; frame <= options.frames; ++frame) {
    const double seconds = milliseconds_since(begin) / 1000;
    if (options.seconds > 0 && seconds > options.seconds / ways && frame > fewest_frames) break;
    const FrameTime time = loop.run_frame(frame);
    result.frames.push_back(time);
    result.kept += loop.kept();
    console.progress.update(
        fmt::format("{}: frame {} of {}, {:.1f} s: move {:.1f} ms, cull {:.1f} ms, {}tests/s, {} kept", scene.name(),
                    frame, options.frames, seconds, time.move, time.cull,
                    prefixed(tests(scene, options.shafts) / (time.cull / 1000)), grouped(loop.kept())));
    if (console.interrupt.signal() != 0) break;
  }
  return result;
}

void add_row(Table& table, const MovingScene& scene, const SceneResult& result, const DemoOptions& options, int threads,
             const char* way) {
  std::vector<double> total;
  std::vector<double> move;
  std::vector<double> cull;
  for (const FrameTime& frame : result.frames) {
    total.push_back(frame.total);
    move.push_back(frame.move);
    cull.push_back(frame.cull);
  }
  const double all_tests = tests(scene, options.shafts) * static_cast<double>(result.frames.size());
  const double cull_seconds = std::accumulate(cull.begin(), cull.end(), 0.0) / 1000;
  table.add_row({std::string(scene.name()), fmt::format("{}", result.frames.size()), grouped(scene.bounds()),
                 fmt::format("{}", options.shafts), fmt::format("{:.2f}", median(total)),
                 fmt::format("{:.2f}", *std::max_element(total.begin(), total.end())),
                 fmt::format("{:.2f}", median(move)), fmt::format("{:.2f}", median(cull)),
                 prefixed(all_tests / cull_seconds), grouped(result.kept / result.frames.size()),
                 fmt::format("{:.3f} %", 100 * static_cast<double>(result.kept) / all_tests),
                 std::string(name(active_isa())), fmt::format("{}", threads), way});
}

std::unique_ptr<MovingScene> make_scene(std::string_view name, std::size_t bounds) {
  if (name == "city") return std::make_unique<City>(bounds > 0 ? bounds : City::full_size);
  if (name == "crowd") return std::make_unique<Crowd>(bounds > 0 ? bounds : Crowd::full_size);
  return std::make_unique<Sphereflake>(bounds > 0 ? bounds : Sphereflake::full_size);
}

/// Runs a scene's frames with its bounds in streams, and then as many in a tree and in two, whose answers must be the
/// same. An interrupt ends it after any frame.
void show(MovingScene& scene, const DemoOptions& options, Table& table, Console& console) {
  FrameLoop loop(scene, options.shafts);
  const SceneResult scanned = run_frames(loop, scene, options, console);
  add_row(table, scene, scanned, options, concurrency(), "streams");

  DemoOptions as_many = options;
  as_many.frames = scanned.frames.size();
  as_many.seconds = 0;
  const auto show_trees = [&](FrameLoop& trees, const char* way) {
    const SceneResult walked = run_frames(trees, scene, as_many, console);
    add_row(table, scene, walked, options, concurrency(), way);
    if (walked.frames.size() == scanned.frames.size() && walked.kept != scanned.kept)
      throw std::logic_error(fmt::format("{}: the {} and the scan differ", scene.name(), way));
  };
  if (console.interrupt.signal() != 0) return;
  const auto begin = std::chrono::steady_clock::now();
  scene.use_tree();
  console.progress.milestone(
      fmt::format("{}: the same bounds in a tree, built in {:.1f} s", scene.name(), milliseconds_since(begin) / 1000));
  show_trees(loop, "tree");
  if (console.interrupt.signal() != 0) return;
  scene.use_second_tree();
  console.progress.milestone(
      fmt::format("{}: and in two trees, one queried while the other is updated for the next frame", scene.name()));
  OverlappedFrameLoop overlapped(scene, options.shafts);
  show_trees(overlapped, "2 trees");
}

void print_table(const Table& table) {
  fmt::print("{}", table.text());
  fmt::print(
      "\nms/frame and its parts move and cull are medians. move: bodies move, and their bounds are\n"
      "updated in place. cull: shafts are formed, and bounds are tested.\n"
      "tests/s: bounds x shafts per second of cull; bounds that are answered without a test\n"
      "count, too. kept: bounds that the shafts do not cull.\n"
      "bounds in streams: every bound is tested. In a tree: only bounds near the shafts are\n"
      "tested, and moving refits the nodes.\n"
      "In 2 trees: one is queried while the other is updated for the next frame. The two parts of\n"
      "a frame run at the same time, and answers come one frame later.\n"
      "In the crowd, 1 % of the bodies disappear, 1 % appear, and 1 % move in each frame. Its\n"
      "tree is a dynamic tree, and the second tree is a snapshot of it.\n");
}

/// Tells which patches of some rooms see each other.
void show_rooms(const DemoOptions& options, const Workers& workers, Console& console) {
  const std::size_t rooms =
      options.bounds == 0 ? most_demo_rooms : std::clamp<std::size_t>(options.bounds / 1000, 1, most_demo_rooms);
  const std::string source = fmt::format("{} room{}", rooms, rooms == 1 ? "" : "s");
  SeesChoice choice;
  choice.patch_size = 0.5;
  choice.solid = {"wall*", "cupboard*", "table*"};
  const SeesScene scene = make_sees_scene(make_rooms(rooms, 1), choice, source);
  const PatchSet patches = scene.patch_set();
  SeesReport report{};
  workers.run([&] { report = run_sees(scene, patches, {}, source, "", {}, console.progress, console.interrupt); });
  fmt::print("\nVisible pairs of patches in {}\n", format_report(report, ReportFormat::text));
  fmt::print(
      "Walls and furniture are solid. Clear, occluded and facing-away pairs are proven; only the others need rays.\n"
      "For your own mesh: shaftcull sees FILE\n");
}

void run(const DemoOptions& options) {
  options.isa.select();
  const Workers workers(options.threads);
  Table table({"scene", "frames", "bounds", "shafts", "ms/frame", "worst", "move", "cull", "tests/s", "kept/frame",
               "kept", "isa", "threads", "bounds in"});
  Console console;
  for (const std::string_view name : {"sphereflake", "city", "crowd"}) {
    if (options.scene != "all" && options.scene != name) continue;
    const auto begin = std::chrono::steady_clock::now();
    const auto scene = make_scene(name, options.bounds);
    console.progress.milestone(fmt::format("{}: {} bounds, {} of them moving, and {} shafts; made in {:.1f} s", name,
                                           grouped(scene->bounds()), grouped(scene->moving()), options.shafts,
                                           milliseconds_since(begin) / 1000));
    workers.run([&] { show(*scene, options, table, console); });
    if (console.interrupt.signal() != 0) break;
  }
  const bool shows_table = options.scene != "rooms";
  if (shows_table) {
    console.progress.milestone("");
    print_table(table);
  }
  if (const int signal = console.interrupt.signal(); signal != 0) {
    throw Interrupted(signal, "demo: interrupted; the table has the frames so far");
  }
  if (options.scene == "all" || options.scene == "rooms") show_rooms(options, workers, console);
}

}  // namespace

void add_demo(CLI::App& program) {
  const auto options = std::make_shared<DemoOptions>();
  CLI::App& demo = *program.add_subcommand(
      "demo",
      "Move millions of bounds and cull them, frame by frame; then count visible pairs of patches in some rooms");
  demo.add_option("--scene", options->scene, "sphereflake, city, crowd, rooms, or all (default: all)")
      ->check(CLI::IsMember({"sphereflake", "city", "crowd", "rooms", "all"}))
      ->type_name("SCENE");
  add_number(demo, "--bounds", options->bounds, 1, 100'000'000,
             "Bounds per scene (default: 5,380,840 spheres, or 1,000,000 boxes); one room per thousand, at most 9")
      ->type_name("N");
  add_number(demo, "--shafts", options->shafts, 1, 100'000, "Number of shafts (default: 64)")->type_name("N");
  CLI::Option* frames = add_number(demo, "--frames", options->frames, 1, 1'000'000,
                                   "Frames per scene (default: 100, or as many as --seconds allows)")
                            ->type_name("N");
  CLI::Option* seconds =
      add_number(demo, "--seconds", options->seconds, 0.001, 86'400,
                 "Start no frame of a scene later than this (default: 6; no limit if --frames is given)")
          ->type_name("S");
  add_number(demo, "--threads", options->threads, 0, most_threads, "Number of threads (default: 0, all of the machine)")
      ->type_name("N");
  options->isa.add_option(demo);
  demo.footer(
      "Ctrl-C (SIGINT) or SIGTERM ends the run after the current frame, with the table of the\n"
      "frames so far. A second signal ends it at once.");
  demo.callback([options, frames, seconds] {
    if (frames->count() > 0 && seconds->count() == 0) options->seconds = 0;
    run(*options);
  });
}

}  // namespace shaftcull::cli
