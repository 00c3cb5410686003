// SPDX-License-Identifier: MIT
/// Queries of many shafts against bounds, in parallel. For every shaft, each verb means the same as for one shaft
/// (cull.hpp).
///
/// Sizes alone determine the tasks. So the tasks, the results and their order do not depend on the number of threads.
/// Calls run on oneTBB inside the caller's task_arena (in a build without oneTBB, serially), or on the caller's own
/// threads (executor.hpp). They are safe to make from many threads.
///
/// All parallel calls of the library, including those of trees and visibility, may be made from within the caller's
/// tasks. Each call has its own task_group_context: it completes even if the caller's group is cancelled, and
/// tbb::task_group::cancel() does not end it. Each call is isolated (tbb::this_task_arena::isolate): a thread that
/// waits inside a call takes none of the caller's other tasks. So the caller may hold a mutex and use thread_local
/// state across a call.
///
/// A call takes at most 64 KiB of stack, as does each of its tasks.
///
/// A child of fork() has no oneTBB threads. It may make calls for one shaft. It may make parallel calls only after it
/// has started another program.
///
/// Calls that write bits or numbers allocate only task memory of oneTBB. Calls that list allocate the lists once in
/// tasks and once for the caller; they reuse the memory of `lists`. Query::only adds a copy of the candidates' bounds.
/// If memory runs out, the call throws std::bad_alloc when its tasks have ended. Lists are then unchanged or empty,
/// bits and counts are unspecified, and everything else is unchanged.
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

/// Writes the bits of cull(shafts[s], …) to row s of `kept_rows`. There is exactly one row of bit_words(bounds.size())
/// words per shaft, row after row.
SHAFTCULL_EXPORT void cull_many(std::span<const CompiledShaft> shafts, const Bounds& bounds,
                                std::span<std::uint64_t> kept_rows, const Query& query = no_options);

/// Writes the bits of classify(shafts[s], …) to row s of `kept_rows` and row s of `inside_rows`; rows are as for
/// cull_many(). `kept_rows` may be empty: then only `inside_rows` is written.
SHAFTCULL_EXPORT void classify_many(std::span<const CompiledShaft> shafts, const Bounds& bounds,
                                    std::span<std::uint64_t> kept_rows, std::span<std::uint64_t> inside_rows,
                                    const Query& query = no_options);

/// Writes count(shafts[s], …) to kept_counts[s], one count per shaft. A shaft that has found Query::limit bounds is not
/// tested with later bounds.
SHAFTCULL_EXPORT void count_many(std::span<const CompiledShaft> shafts, const Bounds& bounds,
                                 std::span<std::uint64_t> kept_counts, const Query& query = no_options);

/// Writes count_classified(shafts[s], …) to counts[s], one element per shaft.
SHAFTCULL_EXPORT void count_classified_many(std::span<const CompiledShaft> shafts, const Bounds& bounds,
                                            std::span<KeptCounts> counts, const Query& query = no_options);

/// Writes the list of list(shafts[s], …) to list s. Throws InvalidArgument as list() does, and std::bad_alloc if memory
/// runs out.
SHAFTCULL_EXPORT void list_many(std::span<const CompiledShaft> shafts, const Bounds& bounds, IndexLists& lists,
                                const Query& query = no_options);

/// Lists bounds that overlap and bounds inside separately, as list_classified() does. Throws InvalidArgument if both
/// are the same lists.
SHAFTCULL_EXPORT void list_classified_many(std::span<const CompiledShaft> shafts, const Bounds& bounds,
                                           IndexLists& overlap, IndexLists& inside, const Query& query = no_options);

/// Writes bit s of `any` (word s / 64, bit s % 64): 1 iff shafts[s] keeps any bound. Bits past the last shaft are 0.
/// `any` has bit_words(shafts.size()) words. A shaft that has kept a bound is not tested with later bounds. So the time
/// depends on where the kept bounds are and, slightly, on the threads; the bits do not.
SHAFTCULL_EXPORT void any_many(std::span<const CompiledShaft> shafts, const Bounds& bounds,
                               std::span<std::uint64_t> any, const Query& query = no_options);

/// Returns how many threads a call from here would use (1 in a build without oneTBB).
[[nodiscard]] SHAFTCULL_EXPORT int concurrency() noexcept;

}  // namespace shaftcull
