// SPDX-License-Identifier: MIT
/// One shaft against a tree, into the caller's memory.
#include <algorithm>

#include "tree/query.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

using kernel::IndexList;
using kernel::LeafRangeList;
using kernel::Question;
using kernel::SpanOutput;

/// What messages about a null span call its items.
template <class Item>
constexpr const char* items = std::is_integral_v<Item> ? "indices" : "leaf ranges";

/// `List` is IndexList or LeafRangeList.
template <template <class, class> class List, class Bound, class Index, class Item>
std::size_t list_kept(const CompiledShaft& shaft, const BoundsTree<Bound, Index>& tree, std::span<Item> kept,
                      const ExcludingOf<Index>& excluding) {
  const kernel::Query<Bound, Index> query({&shaft, 1}, tree, Question::kept, excluding);
  kernel::require_memory("kept", kept, items<Item>);
  query.require_apart("list", "kept", kernel::bytes_of(kept));
  SpanOutput<Item> output(kept);
  kernel::KeptLister lister(List<Index, SpanOutput<Item>>(query.indices(), output));
  query.walk(0, lister);
  return output.count();
}

template <template <class, class> class List, class Bound, class Index, class Item>
KeptCounts list_classes(const CompiledShaft& shaft, const BoundsTree<Bound, Index>& tree, std::span<Item> overlap,
                        std::span<Item> inside, const ExcludingOf<Index>& excluding) {
  const kernel::Query<Bound, Index> query({&shaft, 1}, tree, Question::kept_and_inside, excluding);
  kernel::require_memory("overlap", overlap, items<Item>);
  kernel::require_memory("inside", inside, items<Item>);
  kernel::require_apart("list_classified", "overlap", kernel::bytes_of(overlap), "inside", kernel::bytes_of(inside));
  query.require_apart("list_classified", "overlap", kernel::bytes_of(overlap));
  query.require_apart("list_classified", "inside", kernel::bytes_of(inside));
  using Output = SpanOutput<Item>;
  Output overlaps(overlap);
  Output insides(inside);
  kernel::ClassLister lister(List<Index, Output>(query.indices(), overlaps),
                             List<Index, Output>(query.indices(), insides));
  query.walk(0, lister);
  return {overlaps.count(), insides.count()};
}

}  // namespace

template <class Bound, BoundIndex Index>
std::size_t count(const CompiledShaft& shaft, const BoundsTree<Bound, Index>& tree,
                  const std::type_identity_t<ExcludingOf<Index>>& excluding) {
  const kernel::Query<Bound, Index> query({&shaft, 1}, tree, Question::kept, excluding);
  kernel::Counter counter;
  query.walk(0, counter);
  return counter.count();
}

template <class Bound, BoundIndex Index>
std::size_t count_at_most(const CompiledShaft& shaft, const BoundsTree<Bound, Index>& tree, std::size_t most,
                          const std::type_identity_t<ExcludingOf<Index>>& excluding) {
  const kernel::Query<Bound, Index> query({&shaft, 1}, tree, Question::kept, excluding);
  if (most == 0) return 0;
  kernel::LimitedCounter counter(most);
  query.walk(0, counter);
  return counter.count();
}

template <class Bound, BoundIndex Index>
KeptCounts count_classified(const CompiledShaft& shaft, const BoundsTree<Bound, Index>& tree,
                            const std::type_identity_t<ExcludingOf<Index>>& excluding) {
  const kernel::Query<Bound, Index> query({&shaft, 1}, tree, Question::kept_and_inside, excluding);
  kernel::ClassCounter counter;
  query.walk(0, counter);
  return counter.counts();
}

template <class Bound, BoundIndex Index>
std::size_t list(const CompiledShaft& shaft, const BoundsTree<Bound, Index>& tree,
                 std::type_identity_t<std::span<Index>> kept,
                 const std::type_identity_t<ExcludingOf<Index>>& excluding) {
  return list_kept<IndexList>(shaft, tree, kept, excluding);
}
template <class Bound, BoundIndex Index>
std::size_t list(const CompiledShaft& shaft, const BoundsTree<Bound, Index>& tree,
                 std::type_identity_t<std::span<LeafRangeOf<Index>>> kept,
                 const std::type_identity_t<ExcludingOf<Index>>& excluding) {
  return list_kept<LeafRangeList>(shaft, tree, kept, excluding);
}

template <class Bound, BoundIndex Index>
std::size_t list_at_most(const CompiledShaft& shaft, const BoundsTree<Bound, Index>& tree,
                         std::type_identity_t<std::span<Index>> kept,
                         const std::type_identity_t<ExcludingOf<Index>>& excluding) {
  const kernel::Query<Bound, Index> query({&shaft, 1}, tree, Question::kept, excluding);
  kernel::require_memory("kept", kept, items<Index>);
  query.require_apart("list_at_most", "kept", kernel::bytes_of(kept));
  if (kept.empty()) return 0;
  SpanOutput<Index> output(kept);
  using List = IndexList<Index, SpanOutput<Index>>;
  kernel::LimitedLister<List, Index> lister(List(query.indices(), output), output, kept.size());
  query.walk(0, lister);
  return std::min(output.count(), kept.size());
}

template <class Bound, BoundIndex Index>
KeptCounts list_classified(const CompiledShaft& shaft, const BoundsTree<Bound, Index>& tree,
                           std::type_identity_t<std::span<Index>> overlap,
                           std::type_identity_t<std::span<Index>> inside,
                           const std::type_identity_t<ExcludingOf<Index>>& excluding) {
  return list_classes<IndexList>(shaft, tree, overlap, inside, excluding);
}
template <class Bound, BoundIndex Index>
KeptCounts list_classified(const CompiledShaft& shaft, const BoundsTree<Bound, Index>& tree,
                           std::type_identity_t<std::span<LeafRangeOf<Index>>> overlap,
                           std::type_identity_t<std::span<LeafRangeOf<Index>>> inside,
                           const std::type_identity_t<ExcludingOf<Index>>& excluding) {
  return list_classes<LeafRangeList>(shaft, tree, overlap, inside, excluding);
}

#define SHAFTCULL_QUERIES(Bound, Index)                                                                           \
  template std::size_t count(const CompiledShaft&, const BoundsTree<Bound, Index>&, const ExcludingOf<Index>&);   \
  template std::size_t count_at_most(const CompiledShaft&, const BoundsTree<Bound, Index>&, std::size_t,          \
                                     const ExcludingOf<Index>&);                                                  \
  template std::size_t list_at_most(const CompiledShaft&, const BoundsTree<Bound, Index>&, std::span<Index>,      \
                                    const ExcludingOf<Index>&);                                                   \
  template KeptCounts count_classified(const CompiledShaft&, const BoundsTree<Bound, Index>&,                     \
                                       const ExcludingOf<Index>&);                                                \
  template std::size_t list(const CompiledShaft&, const BoundsTree<Bound, Index>&, std::span<Index>,              \
                            const ExcludingOf<Index>&);                                                           \
  template std::size_t list(const CompiledShaft&, const BoundsTree<Bound, Index>&, std::span<LeafRangeOf<Index>>, \
                            const ExcludingOf<Index>&);                                                           \
  template KeptCounts list_classified(const CompiledShaft&, const BoundsTree<Bound, Index>&, std::span<Index>,    \
                                      std::span<Index>, const ExcludingOf<Index>&);                               \
  template KeptCounts list_classified(const CompiledShaft&, const BoundsTree<Bound, Index>&,                      \
                                      std::span<LeafRangeOf<Index>>, std::span<LeafRangeOf<Index>>,               \
                                      const ExcludingOf<Index>&);
SHAFTCULL_QUERIES(Box, std::uint32_t)
SHAFTCULL_QUERIES(Sphere, std::uint32_t)
SHAFTCULL_QUERIES(Box, std::uint64_t)
SHAFTCULL_QUERIES(Sphere, std::uint64_t)
#undef SHAFTCULL_QUERIES

}  // namespace shaftcull
