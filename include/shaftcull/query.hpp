/// Shafts against bounds trees: what a flat scan would answer, without looking at every bound.
///
/// Bounds and indices are of the tree's kind: a vector passes for a span of them, and braces for `excluding`. Results
/// are in tree order (BoundsTree::order()), which depends on nothing but the bounds, by index, that the tree was last
/// built or rebuilt from: not on threads, instruction sets, or what happened before. A query throws InvalidArgument if
/// the tree needs a refit, if a shaft was formed without the answer asked for, if `excluding` does not fit, or if an
/// output shares memory with another output or with `excluding`; nothing is written then. Cost: about 20 ns for each
/// node or group of 64 bounds that the shaft reaches. Safe to call from many threads. Trees stay as they are, whatever
/// a query throws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <type_traits>
#include <vector>

#include "shaftcull/compiled.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/index.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/results.hpp"
#include "shaftcull/tree.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Leaves [first, first + size) of a tree: bounds order()[first] and so on.
template <BoundIndex Index>
struct TreeRunOf {
  Index first;
  Index size;
  friend bool operator==(const TreeRunOf&, const TreeRunOf&) = default;
};

/// Bounds that a query leaves out, by the user's indices.
template <BoundIndex Index>
struct ExcludingOf {
  /// A row for each shaft, all equally long: own.size() is a multiple of the number of shafts. A shaft's own two
  /// objects, say. All are below the tree's size().
  std::span<const Index> own{};
  /// Bit i of word i / 64 leaves bound i out for all shafts. Empty, or words_for(size()) words.
  std::span<const std::uint64_t> mask{};
};

/// Those of trees with 32-bit indices.
using TreeRun = TreeRunOf<std::uint32_t>;
using Excluding = ExcludingOf<std::uint32_t>;

// One shaft. Nothing is allocated. results.hpp says what happens to results that a span has no room for.

/// How many bounds the shaft keeps (which are not outside).
template <class Bound, BoundIndex Index>
[[nodiscard]] std::size_t count(const CompiledShaft& shaft, const BoundsTree<Bound, Index>& tree,
                                const std::type_identity_t<ExcludingOf<Index>>& excluding = {});

/// Writes the indices of the bounds that the shaft keeps, and returns how many there are.
template <class Bound, BoundIndex Index>
std::size_t cull(const CompiledShaft& shaft, const BoundsTree<Bound, Index>& tree,
                 std::type_identity_t<std::span<Index>> kept,
                 const std::type_identity_t<ExcludingOf<Index>>& excluding = {});

/// Writes the runs of leaves that the shaft keeps, each as long as can be, and returns how many there are.
template <class Bound, BoundIndex Index>
std::size_t cull(const CompiledShaft& shaft, const BoundsTree<Bound, Index>& tree,
                 std::type_identity_t<std::span<TreeRunOf<Index>>> kept,
                 const std::type_identity_t<ExcludingOf<Index>>& excluding = {});

/// As cull(), but bounds that overlap and bounds inside apart. Nothing below a node that is inside is tested.
template <class Bound, BoundIndex Index>
KeptCounts classify(const CompiledShaft& shaft, const BoundsTree<Bound, Index>& tree,
                    std::type_identity_t<std::span<Index>> overlap, std::type_identity_t<std::span<Index>> inside,
                    const std::type_identity_t<ExcludingOf<Index>>& excluding = {});
template <class Bound, BoundIndex Index>
KeptCounts classify(const CompiledShaft& shaft, const BoundsTree<Bound, Index>& tree,
                    std::type_identity_t<std::span<TreeRunOf<Index>>> overlap,
                    std::type_identity_t<std::span<TreeRunOf<Index>>> inside,
                    const std::type_identity_t<ExcludingOf<Index>>& excluding = {});

// Many shafts, in parallel. Results do not depend on the number of threads. If memory runs out (std::bad_alloc), counts
// are unspecified, and lists are as they were or empty.

/// kept_counts[s] becomes the number of bounds that shafts[s] keeps. One count for each shaft.
template <class Bound, BoundIndex Index>
void count_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound, Index>& tree,
                std::span<std::uint64_t> kept_counts, const std::type_identity_t<ExcludingOf<Index>>& excluding = {});

/// Runs in compressed sparse rows: those of shaft s are runs[offsets[s] … offsets[s + 1]), ascending.
template <BoundIndex Index>
struct RunListsOf {
  std::vector<std::uint64_t> offsets;  ///< shafts + 1 of them, the first 0
  std::vector<TreeRunOf<Index>> runs;

  [[nodiscard]] std::size_t size() const noexcept { return offsets.empty() ? 0 : offsets.size() - 1; }
  [[nodiscard]] std::span<const TreeRunOf<Index>> operator[](std::size_t shaft) const noexcept {
    return {runs.data() + offsets[shaft], static_cast<std::size_t>(offsets[shaft + 1] - offsets[shaft])};
  }
};
using RunLists = RunListsOf<std::uint32_t>;

/// Lists what each shaft keeps, as indices or as runs. Reuses the memory of the lists; if this throws, they are as they
/// were or empty.
template <class Bound, BoundIndex Index>
void list_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound, Index>& tree, IndexListsOf<Index>& kept,
               const std::type_identity_t<ExcludingOf<Index>>& excluding = {});
template <class Bound, BoundIndex Index>
void list_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound, Index>& tree, RunListsOf<Index>& kept,
               const std::type_identity_t<ExcludingOf<Index>>& excluding = {});

/// Likewise, but bounds that overlap and bounds inside apart.
template <class Bound, BoundIndex Index>
void list_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound, Index>& tree,
               IndexListsOf<Index>& overlap, IndexListsOf<Index>& inside,
               const std::type_identity_t<ExcludingOf<Index>>& excluding = {});
template <class Bound, BoundIndex Index>
void list_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound, Index>& tree, RunListsOf<Index>& overlap,
               RunListsOf<Index>& inside, const std::type_identity_t<ExcludingOf<Index>>& excluding = {});

/// What one shaft answers. Memory is the library's and is valid during the callback only.
template <BoundIndex Index>
struct ShaftAnswersOf {
  std::size_t shaft;
  std::span<const TreeRunOf<Index>> overlap;  ///< for cull_each() whatever is kept
  std::span<const TreeRunOf<Index>> inside;   ///< empty for cull_each()
};
using ShaftAnswers = ShaftAnswersOf<std::uint32_t>;

/// Called once for every shaft, one call at a time, in their order. An exception ends the run and reaches the caller;
/// shafts after it are not handed out.
template <BoundIndex Index>
using ShaftCallbackOf = std::function<void(const ShaftAnswersOf<Index>&)>;
using ShaftCallback = ShaftCallbackOf<std::uint32_t>;

template <class Bound, BoundIndex Index>
void cull_each(std::span<const CompiledShaft> shafts, const BoundsTree<Bound, Index>& tree,
               const std::type_identity_t<ShaftCallbackOf<Index>>& callback,
               const std::type_identity_t<ExcludingOf<Index>>& excluding = {});
template <class Bound, BoundIndex Index>
void classify_each(std::span<const CompiledShaft> shafts, const BoundsTree<Bound, Index>& tree,
                   const std::type_identity_t<ShaftCallbackOf<Index>>& callback,
                   const std::type_identity_t<ExcludingOf<Index>>& excluding = {});

}  // namespace shaftcull
