// SPDX-License-Identifier: MIT
/// Loops on the caller's executor.
#pragma once

#include <cstddef>

#include "shaftcull/executor.hpp"
#include "shaftcull/function_ref.hpp"

namespace shaftcull::kernel {

/// The executor that a loop started here is to use; null for none.
[[nodiscard]] Executor* executor_in_use() noexcept;

/// parallel_for() on an executor. Within a task of one, the calling thread does all.
void run_on(Executor& executor, std::size_t rows, std::size_t columns,
            FunctionRef<void(std::size_t, std::size_t)> body);

/// ordered_pipeline() on an executor: `slots` items are worked on at once, and then delivered by the calling thread.
void run_in_order_on(Executor& executor, std::size_t count, std::size_t slots,
                     FunctionRef<void(std::size_t, std::size_t)> work,
                     FunctionRef<void(std::size_t, std::size_t)> deliver);

}  // namespace shaftcull::kernel
