// SPDX-License-Identifier: MIT
/// Bounds trees: millions of bounds, still or moving, at a cost per query that grows with the number of results.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

#include "shaftcull/bounds.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/streams.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// The types that hold many bounds of one kind: as streams, and as records.
template <class Bound>
using ViewOf = std::conditional_t<std::is_same_v<Bound, Box>, BoxView, SphereView>;
template <class Bound>
using StridedOf = std::conditional_t<std::is_same_v<Bound, Box>, StridedBoxes, StridedSpheres>;

/// A tree of nodes with 64 children each, over bounds in memory of its own. The bounds are sorted so that neighbours in
/// space are neighbours in memory: the *tree order*. There are no pointers: entry i of a level is the box around
/// entries 64 i … 64 i + 63 of the level below. A visit to a node computes one word of answers with the tests of a flat
/// scan. Every answer therefore equals that of a flat scan (query.hpp).
///
/// Memory: the bounds, 4 bytes per bound for their order, and less than 2 % of both for nodes (spheres 2.5 %). The
/// first update by index or query with Query::only adds 4 bytes per bound, and layers add 4. A tree holds at most
/// 2³² − 1 bounds; more throw InvalidArgument. For more bounds, build one tree per slice, and add the start of the
/// slice to the indices in its results.
///
/// Building takes scratch memory, and frees it before it returns: 56 bytes per box and 48 per sphere. A tree of
/// 2²¹ bounds or more is built region by region in its final memory: that takes at most 8 bytes per box, 12 per sphere,
/// and 1 MiB per thread. Such a tree requests huge pages from the system.
///
/// Bounds come from views and streams, from records of all kinds, and from arrays. They are checked as in packing: a
/// NaN, lo > hi (except the empty box), a negative radius or half extent, a centre and half extent that are both
/// infinite on an axis, or a centre of a sphere that is not finite throws BadBound, which names the first bad bound.
///
/// A call that throws, std::bad_alloc included, leaves the tree as it was, except in one case: update() of all bounds
/// and refit() allocate nothing themselves, but if oneTBB cannot start their tasks, needs_refit() is true afterwards.
/// After such an update() each bound has its old value or its new value. Update again, or refit().
///
/// Building, updating and refitting run in parallel on oneTBB inside the caller's task_arena, isolated from the
/// caller's own tasks (many.hpp), and take at most 64 KiB of the stack. Const members and queries are safe to call from
/// many threads. To query the last frame while the next is made, keep two trees: update the first, query the second,
/// and swap them. Copies are deep. Moves are O(1) and leave an empty tree.
template <class Bound>
class BoundsTree {
  static_assert(std::is_same_v<Bound, Box> || std::is_same_v<Bound, Sphere>, "bounds are boxes or spheres");
  struct NoCentreExtents;  // never defined

 public:
  /// The types that bounds are read from: streams, and the user's own records.
  using View = ViewOf<Bound>;
  using Records = StridedOf<Bound>;
  /// Boxes by centre and half extents, for trees of boxes. Corners that are not floats are rounded outwards. For trees
  /// of spheres, there are no objects of this type.
  using CentreExtents = std::conditional_t<std::is_same_v<Bound, Box>, StridedCentreExtents, NoCentreExtents>;

  BoundsTree() noexcept;
  /// Copies and sorts the bounds. O(n log n). Bounds much larger than their share of space, and empty boxes, get nodes
  /// of their own, since they would make the nodes of other bounds large. The order depends only on the bounds and
  /// their indices, not on the number of threads.
  explicit BoundsTree(const View& bounds);
  explicit BoundsTree(const Records& bounds);
  explicit BoundsTree(std::span<const Bound> bounds);
  explicit BoundsTree(const CentreExtents& bounds);
  BoundsTree(const BoundsTree& other);
  BoundsTree& operator=(const BoundsTree& other);
  BoundsTree(BoundsTree&& other) noexcept;
  BoundsTree& operator=(BoundsTree&& other) noexcept;
  ~BoundsTree();

  /// The number of bounds.
  [[nodiscard]] std::size_t size() const noexcept;
  /// The bytes that the tree holds, padding included.
  [[nodiscard]] std::size_t memory_bytes() const noexcept;
  /// The bounds in tree order, with updates. Valid until the tree is assigned to, moved from, rebuilt or destroyed.
  [[nodiscard]] View leaves() const noexcept;
  /// The smallest box around all bounds; for spheres, the smallest up to rounding. The empty box if there are no
  /// bounds. O(1). Throws NeedsRefit if needs_refit().
  [[nodiscard]] Box box() const;
  /// order()[p] is the user's index of leaf p. Valid as long as leaves().
  [[nodiscard]] std::span<const std::uint32_t> order() const noexcept;

  /// Replaces every bound i with the value at i, and refits, in one pass. Records are faster than separate streams,
  /// since tree order jumps about in the user's memory. Throws InvalidArgument if the number of values is not size(),
  /// or if the values are the tree's own leaves().
  void update(const View& all);
  void update(const Records& all);
  void update(std::span<const Bound> all);
  void update(const CentreExtents& all);

  /// Replaces bound indices[i] with the value at i; if an index occurs twice, the last value counts. Queries throw
  /// NeedsRefit until refit() is called. O(indices.size()), except the first call, which is O(size()). Throws
  /// InvalidArgument for an index that is not below size(), if the numbers of indices and values differ, or if the
  /// values are among the tree's own leaves().
  void update(std::span<const std::uint32_t> indices, const View& bounds);
  void update(std::span<const std::uint32_t> indices, const Records& bounds);
  void update(std::span<const std::uint32_t> indices, std::span<const Bound> bounds);
  void update(std::span<const std::uint32_t> indices, const CentreExtents& bounds);

  /// Fits the nodes to bounds updated since the last refit: only the nodes above them if they are few, otherwise all
  /// nodes in one pass.
  void refit();
  /// Whether bounds were updated since the last refit.
  [[nodiscard]] bool needs_refit() const noexcept;

  /// Puts bounds into 32 layers, by which queries select bounds (Query::layer_mask). Bit l of layers[i] is set iff
  /// bound i is in layer l; a bound may be in several layers or in none. Layers stay with their bounds through updates,
  /// refit(), rebuild(), copies and reorder(). The call replaces all earlier layers. Throws InvalidArgument unless
  /// layers.size() is size(). O(size()).
  void set_layers(std::span<const std::uint32_t> layers);
  /// Replaces the layers of bound indices[i] with layers[i]; if an index occurs twice, the last value counts.
  /// O(indices.size()), except the first such call, which is O(size()) unless bounds were updated by index before.
  /// Throws InvalidArgument unless has_layers(), for an index that is not below size(), or if the two sizes differ.
  void set_layers(std::span<const std::uint32_t> indices, std::span<const std::uint32_t> layers);
  /// Removes all layers and frees their memory. has_layers() is false afterwards.
  void clear_layers() noexcept;
  /// Whether bounds were put into layers.
  [[nodiscard]] bool has_layers() const noexcept;
  /// layers()[p] are the layers of leaf p. Empty unless has_layers(). Valid as long as leaves(), until layers are set
  /// or cleared.
  [[nodiscard]] std::span<const std::uint32_t> layers() const noexcept;

  /// The growth of the smallest nodes, those just above the bounds, since the tree was built or rebuilt: the sum of
  /// their surfaces now, divided by the sum then; 1 at first. Queries slow down somewhat less than this ratio grows; at
  /// 2 or 3 a rebuild() pays off. Infinite nodes are left out. +∞ if the sum was 0 and is not 0 now. O(size() / 64).
  /// Throws NeedsRefit if needs_refit().
  [[nodiscard]] double sah_ratio() const;

  /// Sorts the present bounds again, and refits. The tree becomes the tree that would be built from the same bounds
  /// with the same indices, whatever happened to it before, so a second rebuild() moves nothing. Indices stay; order()
  /// changes. O(n log n). Takes the time and the memory of building; from 2²¹ bounds on, it also makes a copy of the
  /// bounds.
  void rebuild();

  /// Renumbers the bounds in tree order: the index of leaf p becomes p. Use it if you have sorted your own objects by
  /// order(), which is worthwhile if all objects move: update() then reads your memory from front to back, twice as
  /// fast. Since indices are different afterwards, a rebuild() may find another order.
  void reorder() noexcept;

 private:
  friend struct TreeAccess;  // queries read the parts
  struct Parts;
  std::unique_ptr<Parts> parts_;  // null for a tree that was never given any bounds
};

extern template class SHAFTCULL_EXPORT BoundsTree<Box>;
extern template class SHAFTCULL_EXPORT BoundsTree<Sphere>;

/// The two kinds of trees.
using BoxTree = BoundsTree<Box>;
using SphereTree = BoundsTree<Sphere>;

}  // namespace shaftcull
