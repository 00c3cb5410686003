// SPDX-License-Identifier: MIT
/// Scenes of the rows sees/…, and what is asked of them.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/suite.hpp"
#include "scenes/patch_pairs.hpp"
#include "scenes/tree_scene.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/visibility.hpp"

#ifdef SHAFTCULL_BENCH_WITH_EMBREE
#include "peers/embree.hpp"
#endif

namespace shaftcull::bench {

/// The instruction set that SHAFTCULL_ISA names, or the best one that the machine runs.
Isa measured_isa();

/// What solids that are turned hide by: their hulls, or the boxes inside them alone.
enum class TurnedSolids : unsigned char { hulls, boxes_inside };

/// Everything of a scene that may hide something: what is solid as such, meshes object by object. Ready for use: the
/// first call finds which solids are one.
Occluders occluders_of(const PatchScene& scene, TurnedSolids turned = TurnedSolids::hulls);

/// Patches by their corners, counterclockwise as seen from the front.
PatchSet polygons_of(const PatchScene& scene, std::span<const std::uint32_t> patches);

/// "4.8 % clear, 86.0 % occluded, …"
std::string shares_text(const SightCounts& counts);

#ifdef SHAFTCULL_BENCH_WITH_EMBREE

inline constexpr std::size_t partners = 32;  // clusters that a cluster is asked about
inline constexpr float near_in_city = 60;    // metres

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
  const Occluders& occluders_without_hulls() {
    return occluders_without_hulls_.get([&] { return occluders_of(scene(), TurnedSolids::boxes_inside); });
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
  Lazy<Occluders> occluders_without_hulls_;
#ifdef SHAFTCULL_BENCH_WITH_EMBREE
  std::unique_ptr<EmbreeScene> embree_;
  Lazy<std::vector<Product>> near_;
  Lazy<std::vector<Product>> anywhere_;
#endif
};

/// Adds rows of all pairs of patches by their corners.
void declare_corners(Suite& suite, const std::shared_ptr<SeesScene>& sees);

/// Adds the rows of all pairs in a room with a body of many triangles.
void declare_dense(Suite& suite);

#ifdef SHAFTCULL_BENCH_WITH_EMBREE
/// What rays are cast against: what is solid as such and meshes as triangles, or all as triangles.
enum class RayTargets : unsigned char { solids, triangles };

/// Adds the row of 16 rays for each undecided pair, by visible_fractions() alone, and Embree's.
void declare_undecided(Suite& suite, const std::shared_ptr<SeesScene>& sees, RayTargets targets, double target);

/// Adds rows of rays through one group of triangles, and Embree's.
void declare_groups(Suite& suite);

/// Adds the row of pairs that are `near` or anywhere, for so many rays per pair, and Embree's.
void declare_rays(Suite& suite, const std::shared_ptr<SeesScene>& sees, bool near, unsigned rays, double target);
#endif

}  // namespace shaftcull::bench
