// SPDX-License-Identifier: MIT
/// The walk of one shaft through a tree: word by word of answers, from the top down, in tree order.
///
/// Entries that are not outside name words to test one level down. A word is prefetched when it is named, and tested a
/// little later with others, because most of the time of a walk is that of reading memory. An entry that is inside, and
/// has nothing empty below, accepts its leaves as one range.
#pragma once

#include <cstddef>
#include <cstdint>

#include "compiled/contact.hpp"
#include "compiled/with_planes.hpp"
#include "kernels/kernel_table.hpp"
#include "query/counters.hpp"
#include "query/question.hpp"
#include "support/compiler.hpp"
#include "support/prefetch.hpp"
#include "tree/exclusion.hpp"
#include "tree/parts.hpp"

namespace shaftcull::kernel {

/// What becomes of the leaves that a walk finds. Is given all that the shaft keeps, in tree order.
class LeafVisitor {
 public:
  /// All return whether the walk goes on.
  virtual bool words(const FoundWords& found) = 0;
  /// Up to 64 things from position `first` on, any position. For walks whose leaves are boxes around them.
  virtual bool word(std::size_t first, std::uint64_t kept, std::uint64_t inside) = 0;
  /// Leaves that are all inside, whole words.
  virtual bool range(std::size_t first, std::size_t size) = 0;

 protected:
  LeafVisitor() noexcept = default;
  LeafVisitor(const LeafVisitor&) noexcept = default;
  LeafVisitor& operator=(const LeafVisitor&) noexcept = default;
  ~LeafVisitor() = default;
};

/// What a walk does differently for some visitors.
struct VisitorTraits {
  bool may_end_early = false;      ///< few words are tested at once: those in vain cost more than a call for each
  bool reads_indices = false;      ///< prefetches the user's indices of leaves
  bool looks_into_leaves = false;  ///< leaves are boxes around what it looks for: tested as nodes are
};

/// Gives a visitor everything that the shaft keeps and the exclusion does not leave out.
template <class Bound>
class Walk {
 public:
  Walk(const TreeLevels<Bound>& parts, const Kernels& kernels, const ShaftData& shaft, Question question,
       const Exclusion& exclusion, LeafVisitor& visitor, const VisitorTraits& traits) noexcept;
  Walk(const Walk&) = delete;
  Walk& operator=(const Walk&) = delete;

  void run();

 private:
  /// Words tested at once: of leaves they fill the first-level cache and not much of the second.
  static constexpr std::size_t most_in_batch = 32;
  static constexpr std::size_t few_in_batch = 4;

  /// For Question::kept a range only saves time, so only nodes with many kept children are tested for inside.
  static constexpr unsigned many_kept = 48;

  /// Prefetches a word of entries of level `k`.
  SHAFTCULL_ALWAYS_INLINE void prefetch(std::size_t k, std::size_t word) const noexcept {
    if (!prefetches_) return;
    const std::size_t first = word * fanout;
    if (k == 0) {
      const float* const* const stream = parts_.streams_at(first);
      const std::size_t at = parts_.place_in_streams(first);
      for (std::size_t r = 0; r != rows_of<Bound>; ++r) prefetch_to_second_level(stream[r] + at, fanout);
      if (traits_.reads_indices || excludes_) exclusion_.prefetch(first);
    } else {
      for (const float* const row : parts_.node_words(k, first, 1).stream) prefetch_to_second_level(row, fanout);
    }
  }

  void visit(std::size_t k, const std::uint32_t* word, std::size_t words);
  void visit_leaves(const std::uint32_t* word, std::size_t words);
  void test_blocks(const ShaftData& shaft, const std::uint32_t* word, std::size_t words, std::uint64_t* kept,
                   std::uint64_t* inside) const noexcept;
  void visit_range(std::size_t first, std::size_t size);
  void visit_range_in_part(std::size_t first, std::size_t size);
  void visit_range_of_blocks(std::size_t first, std::size_t size);
  std::uint64_t touching_nothing(const BoxView& nodes, std::size_t first, std::uint64_t inside) const noexcept;

  const TreeLevels<Bound>& parts_;
  TestListedWords* test_leaves_;
  TestListedWords* test_nodes_;
  bool prefetches_;
  bool is_done_ = false;
  Question question_;
  VisitorTraits traits_;
  LeafVisitor& visitor_;
  const Exclusion& exclusion_;
  bool excludes_;
  WithPlanes with_planes_;
  const ShaftData& shaft_;
  WithClosedContact of_nodes_;
  bool tests_inside_;
};

extern template class Walk<Box>;
extern template class Walk<Sphere>;

}  // namespace shaftcull::kernel
