// SPDX-License-Identifier: MIT
/// sweep/…: the speed of culling boxes by number of bounds, of shafts and of threads.
///
/// sweep/bounds/N is 64 shafts × N boxes, whose speed should not depend on N, nor that of sweep/classify/N and of
/// sweep/spheres/N; sweep/one_shaft/N and sweep/one_shaft_spheres/N are one shaft, which shows the steps from cache to
/// cache; sweep/shafts/S is S shafts × a quarter of all boxes; sweep/threads/T and sweep/threads_one_shaft/T are 64
/// shafts and one shaft × all boxes on T threads, by the clock on the wall.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "harness/suite.hpp"
#include "harness/threads.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull::bench {
namespace {

constexpr std::size_t most_shafts = 1024;
static_assert(most_shafts <= Workload::pairs);

/// Bounds in the cache that do not fill tiles of 2,048, and what they are compared with, which does.
constexpr std::size_t between_tiles[] = {1500, 2047, 2049, 2100, 3000, 4095};
constexpr std::size_t two_tiles = 4096;
constexpr double least_between_tiles = 0.85;

/// Shafts that are fewer than a vector of eight, and what they are compared with.
constexpr std::size_t few_shafts[] = {5, 6, 7};
constexpr std::size_t eight_shafts = 8;
constexpr double least_of_few_shafts = 0.85;

/// Shafts, and memory for the bits of any point of any curve.
struct Sweep {
  std::vector<CompiledShaft> shafts;
  std::vector<std::uint64_t> kept;
  std::vector<std::uint64_t> inside;
};

class Curves {
 public:
  Curves(Suite& suite, const Workload& workload)
      : suite_(suite),
        boxes_(workload.boxes.view()),
        spheres_(workload.spheres.view()),
        few_(std::max<std::size_t>(boxes_.count / 4, 1)) {
    for (std::size_t i = 0; i < most_shafts; ++i) {
      sweep_->shafts.push_back(compile(workload.a[i], workload.b[i]));
      complete(sweep_->shafts.back());
    }
    sweep_->kept.resize(std::max(most_shafts * bit_words(few_), Workload::test_shafts * bit_words(boxes_.count)));
    sweep_->inside.resize(Workload::test_shafts * bit_words(two_tiles));
  }

  /// From 1,000 boxes to all of them.
  void by_bounds(Isa isa) const {
    std::set<std::size_t> counts{1000, boxes_.count};
    for (std::size_t count = 2048; count < boxes_.count; count *= suite_.quick() ? 8 : 2) counts.insert(count);
    for (const std::size_t count : counts) {
      const bool end = count == 1000 || count == boxes_.count;
      const bool coarse = !suite_.quick() && std::has_single_bit(count) && std::countr_zero(count) % 2 == 0;
      if ((end || coarse || suite_.quick()) && count != two_tiles) {
        point(fmt::format("sweep/bounds/{}/{}", count, name(isa)), isa, Workload::test_shafts, count, {.brief = !end});
      }
      point(fmt::format("sweep/one_shaft/{}/{}", count, name(isa)), isa, 1, count, {.brief = true});
    }
    suite_.add_time_ratio_target(fmt::format("sweep/bounds/{}/{}", boxes_.count, name(isa)),
                                 fmt::format("sweep/bounds/1000/{}", name(isa)), 1.25);
  }

  /// Bounds that fill tiles of 2,048, and such that do not.
  void between_full_tiles(Isa isa) const {
    constexpr std::size_t shafts = Workload::test_shafts;
    const auto curve = [&](const std::string& family, const auto& add_point) {
      const auto name_of = [&](std::size_t count) { return fmt::format("sweep/{}/{}/{}", family, count, name(isa)); };
      add_point(name_of(two_tiles), two_tiles);
      for (const std::size_t count : between_tiles) {
        if (count > boxes_.count) continue;
        add_point(name_of(count), count);
        suite_.add_target(name_of(count), name_of(two_tiles), least_between_tiles);
      }
    };
    curve("bounds",
          [&](const std::string& name, std::size_t count) { point(name, isa, shafts, count, {.brief = true}); });
    curve("classify", [&](const std::string& name, std::size_t count) {
      point_of(name, isa, shafts, boxes_.slice(0, count), true, {.brief = true});
    });
    curve("spheres", [&](const std::string& name, std::size_t count) {
      point_of(name, isa, shafts, spheres_.slice(0, count), false, {.brief = true});
    });
    const std::string one = fmt::format("sweep/one_shaft_spheres/{}/{}", two_tiles, name(isa));
    point_of(one, isa, 1, spheres_.slice(0, two_tiles), false, {.brief = true});
    suite_.add_target(one, fmt::format("sweep/spheres/{}/{}", two_tiles, name(isa)), 0.5);
  }

  /// From one shaft to 1,024.
  void by_shafts(Isa isa) const {
    const auto name_of = [&](std::size_t count) { return fmt::format("sweep/shafts/{}/{}", count, name(isa)); };
    std::set<std::size_t> counts{eight_shafts};
    for (std::size_t count = 1; count <= most_shafts; count *= suite_.quick() ? 32 : 2) counts.insert(count);
    for (const std::size_t count : few_shafts) {
      counts.insert(count);
      suite_.add_target(name_of(count), name_of(eight_shafts), least_of_few_shafts);
    }
    for (const std::size_t count : counts) point(name_of(count), isa, count, few_, {.brief = true});
  }

  void by_threads(Isa isa) const {
    for (const unsigned threads : thread_counts()) {
      point(fmt::format("sweep/threads/{}", threads), isa, Workload::test_shafts, boxes_.count,
            {.threads = threads, .wall_clock = true});
      point(fmt::format("sweep/threads_one_shaft/{}", threads), isa, 1, boxes_.count,
            {.threads = threads, .wall_clock = true, .brief = true});
    }
    if (all_threads() > 1) suite_.add_target("sweep/threads/2", "sweep/threads/1", 1.85);
  }

 private:
  void point(const std::string& name, Isa isa, std::size_t shafts, std::size_t bounds, RunOptions options) const {
    point_of(name, isa, shafts, boxes_.slice(0, bounds), false, options);
  }

  void point_of(const std::string& name, Isa isa, std::size_t shafts, const Bounds& bounds, bool classify,
                RunOptions options) const {
    const auto body = [sweep = sweep_, bounds, isa, shafts, classify](benchmark::State& state) {
      select_isa(isa);
      const std::span<std::uint64_t> kept(sweep->kept.data(), shafts * bit_words(bounds.size()));
      const std::span<std::uint64_t> inside(sweep->inside.data(), classify ? kept.size() : 0);
      std::size_t next = 0;  // one shaft after the other where one is tested at a time: they differ in speed
      for (auto _ : state) {
        const std::size_t first = shafts == 1 ? next++ % Workload::test_shafts : 0;
        const std::span<const CompiledShaft> some = std::span(sweep->shafts).subspan(first, shafts);
        if (classify) {
          classify_many(some, bounds, kept, inside);
        } else {
          cull_many(some, bounds, kept);
        }
        benchmark::ClobberMemory();
      }
      state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(shafts * bounds.size()));
    };
    suite_.add(name, "", body, options);
  }

  Suite& suite_;
  BoxView boxes_;
  SphereView spheres_;
  std::size_t few_;
  std::shared_ptr<Sweep> sweep_ = std::make_shared<Sweep>();
};

}  // namespace

void declare_sweep(Suite& suite, const Workload& workload) {
  const Curves curves(suite, workload);
  const std::vector<Isa> available = available_isas();
  const Isa best = available.back();
  std::set<Isa> isas{best};
  if (std::find(available.begin(), available.end(), Isa::avx2) != available.end()) isas.insert(Isa::avx2);
  for (const Isa isa : isas) {
    curves.by_bounds(isa);
    curves.between_full_tiles(isa);
    curves.by_shafts(isa);
  }
  curves.by_threads(best);
  if (all_threads() == 1)
    suite.note("sweep/threads has one point, and its target is not measured: there is one thread here");
  suite.note(
      "sweep/threads… and memory/…_threads are timed by the clock on the wall, which other programs disturb; "
      "everything "
      "else by processor time");
}

}  // namespace shaftcull::bench
