// SPDX-License-Identifier: MIT
/// sees/…: which patches of a scene see each other, against shadow rays by Embree, on one thread.
///
/// sees/SCENE/PAIRS/S/embree traces S shadow rays for each of some pairs of patches that face each other. Pairs are
/// those of a cluster of up to 64 patches with eight others: `near` in the same room or closer than 60 m, or
/// `anywhere`. An item is such a pair.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "harness/suite.hpp"
#include "scenes/city_blocks.hpp"
#include "scenes/interior.hpp"
#include "scenes/patch_pairs.hpp"
#include "scenes/shadow_rays.hpp"
#include "scenes/tree_scene.hpp"

#ifdef SHAFTCULL_BENCH_WITH_EMBREE
#include "peers/embree.hpp"
#endif

namespace shaftcull::bench {
namespace {

#ifdef SHAFTCULL_BENCH_WITH_EMBREE

constexpr std::size_t partners = 8;  // clusters that a cluster is asked about
constexpr float near_in_city = 60;   // metres

/// Products for so many rays a pair: Embree takes about as long for each.
constexpr std::size_t products_for(unsigned rays, bool quick) {
  return (quick ? 10 : 40) * 16 / rays + (quick ? 2 : 4);
}

struct Product {
  PatchProduct patches;
  std::vector<FacingPair> facing;
};

#endif

/// A scene and what is asked of it, made when it is first needed.
class SeesScene {
 public:
  SeesScene(std::string scene_name, PatchScene (*make)()) : name(std::move(scene_name)), make_(make) {}

  const PatchScene& scene() {
    return scene_.get([&] { return make_(); });
  }
#ifdef SHAFTCULL_BENCH_WITH_EMBREE
  const EmbreeScene& embree() {
    if (!embree_) embree_ = std::make_unique<EmbreeScene>(scene());
    return *embree_;
  }
  const std::vector<Product>& products(bool near) {
    return (near ? near_ : anywhere_).get([&] {
      const std::vector<PatchCluster> clusters = clusters_of(scene());
      const bool has_rooms = clusters.front().zone != clusters.back().zone;
      const auto are_near = [&](const PatchCluster& a, const PatchCluster& b) {
        return has_rooms ? a.zone == b.zone : distance(a.box, b.box) < near_in_city;
      };
      std::vector<Product> products;
      for (const PatchProduct& product :
           random_products(clusters, products_for(16, false), partners, near ? 4301 : 4302,
                           [&](const PatchCluster&a, const PatchCluster&b) { return !near || are_near(a, b); })) {
        products.push_back({product, facing_pairs(scene(), product)});
      }
      return products;
    });
  }
#endif

  const std::string name;

 private:
  PatchScene (*make_)();
  Lazy<PatchScene> scene_;
#ifdef SHAFTCULL_BENCH_WITH_EMBREE
  std::unique_ptr<EmbreeScene> embree_;
  Lazy<std::vector<Product>> near_;
  Lazy<std::vector<Product>> anywhere_;
#endif
};

#ifdef SHAFTCULL_BENCH_WITH_EMBREE

/// What part of `counts` was clear: what a user wants to know of a pair.
float share_of(RayCounts counts) {
  return counts.traced == 0 ? 0.0F : static_cast<float>(counts.clear) / static_cast<float>(counts.traced);
}

void declare_rays(Suite& suite, const std::shared_ptr<SeesScene>& sees, bool near, unsigned rays) {
  const std::size_t count = products_for(rays, suite.quick());
  const std::string row = fmt::format("sees/{}/{}/{}", sees->name, near ? "near" : "anywhere", rays);
  suite.add(row + "/embree", "",
            [=](benchmark::State& state) {
              const std::span<const Product> products = std::span(sees->products(near)).first(count);
              const EmbreeScene& embree = sees->embree();
              const ShadowRays shadow_rays(rays);
              std::vector<float> shares;
              std::int64_t pairs = 0;
              for (const Product& product : products) pairs += static_cast<std::int64_t>(product.facing.size());
              for (auto _ : state) {
                for (const Product& product : products) {
                  shares.resize(product.facing.size());
                  for (std::size_t i = 0; i != shares.size(); ++i) {
                    shares[i] = share_of(embree.trace(product.facing[i], shadow_rays));
                  }
                  benchmark::DoNotOptimize(shares.data());
                }
              }
              state.SetItemsProcessed(state.iterations() * pairs);
            },
            {.brief = true});
}

#endif

}  // namespace

void declare_sees(Suite& suite, const Workload& /*workload*/) {
  const auto inside = std::make_shared<SeesScene>("interior", [] { return interior(); });
  const auto outside = std::make_shared<SeesScene>("city", [] { return city_blocks(); });
#ifdef SHAFTCULL_BENCH_WITH_EMBREE
  for (const auto& scene : {inside, outside}) {
    for (const bool near : {true, false}) {
      for (const unsigned rays : {16U, 64U, 256U}) declare_rays(suite, scene, near, rays);
    }
  }
#else
  suite.note("sees/…/embree is not measured: this build found no Embree 3 (Debian: libembree-dev)");
#endif
}

}  // namespace shaftcull::bench
