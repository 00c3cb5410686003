// SPDX-License-Identifier: MIT
/// sees/SCENE/PAIRS/S: shares of clear rays by visibility() and visible_fractions(), against Embree.
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
#include "shaftcull/rays.hpp"

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

/// Asks for all pairs of a product, and calls decided(of_a, of_b, sight) for runs of them, by positions in the
/// product's lists, and undecided(pairs) for the others.
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
    undecided(batch.undecided);
  });
}

/// The share of clear rays of each pair of a product, row by row.
void answer(SeesScene& sees, unsigned rays, const PatchProduct& product, std::vector<float>& shares) {
  const std::size_t columns = product.b.size();
  const PatchSet a = polygons_of(sees.scene(), product.a);
  const PatchSet b = polygons_of(sees.scene(), product.b);
  std::vector<float> fractions;
  shares.assign(product.a.size() * columns, 0.0F);
  ask(
      sees.scene(), sees.occluders(), product,
      [&](std::span<const std::uint32_t> of_a, std::span<const std::uint32_t> of_b, Sight sight) {
        if (sight != Sight::clear) return;
        for (const std::uint32_t i : of_a) {
          for (const std::uint32_t j : of_b) shares[i * columns + j] = 1;
        }
      },
      [&](const UndecidedPairs& open) {
        fractions.resize(open.pairs.size());
        visible_fractions(a, b, sees.occluders(), open, fractions, {.rays = rays});
        for (std::size_t i = 0; i != fractions.size(); ++i) {
          shares[open.pairs[i].a * columns + open.pairs[i].b] = fractions[i];
        }
      });
}

/// What Embree's rays say of the answers for some products.
struct Check {
  SightCounts counts;            ///< of pairs that face each other
  std::uint64_t candidates = 0;  ///< of those that are undecided
  std::uint64_t grazed = 0;      ///< clear pairs of which rays meet nothing but, by rounding, the surface they graze
  double ours = 0;               ///< sum of the shares of undecided pairs
  double embree = 0;             ///< the same by its rays, which are others
  std::uint64_t far_off = 0;     ///< undecided pairs whose shares differ by more than chance has it
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
    ask(sees.scene(), sees.occluders(), product.patches, note_all, [&](const UndecidedPairs& open) {
      for (const PatchPair& pair : open.pairs) note(pair.a, pair.b, Sight::undecided);
      result.candidates += open.candidates.size();
    });
    std::vector<float> shares;
    answer(sees, rays.count, product.patches, shares);
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
            const float theirs = share_of(traced);
            result.ours += double{share};
            result.embree += double{theirs};
            // Four standard errors of the difference between two samples of so many independent rays.
            if (std::abs(share - theirs) > 4 * std::sqrt(0.5F / static_cast<float>(traced.traced))) ++result.far_off;
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
  const double undecided = static_cast<double>(result.counts.undecided);
  if (100 * std::abs(result.ours - result.embree) > undecided ||
      1000 * static_cast<double>(result.far_off) > undecided) {
    if (result.wrong++ == 0) {
      result.first_wrong =
          fmt::format("{} of {} undecided pairs are far from what Embree says, and in all {:.1f}, not {:.1f}",
                      result.far_off, result.counts.undecided, result.ours, result.embree);
    }
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
        if (!*checked) {
          const Check checked_pairs = check(*sees, products_of(), ShadowRays(rays));
          if (checked_pairs.wrong != 0) {
            state.SkipWithError(
                fmt::format("{} answers are wrong; {}", checked_pairs.wrong, checked_pairs.first_wrong).c_str());
            return;
          }
          const auto undecided = static_cast<double>(std::max<std::uint64_t>(checked_pairs.counts.undecided, 1));
          suite.note(fmt::format(
              "{}: {} of {} pairs that face each other; {:.1f} candidates an undecided pair, of which "
              "{:.2f} % is visible, by Embree {:.2f} %; of {} clear pairs rays graze the surface",
              row, shares_text(checked_pairs.counts), checked_pairs.counts.total(),
              static_cast<double>(checked_pairs.candidates) / undecided, 100 * checked_pairs.ours / undecided,
              100 * checked_pairs.embree / undecided, checked_pairs.grazed));
          *checked = true;
        }
        std::vector<float> shares;
        for (auto _ : state) {
          for (const Product& product : products_of()) {
            answer(*sees, rays, product.patches, shares);
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
