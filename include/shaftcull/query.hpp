/// Shafts against bounds trees: what a flat scan would answer, without looking at every bound.
///
/// Results are in tree order (BoundsTree::order()), which depends on the bounds alone. A query throws InvalidArgument
/// if the tree needs a refit, if a shaft was formed without the answer asked for, or if `excluding` does not fit. Cost:
/// about 20 ns for each node or group of 64 bounds that the shaft reaches. Safe to call from many threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "shaftcull/compiled.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/tree.hpp"

namespace shaftcull {

/// Leaves [first, first + size) of a tree: bounds order()[first] and so on.
struct TreeRun {
  std::uint32_t first;
  std::uint32_t size;
  friend bool operator==(const TreeRun&, const TreeRun&) = default;
};

/// Bounds that a query leaves out, by the user's indices.
struct Excluding {
  /// A row for each shaft, all equally long: own.size() is a multiple of the number of shafts. A shaft's own two
  /// objects, say.
  std::span<const std::uint32_t> own{};
  /// Bit i of word i / 64 leaves bound i out for all shafts. Empty, or words_for(size()) words.
  std::span<const std::uint64_t> mask{};
};

/// How many of each answer there are.
struct KeptCounts {
  std::size_t overlap;
  std::size_t inside;
  friend bool operator==(const KeptCounts&, const KeptCounts&) = default;
};

// One shaft. Nothing is allocated. Results that a span has no room for are counted, but not written: call again with
// as much room as the number returned, if that was more than there was.

/// How many bounds the shaft keeps (which are not outside).
[[nodiscard]] std::size_t count(const CompiledShaft& shaft, const BoxTree& tree, const Excluding& excluding = {});
[[nodiscard]] std::size_t count(const CompiledShaft& shaft, const SphereTree& tree, const Excluding& excluding = {});

/// Writes the indices of the bounds that the shaft keeps, and returns how many there are.
std::size_t cull(const CompiledShaft& shaft, const BoxTree& tree, std::span<std::uint32_t> kept,
                 const Excluding& excluding = {});
std::size_t cull(const CompiledShaft& shaft, const SphereTree& tree, std::span<std::uint32_t> kept,
                 const Excluding& excluding = {});

/// Writes the runs of leaves that the shaft keeps, each as long as can be, and returns how many there are.
std::size_t cull(const CompiledShaft& shaft, const BoxTree& tree, std::span<TreeRun> kept,
                 const Excluding& excluding = {});
std::size_t cull(const CompiledShaft& shaft, const SphereTree& tree, std::span<TreeRun> kept,
                 const Excluding& excluding = {});

/// As cull(), but bounds that overlap and bounds inside apart. Nothing below a node that is inside is tested.
KeptCounts classify(const CompiledShaft& shaft, const BoxTree& tree, std::span<std::uint32_t> overlap,
                    std::span<std::uint32_t> inside, const Excluding& excluding = {});
KeptCounts classify(const CompiledShaft& shaft, const SphereTree& tree, std::span<std::uint32_t> overlap,
                    std::span<std::uint32_t> inside, const Excluding& excluding = {});
KeptCounts classify(const CompiledShaft& shaft, const BoxTree& tree, std::span<TreeRun> overlap,
                    std::span<TreeRun> inside, const Excluding& excluding = {});
KeptCounts classify(const CompiledShaft& shaft, const SphereTree& tree, std::span<TreeRun> overlap,
                    std::span<TreeRun> inside, const Excluding& excluding = {});

// Many shafts, in parallel. Results do not depend on the number of threads.

/// kept_counts[s] becomes the number of bounds that shafts[s] keeps. One count for each shaft.
void count_many(std::span<const CompiledShaft> shafts, const BoxTree& tree, std::span<std::uint64_t> kept_counts,
                const Excluding& excluding = {});
void count_many(std::span<const CompiledShaft> shafts, const SphereTree& tree, std::span<std::uint64_t> kept_counts,
                const Excluding& excluding = {});

/// Runs in compressed sparse rows: those of shaft s are runs[offsets[s] … offsets[s + 1]), ascending.
struct RunLists {
  std::vector<std::uint64_t> offsets;  ///< shafts + 1 of them, the first 0
  std::vector<TreeRun> runs;

  [[nodiscard]] std::size_t size() const noexcept { return offsets.empty() ? 0 : offsets.size() - 1; }
  [[nodiscard]] std::span<const TreeRun> operator[](std::size_t shaft) const noexcept {
    return {runs.data() + offsets[shaft], static_cast<std::size_t>(offsets[shaft + 1] - offsets[shaft])};
  }
};

/// Lists what each shaft keeps, as indices or as runs. Reuses the memory of the lists.
void list_many(std::span<const CompiledShaft> shafts, const BoxTree& tree, IndexLists& kept,
               const Excluding& excluding = {});
void list_many(std::span<const CompiledShaft> shafts, const SphereTree& tree, IndexLists& kept,
               const Excluding& excluding = {});
void list_many(std::span<const CompiledShaft> shafts, const BoxTree& tree, RunLists& kept,
               const Excluding& excluding = {});
void list_many(std::span<const CompiledShaft> shafts, const SphereTree& tree, RunLists& kept,
               const Excluding& excluding = {});

/// Likewise, but bounds that overlap and bounds inside apart.
void list_many(std::span<const CompiledShaft> shafts, const BoxTree& tree, IndexLists& overlap, IndexLists& inside,
               const Excluding& excluding = {});
void list_many(std::span<const CompiledShaft> shafts, const SphereTree& tree, IndexLists& overlap, IndexLists& inside,
               const Excluding& excluding = {});
void list_many(std::span<const CompiledShaft> shafts, const BoxTree& tree, RunLists& overlap, RunLists& inside,
               const Excluding& excluding = {});
void list_many(std::span<const CompiledShaft> shafts, const SphereTree& tree, RunLists& overlap, RunLists& inside,
               const Excluding& excluding = {});

/// What one shaft answers. Memory is the library's and is valid during the callback only.
struct ShaftAnswers {
  std::size_t shaft;
  std::span<const TreeRun> overlap;  ///< for cull_each() whatever is kept
  std::span<const TreeRun> inside;   ///< empty for cull_each()
};

/// Called once for every shaft, one call at a time, in their order. An exception ends the run and reaches the caller.
using ShaftCallback = std::function<void(const ShaftAnswers&)>;

void cull_each(std::span<const CompiledShaft> shafts, const BoxTree& tree, const ShaftCallback& callback,
               const Excluding& excluding = {});
void cull_each(std::span<const CompiledShaft> shafts, const SphereTree& tree, const ShaftCallback& callback,
               const Excluding& excluding = {});
void classify_each(std::span<const CompiledShaft> shafts, const BoxTree& tree, const ShaftCallback& callback,
                   const Excluding& excluding = {});
void classify_each(std::span<const CompiledShaft> shafts, const SphereTree& tree, const ShaftCallback& callback,
                   const Excluding& excluding = {});

}  // namespace shaftcull
