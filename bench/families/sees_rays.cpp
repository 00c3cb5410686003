// SPDX-License-Identifier: MIT
/// sees/SCENE/PAIRS/S: shares of clear rays by visibility() and Embree, against Embree alone.
#ifdef SHAFTCULL_BENCH_WITH_EMBREE

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "families/sees_scene.hpp"
#include "scenes/shadow_rays.hpp"

namespace shaftcull::bench {
namespace {

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

}  // namespace

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

}  // namespace shaftcull::bench

#endif
