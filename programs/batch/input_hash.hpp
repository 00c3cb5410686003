// SPDX-License-Identifier: MIT
/// What tells the inputs of two jobs apart.
#pragma once

#include <functional>

#include "batch/array_file.hpp"
#include "batch/checksum.hpp"
#include "batch/ranks.hpp"

namespace shaftcull::batch {

/// All ranks: a fingerprint of the shape and of all numbers of an array, however it is stored. Each rank reads its
/// part, in parallel where it is mapped; `on_threads` does some work where for_chunks() is parallel.
[[nodiscard]] Fingerprint hash_of(const ArrayFile& array, Ranks& ranks,
                                  const std::function<void(const std::function<void()>&)>& on_threads);

}  // namespace shaftcull::batch
