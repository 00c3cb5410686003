// SPDX-License-Identifier: MIT
/// The ladder: groups of patches are compared before the patches in them.
///
/// A product is two groups, with the blockers that may stand between some of their patches. Their children are
/// compared: each child of the one with all of the other, each child of the other with all of the one, and then each
/// two that are left. Each time first what faces away, then what a solid blocks, then what nothing reaches into. What
/// is left is a product of its own, or a pair that is undecided.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "kernels/table.hpp"
#include "shaftcull/function_ref.hpp"
#include "shaftcull/visibility.hpp"
#include "visibility/blockers.hpp"
#include "visibility/patch_tree.hpp"

namespace shaftcull::kernel {

/// One of the two sets. Errors are those of computed distances from planes, for coordinates of this job.
struct SightSet {
  const PatchTree& tree;
  std::vector<float> patch_error;
  std::vector<float> group_error;
};

/// Everything that a walk reads.
struct SightJob {
  SightSet a;
  SightSet b;
  bool is_of_one_set;
  const BlockerData& blockers;
  const SiblingKernels& kernels;
  Contact contact;
  bool solids_around_ends;
  bool wants_products;    ///< else decided pairs are counted only
  bool wants_undecided;   ///< likewise
  bool wants_candidates;  ///< of undecided pairs

  /// How many pairs the product of two groups has.
  [[nodiscard]] std::uint64_t pairs(std::uint32_t a_group, std::uint32_t b_group) const noexcept;
};

/// What may stand between two groups, by numbers that ascend.
struct SightLists {
  std::vector<std::uint32_t> candidates;
  std::vector<std::uint32_t> solids;
  std::vector<std::uint32_t> polygons;
};

/// Two groups, and what may stand between them.
struct SightProductTask {
  std::uint32_t a;
  std::uint32_t b;
  SightLists lists;
};

/// Answers as they are found.
struct SightAnswers {
  SightCounts counts;
  std::vector<SightProduct> products;
  std::vector<PatchPair> undecided;
  std::vector<std::size_t> first_candidate{0};
  std::vector<std::uint32_t> candidates;

  void clear() noexcept;
  [[nodiscard]] std::size_t memory_bytes() const noexcept;
};

/// A walk through products, of one thread. Memory is kept from one to the next.
class Ladder {
 public:
  /// What is done with a product that is left to others; it may take its lists.
  using Leave = FunctionRef<void(SightProductTask&&)>;
  /// What is done when there are answers enough; it may take and clear them.
  using Full = FunctionRef<void()>;

  Ladder(const SightJob& job, SightAnswers& answers);
  Ladder(const Ladder&) = delete;
  Ladder& operator=(const Ladder&) = delete;
  ~Ladder();

  /// Answers all pairs of a product.
  void answer(SightProductTask&& task);
  /// Likewise, but calls full() between rows of pairs when the answers take `most_bytes` or more.
  void answer_in_parts(SightProductTask&& task, std::size_t most_bytes, const Full& full);
  /// Answers those of its products that have more than `most_pairs` pairs as far as groups do, and leaves the others in
  /// order: leave() is called after everything before them was answered.
  void split(SightProductTask&& task, std::uint64_t most_pairs, const Leave& leave);

 private:
  struct Side;
  struct Level;
  struct Selection;
  /// A group of patches and a blocker that has points. Bit i of `lanes` says that all points lie on or behind the plane
  /// of patch i of the group.
  struct PointsBehind {
    const PatchTree* tree = nullptr;
    std::uint32_t first = 0;  ///< position of the first patch of the group
    std::uint32_t blocker = 0;
    std::uint64_t lanes = 0;
  };

  Level& level(std::size_t depth);
  void enter(SightProductTask&& task);
  void descend(std::uint32_t a, std::uint32_t b, std::size_t depth);
  void walk(std::uint32_t a, std::uint32_t b, std::size_t depth);
  std::uint64_t compare_with_group(Level& level, const Side& lanes, const Side& group, bool lanes_are_rows,
                                   std::uint64_t rows);
  std::uint64_t drop_behind(const Level& level, const Side& lanes, std::vector<std::uint64_t>& kept);
  void go_into_itself(std::size_t depth, const Side& rows, unsigned row);
  void answer_row(std::size_t depth, const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes);
  void answer_patches(Level& here, const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes);
  [[nodiscard]] std::uint64_t block(const Selection& solids, const Selection& polygons, std::uint64_t asked);
  void select(const std::vector<std::uint32_t>& list, const std::vector<std::uint64_t>& of_rows,
              const std::vector<std::uint64_t>& of_columns, unsigned row, std::uint64_t lanes, bool packed,
              Selection& selection) const;
  void write_undecided(const Level& here, const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes);
  void form(const Side& fixed, unsigned lane, const Side& lanes, std::uint64_t asked);
  void form(const Side& fixed, unsigned lane, const float* const* boxes, unsigned count, std::uint64_t asked);
  void form_exchanged(const Side& fixed, unsigned lane, const Side& lanes, std::uint64_t asked);
  [[nodiscard]] std::uint64_t behind(const Side& lanes, std::uint32_t blocker, std::uint64_t asked);
  [[nodiscard]] std::uint64_t blocked_by_polygons(const std::uint32_t* polygons, std::size_t count,
                                                  const std::uint64_t* may_block, std::uint64_t asked) const;
  void decide_rows(const Side& rows, std::uint64_t which, const Side& columns, unsigned column, Sight sight);
  void decide(const Side& rows, unsigned row, const Side& columns, std::uint64_t which, Sight sight);
  [[nodiscard]] bool has_planes() const noexcept;
  void write(const PatchRun& a, const PatchRun& b, Sight sight);

  const SightJob& job_;
  SightAnswers& answers_;
  std::vector<std::unique_ptr<Level>> levels_;
  Siblings siblings_;
  PackedBoxes packed_;
  const float* packed_box_[6];
  float fixed_[6] = {};      // the box that all siblings_ begin at
  float exchanged_[6] = {};  // likewise of form_exchanged()
  std::vector<PointsBehind> points_behind_;
  const Side* rows_ = nullptr;  // of the product at hand
  std::uint64_t most_pairs_ = 0;
  const Leave* leave_ = nullptr;
  std::size_t most_bytes_ = 0;
  const Full* full_ = nullptr;
};

}  // namespace shaftcull::kernel
