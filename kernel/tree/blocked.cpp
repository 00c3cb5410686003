// SPDX-License-Identifier: MIT
/// blocked() and its like of trees, but for lists of many shafts, which many.cpp makes.
#include "shaftcull/blocked.hpp"

#include <algorithm>
#include <bit>

#include "parallel/parallel.hpp"
#include "tree/query.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

using kernel::Question;

bool is_blocked(const kernel::Query<Box>& query, std::size_t s) {
  kernel::Finder visitor;
  query.walk(s, visitor);
  return visitor.is_done();
}

/// Visitor that takes the first box in tree order, and then ends the walk.
class FirstFinder {
 public:
  explicit FirstFinder(const kernel::LeafIndices& indices) noexcept : indices_(indices) {}

  void word(std::size_t first, std::uint64_t kept, std::uint64_t /*inside*/) noexcept {
    if (kept != 0) found_ = indices_[first + static_cast<std::size_t>(std::countr_zero(kept))];
  }
  void range(std::size_t first, std::size_t /*size*/) noexcept { found_ = indices_[first]; }
  [[nodiscard]] bool is_done() const noexcept { return found_.has_value(); }
  [[nodiscard]] const std::optional<std::uint32_t>& found() const noexcept { return found_; }

 private:
  kernel::LeafIndices indices_;
  std::optional<std::uint32_t> found_;
};

}  // namespace

bool blocked(const CompiledShaft& shaft, const BoundsTree<Box>& solids, const Excluding& excluding) {
  const kernel::Query<Box> query({&shaft, 1}, solids, Question::blocking, excluding);
  return is_blocked(query, 0);
}

std::optional<std::uint32_t> blocked_by(const CompiledShaft& shaft, const BoundsTree<Box>& solids,
                                        const Excluding& excluding) {
  const kernel::Query<Box> query({&shaft, 1}, solids, Question::blocking, excluding);
  FirstFinder visitor(query.indices());
  query.walk(0, visitor);
  return visitor.found();
}

std::size_t list_blocking(const CompiledShaft& shaft, const BoundsTree<Box>& solids, std::span<std::uint32_t> blocking,
                          const Excluding& excluding) {
  const kernel::Query<Box> query({&shaft, 1}, solids, Question::blocking, excluding);
  kernel::require_memory("blocking", blocking, "indices");
  query.require_apart("list_blocking", "blocking", kernel::bytes_of(blocking));
  kernel::SpanOutput<std::uint32_t> output(blocking);
  kernel::KeptLister lister(kernel::IndexList<kernel::SpanOutput<std::uint32_t>>(query.indices(), output));
  query.walk(0, lister);
  return output.count();
}

void blocked_many(std::span<const CompiledShaft> shafts, const BoundsTree<Box>& solids,
                  std::span<std::uint64_t> blocked, const Excluding& excluding) {
  const kernel::Query<Box> query(shafts, solids, Question::blocking, excluding);
  kernel::require_shaft_bits("blocked", blocked, shafts.size());
  query.require_apart("blocked_many", "blocked", kernel::bytes_of(blocked));
  kernel::parallel_for(blocked.size(), 1, [&](std::size_t w, std::size_t) {  // no two tasks share a word
    std::uint64_t bits = 0;
    for (std::size_t s = 64 * w; s != std::min(shafts.size(), 64 * (w + 1)); ++s) {
      bits |= std::uint64_t{is_blocked(query, s)} << s % 64;
    }
    blocked[w] = bits;
  });
}

}  // namespace shaftcull
