// SPDX-License-Identifier: MIT
/// Bounds in memory, in a tree: all of a job, or a share of them.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "batch/block_answer.hpp"
#include "batch/bounds_source.hpp"
#include "batch/question.hpp"
#include "batch/shaft_source.hpp"
#include "batch/share_plan.hpp"
#include "shaftcull/tree.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::batch {

/// A tree holds at most so many.
inline constexpr std::uint64_t most_bounds_a_share = 0xfffffffe;

/// Bytes a bound that building a share takes at its peak, and that it holds then; what is mapped from a file left out.
/// Of a share among several or of all bounds.
[[nodiscard]] std::uint64_t bytes_a_bound(BoundKind kind, bool several) noexcept;

/// How many bounds each share of a plan has, of those [first, first + count). Parallel.
[[nodiscard]] std::vector<std::uint64_t> share_sizes(const BoundsSource& bounds, const SharePlan& plan,
                                                     std::uint64_t first, std::uint64_t count);

/// What answers for a share of the bounds. Indices are positions in the file, whatever the share.
class Share {
 public:
  /// Reads all bounds, keeps those of share `which`, which are `size`, and sorts them into a tree; parallel. Throws
  /// InvalidArgument, which names file and row, for a bound that cannot be used.
  Share(const BoundsSource& bounds, const SharePlan& plan, std::size_t which, std::uint64_t size);

  /// Answers of shafts [first, first + count); parallel. Only shafts that meet the box around the share are asked
  /// about.
  [[nodiscard]] BlockAnswer answer(const ShaftSource& shafts, std::uint64_t first, std::uint64_t count,
                                   const Question& question) const;

 private:
  [[nodiscard]] std::uint64_t id(std::uint64_t local) const noexcept {
    return ids_.empty() ? local : ids_[static_cast<std::size_t>(local)];
  }
  void build(const BoundsSource& bounds, std::span<const float> floats);
  void add_answers(std::span<const CompiledShaft> shafts, std::span<const std::uint32_t> rows, const Question& question,
                   BlockAnswer& answer) const;

  std::variant<BoxTree, SphereTree, TriangleTree> tree_;
  std::vector<std::uint64_t> ids_;  ///< positions in the file, ascending; empty if all bounds are here
  bool several_ = false;            ///< whether there are other shares
  Box box_{};                       ///< around all of them
};

}  // namespace shaftcull::batch
