// SPDX-License-Identifier: MIT
/// sees/…: which patches of a scene see each other, on one thread, against shadow rays by Embree. On the instruction
/// set that SHAFTCULL_ISA names, or the best one.
///
/// sees/SCENE/PAIRS/S answers what part of S shadow rays is clear, for pairs of patches that face each other:
/// visibility() first, then Embree's rays for what is undecided. sees/SCENE/PAIRS/S/embree traces the same rays for all
/// of them. Pairs are those of a cluster of up to 64 patches with up to 32 others: `near` in the same room or closer
/// than 60 m, or `anywhere`. Sets of patches are formed anew for each cluster. An item is such a pair. Answers are
/// compared before anything is timed: of a pair that is clear no ray may meet anything, of one that is occluded every
/// ray must.
///
/// sees/SCENE/occluders prepares what may hide something, as the peer's tree is prepared; an item is an occluder. It is
/// in no other row. sees/SCENE/all counts answers for all pairs of a scene, sets formed anew; `finer` does so for four
/// times the patches on the same surfaces. sees/SCENE/all/deliver has them delivered, with candidates, to a callback
/// that reads them all. An item is a pair.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <fmt/format.h>

#include "families/candidate_rays.hpp"
#include "harness/suite.hpp"
#include "harness/threads.hpp"
#include "scenes/city_blocks.hpp"
#include "scenes/interior.hpp"
#include "scenes/patch_pairs.hpp"
#include "scenes/shadow_rays.hpp"
#include "scenes/tree_scene.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/triangles.hpp"
#include "shaftcull/visibility.hpp"

#ifdef SHAFTCULL_BENCH_WITH_EMBREE
#include "peers/embree.hpp"
#endif

namespace shaftcull::bench {
namespace {

/// The instruction set that SHAFTCULL_ISA names, or the best one that the machine runs.
Isa measured_isa() {
  const std::vector<Isa> available = available_isas();
  const std::optional<Isa> asked = isa_from_name(isa_choice().asked);
  const bool runs = asked && std::find(available.begin(), available.end(), *asked) != available.end();
  return runs ? *asked : available.back();
}

/// Everything of a scene that may hide something: what is solid as such, meshes object by object. Ready for use: the
/// first call finds which solids are one.
Occluders occluders_of(const PatchScene& scene) {
  Occluders occluders;
  occluders.add_solids(scene.boxes);
  std::vector<Vec3> corners;
  std::vector<std::size_t> first_corner{0};
  for (const TurnedBox& box : scene.turned) {
    corners.insert(corners.end(), box.begin(), box.end());
    first_corner.push_back(corners.size());
  }
  occluders.add_solid_hulls(corners, first_corner);
  const std::size_t first = scene.objects[scene.first_mesh()];
  const TriangleStream meshes(std::span(scene.triangles).subspan(first));
  std::vector<std::size_t> first_triangle;
  for (std::size_t i = scene.first_mesh(); i != scene.objects.size(); ++i) {
    first_triangle.push_back(scene.objects[i] - first);
  }
  occluders.add_triangles(meshes, first_triangle);
  const Box somewhere{};
  benchmark::DoNotOptimize(count_visibility(PatchSet(std::span(&somewhere, 1)), occluders));
  return occluders;
}

/// "4.8 % clear, 86.0 % occluded, …"
std::string shares_text(const SightCounts& counts) {
  const auto percent = [total = static_cast<double>(counts.total())](std::uint64_t part) {
    return 100 * static_cast<double>(part) / total;
  };
  return fmt::format("{:.1f} % clear, {:.1f} % occluded, {:.1f} % facing away, {:.1f} % undecided",
                     percent(counts.clear), percent(counts.occluded), percent(counts.facing_away),
                     percent(counts.undecided));
}

#ifdef SHAFTCULL_BENCH_WITH_EMBREE

constexpr std::size_t partners = 32;         // clusters that a cluster is asked about
constexpr std::size_t most_candidates = 32;  // of a pair whose rays are tested with them one by one
constexpr unsigned most_rays = 256;          // a pair
constexpr float near_in_city = 60;           // metres

/// Products for so many rays a pair, so that all take about as long.
constexpr std::size_t products_for(unsigned rays, bool quick) {
  return quick ? 10 * 16 / rays + 1 : 40 * 16 / rays + 4;
}

struct Product {
  PatchProduct patches;
  std::vector<FacingPair> facing;
};

#endif

/// A scene and what is asked of it, made when it is first needed.
class SeesScene {
 public:
  using Make = PatchScene(unsigned finer);

  SeesScene(std::string scene_name, Make* make) : name(std::move(scene_name)), make_(make) {}

  const PatchScene& scene() {
    return scene_.get([&] { return make_(1); });
  }
  const PatchScene& finer() {
    return finer_.get([&] { return make_(2); });
  }
  const Occluders& occluders() {
    return occluders_.get([&] { return occluders_of(scene()); });
  }
#ifdef SHAFTCULL_BENCH_WITH_EMBREE
  const std::vector<RayBox>& ray_boxes() {
    return ray_boxes_.get([&] { return ray_boxes_of(scene()); });
  }
  const EmbreeScene& embree() {
    if (!embree_) embree_ = std::make_unique<EmbreeScene>(scene());
    return *embree_;
  }
  const std::vector<Product>& products(bool near) {
    return (near ? near_ : anywhere_).get([&] {
      const std::vector<PatchCluster> clusters = clusters_of(scene());
      const bool has_rooms = clusters.front().zone != clusters.back().zone;
      const auto are_partners = [&](const PatchCluster& a, const PatchCluster& b) {
        if (!near) return true;
        return has_rooms ? a.zone == b.zone : distance(a.box, b.box) < near_in_city;
      };
      std::vector<Product> products;
      for (const PatchProduct& product :
           random_products(clusters, products_for(16, false), partners, near ? 4301 : 4302, are_partners)) {
        products.push_back({product, facing_pairs(scene(), product)});
      }
      return products;
    });
  }
#endif

  const std::string name;

 private:
  Make* make_;
  Lazy<PatchScene> scene_;
  Lazy<PatchScene> finer_;
  Lazy<Occluders> occluders_;
#ifdef SHAFTCULL_BENCH_WITH_EMBREE
  Lazy<std::vector<RayBox>> ray_boxes_;
  std::unique_ptr<EmbreeScene> embree_;
  Lazy<std::vector<Product>> near_;
  Lazy<std::vector<Product>> anywhere_;
#endif
};

#ifdef SHAFTCULL_BENCH_WITH_EMBREE

/// What part of a pair's rays was clear: what a user wants to know of it.
float share_of(RayCounts counts) {
  return counts.traced == 0 ? 0.0F : static_cast<float>(counts.clear) / static_cast<float>(counts.traced);
}

PatchSet set_of(const PatchScene& scene, std::span<const std::uint32_t> patches) {
  std::vector<Box> boxes;
  std::vector<Plane> planes;
  boxes.reserve(patches.size());
  planes.reserve(patches.size());
  for (const std::uint32_t patch : patches) {
    boxes.push_back(scene.patch_boxes[patch]);
    planes.push_back(scene.patch_planes[patch]);
  }
  return PatchSet(boxes, planes);
}

/// Asks for all pairs of a product, and calls decided(i, j, sight) or undecided(i, j, candidates) for each, by
/// positions in the product's lists.
template <class Decided, class Undecided>
void ask(const PatchScene& scene, const Occluders& occluders, const PatchProduct& product, const Decided& decided,
         const Undecided& undecided) {
  const PatchSet a = set_of(scene, product.a);
  const PatchSet b = set_of(scene, product.b);
  const std::span<const std::uint32_t> order_a = a.order();
  const std::span<const std::uint32_t> order_b = b.order();
  visibility(a, b, occluders, [&](const SightBatch& batch) {
    for (const PairBlock& part : batch.blocks) {
      decided(order_a.subspan(part.a.first, part.a.count), order_b.subspan(part.b.first, part.b.count), part.sight);
    }
    const UndecidedPairs& open = batch.undecided;
    for (std::size_t i = 0; i != open.pairs.size(); ++i) {
      undecided(
          open.pairs[i].a, open.pairs[i].b,
          open.candidates.subspan(open.first_candidate[i], open.first_candidate[i + 1] - open.first_candidate[i]));
    }
  });
}

/// The part of its rays that is clear, of a pair of which these are all the occluders that they may meet. Solids are
/// boxes to be tested with: Embree traces those rays only that meet none of them but the box around a mesh.
float share_past(SeesScene& sees, const FacingPair& pair, const ShadowRays& rays,
                 std::span<const std::uint32_t> candidates) {
  const PatchScene& scene = sees.scene();
  static TraceCandidates* const trace = trace_candidates(measured_isa());
  if (trace == nullptr || candidates.size() > most_candidates) return share_of(sees.embree().trace(pair, rays));
  std::array<std::uint64_t, most_rays / 64> maybe;
  const RayEnds ends{scene.patches[pair.a], scene.patches[pair.b], scene.patch_planes[pair.a],
                     scene.patch_planes[pair.b]};
  const CandidateCounts counts = trace(ends, rays, sees.ray_boxes(), candidates, maybe.data());
  unsigned clear = counts.clear;
  if (counts.maybe != 0) clear += sees.embree().count_clear(pair, rays, maybe);
  return counts.traced == 0 ? 0.0F : static_cast<float>(clear) / static_cast<float>(counts.traced);
}

/// The share of clear rays of each pair of a product, row by row.
void answer(SeesScene& sees, const ShadowRays& rays, const PatchProduct& product, std::vector<float>& shares) {
  const std::size_t columns = product.b.size();
  shares.assign(product.a.size() * columns, 0.0F);
  ask(
      sees.scene(), sees.occluders(), product,
      [&](std::span<const std::uint32_t> of_a, std::span<const std::uint32_t> of_b, Sight sight) {
        if (sight != Sight::clear) return;
        for (const std::uint32_t i : of_a) {
          for (const std::uint32_t j : of_b) shares[i * columns + j] = 1;
        }
      },
      [&](std::uint32_t i, std::uint32_t j, std::span<const std::uint32_t> candidates) {
        shares[i * columns + j] = share_past(sees, {product.a[i], product.b[j]}, rays, candidates);
      });
}

/// What Embree's rays say of the answers for some products.
struct Check {
  SightCounts counts;            ///< of pairs that face each other
  std::uint64_t candidates = 0;  ///< of those that are undecided
  std::uint64_t grazed = 0;      ///< clear pairs of which rays meet nothing but, by rounding, the surface they graze
  std::uint64_t rays = 0;        ///< of undecided pairs
  std::uint64_t differ = 0;      ///< of these, which meet a box but not its triangles, or the other way
  std::uint64_t wrong = 0;
  std::string first_wrong;
};

Check check(SeesScene& sees, std::span<const Product> products, const ShadowRays& rays) {
  Check result;
  const float grazing = sees.embree().grazing_height();
  for (const Product& product : products) {
    const std::size_t columns = product.patches.b.size();
    std::vector<Sight> sights(product.patches.a.size() * columns);
    std::vector<std::uint8_t> answers(sights.size());
    const auto note = [&](std::uint32_t i, std::uint32_t j, Sight sight) {
      sights[i * columns + j] = sight;
      ++answers[i * columns + j];
    };
    const auto note_all = [&](std::span<const std::uint32_t> of_a, std::span<const std::uint32_t> of_b, Sight sight) {
      for (const std::uint32_t i_of_a : of_a) {
        for (const std::uint32_t j_of_b : of_b) note(i_of_a, j_of_b, sight);
      }
    };
    ask(sees.scene(), sees.occluders(), product.patches, note_all,
        [&](std::uint32_t i, std::uint32_t j, std::span<const std::uint32_t> candidates) {
          note(i, j, Sight::undecided);
          result.candidates += candidates.size();
        });
    std::vector<float> shares;
    answer(sees, rays, product.patches, shares);
    std::size_t next = 0;
    for (std::size_t i = 0; i != product.patches.a.size(); ++i) {
      for (std::size_t j = 0; j != columns; ++j) {
        const FacingPair pair{product.patches.a[i], product.patches.b[j]};
        const bool faces =
            next != product.facing.size() && product.facing[next].a == pair.a && product.facing[next].b == pair.b;
        if (faces) ++next;
        const Sight sight = sights[i * columns + j];
        const float share = shares[i * columns + j];
        bool right = answers[i * columns + j] == 1;
        RayCounts traced{0, 0};
        if (faces) {
          traced = sees.embree().trace(pair, rays);
          // Rays of a pair that hardly faces may all leave from behind: none of them says anything.
          bool agrees = traced.traced == 0 || share == share_of(traced);
          if (!agrees && sight == Sight::clear) {
            const RayCounts high = sees.embree().trace(pair, rays, grazing);
            agrees = high.clear == high.traced;
            if (agrees) ++result.grazed;
          }
          if (sight == Sight::undecided) {
            const float clear = share * static_cast<float>(traced.traced);
            result.rays += traced.traced;
            result.differ +=
                static_cast<std::uint64_t>(std::lround(std::abs(clear - static_cast<float>(traced.clear))));
            agrees = true;
          }
          right = right && agrees;
          ++result.counts.of(sight);
        }
        if (right || result.wrong++ != 0) continue;
        result.first_wrong =
            fmt::format("patches {} and {} got {} answers, the last one {}, but {} of {} rays are clear", pair.a,
                        pair.b, answers[i * columns + j], shaftcull::name(sight), traced.clear, traced.traced);
      }
    }
  }
  // Edges are grazed by one ray in ten thousand.
  if (1000 * result.differ > result.rays && result.wrong++ == 0) {
    result.first_wrong = fmt::format("{} of {} rays of undecided pairs are clear past boxes or past triangles alone",
                                     result.differ, result.rays);
  }
  return result;
}

void declare_rays(Suite& suite, const std::shared_ptr<SeesScene>& sees, bool near, unsigned rays, double target) {
  const std::size_t count = products_for(rays, suite.quick());
  const RunOptions options{.brief = !suite.quick(), .once = suite.quick()};
  const std::string kind = fmt::format("sees/{}/{}", sees->name, near ? "near" : "anywhere");
  const std::string row = fmt::format("{}/{}", kind, rays);
  const auto products_of = [=] { return std::span<const Product>(sees->products(near)).first(count); };
  const auto set_items = [=](benchmark::State& state) {
    std::int64_t pairs = 0;
    for (const Product& product : products_of()) pairs += static_cast<std::int64_t>(product.facing.size());
    state.SetItemsProcessed(state.iterations() * pairs);
  };
  suite.add(
      row, "",
      [=, &suite, checked = std::make_shared<bool>(false)](benchmark::State& state) {
        select_isa(measured_isa());
        const ShadowRays shadow_rays(rays);
        if (!*checked) {
          const Check checked_pairs = check(*sees, products_of(), shadow_rays);
          if (checked_pairs.wrong != 0) {
            state.SkipWithError(
                fmt::format("{} answers are wrong; {}", checked_pairs.wrong, checked_pairs.first_wrong).c_str());
            return;
          }
          suite.note(
              fmt::format("{}: {} of {} pairs that face each other; {:.1f} candidates an undecided pair; {} of "
                          "{} rays differ; of {} clear pairs rays graze the surface",
                          row, shares_text(checked_pairs.counts), checked_pairs.counts.total(),
                          static_cast<double>(checked_pairs.candidates) /
                              static_cast<double>(std::max<std::uint64_t>(checked_pairs.counts.undecided, 1)),
                          checked_pairs.differ, checked_pairs.rays, checked_pairs.grazed));
          *checked = true;
        }
        std::vector<float> shares;
        for (auto _ : state) {
          for (const Product& product : products_of()) {
            answer(*sees, shadow_rays, product.patches, shares);
            benchmark::DoNotOptimize(shares.data());
          }
        }
        set_items(state);
      },
      options);
  suite.add(
      row + "/embree", "",
      [=](benchmark::State& state) {
        const EmbreeScene& embree = sees->embree();
        const ShadowRays shadow_rays(rays);
        std::vector<float> shares;
        for (auto _ : state) {
          for (const Product& product : products_of()) {
            shares.resize(product.facing.size());
            for (std::size_t i = 0; i != shares.size(); ++i) {
              shares[i] = share_of(embree.trace(product.facing[i], shadow_rays));
            }
            benchmark::DoNotOptimize(shares.data());
          }
        }
        set_items(state);
      },
      options);
  suite.add_target(row, row + "/embree", target);
}

#endif

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

void declare_all(Suite& suite, const std::shared_ptr<SeesScene>& sees, double pairs_per_second) {
  const std::string row = fmt::format("sees/{}/all", sees->name);
  const auto add = [&](const std::string& name, bool finer, RunOptions options) {
    (suite.quick() || finer ? options.once : options.brief) = true;
    suite.add(
        name, "",
        [=, &suite, noted = std::make_shared<bool>(options.threads != 1)](benchmark::State& state) {
          select_isa(measured_isa());
          const PatchScene& scene = finer ? sees->finer() : sees->scene();
          const Occluders& occluders = sees->occluders();  // whatever the patches, surfaces are the same
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
  add(row, false, {});
  suite.add_time_target(row, 1e9 / pairs_per_second);
  declare_delivery(suite, sees, row + "/deliver", {});
  if (all_threads() > 1) {
    add(row + "/2threads", false, {.threads = 2, .wall_clock = true});
    suite.add_target(row + "/2threads", row, 1.85);
    declare_delivery(suite, sees, row + "/deliver/2threads", {.threads = 2, .wall_clock = true});
    suite.add_target(row + "/deliver/2threads", row + "/deliver", 1.6);  // the callback is called by one at a time
  }
  if (!suite.quick()) {
    add(row + "/finer", true, {});
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
#else
  suite.note("sees/…/embree is not measured: this build found no Embree 3 (Debian: libembree-dev)");
#endif
}

}  // namespace shaftcull::bench
