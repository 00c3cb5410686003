// SPDX-License-Identifier: MIT
/// How many threads the library's parallel calls use. The only place in the benchmarks that knows oneTBB.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace shaftcull::bench {

/// Threads that a benchmark can use here: those of the machine, or 1 in a build without oneTBB.
[[nodiscard]] unsigned all_threads() noexcept;

/// 1, 2, 4, … and all_threads().
[[nodiscard]] std::vector<unsigned> thread_counts();

/// Calls work(), whose parallel calls run on `threads` threads, the calling one among them.
void run_on(unsigned threads, const std::function<void()>& work);

/// Calls work(first, size) for all of `count` in chunks of `size`, the last one smaller, on the threads of run_on().
void for_chunks(std::size_t count, std::size_t size, const std::function<void(std::size_t, std::size_t)>& work);

}  // namespace shaftcull::bench
