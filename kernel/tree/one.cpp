/// One shaft against a tree, into the caller's memory.
#include "tree/query.hpp"

namespace shaftcull {
namespace {

using kernel::Question;

template <class Bound>
std::size_t count_kept(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, const Excluding& excluding) {
  const kernel::Query<Bound> query({&shaft, 1}, tree, Question::kept, excluding);
  kernel::Counter counter;
  query.walk(0, counter);
  return counter.count();
}

/// `List` is kernel::IndexList or kernel::RunList.
template <template <class> class List, class Bound, class Item>
std::size_t list_kept(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, std::span<Item> kept,
                      const Excluding& excluding) {
  const kernel::Query<Bound> query({&shaft, 1}, tree, Question::kept, excluding);
  kernel::SpanOutput<Item> output(kept);
  kernel::KeptLister lister(List<kernel::SpanOutput<Item>>(query.order(), output));
  query.walk(0, lister);
  return output.count();
}

template <template <class> class List, class Bound, class Item>
KeptCounts list_classes(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, std::span<Item> overlap,
                        std::span<Item> inside, const Excluding& excluding) {
  const kernel::Query<Bound> query({&shaft, 1}, tree, Question::kept_and_inside, excluding);
  using Output = kernel::SpanOutput<Item>;
  Output overlaps(overlap);
  Output insides(inside);
  kernel::ClassLister lister(List<Output>(query.order(), overlaps), List<Output>(query.order(), insides));
  query.walk(0, lister);
  return {overlaps.count(), insides.count()};
}

}  // namespace

std::size_t count(const CompiledShaft& shaft, const BoxTree& tree, const Excluding& excluding) {
  return count_kept(shaft, tree, excluding);
}
std::size_t count(const CompiledShaft& shaft, const SphereTree& tree, const Excluding& excluding) {
  return count_kept(shaft, tree, excluding);
}

std::size_t cull(const CompiledShaft& shaft, const BoxTree& tree, std::span<std::uint32_t> kept,
                 const Excluding& excluding) {
  return list_kept<kernel::IndexList>(shaft, tree, kept, excluding);
}
std::size_t cull(const CompiledShaft& shaft, const SphereTree& tree, std::span<std::uint32_t> kept,
                 const Excluding& excluding) {
  return list_kept<kernel::IndexList>(shaft, tree, kept, excluding);
}
std::size_t cull(const CompiledShaft& shaft, const BoxTree& tree, std::span<TreeRun> kept, const Excluding& excluding) {
  return list_kept<kernel::RunList>(shaft, tree, kept, excluding);
}
std::size_t cull(const CompiledShaft& shaft, const SphereTree& tree, std::span<TreeRun> kept,
                 const Excluding& excluding) {
  return list_kept<kernel::RunList>(shaft, tree, kept, excluding);
}

KeptCounts classify(const CompiledShaft& shaft, const BoxTree& tree, std::span<std::uint32_t> overlap,
                    std::span<std::uint32_t> inside, const Excluding& excluding) {
  return list_classes<kernel::IndexList>(shaft, tree, overlap, inside, excluding);
}
KeptCounts classify(const CompiledShaft& shaft, const SphereTree& tree, std::span<std::uint32_t> overlap,
                    std::span<std::uint32_t> inside, const Excluding& excluding) {
  return list_classes<kernel::IndexList>(shaft, tree, overlap, inside, excluding);
}
KeptCounts classify(const CompiledShaft& shaft, const BoxTree& tree, std::span<TreeRun> overlap,
                    std::span<TreeRun> inside, const Excluding& excluding) {
  return list_classes<kernel::RunList>(shaft, tree, overlap, inside, excluding);
}
KeptCounts classify(const CompiledShaft& shaft, const SphereTree& tree, std::span<TreeRun> overlap,
                    std::span<TreeRun> inside, const Excluding& excluding) {
  return list_classes<kernel::RunList>(shaft, tree, overlap, inside, excluding);
}

}  // namespace shaftcull
