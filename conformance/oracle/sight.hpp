// SPDX-License-Identifier: MIT
/// What is true of a pair of patches, in exact integers and straight from the definitions (shaftcull/visibility.hpp).
/// Slow, and shares no code with the library.
///
/// Floats are integers times a power of two. Where all of a scene's together fit, these are 128-bit ones, else of any
/// length.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"

namespace shaftcull::oracle {

/// What may stand between: a box, or what has these corners.
struct SightOccluder {
  Box box;
  std::vector<Vec3> corners{};                   ///< none if it is the box
  std::vector<std::array<Vec3, 3>> triangles{};  ///< if not empty, one of these must reach into the shaft, too
};

/// What is asked about. `a_planes` and `b_planes` are empty or as many as patches. So are `a_corners` and `b_corners`;
/// a patch with corners has its plane from them unless it has `both_sides`, and its box is the one around them.
struct SightQuestion {
  std::vector<Box> a;
  std::vector<Plane> a_planes;
  std::vector<Box> b;
  std::vector<Plane> b_planes;
  std::vector<std::vector<Vec3>> a_corners{};
  std::vector<std::vector<Vec3>> b_corners{};
  bool both_sides = false;
  std::vector<SightOccluder> occluders;
  std::vector<Box> solids;                  ///< those that make pairs occluded
  std::vector<std::vector<Vec3>> hulls{};   ///< likewise: solid hulls of these points
  std::vector<std::vector<Vec3>> polygons;  ///< likewise: convex, all corners in one plane
  /// For each polygon the back polygon, if it is a plate, or none: it makes pairs occluded if both do.
  std::vector<std::vector<Vec3>> backs{};
  Contact contact = Contact::open;
  bool solids_around_ends = true;
  float tolerance = 0;
};

/// All that is true of a pair.
struct SightTruth {
  bool is_facing_away = false;
  bool is_occluded = false;
  std::vector<std::uint32_t> candidates{};  ///< those that reach into the shaft and in front of both planes
  [[nodiscard]] bool is_clear() const noexcept { return candidates.empty(); }
};

class SightOracle {
 public:
  explicit SightOracle(const SightQuestion& question);
  SightOracle(const SightOracle&) = delete;
  SightOracle& operator=(const SightOracle&) = delete;
  ~SightOracle();

  /// Of patch i of a and patch j of b.
  [[nodiscard]] SightTruth truth(std::size_t i, std::size_t j) const;

  /// Whether occluder k reaches into the shaft between both, planes left out.
  [[nodiscard]] bool reaches(std::size_t i, std::size_t j, std::size_t k) const;
  /// Whether solid k alone, a box, hides both from each other.
  [[nodiscard]] bool blocks(std::size_t i, std::size_t j, std::size_t k) const;
  /// Whether all of patch j of b is on or behind the plane of patch i of a.
  [[nodiscard]] bool is_behind(std::size_t i, std::size_t j) const;

  class Questions;

 private:
  std::unique_ptr<const Questions> questions_;
};

}  // namespace shaftcull::oracle
