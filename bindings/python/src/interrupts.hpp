// SPDX-License-Identifier: MIT
/// Long calls in chunks of shafts, between which signal handlers run, so that Ctrl-C ends them; and the guard of
/// parallel calls in a child of fork().
#pragma once

#include <cstddef>

#include "shaftcull/function_ref.hpp"

namespace shaftcull::python {

/// How the results of chunks become one.
enum class Chunks {
  side_by_side,  ///< Each is written to its own place.
  joined,        ///< They are put together afterwards, which costs a copy: one chunk of all is better.
};

/// Calls run(first, count) for ranges of shafts, in order, with the interpreter lock released. Between them signal
/// handlers run, and their exceptions leave this call. The first range is a few shafts, whose time shows how many
/// others take half a second. Where chunks are joined and all shafts take no longer than that, run(0, shafts) follows
/// the first range: so first == 0 begins again. Errors name positions among all shafts.
///
/// Call it with the lock held. RuntimeError in a child of fork() whose parent has run a parallel call.
void in_chunks(std::size_t shafts, Chunks chunks, FunctionRef<void(std::size_t first, std::size_t count)> run);

/// Notes that this process runs a parallel call, or throws in a child of fork() that cannot.
void begin_parallel();

}  // namespace shaftcull::python
