// SPDX-License-Identifier: MIT
/// What objects see of each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sees_run.hpp"

namespace shaftcull::cli {

/// Of more objects there would be a table of more than two million rows.
inline constexpr std::size_t most_objects_in_pairs = 2000;

/// What patches of two objects see of each other.
struct ObjectPair {
  std::string a;
  std::string b;
  SightCounts sights;
  double rays_seen;  ///< share of the rays of undecided pairs that arrive; 0 without rays
};

/// Counts answers by the objects of their patches.
class ObjectSights final : public SummingSink {
 public:
  /// Throws InvalidArgument for more than most_objects_in_pairs.
  ObjectSights(const SeesScene& scene, std::span<const std::uint32_t> order, std::uint32_t rays);

  void take(const SightBatch& batch, std::span<const std::uint32_t> seen) override;
  void finish() override {}
  [[nodiscard]] std::span<std::uint64_t> sums() noexcept override { return sums_; }

  /// Each two objects, or one with itself, between which there are pairs.
  [[nodiscard]] std::vector<ObjectPair> pairs() const;

 private:
  static constexpr std::size_t numbers = 5;  ///< of two objects: pairs by Sight, then rays that arrive

  [[nodiscard]] std::uint64_t* row(std::uint32_t a, std::uint32_t b) noexcept;
  [[nodiscard]] std::uint32_t object_of(std::uint32_t patch) const;
  /// How many patches of a run each object has, of those that have any.
  [[nodiscard]] std::vector<std::array<std::uint32_t, 2>> objects_of(const PatchRun& run);

  const SeesScene& scene_;
  std::span<const std::uint32_t> order_;
  std::uint32_t rays_;
  std::vector<std::uint32_t> patches_of_;  ///< of each object in objects_of(), then 0 again
  std::vector<std::uint64_t>
      sums_;  ///< rows of `numbers`, of each two objects of which the first is not above the second
};

}  // namespace shaftcull::cli
