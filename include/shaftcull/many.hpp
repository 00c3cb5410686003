// SPDX-License-Identifier: MIT
/// Many shafts against many bounds, in parallel.
///
/// Each verb means for every shaft what it means for one in cull.hpp; all take a view of boxes or spheres, or a stream.
///
/// Work is cut into tiles: bounds few enough for the cache, against a group of shafts. The cut depends only on the
/// sizes, never on the number of threads, and so do all results and their order. Calls run on oneTBB inside the
/// caller's task_arena (in a build without oneTBB, serially), and are safe to make from many threads. They take
/// O(shafts · bounds), and allocate what they say.
///
/// All parallel calls of the library, those of tree.hpp, query.hpp and refine.hpp too, may be made from within tasks of
/// the caller's own. Each has a task_group_context of its own: it is completed even where the caller's group is
/// cancelled, and tbb::task_group::cancel() does not end it. Each is isolated (tbb::this_task_arena::isolate): a thread
/// that waits inside a call takes none of the caller's other tasks, so a mutex may be held and thread_local state used
/// across it. Callbacks run on any thread of the arena, in the caller's floating-point modes.
///
/// A call takes at most 64 KiB of the stack, as does each of its tasks; what callbacks take comes on top.
///
/// A child of fork() has none of oneTBB's threads: it may make calls of one shaft, and parallel ones after it has begun
/// another program.
///
/// Errors are those of cull.hpp, found before anything is written.
///
/// If memory runs out (std::bad_alloc) or a callback throws, the call ends by that exception when its tasks have ended.
/// Lists are then as they were or empty, bits and counts are unspecified, and everything else is as it was.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/function_ref.hpp"
#include "shaftcull/results.hpp"
#include "shaftcull/streams.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Bits: row s (words_for(count of the view) words, rows one behind the other) gets what cull(shafts[s], …) gives.
/// `kept_rows` has exactly as many words as all rows.
/// Like all calls of this header that write bits or numbers, it allocates nothing but task memory of oneTBB.
SHAFTCULL_EXPORT void cull_many(std::span<const CompiledShaft> shafts, const BoxView& boxes,
                                std::span<std::uint64_t> kept_rows);
SHAFTCULL_EXPORT void cull_many(std::span<const CompiledShaft> shafts, const SphereView& spheres,
                                std::span<std::uint64_t> kept_rows);

/// Bits of both kinds, as classify(), in rows as those of cull_many(). Throws InvalidArgument if the two spans share
/// memory.
SHAFTCULL_EXPORT void classify_many(std::span<const CompiledShaft> shafts, const BoxView& boxes,
                                    std::span<std::uint64_t> kept_rows, std::span<std::uint64_t> inside_rows);
SHAFTCULL_EXPORT void classify_many(std::span<const CompiledShaft> shafts, const SphereView& spheres,
                                    std::span<std::uint64_t> kept_rows, std::span<std::uint64_t> inside_rows);

/// Bits of those inside alone, as contained(), in rows as those of cull_many().
SHAFTCULL_EXPORT void contained_many(std::span<const CompiledShaft> shafts, const BoxView& boxes,
                                     std::span<std::uint64_t> inside_rows);
SHAFTCULL_EXPORT void contained_many(std::span<const CompiledShaft> shafts, const SphereView& spheres,
                                     std::span<std::uint64_t> inside_rows);

/// Counts: kept_counts[s] becomes the number of bounds that shafts[s] keeps. One count for each shaft.
SHAFTCULL_EXPORT void count_many(std::span<const CompiledShaft> shafts, const BoxView& boxes,
                                 std::span<std::uint64_t> kept_counts);
SHAFTCULL_EXPORT void count_many(std::span<const CompiledShaft> shafts, const SphereView& spheres,
                                 std::span<std::uint64_t> kept_counts);

/// kept_counts[s] becomes count_at_most(shafts[s], …, most). One count for each shaft. A shaft that has found so many
/// is not tested with later tiles of bounds, as with any_many().
SHAFTCULL_EXPORT void count_at_most_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, std::size_t most,
                                         std::span<std::uint64_t> kept_counts);
SHAFTCULL_EXPORT void count_at_most_many(std::span<const CompiledShaft> shafts, const SphereView& spheres,
                                         std::size_t most, std::span<std::uint64_t> kept_counts);

/// Counts of both kinds: counts[s] becomes what count_classified(shafts[s], …) returns. One for each shaft.
SHAFTCULL_EXPORT void count_classified_many(std::span<const CompiledShaft> shafts, const BoxView& boxes,
                                            std::span<KeptCounts> counts);
SHAFTCULL_EXPORT void count_classified_many(std::span<const CompiledShaft> shafts, const SphereView& spheres,
                                            std::span<KeptCounts> counts);

/// One bit a shaft: bit s of `any` (word s / 64, bit s % 64) is set iff shafts[s] keeps any bound; bits past the last
/// shaft are zero. `any` has words_for(shafts.size()) words. A shaft that has kept one is not tested with later tiles
/// of bounds, so that time depends on where bounds are and, a little, on threads; bits do not.
SHAFTCULL_EXPORT void any_many(std::span<const CompiledShaft> shafts, const BoxView& boxes,
                               std::span<std::uint64_t> any);
SHAFTCULL_EXPORT void any_many(std::span<const CompiledShaft> shafts, const SphereView& spheres,
                               std::span<std::uint64_t> any);

/// Index lists in compressed sparse rows: what shaft s keeps is indices[offsets[s] … offsets[s + 1]), ascending.
struct IndexLists {
  std::vector<std::uint64_t> offsets;  ///< shafts + 1 of them, the first 0
  std::vector<std::uint32_t> indices;  ///< of all lists, one behind the other

  /// How many lists there are: one for each shaft.
  [[nodiscard]] std::size_t size() const noexcept { return offsets.empty() ? 0 : offsets.size() - 1; }
  /// `shaft` is below size(); not checked.
  [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t shaft) const noexcept {
    return {indices.data() + offsets[shaft], static_cast<std::size_t>(offsets[shaft + 1] - offsets[shaft])};
  }
};

/// Lists what each shaft keeps. Reuses the memory of `lists`; if this throws, they are as they were or empty. Throws
/// InvalidArgument if there are more than 2³² − 1 bounds, std::bad_alloc if memory runs out.
SHAFTCULL_EXPORT void list_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, IndexLists& lists);
SHAFTCULL_EXPORT void list_many(std::span<const CompiledShaft> shafts, const SphereView& spheres, IndexLists& lists);

/// Writes for each shaft what list_at_most() writes, the first indices of what it keeps, `most` of them or fewer: those
/// of shaft s from kept[s * most] on, and how many they are to kept_counts[s]. What is behind them is not written.
/// `kept` has room for exactly `most` indices a shaft, and kept_counts for one count. A shaft that has found so many is
/// not tested with later tiles of bounds. Work is divided by shafts alone. Throws InvalidArgument if there are more
/// bounds than an index can tell apart, and if the two spans share memory.
SHAFTCULL_EXPORT void list_at_most_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, std::size_t most,
                                        std::span<std::uint32_t> kept, std::span<std::uint64_t> kept_counts);
SHAFTCULL_EXPORT void list_at_most_many(std::span<const CompiledShaft> shafts, const SphereView& spheres,
                                        std::size_t most, std::span<std::uint32_t> kept,
                                        std::span<std::uint64_t> kept_counts);

/// Lists bounds that overlap and bounds inside apart. As list_many(), and InvalidArgument if both are the same lists.
SHAFTCULL_EXPORT void list_classified_many(std::span<const CompiledShaft> shafts, const BoxView& boxes,
                                           IndexLists& overlap, IndexLists& inside);
SHAFTCULL_EXPORT void list_classified_many(std::span<const CompiledShaft> shafts, const SphereView& spheres,
                                           IndexLists& overlap, IndexLists& inside);

/// What one shaft answers for one tile of bounds, [first, first + size); first is a multiple of 64.
/// Memory is the library's and is valid during the callback only.
struct TileAnswers {
  std::size_t shaft;                      ///< its position among those asked
  std::size_t first;                      ///< the first bound of the tile
  std::size_t size;                       ///< how many bounds the tile has
  std::span<const std::uint64_t> kept;    ///< bit i is bound first + i
  std::span<const std::uint64_t> inside;  ///< likewise; empty for for_each_tile()
};

/// What for_each_tile() and for_each_classified_tile() call.
using TileCallback = FunctionRef<void(const TileAnswers&)>;

/// Calls back once for every tile and shaft, one call at a time, ordered by tile and then by shaft; with bits of both
/// kinds for for_each_classified_tile(). An exception ends the call and reaches the caller; tiles after it are not
/// delivered. Throws InvalidArgument if the callback is empty. Allocates some tiles' bits for each thread.
SHAFTCULL_EXPORT void for_each_tile(std::span<const CompiledShaft> shafts, const BoxView& boxes, TileCallback callback);
SHAFTCULL_EXPORT void for_each_tile(std::span<const CompiledShaft> shafts, const SphereView& spheres,
                                    TileCallback callback);
SHAFTCULL_EXPORT void for_each_classified_tile(std::span<const CompiledShaft> shafts, const BoxView& boxes,
                                               TileCallback callback);
SHAFTCULL_EXPORT void for_each_classified_tile(std::span<const CompiledShaft> shafts, const SphereView& spheres,
                                               TileCallback callback);

/// How many threads a call from here would use (1 in a build without oneTBB).
[[nodiscard]] SHAFTCULL_EXPORT int concurrency() noexcept;

}  // namespace shaftcull
