// SPDX-License-Identifier: MIT
/// Rays between two patches, for pairs of which shafts cannot tell.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "patches.hpp"

namespace shaftcull::cli {

/// Triangles of occluders, in doubles. Const members are safe to call from many threads.
class SightRays {
 public:
  /// Rays of each pair; their points depend on `seed` and the pair alone. With `both_sides` patches see backwards, too.
  SightRays(std::uint32_t rays, std::uint64_t seed, bool both_sides) : rays_(rays), seed_(seed), sides_(both_sides) {}

  /// Occluder after occluder, in the order in which the library numbers them. `triangles` are positions in `mesh`.
  void add_occluder(std::span<const MeshTriangle> mesh, std::span<const std::uint32_t> triangles);

  [[nodiscard]] std::uint32_t rays() const noexcept { return rays_; }

  /// How many of the rays between patches `a` and `b` of `patches` meet no triangle of these occluders, and leave and
  /// arrive in front. Points are spread evenly over both patches.
  [[nodiscard]] std::uint32_t seen(std::span<const MeshPatch> patches, std::uint32_t a, std::uint32_t b,
                                   std::span<const std::uint32_t> occluders) const;

 private:
  struct RayTriangle {
    Point3 vertex;
    Point3 edge[2];
    std::uint32_t number;  ///< in the mesh
  };
  struct RayOccluder {
    Point3 lo;
    Point3 hi;
    std::size_t end;  ///< of its triangles; they begin where those of the one before end
  };

  [[nodiscard]] bool is_hit(const RayOccluder& occluder, std::size_t first, const Point3& from, const Point3& way,
                            const MeshPatch& a, const MeshPatch& b) const;

  std::uint32_t rays_;
  std::uint64_t seed_;
  bool sides_;
  std::vector<RayTriangle> triangles_;
  std::vector<RayOccluder> occluders_;
};

}  // namespace shaftcull::cli
