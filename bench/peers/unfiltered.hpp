// SPDX-License-Identifier: MIT
/// The slab test without its filter: as fast, and as wrong near a boundary, as rounded arithmetic is. What exactness
/// costs is measured against it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "shaftcull/compiled.hpp"

namespace shaftcull::bench {

/// Writes one bit for each box of `words` whole words, on AVX2. The shaft is tested as if its slab form were fused.
void cull_unfiltered_avx2(const CompiledShaft& shaft, const BoxView& boxes, std::size_t words,
                          std::uint64_t* kept) noexcept;

}  // namespace shaftcull::bench
