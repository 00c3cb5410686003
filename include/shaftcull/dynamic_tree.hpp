// SPDX-License-Identifier: MIT
/// Bounds trees of bounds that come, go and move, and snapshots of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

#include "shaftcull/bounds.hpp"
#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// A bound of a dynamic tree. Queries return the index of a bound. The index of an erased bound is used again, with the
/// next generation. So an id never means another bound of its tree, until an index was used 2³² times.
struct BoundId {
  static constexpr std::uint32_t none = 0xFFFFFFFF;  ///< the index of no bound

  std::uint32_t index = none;    ///< what queries return; below DynamicTree::index_end()
  std::uint32_t generation = 0;  ///< how often the index was used before
  friend bool operator==(const BoundId&, const BoundId&) = default;
};

/// All layers (Query::layer_mask).
inline constexpr std::uint32_t all_layers = 0xFFFFFFFF;

/// A state of a dynamic tree: that of one commit. It never changes, whatever becomes of the tree. Copies are O(1) and
/// share the state. Every query takes it as bounds. Safe to read from many threads.
template <class Bound>
class TreeSnapshot {
  static_assert(std::is_same_v<Bound, Box> || std::is_same_v<Bound, Sphere>, "bounds are boxes or spheres");

 public:
  TreeSnapshot() noexcept;  ///< of a tree without bounds
  TreeSnapshot(const TreeSnapshot& other) noexcept;
  TreeSnapshot& operator=(const TreeSnapshot& other) noexcept;
  TreeSnapshot(TreeSnapshot&& other) noexcept;
  TreeSnapshot& operator=(TreeSnapshot&& other) noexcept;
  ~TreeSnapshot();

  /// The number of bounds.
  [[nodiscard]] std::size_t count() const noexcept;
  /// All indices are below it. It is what queries call the number of bounds: their bits and Query::exclude_mask have
  /// this many, and bits of indices without a bound are 0. It never falls while a tree lives. In Query::only and
  /// Query::exclude such an index is legal, and names an empty bound.
  [[nodiscard]] std::size_t index_end() const noexcept;
  /// Whether an index has a bound.
  [[nodiscard]] bool has(std::uint32_t index) const noexcept;
  /// The bound of an index. O(1). Throws InvalidArgument unless has(index).
  [[nodiscard]] Bound operator[](std::uint32_t index) const;
  /// The box around all bounds: the smallest around boxes, and within rounding around spheres. The empty box if there
  /// are no bounds. O(number of bounds / 262,144).
  [[nodiscard]] Box box() const noexcept;

 private:
  friend struct DynamicAccess;  // queries read the state
  struct State;
  State* state_ = nullptr;  // shared; null without bounds
};

/// What a dynamic tree does to stay fast.
struct TreeUpkeep {
  std::size_t blocks = 0;       ///< groups of up to 4,096 bounds, which are sorted together
  double growth = 1;            ///< mean growth of the nodes just above bounds, by surface, since they were sorted
  std::size_t waiting = 0;      ///< bounds in blocks that have grown enough to be sorted again
  std::size_t sorted_last = 0;  ///< bounds that the last commit sorted
};

/// A tree of bounds that are inserted, erased and moved. Queries see the state of the last commit(). All verbs and
/// options take a dynamic tree, or a snapshot of it, as they take a BoundsTree, and give the same answers for the same
/// bounds; lists are in the order of the tree, which depends only on the calls that were made.
///
///     DynamicBoxTree bodies;
///     const BoundId id = bodies.insert(box);
///     bodies.commit();
///     list(shaft, bodies, kept);            // kept holds id.index
///     bodies.move(id, moved_box);
///     bodies.commit();
///
/// *Changes* are checked when they are made, and wait for the next commit(). Each is O(1). An id is valid at once, so a
/// bound may be moved or erased before the commit that would show it. Bounds are checked as in packing: BadBound for a
/// NaN, lo > hi (except the empty box), a negative radius or a centre that is not finite. An id of no bound, such as
/// that of an erased one, is an InvalidArgument.
///
/// *A commit* costs what has changed. Bounds are in blocks of up to 4,096. A commit writes to the blocks that changes
/// are in, and fits the nodes above. It sorts blocks again that are too full or too empty, and some of those that have
/// grown (set_upkeep()). It sorts everything if half as many bounds come as there are. Bounds much larger than most
/// have blocks of their own. Runs in parallel, as building a tree does.
///
/// *When not to use it.* If all bounds move in each frame, BoundsTree::update() is many times faster. If nothing comes
/// or goes, queries of a BoundsTree are faster.
///
/// *Threads.* One thread at a time makes changes and commits. Other threads take snapshots, and query them. Queries
/// never wait. While a snapshot of the last commit exists, the next commit copies each block that it changes. Without
/// one, it changes blocks where they are, and snapshot() waits until it ends.
///
/// *Errors.* A call that throws, std::bad_alloc included, leaves the tree, its changes and all snapshots as they were.
///
/// Memory: the bound, about 24 bytes more, and 4 if any bound is not in all layers. A change takes 32 bytes until the
/// commit. At most 2²⁹ bounds. Moves are O(1) and leave an empty tree. There are no copies: copy snapshots.
template <class Bound>
class DynamicTree {
 public:
  DynamicTree() noexcept;
  DynamicTree(DynamicTree&& other) noexcept;
  DynamicTree& operator=(DynamicTree&& other) noexcept;
  ~DynamicTree();

  /// Inserts a bound, in these layers.
  BoundId insert(const Bound& bound, std::uint32_t layers = all_layers);
  /// Inserts bounds, and writes the id of bound i to ids[i]. `layers` has one set of bits per bound, or is empty: all
  /// layers. Throws InvalidArgument for spans of different sizes.
  void insert(std::span<const Bound> bounds, std::span<BoundId> ids, std::span<const std::uint32_t> layers = {});

  /// Erases bounds. Throws InvalidArgument for an id that occurs twice.
  void erase(BoundId id);
  void erase(std::span<const BoundId> ids);

  /// Gives bound ids[i] the value at i. If an id occurs twice, the last value counts.
  void move(BoundId id, const Bound& bound);
  void move(std::span<const BoundId> ids, std::span<const Bound> bounds);
  /// Moves bound ids[i] by the vector at i: coordinates are added in floats. Throws InvalidArgument for an id that
  /// occurs twice, and BadBound for a sum that is NaN or overflows.
  void move_by(BoundId id, const Vec3& displacement);
  void move_by(std::span<const BoundId> ids, std::span<const Vec3> displacements);
  /// Puts a bound into other layers.
  void set_layers(BoundId id, std::uint32_t layers);

  /// Makes all changes visible. O(changes), and the upkeep: also without changes, some blocks that have grown are
  /// sorted again.
  void commit();
  /// The same, and sorts all bounds again. O(n log n). For a world that was built bit by bit and stays.
  void rebuild();

  /// Whether an id has a bound, with all changes.
  [[nodiscard]] bool has(BoundId id) const noexcept;
  /// The id that has this index now. The index is `none` if no bound has it.
  [[nodiscard]] BoundId id_of(std::uint32_t index) const noexcept;
  /// The value of a bound, with all changes. Throws InvalidArgument unless has(id).
  [[nodiscard]] Bound operator[](BoundId id) const;
  /// The number of bounds, with all changes.
  [[nodiscard]] std::size_t count() const noexcept;
  /// The bytes that the tree and its last state hold.
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

  /// The state of the last commit. Safe to call from any thread at any time; waits for a commit that changes blocks
  /// where they are (above).
  [[nodiscard]] TreeSnapshot<Bound> snapshot() const;
  /// The same, only for the thread that commits: the reference is valid until the next commit.
  [[nodiscard]] const TreeSnapshot<Bound>& committed() const noexcept;

  /// How many bounds commits sort again, at most, for each change; an eighth of that for a bound that moves within its
  /// block. The default is 2. More keep queries faster while bounds come and go, and make commits slower. To that come
  /// 1,024 per commit. What is not spent is saved for later commits, up to a quarter of all bounds. With 0, blocks are
  /// sorted only if they are too full or too empty. Throws InvalidArgument for a negative or infinite number.
  void set_upkeep(double sorted_per_change);
  /// The state of the upkeep after the last commit. O(blocks).
  [[nodiscard]] TreeUpkeep upkeep() const noexcept;

 private:
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
