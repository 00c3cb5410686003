// SPDX-License-Identifier: MIT
/// Dynamic trees, whose bounds are inserted, erased and moved, and snapshots of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

#include "shaftcull/bounds.hpp"
#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// The id of a bound in a dynamic tree. Queries return its index. The index of an erased bound is used again, with the
/// next generation. So an id never denotes another bound of its tree, until an index has been used 2³² times.
struct BoundId {
  static constexpr std::uint32_t none = 0xFFFFFFFF;  ///< the index of no bound

  std::uint32_t index = none;    ///< the index that queries return; below TreeSnapshot::index_end()
  std::uint32_t generation = 0;  ///< how many bounds had the index before
  friend bool operator==(const BoundId&, const BoundId&) = default;
};

/// All layers (Query::layer_mask).
inline constexpr std::uint32_t all_layers = 0xFFFFFFFF;

/// The state of a dynamic tree after one commit. It never changes, whatever happens to the tree. Copies are O(1) and
/// share the state. Every query accepts a snapshot as its bounds. Safe to read from many threads.
template <class Bound>
class TreeSnapshot {
  static_assert(std::is_same_v<Bound, Box> || std::is_same_v<Bound, Sphere>, "bounds are boxes or spheres");

 public:
  TreeSnapshot() noexcept;  ///< the snapshot of a tree without bounds
  TreeSnapshot(const TreeSnapshot& other) noexcept;
  TreeSnapshot& operator=(const TreeSnapshot& other) noexcept;
  TreeSnapshot(TreeSnapshot&& other) noexcept;
  TreeSnapshot& operator=(TreeSnapshot&& other) noexcept;
  ~TreeSnapshot();

  /// The number of bounds.
  [[nodiscard]] std::size_t bound_count() const noexcept;
  /// All indices are below this number. Queries use it as the number of bounds: their bits and Query::exclude_mask have
  /// this many bits, and the bits of indices without a bound are 0. It never decreases during the life of a tree. An
  /// index without a bound is legal in Query::only and Query::exclude, and names an empty bound.
  [[nodiscard]] std::size_t index_end() const noexcept;
  /// Whether an index has a bound.
  [[nodiscard]] bool has(std::uint32_t index) const noexcept;
  /// The bound of an index. O(1). Throws InvalidArgument unless has(index).
  [[nodiscard]] Bound operator[](std::uint32_t index) const;
  /// The smallest box around all bounds; for spheres, the smallest up to rounding. The empty box if there are no
  /// bounds. O(number of bounds / 262,144).
  [[nodiscard]] Box box() const noexcept;

 private:
  friend struct DynamicAccess;  // queries read the state
  struct State;
  State* state_ = nullptr;  // shared; null without bounds
};

/// The work by which a dynamic tree stays fast.
struct TreeUpkeep {
  std::size_t blocks = 0;       ///< groups of up to 4,096 bounds, which are sorted together
  double sah_ratio = 1;         ///< as BoundsTree::sah_ratio(): the mean of the blocks, each since it was sorted
  std::size_t waiting = 0;      ///< bounds in blocks that have grown enough to be sorted again
  std::size_t sorted_last = 0;  ///< bounds that the last commit sorted
};

/// A tree of bounds that are inserted, erased and moved. Queries see the state of the last commit(). All verbs and
/// options work with a dynamic tree, or with a snapshot of it, as with a BoundsTree, and give the same answers for the
/// same bounds. Lists are in the order of the tree, which depends only on the calls that were made.
///
///     DynamicBoxTree bodies;
///     const BoundId id = bodies.insert(box);
///     bodies.commit();
///     list(shaft, bodies, kept);            // kept holds id.index
///     bodies.move(id, moved_box);
///     bodies.commit();
///
/// *Changes* are checked when they are made, and wait for the next commit(). Each is O(1). An id is valid at once, so a
/// bound may be moved or erased before the commit that makes it visible. Bounds are checked as in packing
/// (streams.hpp): BadBound for a NaN, lo > hi (except the empty box), a negative radius or a centre that is not finite.
/// An id without a bound, such as the id of an erased bound, causes InvalidArgument.
///
/// *Commits.* The cost of a commit depends on the number of changes. Bounds are stored in blocks of up to 4,096. A
/// commit writes to the blocks that contain changes, and fits the nodes above them. It re-sorts blocks that are too
/// full or too empty, and some of the blocks that have grown (set_sorted_per_change()). It re-sorts all bounds if half
/// as many bounds are inserted as the tree has. Bounds that are much larger than most have blocks of their own. A
/// commit runs in parallel, as building a tree does.
///
/// *When not to use it.* If all bounds move in each frame, BoundsTree::update() is many times faster. If no bounds are
/// inserted or erased, queries of a BoundsTree are faster.
///
/// *Threads.* One thread at a time makes changes and commits. Other threads take snapshots, and query them. Queries
/// never wait. While a snapshot of the last commit exists, the next commit copies each block that it changes. Otherwise
/// the commit changes blocks in place, and snapshot() waits until the commit ends.
///
/// *Errors.* A call that throws, std::bad_alloc included, leaves the tree, its changes and all snapshots as they were.
///
/// *Memory.* Each bound takes its own size, about 24 bytes more, and another 4 if any bound is not in all layers. A
/// tree of a few thousand bounds, or of bounds of very different sizes, takes up to twice as much, and a tree with any
/// bound at least about 140 kB. A pending change takes 32 bytes, or 24 for a sphere. The memory for changes may be up
/// to twice that. It is kept for the next commit, unless that has far fewer changes. A tree holds at most 2²⁹ bounds.
/// Moves are O(1) and leave an empty tree. A tree cannot be copied: copy its snapshots.
template <class Bound>
class DynamicTree {
 public:
  DynamicTree() noexcept;
  DynamicTree(DynamicTree&& other) noexcept;
  DynamicTree& operator=(DynamicTree&& other) noexcept;
  ~DynamicTree();

  /// Inserts a bound into the given layers, and returns its id.
  BoundId insert(const Bound& bound, std::uint32_t layers = all_layers);
  /// Inserts bounds, and writes the id of bound i to ids[i]. `layers` has one set of bits per bound; if it is empty,
  /// the bounds are in all layers. Throws InvalidArgument for spans of different sizes.
  void insert(std::span<const Bound> bounds, std::span<BoundId> ids, std::span<const std::uint32_t> layers = {});

  /// Erases bounds. Throws InvalidArgument for an id that occurs twice.
  void erase(BoundId id);
  void erase(std::span<const BoundId> ids);

  /// Gives bound ids[i] the value bounds[i]. If an id occurs twice, the last value counts.
  void move(BoundId id, const Bound& bound);
  void move(std::span<const BoundId> ids, std::span<const Bound> bounds);
  /// Moves bound ids[i] by the vector displacements[i]: coordinates are added in floats. Throws InvalidArgument for an
  /// id that occurs twice, and BadBound for a sum that is NaN or overflows.
  void move_by(BoundId id, const Vec3& displacement);
  void move_by(std::span<const BoundId> ids, std::span<const Vec3> displacements);
  /// Puts a bound into these layers, and out of all others.
  void set_layers(BoundId id, std::uint32_t layers);

  /// Makes all changes visible. O(changes), plus the upkeep: even without changes, a commit re-sorts some of the blocks
  /// that have grown.
  void commit();
  /// Makes all changes visible, and sorts all bounds again. O(n log n). Useful for a world that was built step by step
  /// and then stays the same.
  void rebuild();

  /// Whether an id has a bound, with all changes, committed or not.
  [[nodiscard]] bool has(BoundId id) const noexcept;
  /// The id of the bound that has this index now; its index is `none` if no bound has it.
  [[nodiscard]] BoundId id_of(std::uint32_t index) const noexcept;
  /// The value of a bound, with all changes, committed or not. Throws InvalidArgument unless has(id).
  [[nodiscard]] Bound operator[](BoundId id) const;
  /// The number of bounds, with all changes, committed or not.
  [[nodiscard]] std::size_t bound_count() const noexcept;
  /// The bytes that the tree and the state of its last commit hold.
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

  /// The state of the last commit. Safe to call from any thread at any time; waits for a commit that changes blocks in
  /// place (above).
  [[nodiscard]] TreeSnapshot<Bound> snapshot() const;
  /// The state of the last commit, for the thread that commits only: the reference is valid until the next commit.
  [[nodiscard]] const TreeSnapshot<Bound>& committed() const noexcept;

  /// Sets how many bounds a commit may re-sort per change; a bound that moves within its block counts an eighth of a
  /// change. The default is 2. A larger number keeps queries faster while bounds are inserted and erased, and makes
  /// commits slower. A commit may re-sort 1,024 bounds in addition. The part of this budget that a commit does not use
  /// is saved for later commits, up to a quarter of all bounds. With 0, blocks are sorted only if they are too full or
  /// too empty. Throws InvalidArgument for a negative or infinite number.
  void set_sorted_per_change(double sorted_per_change);
  /// The state of the upkeep after the last commit. O(blocks).
  [[nodiscard]] TreeUpkeep upkeep() const noexcept;

 private:
  friend struct DynamicAccess;  // images are written from its members
  struct Writer;
  [[nodiscard]] Writer& writer();
  std::unique_ptr<Writer> writer_;  // null for a tree that was never changed
};

extern template class SHAFTCULL_EXPORT TreeSnapshot<Box>;
extern template class SHAFTCULL_EXPORT TreeSnapshot<Sphere>;
extern template class SHAFTCULL_EXPORT DynamicTree<Box>;
extern template class SHAFTCULL_EXPORT DynamicTree<Sphere>;

/// The two kinds of dynamic trees, and of their snapshots.
using DynamicBoxTree = DynamicTree<Box>;
using DynamicSphereTree = DynamicTree<Sphere>;
using BoxTreeSnapshot = TreeSnapshot<Box>;
using SphereTreeSnapshot = TreeSnapshot<Sphere>;

}  // namespace shaftcull
