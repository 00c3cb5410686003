// SPDX-License-Identifier: MIT
/// Bounds trees: millions of bounds, still or moving, at a cost a shaft that grows with what is found.
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

/// Many bounds of one kind, in streams and in records.
template <class Bound>
using ViewOf = std::conditional_t<std::is_same_v<Bound, Box>, BoxView, SphereView>;
template <class Bound>
using StridedOf = std::conditional_t<std::is_same_v<Bound, Box>, StridedBoxes, StridedSpheres>;

/// A tree of nodes with 64 children each over bounds in memory of its own, which are sorted so that neighbours in
/// space are neighbours in memory: the *tree order*. There are no pointers: entry i of a level is the box around
/// entries 64 i … 64 i + 63 of the level below, and a visit to a node is one word of answers of the same tests as
/// everywhere else. Every answer therefore equals that of a flat scan (see query.hpp for the questions).
///
/// Memory: the bounds, 4 bytes a bound for their order, and less than 2 % of both for nodes (spheres 2.5 %); 4 bytes a
/// bound more from the first update by index or query with Query::only on, and 4 bytes a bound for layers, if it has
/// any. A tree holds at most 2³² − 1 bounds; InvalidArgument for more. Of more bounds, build several trees, each of a
/// slice, and add where a slice begins to the indices of its answers.
///
/// Building takes scratch memory, which is free again when it returns: 56 bytes a box and 48 a sphere. Trees of 2²¹
/// bounds and more are built region by region, where they will be: that takes at most 8 bytes a box and 12 a sphere,
/// and 1 MiB a thread. They ask for huge pages.
///
/// Bounds come from views and streams, from records of all kinds, and from arrays. They are checked as in packing: a
/// NaN, lo > hi (but for the empty box), a negative radius or half extent, a centre and half extent that are both
/// infinite on an axis, or a centre of a sphere that is not finite throws BadBound, which names the first bad one.
///
/// A call that throws leaves the tree as it was, std::bad_alloc included, but for this: update() of all bounds and
/// refit() allocate nothing themselves, and if oneTBB cannot start their tasks, needs_refit() is true afterwards. After
/// such an update() each bound has its old value or its new one. Update again, or refit().
///
/// Building, updating and refitting run in parallel on oneTBB inside the caller's task_arena, apart from the caller's
/// own tasks (many.hpp), and take at most 64 KiB of the stack. Const members and queries are safe to call from many
/// threads. To ask the last frame while the next is made, keep two trees: update the one, ask the other, and swap them.
/// Copies are deep; moves are O(1) and leave an empty tree.
template <class Bound>
class BoundsTree {
  static_assert(std::is_same_v<Bound, Box> || std::is_same_v<Bound, Sphere>, "bounds are boxes or spheres");

 public:
  /// What bounds are read from: streams, and the user's own records.
  using View = ViewOf<Bound>;
  using Records = StridedOf<Bound>;

  BoundsTree() noexcept;
  /// Copies and sorts the bounds; O(n log n). Bounds much larger than their share of space, and empty boxes, are kept
  /// apart from the others, whose nodes they would spoil. The order depends on the bounds and their indices alone, not
  /// on the number of threads.
  explicit BoundsTree(const View& bounds);
  explicit BoundsTree(const Records& bounds);
  explicit BoundsTree(std::span<const Bound> bounds);
  /// Trees of boxes only. Corners that are not floats are rounded outwards.
  explicit BoundsTree(const StridedCentreExtents& bounds) requires std::is_same_v<Bound, Box>;
  BoundsTree(const BoundsTree& other);
  BoundsTree& operator=(const BoundsTree& other);
  BoundsTree(BoundsTree&& other) noexcept;
  BoundsTree& operator=(BoundsTree&& other) noexcept;
  ~BoundsTree();

  /// How many bounds it holds.
  [[nodiscard]] std::size_t size() const noexcept;
  /// Bytes that the tree holds, padding included.
  [[nodiscard]] std::size_t memory_bytes() const noexcept;
  /// The bounds in tree order. Valid until the tree is assigned to, moved from, rebuilt or destroyed; sees updates.
  [[nodiscard]] View leaves() const noexcept;
  /// The box around all bounds: the smallest around boxes, and around spheres within rounding. The empty box if there
  /// are none. O(1). Throws NeedsRefit if needs_refit().
  [[nodiscard]] Box box() const;
  /// order()[p] is the user's index of leaf p. Valid as leaves().
  [[nodiscard]] std::span<const std::uint32_t> order() const noexcept;

  /// Gives every bound a new value, bound i the value at i, and refits: one pass. Records are faster than separate
  /// streams, since tree order jumps about in the user's memory. Throws InvalidArgument unless there are size() of
  /// them, or if they are the tree's own leaves().
  void update(const View& all);
  void update(const Records& all);
  void update(std::span<const Bound> all);
  void update(const StridedCentreExtents& all) requires std::is_same_v<Bound, Box>;

  /// Gives bound indices[i] the value at i; if an index comes twice, the last value counts. Queries throw NeedsRefit
  /// until refit() is called. O(indices.size()), but for the first call, which is O(size()). Throws InvalidArgument for
  /// an index not below size(), unless there are as many indices as values, or if the values are among the tree's own
  /// leaves().
  void update(std::span<const std::uint32_t> indices, const View& bounds);
  void update(std::span<const std::uint32_t> indices, const Records& bounds);
  void update(std::span<const std::uint32_t> indices, std::span<const Bound> bounds);
  void update(std::span<const std::uint32_t> indices,
              const StridedCentreExtents& bounds) requires std::is_same_v<Bound, Box>;

  /// Fits the nodes to bounds updated since the last refit: those above them if they are few, else all in one pass.
  void refit();
  /// Whether bounds were updated since the last refit.
  [[nodiscard]] bool needs_refit() const noexcept;

  /// Puts bounds into layers, 32 of them, by which queries can pick (Query::layer_mask): bit l of layers[i] says
  /// that bound i is in layer l. A bound may be in several or in none. Layers belong to bounds as indices do: they stay
  /// through updates, refit(), rebuild() and copies, and move with their bounds when reorder() gives these other
  /// indices. Replaces the layers that there were. Throws InvalidArgument unless there are size() of them. O(size()).
  void set_layers(std::span<const std::uint32_t> layers);
  /// Puts bound indices[i] into layers[i] instead of those that it was in; if an index comes twice, the last counts.
  /// O(indices.size()), but for the first such call, which is O(size()) unless bounds were updated by index before.
  /// Throws InvalidArgument unless has_layers(), for an index not below size(), or unless there are as many of both.
  void set_layers(std::span<const std::uint32_t> indices, std::span<const std::uint32_t> layers);
  /// Forgets all layers and frees their memory: has_layers() is false then.
  void clear_layers() noexcept;
  /// Whether bounds were put into layers.
  [[nodiscard]] bool has_layers() const noexcept;
  /// layers()[p] are those of leaf p; empty unless has_layers(). Valid as leaves(), until layers are set or cleared.
  [[nodiscard]] std::span<const std::uint32_t> layers() const noexcept;

  /// How much larger the smallest nodes have become since the tree was built or rebuilt, 1 at first: the sum of their
  /// surfaces over what it was then. Queries slow down somewhat less than it grows; at 2 or 3 a rebuild() pays.
  /// Infinite nodes are left out. +∞ if the sum was 0 and is not now. O(size() / 64); throws NeedsRefit if
  /// needs_refit().
  [[nodiscard]] double sah_ratio() const;

  /// Sorts the bounds anew as they are now, and refits: the tree becomes the one that would be built of the same bounds
  /// with the same indices, whatever it went through before, so rebuilding it once more moves nothing. Indices stay;
  /// order() changes. O(n log n); takes as long and as much memory as building; from 2²¹ bounds on, a copy of the
  /// bounds more.
  void rebuild();

  /// Numbers the bounds anew, in tree order: the index of leaf p becomes p. For users who have sorted their own objects
  /// by order(), as they should if all of them move: update() then reads their memory from front to back, twice as
  /// fast. With other indices, a rebuild() may find another order.
  void reorder() noexcept;

 private:
  friend struct TreeAccess;  // queries read the parts
  struct Parts;
  std::unique_ptr<Parts> parts_;  // null for a tree that was never given any bounds
};

extern template class SHAFTCULL_EXPORT BoundsTree<Box>;
extern template class SHAFTCULL_EXPORT BoundsTree<Sphere>;

/// What trees are used as.
using BoxTree = BoundsTree<Box>;
using SphereTree = BoundsTree<Sphere>;

}  // namespace shaftcull
