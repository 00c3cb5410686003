// SPDX-License-Identifier: MIT
#include "tree/tree_answers.hpp"

#include <algorithm>

namespace shaftcull::kernel {
namespace {

using SpanList = IndexList<SpanOutput<std::uint32_t>>;

/// A row of bits, all zero.
IndexBits empty_row(const TreeQuery& query, std::uint64_t* words) noexcept {
  std::fill_n(words, query.row_words(), 0);
  return {query.indices(), words};
}

}  // namespace

void write_bits(const TreeQuery& query, std::size_t s, std::uint64_t* kept, std::uint64_t* inside) {
  if (inside == nullptr) {
    KeptLister visitor(empty_row(query, kept));
    query.walk(s, visitor);
  } else if (kept == nullptr) {
    InsideLister visitor(empty_row(query, inside));
    query.walk(s, visitor);
  } else {
    KeptAndInsideLister visitor(empty_row(query, kept), empty_row(query, inside));
    query.walk(s, visitor);
  }
}

std::size_t list(const TreeQuery& query, std::size_t s, std::span<std::uint32_t> kept, std::size_t limit) {
  if (limit == 0) return 0;
  SpanOutput<std::uint32_t> output(kept);
  if (limit == Query::no_limit) {
    KeptLister lister(SpanList(query.indices(), output));
    query.walk(s, lister);
  } else {
    LimitedLister lister(SpanList(query.indices(), output), limit);
    query.walk(s, lister);
  }
  return output.count();
}

KeptCounts list_classified(const TreeQuery& query, std::size_t s, std::span<std::uint32_t> overlap,
                           std::span<std::uint32_t> inside) {
  SpanOutput<std::uint32_t> overlaps(overlap);
  SpanOutput<std::uint32_t> insides(inside);
  ClassLister lister(SpanList(query.indices(), overlaps), SpanList(query.indices(), insides));
  query.walk(s, lister);
  return {overlaps.count(), insides.count()};
}

std::optional<std::uint32_t> first_kept(const TreeQuery& query, std::size_t s) {
  FirstFinder visitor(query.indices());
  query.walk(s, visitor);
  return visitor.found();
}

}  // namespace shaftcull::kernel
