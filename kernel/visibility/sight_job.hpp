// SPDX-License-Identifier: MIT
/// What a walk through products reads, and the answers that it writes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/turned_box.hpp"
#include "kernels/kernel_table.hpp"
#include "shaftcull/visibility.hpp"
#include "visibility/occluders.hpp"
#include "visibility/sight_set.hpp"

namespace shaftcull::kernel {

/// Everything that a walk reads.
struct SightJob {
  SightSet a;
  SightSet b;
  bool is_of_one_set;
  const OccluderData& occluders;
  std::span<const BoxRow> solids;               ///< as SolidRows has them
  const BoxClumps& occluder_clumps;             ///< of all occluders
  const BoxClumps& polygon_clumps;              ///< of all polygons
  const BoxClumps& solid_clumps;                ///< of all solids, and of more
  std::span<const TurnedBox> turned_occluders;  ///< around the points of each, if patches have corners
  const SiblingKernels& kernels;
  Contact contact;
  bool solids_around_ends;
  bool wants_blocks;      ///< else decided pairs are counted only
  bool wants_undecided;   ///< likewise
  bool wants_candidates;  ///< of undecided pairs
  bool wants_places;      ///< of undecided pairs among blocks

  /// How many pairs the product of two groups has.
  [[nodiscard]] std::uint64_t pairs(std::uint32_t a_group, std::uint32_t b_group) const noexcept;
};

/// What may stand between two groups, by numbers that ascend: of occluders, of merged solids, or of polygons.
struct SightLists {
  std::vector<std::uint32_t> candidates;
  std::vector<std::uint32_t> solids;  ///< the hulls among them come first
  std::vector<std::uint32_t> polygons;

  [[nodiscard]] std::size_t held_bytes() const noexcept;
};

/// Two groups, and what may stand between them.
struct PairBlockTask {
  std::uint32_t a;
  std::uint32_t b;
  SightLists lists;
};

/// Answers as they are found.
struct SightAnswers {
  SightCounts counts;
  std::vector<PairBlock> blocks;
  std::vector<PatchPair> undecided;
  std::vector<std::size_t> first_candidate{0};
  std::vector<std::uint32_t> candidates;
  std::vector<std::size_t> places;  ///< of each undecided pair, how many blocks were found before it

  void clear() noexcept;
  /// Bytes of what was found.
  [[nodiscard]] std::size_t memory_bytes() const noexcept;
  /// Bytes that are held for it, and for more.
  [[nodiscard]] std::size_t held_bytes() const noexcept;
};

}  // namespace shaftcull::kernel
