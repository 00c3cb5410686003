// SPDX-License-Identifier: MIT
/// Walks through trees of triangles.
#include <algorithm>
#include <bit>

#include "query/bound_test.hpp"
#include "tree/tree_query.hpp"

namespace shaftcull::kernel {
namespace {

/// Visitor that tests the triangles of chunks that a walk keeps, in tree order.
class ChunkVisitor {
 public:
  static constexpr bool looks_into_leaves = true;

  ChunkVisitor(const TriangleParts& parts, const ShaftData& shaft, const BoundTest& test, bool tests_inside,
               const ExcludedIndices& excluded, LeafVisitor& visitor) noexcept
      : parts_(parts),
        shaft_(shaft),
        test_(test),
        excluded_(excluded),
        visitor_(visitor),
        tests_inside_(tests_inside) {}

  void word(std::size_t first, std::uint64_t kept, std::uint64_t /*inside*/) {
    while (kept != 0 && !is_done_) {
      const auto from = static_cast<unsigned>(std::countr_zero(kept));
      const auto leaves = static_cast<unsigned>(std::countr_one(kept >> from));
      const IndexRange range = parts_.triangles_of(first + from, leaves);
      const TriangleView part = parts_.triangles.view().slice(range.first, range.size);
      std::uint64_t bits[most_words];
      std::uint64_t inside[most_words];
      test_(shaft_, part.stream.data(), part.count, bits, tests_inside_ ? inside : nullptr);
      deliver(range, bits, tests_inside_ ? inside : nullptr);
      if (from + leaves == fanout) return;
      kept &= ~std::uint64_t{0} << (from + leaves);
    }
  }
  /// All of these chunks are inside, so their triangles are, too.
  void range(std::size_t first, std::size_t size) {
    for (std::size_t leaf = first; leaf < first + size && !is_done_; leaf += fanout) {
      const IndexRange range = parts_.triangles_of(leaf, fanout);
      std::uint64_t bits[most_words];
      std::fill_n(bits, bit_words(range.size), ~std::uint64_t{0});
      if (range.size % 64 != 0) bits[range.size / 64] = (std::uint64_t{1} << range.size % 64) - 1;
      deliver(range, bits, bits);
    }
  }
  [[nodiscard]] bool is_done() const noexcept { return is_done_; }

 private:
  static constexpr std::size_t most_words = fanout * TriangleTree::chunk_size / 64;

  /// Gives the visitor the triangles of a range. `inside` is null if it does not ask.
  void deliver(const IndexRange& range, const std::uint64_t* bits, const std::uint64_t* inside) {
    for (std::size_t w = 0; w != bit_words(range.size) && !is_done_; ++w) {
      const std::size_t first = range.first + 64 * w;
      const std::uint64_t kept = excluded_.is_on() ? not_left_out(first, bits[w]) : bits[w];
      if (kept != 0) is_done_ = !visitor_.word(first, kept, inside == nullptr ? 0 : inside[w] & kept);
    }
  }
  [[nodiscard]] std::uint64_t not_left_out(std::size_t first, std::uint64_t kept) const noexcept {
    for (std::uint64_t left = kept; left != 0; left &= left - 1) {
      if (excluded_.has(parts_.order[first + static_cast<std::size_t>(std::countr_zero(left))]))
        kept &= ~(left & -left);
    }
    return kept;
  }

  const TriangleParts& parts_;
  const ShaftData& shaft_;
  const BoundTest& test_;
  const ExcludedIndices excluded_;
  LeafVisitor& visitor_;
  bool tests_inside_;
  bool is_done_ = false;
};

}  // namespace

void TriangleQuery::walk_leaves(std::size_t s, LeafVisitor& visitor, const VisitorTraits& traits) const {
  const BoundTest test(kernels(), question(), BoundKind::triangles, options().triangle_test());
  const bool tests_inside = asks_for_inside(question());
  const WithPlanes with_planes(shaft(s), test.needs_planes(shaft(s)));
  ChunkVisitor chunks(parts_, with_planes.shaft(), test, tests_inside, options().excluded(s), visitor);
  WordByWord<ChunkVisitor> words(chunks);
  VisitorTraits of_chunks = WordByWord<ChunkVisitor>::traits;
  of_chunks.may_end_early = traits.may_end_early;
  of_chunks.reads_indices = false;
  static const TreeParts<Box> empty;
  const TreeParts<Box>* const chunk_tree = TreeAccess::parts(parts_.chunks);
  const TreeParts<Box>& boxes = chunk_tree == nullptr ? empty : *chunk_tree;
  in_float_environment([&] {
    const Exclusion nothing(LeafIndices(boxes.order, false, kernels()), {}, {});
    Walk<Box>(boxes, kernels(), with_planes.shaft(), Question::kept, nothing, words, of_chunks).run();
  });
}

}  // namespace shaftcull::kernel
