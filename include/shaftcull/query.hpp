// SPDX-License-Identifier: MIT
/// Shafts against bounds trees: what a flat scan would answer, without looking at every bound.
///
/// *Verbs* are those of views (cull.hpp, many.hpp). Bounds and indices are of the tree's kind, and a vector or an array
/// passes for a span of them. Bits are by the user's index: bit i % 64 of word i / 64 is the bound with index i, and
/// all words are written. Lists are in tree order (BoundsTree::order()). That depends only on the bounds, by index,
/// that the tree was last built or rebuilt from.
///
/// *Excluding.* Every query can leave bounds out, as if the tree did not hold them: `{.own = indices}`,
/// `{.own = {3, 7}}`, `{.mask = words}`, `{.only_layers = {0b101}}`, or several of these (Excluding). Whole nodes of
/// bounds that are in none of the layers asked for are passed over without being tested.
///
/// *Results that do not fit* are counted and not written: see results.hpp.
///
/// *Errors.* Before anything is written, a query throws NeedsRefit if the tree needs a refit, and InvalidArgument if a
/// shaft was never formed or formed without the answer asked for, if `excluding` or the size of an output does not fit,
/// if a span is null that is not empty, or if an output shares memory with another output or with `excluding`. Trees
/// stay as they are, whatever a query throws.
///
/// *Cost.* About 20 ns for each node or group of 64 bounds that the shaft reaches, and what is written. Queries are
/// safe to call from many threads, and take at most 64 KiB of the stack. Those of one shaft allocate nothing; those of
/// many that write bits or numbers nothing but task memory of oneTBB; those that list allocate what they list, in tasks
/// and in the lists.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <span>
#include <vector>

#include "shaftcull/compiled.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/function_ref.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/results.hpp"
#include "shaftcull/tree.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Leaves [first, first + size) of a tree: bounds order()[first] and so on.
struct LeafRange {
  std::uint32_t first;  ///< the first leaf
  std::uint32_t size;   ///< how many leaves
  friend bool operator==(const LeafRange&, const LeafRange&) = default;
};

/// Numbers that a call reads: a span, which may be made of braces as those of C++26. What braces hold is gone at the
/// end of the statement, so write them in the call itself: `Excluding excluding{.own = {3, 7}};` refers to nothing
/// afterwards.
template <class Number>
struct SpanOrBraces : std::span<const Number> {
  constexpr SpanOrBraces() noexcept = default;
  using std::span<const Number>::span;  // NOLINT(modernize-use-equals-default): clang-tidy 14 takes it for a
                                        // constructor
  /// A span as it is.
  constexpr SpanOrBraces(std::span<const Number> numbers) noexcept  // NOLINT(google-explicit-constructor)
      : std::span<const Number>(numbers) {}
  /// What stands in braces, until the end of the statement.
  constexpr SpanOrBraces(std::initializer_list<Number> numbers) noexcept
      : std::span<const Number>(std::data(numbers), numbers.size()) {}
};

/// Bounds that a query leaves out.
struct Excluding {
  /// The user's indices: a row for each shaft, all equally long, so that own.size() is a multiple of the number of
  /// shafts. A shaft's own two objects, say. All are below the tree's size().
  SpanOrBraces<std::uint32_t> own{};
  /// Bit i % 64 of word i / 64 leaves bound i out for all shafts. Empty, or words_for(size()) words.
  std::span<const std::uint64_t> mask{};
  /// Layers, one set of them for each shaft, or one for all shafts: a shaft's query leaves out every bound that is in
  /// none of them, layers & only_layers == 0. Layers are bits, and the tree must have them (BoundsTree::set_layers()).
  /// Throws InvalidArgument for a tree of some bounds without layers, and unless there is one set, or one for each
  /// shaft. Empty: bounds of all layers, and of none, are asked about.
  SpanOrBraces<std::uint32_t> only_layers{};
};

// One shaft.

/// Culls: sets the bit of every bound that the shaft keeps (which is not outside). `kept` has exactly
/// words_for(tree.size()) words. O(size() / 64) for the words, and then as every query: a scan writes the bits of a
/// shaft that keeps much of what there is faster than a tree.
template <class Bound>
SHAFTCULL_EXPORT void cull(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, std::span<std::uint64_t> kept,
                           const Excluding& excluding = {});

/// Classifies: `kept` as in cull(), and in `inside` the bits of bounds that are fully inside the shaft. Both have
/// exactly words_for(tree.size()) words.
template <class Bound>
SHAFTCULL_EXPORT void classify(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, std::span<std::uint64_t> kept,
                               std::span<std::uint64_t> inside, const Excluding& excluding = {});

/// Sets the bits of bounds that are fully inside: the only question that a shaft formed for inside alone answers.
/// `inside` has exactly words_for(tree.size()) words.
template <class Bound>
SHAFTCULL_EXPORT void contained(const CompiledShaft& shaft, const BoundsTree<Bound>& tree,
                                std::span<std::uint64_t> inside, const Excluding& excluding = {});

/// Whether the shaft keeps any bound. Stops at the first one that it finds.
template <class Bound>
[[nodiscard]] SHAFTCULL_EXPORT bool any(const CompiledShaft& shaft, const BoundsTree<Bound>& tree,
                                        const Excluding& excluding = {});

/// How many bounds the shaft keeps.
template <class Bound>
[[nodiscard]] SHAFTCULL_EXPORT std::size_t count(const CompiledShaft& shaft, const BoundsTree<Bound>& tree,
                                                 const Excluding& excluding = {});

/// How many bounds the shaft keeps, or `most` if that is fewer: stops when it has found so many. To learn whether there
/// are more than n, ask for n + 1.
template <class Bound>
[[nodiscard]] SHAFTCULL_EXPORT std::size_t count_at_most(const CompiledShaft& shaft, const BoundsTree<Bound>& tree,
                                                         std::size_t most, const Excluding& excluding = {});

/// How many bounds overlap the shaft, and how many are inside it. Nothing below a node that is inside is tested.
template <class Bound>
[[nodiscard]] SHAFTCULL_EXPORT KeptCounts count_classified(const CompiledShaft& shaft, const BoundsTree<Bound>& tree,
                                                           const Excluding& excluding = {});

/// Writes the indices of the bounds that the shaft keeps, and returns how many there are.
template <class Bound>
[[nodiscard]] SHAFTCULL_EXPORT std::size_t list(const CompiledShaft& shaft, const BoundsTree<Bound>& tree,
                                                std::span<std::uint32_t> kept, const Excluding& excluding = {});

/// Writes the first indices that list() would write, until `kept` is full, and returns how many it wrote: it stops
/// there, and does not say whether there are more.
template <class Bound>
[[nodiscard]] SHAFTCULL_EXPORT std::size_t list_at_most(const CompiledShaft& shaft, const BoundsTree<Bound>& tree,
                                                        std::span<std::uint32_t> kept, const Excluding& excluding = {});

/// Writes the ranges of leaves that the shaft keeps, each as long as can be, and returns how many there are.
template <class Bound>
[[nodiscard]] SHAFTCULL_EXPORT std::size_t list(const CompiledShaft& shaft, const BoundsTree<Bound>& tree,
                                                std::span<LeafRange> kept, const Excluding& excluding = {});

/// As list(), but bounds that overlap and bounds inside apart. Nothing below a node that is inside is tested.
template <class Bound>
[[nodiscard]] SHAFTCULL_EXPORT KeptCounts list_classified(const CompiledShaft& shaft, const BoundsTree<Bound>& tree,
                                                          std::span<std::uint32_t> overlap,
                                                          std::span<std::uint32_t> inside,
                                                          const Excluding& excluding = {});
template <class Bound>
[[nodiscard]] SHAFTCULL_EXPORT KeptCounts list_classified(const CompiledShaft& shaft, const BoundsTree<Bound>& tree,
                                                          std::span<LeafRange> overlap, std::span<LeafRange> inside,
                                                          const Excluding& excluding = {});

// Many shafts, in parallel, as many.hpp says. Results do not depend on the number of threads. If memory runs out
// (std::bad_alloc), bits and counts are unspecified, and lists are as they were or empty.

/// Row s of the bits (words_for(tree.size()) words, rows one behind the other) gets what cull(shafts[s], …) gives, or
/// classify() or contained(). There are exactly as many rows as shafts.
template <class Bound>
SHAFTCULL_EXPORT void cull_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                                std::span<std::uint64_t> kept_rows, const Excluding& excluding = {});
template <class Bound>
SHAFTCULL_EXPORT void classify_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                                    std::span<std::uint64_t> kept_rows, std::span<std::uint64_t> inside_rows,
                                    const Excluding& excluding = {});
template <class Bound>
SHAFTCULL_EXPORT void contained_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                                     std::span<std::uint64_t> inside_rows, const Excluding& excluding = {});

/// One bit a shaft: bit s % 64 of word s / 64 of `any` is set iff shafts[s] keeps any bound; bits past the last shaft
/// are zero. `any` has exactly words_for(shafts.size()) words.
template <class Bound>
SHAFTCULL_EXPORT void any_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                               std::span<std::uint64_t> any, const Excluding& excluding = {});

/// kept_counts[s] becomes the number of bounds that shafts[s] keeps. One count for each shaft.
template <class Bound>
SHAFTCULL_EXPORT void count_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                                 std::span<std::uint64_t> kept_counts, const Excluding& excluding = {});

/// kept_counts[s] becomes count_at_most(shafts[s], tree, most, …). One count for each shaft.
template <class Bound>
SHAFTCULL_EXPORT void count_at_most_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                                         std::size_t most, std::span<std::uint64_t> kept_counts,
                                         const Excluding& excluding = {});

/// counts[s] becomes count_classified(shafts[s], …). One for each shaft.
template <class Bound>
SHAFTCULL_EXPORT void count_classified_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                                            std::span<KeptCounts> counts, const Excluding& excluding = {});

/// Leaf ranges in compressed sparse rows: those of shaft s are ranges[offsets[s] … offsets[s + 1]), ascending.
struct LeafRangeLists {
  std::vector<std::uint64_t> offsets;  ///< shafts + 1 of them, the first 0
  std::vector<LeafRange> ranges;       ///< of all lists, one behind the other

  /// How many lists there are: one for each shaft.
  [[nodiscard]] std::size_t size() const noexcept { return offsets.empty() ? 0 : offsets.size() - 1; }
  /// `shaft` is below size(); not checked.
  [[nodiscard]] std::span<const LeafRange> operator[](std::size_t shaft) const noexcept {
    return {ranges.data() + offsets[shaft], static_cast<std::size_t>(offsets[shaft + 1] - offsets[shaft])};
  }
};

/// Lists what each shaft keeps, as indices or as leaf ranges. Reuses the memory of `lists`; if this throws, they are as
/// they were or empty.
template <class Bound>
SHAFTCULL_EXPORT void list_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree, IndexLists& lists,
                                const Excluding& excluding = {});
template <class Bound>
SHAFTCULL_EXPORT void list_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                                LeafRangeLists& lists, const Excluding& excluding = {});

/// Writes for each shaft what list_at_most() writes, `most` indices or fewer: those of shaft s from kept[s * most] on,
/// and how many they are to kept_counts[s]. The rest of each row may be overwritten with anything. `kept` has room for
/// exactly `most` indices a shaft, and kept_counts for one count; the two share no memory.
template <class Bound>
SHAFTCULL_EXPORT void list_at_most_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                                        std::size_t most, std::span<std::uint32_t> kept,
                                        std::span<std::uint64_t> kept_counts, const Excluding& excluding = {});

/// Likewise, but bounds that overlap and bounds inside apart.
template <class Bound>
SHAFTCULL_EXPORT void list_classified_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                                           IndexLists& overlap, IndexLists& inside, const Excluding& excluding = {});
template <class Bound>
SHAFTCULL_EXPORT void list_classified_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                                           LeafRangeLists& overlap, LeafRangeLists& inside,
                                           const Excluding& excluding = {});

/// What one shaft keeps, as leaf ranges, for a callback. The ranges are the library's and valid during the callback
/// only.
struct KeptRanges {
  std::size_t shaft;                ///< its position among those asked
  std::span<const LeafRange> kept;  ///< what it keeps
};

/// Likewise, but bounds that overlap and bounds inside apart.
struct ClassifiedRanges {
  std::size_t shaft;                   ///< its position among those asked
  std::span<const LeafRange> overlap;  ///< what it keeps that is not inside
  std::span<const LeafRange> inside;   ///< what is inside
};

/// Calls callback(KeptRanges) or callback(ClassifiedRanges) once for every shaft, one call at a time, in their
/// order, while other threads go on with the next shafts. An exception of the callback ends the call and reaches the
/// caller; shafts after it are not handed out. Ranges are ascending and each as long as can be. The callback runs on
/// any thread of the arena (many.hpp). Throws InvalidArgument if it is empty. Allocates the ranges of eight shafts for
/// each thread.
template <class Bound>
SHAFTCULL_EXPORT void for_each_kept(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                                    FunctionRef<void(const KeptRanges&)> callback, const Excluding& excluding = {});
template <class Bound>
SHAFTCULL_EXPORT void for_each_classified(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                                          FunctionRef<void(const ClassifiedRanges&)> callback,
                                          const Excluding& excluding = {});

}  // namespace shaftcull
