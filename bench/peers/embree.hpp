// SPDX-License-Identifier: MIT
/// Embree, which what sees what is measured against: shadow rays between two patches.
#pragma once

#include <cstdint>
#include <memory>

#include "scenes/patch_pairs.hpp"
#include "scenes/patch_scene.hpp"
#include "scenes/shadow_rays.hpp"

namespace shaftcull::bench {

/// What became of a pair's rays. Those that leave or arrive behind a patch's plane are not traced and not counted.
struct RayCounts {
  std::uint16_t traced;
  std::uint16_t clear;  ///< of these, how many meet nothing
  friend bool operator==(const RayCounts&, const RayCounts&) = default;
};

/// A scene's triangles in Embree's tree, built at high quality on the library's instruction set, asked on the calling
/// thread by packets of as many rays as that has lanes.
class EmbreeScene {
 public:
  /// `scene` must outlive it.
  explicit EmbreeScene(const PatchScene& scene);
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;
  ~EmbreeScene();

  /// Rays a packet: 4, 8 or 16.
  [[nodiscard]] unsigned packet() const noexcept;

  /// Without rays that begin or end less than `least_height` above the other patch's plane, either.
  [[nodiscard]] RayCounts trace(const FacingPair& pair, const ShadowRays& rays, float least_height = 0) const;
  /// Rays lower than this above a plane may meet the surface that they come from, for all that is left out at their
  /// ends: rounding moves them, and the surface, as far.
  [[nodiscard]] float grazing_height() const noexcept;

 private:
  struct Handles;

  std::unique_ptr<Handles> handles_;
  const PatchScene& scene_;
};

}  // namespace shaftcull::bench
