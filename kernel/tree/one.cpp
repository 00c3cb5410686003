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
template <template <class> class List, class Bound, class Item>
std::size_t list_kept(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, std::span<Item> kept,
                      const Excluding& excluding) {
  const kernel::Query<Bound> query({&shaft, 1}, tree, Question::kept, excluding);
  kernel::require_memory("kept", kept, items<Item>);
  query.require_apart("list", "kept", kernel::bytes_of(kept));
  SpanOutput<Item> output(kept);
  kernel::KeptLister lister(List<SpanOutput<Item>>(query.indices(), output));
  query.walk(0, lister);
  return output.count();
}

template <template <class> class List, class Bound, class Item>
KeptCounts list_classes(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, std::span<Item> overlap,
                        std::span<Item> inside, const Excluding& excluding) {
  const kernel::Query<Bound> query({&shaft, 1}, tree, Question::kept_and_inside, excluding);
  kernel::require_memory("overlap", overlap, items<Item>);
  kernel::require_memory("inside", inside, items<Item>);
  kernel::require_apart("list_classified", "overlap", kernel::bytes_of(overlap), "inside", kernel::bytes_of(inside));
  query.require_apart("list_classified", "overlap", kernel::bytes_of(overlap));
  query.require_apart("list_classified", "inside", kernel::bytes_of(inside));
  using Output = SpanOutput<Item>;
  Output overlaps(overlap);
  Output insides(inside);
  kernel::ClassLister lister(List<Output>(query.indices(), overlaps), List<Output>(query.indices(), insides));
  query.walk(0, lister);
  return {overlaps.count(), insides.count()};
}

}  // namespace

template <class Bound>
std::size_t count(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, const Excluding& excluding) {
  const kernel::Query<Bound> query({&shaft, 1}, tree, Question::kept, excluding);
  kernel::Counter counter(query.kernels());
  query.walk(0, counter);
  return counter.count();
}

template <class Bound>
std::size_t count_at_most(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, std::size_t most,
                          const Excluding& excluding) {
  const kernel::Query<Bound> query({&shaft, 1}, tree, Question::kept, excluding);
  if (most == 0) return 0;
  kernel::LimitedCounter counter(most);
  query.walk(0, counter);
  return counter.count();
}

template <class Bound>
KeptCounts count_classified(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, const Excluding& excluding) {
  const kernel::Query<Bound> query({&shaft, 1}, tree, Question::kept_and_inside, excluding);
  kernel::ClassCounter counter(query.kernels());
  query.walk(0, counter);
  return counter.counts();
}

template <class Bound>
std::size_t list(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, std::span<std::uint32_t> kept,
                 const Excluding& excluding) {
  return list_kept<IndexList>(shaft, tree, kept, excluding);
}
template <class Bound>
std::size_t list(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, std::span<LeafRange> kept,
                 const Excluding& excluding) {
  return list_kept<LeafRangeList>(shaft, tree, kept, excluding);
}

template <class Bound>
std::size_t list_at_most(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, std::span<std::uint32_t> kept,
                         const Excluding& excluding) {
  const kernel::Query<Bound> query({&shaft, 1}, tree, Question::kept, excluding);
  kernel::require_memory("kept", kept, items<std::uint32_t>);
  query.require_apart("list_at_most", "kept", kernel::bytes_of(kept));
  if (kept.empty()) return 0;
  SpanOutput<std::uint32_t> output(kept);
  using List = IndexList<SpanOutput<std::uint32_t>>;
  kernel::LimitedLister<List> lister(List(query.indices(), output), output, kept.size());
  query.walk(0, lister);
  return std::min(output.count(), kept.size());
}

template <class Bound>
KeptCounts list_classified(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, std::span<std::uint32_t> overlap,
                           std::span<std::uint32_t> inside, const Excluding& excluding) {
  return list_classes<IndexList>(shaft, tree, overlap, inside, excluding);
}
template <class Bound>
KeptCounts list_classified(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, std::span<LeafRange> overlap,
                           std::span<LeafRange> inside, const Excluding& excluding) {
  return list_classes<LeafRangeList>(shaft, tree, overlap, inside, excluding);
}

#define SHAFTCULL_QUERIES(Bound)                                                                                     \
  template std::size_t count(const CompiledShaft&, const BoundsTree<Bound>&, const Excluding&);                      \
  template std::size_t count_at_most(const CompiledShaft&, const BoundsTree<Bound>&, std::size_t, const Excluding&); \
  template std::size_t list_at_most(const CompiledShaft&, const BoundsTree<Bound>&, std::span<std::uint32_t>,        \
                                    const Excluding&);                                                               \
  template KeptCounts count_classified(const CompiledShaft&, const BoundsTree<Bound>&, const Excluding&);            \
  template std::size_t list(const CompiledShaft&, const BoundsTree<Bound>&, std::span<std::uint32_t>,                \
                            const Excluding&);                                                                       \
  template std::size_t list(const CompiledShaft&, const BoundsTree<Bound>&, std::span<LeafRange>, const Excluding&); \
  template KeptCounts list_classified(const CompiledShaft&, const BoundsTree<Bound>&, std::span<std::uint32_t>,      \
                                      std::span<std::uint32_t>, const Excluding&);                                   \
  template KeptCounts list_classified(const CompiledShaft&, const BoundsTree<Bound>&, std::span<LeafRange>,          \
                                      std::span<LeafRange>, const Excluding&);
SHAFTCULL_QUERIES(Box)
SHAFTCULL_QUERIES(Sphere)
#undef SHAFTCULL_QUERIES

}  // namespace shaftcull
