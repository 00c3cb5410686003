// SPDX-License-Identifier: MIT
/// sees/…: which patches of a scene see each other, on one thread, against shadow rays by Embree. On the instruction
/// set that SHAFTCULL_ISA names, or the best one.
///
/// sees/SCENE/PAIRS/S answers what part of S shadow rays is clear, for pairs of patches that face each other:
/// visibility() first, then visible_fractions() for what is undecided. sees/SCENE/PAIRS/S/embree traces the same rays
/// for all of them. Pairs are those of a cluster of up to 64 patches with up to 32 others: `near` in the same room or
/// closer than 60 m, or `anywhere`. Sets of patches are formed anew for each cluster. An item is such a pair. Answers
/// are compared before anything is timed: of a pair that is clear no ray may meet anything, of one that is occluded
/// every ray must.
///
/// sees/SCENE/undecided/TARGETS casts 16 rays for each undecided pair of these, and nothing else: against `solids`, and
/// meshes as triangles; or against all as `triangles`, of which nothing is known, so that more pairs are undecided. An
/// item is such a pair.
///
/// sees/SCENE/occluders prepares what may hide something, as the peer's tree is prepared; an item is an occluder. It is
/// in no other row. sees/SCENE/all counts answers for all pairs of a scene, sets formed anew; `boxes` does so with
/// turned solids that hide as the boxes inside them alone, `finer` for four times the patches on the same surfaces.
/// sees/SCENE/all/deliver has them delivered, with candidates, to a callback that reads them all. An item is a pair.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <fmt/format.h>

#include "families/sees_scene.hpp"
#include "harness/suite.hpp"
#include "harness/threads.hpp"
#include "scenes/city_blocks.hpp"
#include "scenes/interior.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull::bench {
namespace {

/// What Linux says of this process in /proc/self/status; 0 elsewhere.
std::size_t status_bytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::size_t kilobytes = 0;
    if (word == key && status >> kilobytes) return kilobytes << 10;
  }
  return 0;
}

/// From now on "VmHWM:" is the most memory since now, where Linux lets a process say so. What the C library keeps of
/// earlier calls is given back first.
void forget_peak_of_process() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
  std::ofstream("/proc/self/clear_refs") << "5";
}

/// What is made of answers that are delivered, so that all of them are read.
struct DeliveredSum {
  std::uint64_t pairs = 0;
  std::uint64_t blocks = 0;
  std::uint64_t undecided = 0;
  std::uint64_t candidates = 0;
  std::uint64_t numbers = 0;  ///< sum of the candidates' numbers and of the pairs' patches

  void add(const SightBatch& batch) {
    for (const PairBlock& block : batch.blocks) pairs += std::uint64_t{block.a.count} * block.b.count;
    for (const PatchPair& pair : batch.undecided.pairs) numbers += std::uint64_t{pair.a} + pair.b;
    for (const std::uint32_t candidate : batch.undecided.candidates) numbers += candidate;
    blocks += batch.blocks.size();
    pairs += batch.undecided.pairs.size();
    undecided += batch.undecided.pairs.size();
    candidates += batch.undecided.candidates.size();
  }
};

/// The call that delivers answers, of all pairs of a scene.
void declare_delivery(Suite& suite, const std::shared_ptr<SeesScene>& sees, const std::string& name,
                      RunOptions options) {
  (suite.quick() ? options.once : options.brief) = true;
  suite.add(
      name, "",
      [=, &suite, noted = std::make_shared<bool>(false)](benchmark::State& state) {
        select_isa(measured_isa());
        const PatchScene& scene = sees->scene();
        const Occluders& occluders = sees->occluders();
        DeliveredSum sum;
        forget_peak_of_process();
        const std::size_t before = status_bytes("VmRSS:");
        for (auto _ : state) {
          sum = {};
          const PatchSet patches(scene.patch_boxes, scene.patch_planes);
          visibility(patches, occluders, [&](const SightBatch& batch) { sum.add(batch); });
          benchmark::DoNotOptimize(sum.numbers);
        }
        const std::uint64_t pairs = scene.patches.size() * (scene.patches.size() - 1) / 2;
        if (sum.pairs != pairs) {
          state.SkipWithError(fmt::format("{} of {} pairs were delivered", sum.pairs, pairs).c_str());
          return;
        }
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pairs));
        if (std::exchange(*noted, true)) return;
        std::string memory;
        if (const std::size_t peak = status_bytes("VmHWM:"); peak > before) {
          memory = fmt::format("; at most {} MB more than before", (peak - before) >> 20);
        }
        suite.note(fmt::format(
            "{}: {:.1f} M blocks, {:.1f} M undecided pairs with {:.1f} candidates each{}", name,
            static_cast<double>(sum.blocks) / 1e6, static_cast<double>(sum.undecided) / 1e6,
            static_cast<double>(sum.candidates) / static_cast<double>(std::max<std::uint64_t>(sum.undecided, 1)),
            memory));
      },
      options);
}

/// Which patches are asked about, and what hides them.
enum class Asked : unsigned char { as_it_is, without_hulls, finer };

void declare_all(Suite& suite, const std::shared_ptr<SeesScene>& sees, double pairs_per_second) {
  const std::string row = fmt::format("sees/{}/all", sees->name);
  const auto add = [&](const std::string& name, Asked asked, RunOptions options) {
    (suite.quick() || asked == Asked::finer ? options.once : options.brief) = true;
    suite.add(
        name, "",
        [=, &suite, noted = std::make_shared<bool>(options.threads != 1)](benchmark::State& state) {
          select_isa(measured_isa());
          const PatchScene& scene = asked == Asked::finer ? sees->finer() : sees->scene();
          // Whatever the patches, surfaces are the same.
          const Occluders& occluders =
              asked == Asked::without_hulls ? sees->occluders_without_hulls() : sees->occluders();
          SightCounts counts;
          for (auto _ : state) {
            const PatchSet patches(scene.patch_boxes, scene.patch_planes);
            counts = count_visibility(patches, occluders, {.candidates = false});
          }
          const std::uint64_t pairs = scene.patches.size() * (scene.patches.size() - 1) / 2;
          if (counts.total() != pairs) {
            state.SkipWithError(fmt::format("{} of {} pairs were answered", counts.total(), pairs).c_str());
            return;
          }
          state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pairs));
          if (!std::exchange(*noted, true)) {
            suite.note(fmt::format("{}: {} patches, {} M pairs: {}", name, scene.patches.size(), pairs / 1'000'000,
                                   shares_text(counts)));
          }
        },
        options);
  };
  suite.add(fmt::format("sees/{}/occluders", sees->name), "",
            [=](benchmark::State& state) {
              select_isa(measured_isa());
              const PatchScene& scene = sees->scene();
              for (auto _ : state) benchmark::DoNotOptimize(occluders_of(scene).size());
              state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(scene.objects.size() - 1));
            },
            {.brief = !suite.quick(), .once = suite.quick()});
  add(row, Asked::as_it_is, {});
  add(row + "/boxes", Asked::without_hulls, {});
  suite.add_time_target(row + "/boxes", 1e9 / pairs_per_second);
  declare_delivery(suite, sees, row + "/deliver", {});
  if (all_threads() > 1) {
    add(row + "/2threads", Asked::as_it_is, {.threads = 2, .wall_clock = true});
    suite.add_target(row + "/2threads", row, 1.85);
    declare_delivery(suite, sees, row + "/deliver/2threads", {.threads = 2, .wall_clock = true});
    suite.add_target(row + "/deliver/2threads", row + "/deliver", 1.6);  // the callback is called by one at a time
  }
  if (!suite.quick()) {
    add(row + "/finer", Asked::finer, {});
    suite.add_time_ratio_target(row + "/finer", row, 10.0 / 16);  // ten times the time for 16 times the pairs
  }
}

}  // namespace

void declare_sees(Suite& suite, const Workload& /*workload*/) {
  const auto inside = std::make_shared<SeesScene>("interior", [](unsigned finer) {
    return interior({interior_patch, finer});
  });
  const auto outside = std::make_shared<SeesScene>("city", [](unsigned finer) {
    return city_blocks({city_blocks_patch, finer});
  });
  // Targets are set for AVX-512.
  const double share = measured_isa() == Isa::avx512 ? 1 : 0.7;
  declare_all(suite, inside, 150e6 * share);
  declare_all(suite, outside, 100e6 * share);
  for (const auto& scene : {inside, outside}) declare_corners(suite, scene);
  declare_dense(suite);
#ifdef SHAFTCULL_BENCH_WITH_EMBREE
  struct Rows {
    std::shared_ptr<SeesScene> scene;
    bool near;
    std::array<double, 3> targets;  // with 16, 64 and 256 rays
  };
  for (const Rows& rows : {Rows{inside, true, {1.3, 1.6, 1.8}}, Rows{outside, true, {5, 8, 10}},
                           Rows{inside, false, {4, 5.5, 6.5}}, Rows{outside, false, {7, 12, 16}}}) {
    unsigned count = 16;
    for (const double target : rows.targets) {
      declare_rays(suite, rows.scene, rows.near, count, target * share);
      count *= 4;
    }
  }
  for (const auto& scene : {inside, outside}) {
    declare_undecided(suite, scene, RayTargets::solids, 1.2);
    declare_undecided(suite, scene, RayTargets::triangles, 0.8);
  }
  declare_groups(suite);
#else
  suite.note("sees/…/embree is not measured: this build found no Embree 3 (Debian: libembree-dev)");
#endif
}

}  // namespace shaftcull::bench
