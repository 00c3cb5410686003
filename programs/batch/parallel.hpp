// SPDX-License-Identifier: MIT
/// Loops on the threads of a rank.
#pragma once

#include <cstddef>
#include <functional>

namespace shaftcull::batch {

/// Calls `work(first, size)` for consecutive chunks of [0, count), on the threads of the task arena that it is called
/// in (in a build without oneTBB one after the other). An exception of one call reaches the caller; chunks that were
/// not begun are left out then.
void for_chunks(std::size_t count, std::size_t chunk, const std::function<void(std::size_t, std::size_t)>& work);

}  // namespace shaftcull::batch
