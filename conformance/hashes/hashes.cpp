// SPDX-License-Identifier: MIT
#include "hashes/hashes.hpp"

namespace shaftcull::hashes {
namespace {

constexpr Way one_way[] = {Way::slab};
constexpr Way one_or_many[] = {Way::slab, Way::many};
constexpr Way all_ways[] = {Way::slab, Way::planes, Way::many};

constexpr Family all[] = {
    {"between", "shafts between two boxes, some with added planes; boxes and spheres: kept, inside", all_ways,
     between_boxes, 600, 3817, 0x1bec58e5794e5972U, 0x7e6ef6257acbc004U},
    {"between, open", "the same with open contact", all_ways, between_boxes_open, 600, 3817, 0xd109f63602a4369cU,
     0x39dee2658a060945U},
    {"moving", "swept boxes with and without an end, shadows; boxes and spheres: kept, inside", all_ways, moving_boxes,
     600, 3817, 0x88505ac1299f5486U, 0x746f452a79e06e8aU},
    {"moving, open", "the same with open contact", all_ways, moving_boxes_open, 600, 3817, 0xd4c784b8d488429cU,
     0x36969a3e8b182bbcU},
    {"hulls", "convex hulls with and without an end; boxes and spheres: kept, inside", all_ways, convex_hulls, 200,
     3817, 0x5464da35e3224d44U, 0x267eb03caece0e04U},
    {"hulls, open", "the same with open contact", all_ways, convex_hulls_open, 200, 3817, 0x6c0dea24a6e3b0f3U,
     0x51555a9b6127aa43U},
    {"hulls, triangles", "triangles, kept exactly by convex hulls, with closed and open contact", one_way,
     triangles_of_hulls, 200, 3817, 0x663deeb5ecc1f270U, 0x3cd056b7bbc17a38U},
    {"polygon shafts", "shafts between two polygons; boxes and spheres: kept, inside; triangles; occlusion", all_ways,
     polygon_shafts, 100, 2500, 0xb8849bebd263e530U, 0x947c0cd05017a2f9U},
    {"triangles, vertices", "triangles, kept by their vertices", one_way, triangles_by_vertices, 600, 7634,
     0x9f86b1662b335c9eU, 0xe2487f5892904c7dU},
    {"triangles, exact", "triangles, kept exactly", one_way, triangles_exactly, 600, 7634, 0x2f6d317107631001U,
     0x519a275f2e6f5064U},
    {"blocking", "which boxes block shafts between two boxes", one_way, what_blocks, 600, 7634, 0x0737d065e97c6ff2U,
     0x8748df6876a6c65fU},
    {"first contact", "the bound that a moving box reaches first, and the times at which it reaches bounds", all_ways,
     first_contacts, 600, 3817, 0x27caeb5e952bb7e6U, 0x1923864c03c1de61U},
    {"contact normals", "normals of contact of moving boxes with each bound alone", all_ways, contact_normals, 300,
     1900, 0x65b598401279b2b2U, 0x1efe37faf74bba1cU},
    {"trees of boxes", "tree order; lists, counts and first contacts", one_or_many, box_trees, 2, 21,
     0x38580d059d4c45b0U, 0x5e16d53c1c2344ecU},
    {"trees of spheres", "the same of spheres", one_or_many, sphere_trees, 2, 21, 0x9aa473044558ac90U,
     0x96e999e74229791bU},
    {"trees of triangles", "tree order, and lists of triangles", one_or_many, triangle_trees, 2, 21,
     0x41f602232f89e84bU, 0xea386fa648ca31efU},
    {"sights", "visibility of pairs: every answer, and candidates of undecided pairs", one_way, sights, 10, 421,
     0xb997649073f49f5eU, 0x3c5718ef23b17ab6U},
    {"facet sights", "the same of polygons, with and without a tolerance", one_way, facet_sights, 20, 2500,
     0x4e7f52924801e58dU, 0x9a1cce2b82953378U},
    {"solids", "boxes that are joined, and boxes inside hulls", one_way, solids, 100, 24391, 0xb60212bc1b5d9965U,
     0x8d8d9514e575687dU},
    {"found solids", "solids found in triangles: bodies, polygons and boxes inside bodies", one_way, found_solids, 200,
     10000, 0xa5eeda74133e859cU, 0x8c1867a973f32975U},
};

}  // namespace

std::span<const Family> families() noexcept { return all; }

std::vector<Deviation> deviations(const Family& family, bool quick, std::span<const Isa> isas) {
  std::vector<Deviation> found;
  const Isa before = active_isa();
  for (const Isa isa : isas) {
    select_isa(isa);
    for (const Way way : family.ways) {
      const std::uint64_t hash = family.hash_of(quick ? family.few : family.many, way);
      if (hash != (quick ? family.hash_of_few : family.hash_of_many)) found.push_back({isa, way, hash});
    }
  }
  select_isa(before);
  return found;
}

const char* name(Way way) noexcept {
  return way == Way::slab ? "slab form" : way == Way::planes ? "plane form" : "many shafts";
}

}  // namespace shaftcull::hashes
