// SPDX-License-Identifier: MIT
/// Many shafts against bounds, in parallel. Each verb means for every shaft what it means for one (cull.hpp).
///
/// Work is cut into tasks by the sizes alone, never by the number of threads, and so are all results and their order.
/// Calls run on oneTBB inside the caller's task_arena (in a build without oneTBB, serially), and are safe to make from
/// many threads.
///
/// All parallel calls of the library, trees and visibility included, may be made from within tasks of the caller's own.
/// Each has a task_group_context of its own: it is completed even where the caller's group is cancelled, and
/// tbb::task_group::cancel() does not end it. Each is isolated (tbb::this_task_arena::isolate): a thread that waits
/// inside a call takes none of the caller's other tasks, so a mutex may be held and thread_local state used across it.
///
/// A call takes at most 64 KiB of the stack, as does each of its tasks.
///
/// A child of fork() has none of oneTBB's threads: it may make calls for one shaft, and parallel ones after it has
/// begun another program.
///
/// Calls that write bits or numbers allocate nothing but task memory of oneTBB. Calls that list allocate the lists,
/// once in tasks and once for the caller; they reuse the memory of `lists`. Query::only adds a copy of the candidates'
/// bounds. If memory runs out (std::bad_alloc), the call ends by that exception when its tasks have ended. Lists are
/// then as they were or empty, bits and counts are unspecified, and everything else is as it was.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/query.hpp"
#include "shaftcull/results.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Row s of `kept_rows` gets the bits that cull(shafts[s], …) writes. Rows have bit_words(bounds.size()) words and lie
/// one behind the other, exactly one for each shaft.
SHAFTCULL_EXPORT void cull_many(std::span<const CompiledShaft> shafts, const Bounds& bounds,
                                std::span<std::uint64_t> kept_rows, const Query& query = no_options);

/// Bits of both kinds, as classify() writes them, in rows as those of cull_many(). `kept_rows` may be empty: then only
/// `inside_rows` is written.
SHAFTCULL_EXPORT void classify_many(std::span<const CompiledShaft> shafts, const Bounds& bounds,
                                    std::span<std::uint64_t> kept_rows, std::span<std::uint64_t> inside_rows,
                                    const Query& query = no_options);

/// kept_counts[s] becomes count(shafts[s], …). One count for each shaft. A shaft that has found Query::limit bounds is
/// not tested with later ones.
SHAFTCULL_EXPORT void count_many(std::span<const CompiledShaft> shafts, const Bounds& bounds,
                                 std::span<std::uint64_t> kept_counts, const Query& query = no_options);

/// counts[s] becomes count_classified(shafts[s], …). One for each shaft.
SHAFTCULL_EXPORT void count_classified_many(std::span<const CompiledShaft> shafts, const Bounds& bounds,
                                            std::span<KeptCounts> counts, const Query& query = no_options);

/// List s becomes the list of list(shafts[s], …). Throws InvalidArgument as list(), std::bad_alloc if memory runs out.
SHAFTCULL_EXPORT void list_many(std::span<const CompiledShaft> shafts, const Bounds& bounds, IndexLists& lists,
                                const Query& query = no_options);

/// Lists bounds that overlap and bounds inside apart, as list_classified(). Throws InvalidArgument if both are the same
/// lists.
SHAFTCULL_EXPORT void list_classified_many(std::span<const CompiledShaft> shafts, const Bounds& bounds,
                                           IndexLists& overlap, IndexLists& inside, const Query& query = no_options);

/// Bit s of `any` (word s / 64, bit s % 64) is set iff shafts[s] keeps any bound; bits past the last shaft are zero.
/// `any` has bit_words(shafts.size()) words. A shaft that has kept one is not tested with later bounds, so time depends
/// on where bounds are and, a little, on threads; bits do not.
SHAFTCULL_EXPORT void any_many(std::span<const CompiledShaft> shafts, const Bounds& bounds,
                               std::span<std::uint64_t> any, const Query& query = no_options);

/// How many threads a call from here would use (1 in a build without oneTBB).
[[nodiscard]] SHAFTCULL_EXPORT int concurrency() noexcept;

}  // namespace shaftcull
