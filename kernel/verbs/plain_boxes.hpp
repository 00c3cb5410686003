// SPDX-License-Identifier: MIT
/// Queries without options about the boxes of a view, by one shaft: what Asked and a Scan cost is as much as two tests
/// of 64 boxes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>

#include "compiled/answers.hpp"
#include "dispatch/active_kernels.hpp"
#include "flat/scan.hpp"
#include "query/bound_streams.hpp"
#include "query/counters.hpp"
#include "query/options.hpp"
#include "shaftcull/query.hpp"
#include "support/arguments.hpp"
#include "support/float_environment.hpp"

namespace shaftcull::kernel {

/// The boxes of a view that a query without options asks about, or null.
[[nodiscard]] inline const BoxView* plain_boxes(const Bounds& bounds, const Query& query) noexcept {
  if (Options::are_given(query) || !BoundsAccess::layers(bounds).empty()) return nullptr;
  return std::get_if<BoxView>(&BoundsAccess::from(bounds));
}

/// Throws InvalidArgument for a shaft that was never formed, and for a view that is none.
inline void require_plain(const CompiledShaft& shaft, const BoxView& boxes) {
  require_formed(data_of(shaft), 0);
  require_view(boxes);
}

/// Calls visit(chunk) for the bits of all boxes until it returns false, as Scan::for_each_chunk().
template <class Visit>
void for_each_plain_chunk(const CompiledShaft& shaft, const BoxView& boxes, const Kernels& kernels, std::size_t chunk,
                          const Visit& visit) {
  const FloatEnvironment environment;
  std::uint64_t kept[bit_words(chunk_bounds)];
  for_each_slice(BoundStreams(boxes), chunk, [&](const float* const* stream, std::size_t first, std::size_t size) {
    kernels.boxes(data_of(shaft), stream, size, kept, nullptr);
    return visit(ScannedChunk{first, bit_words(size), kept, nullptr});
  });
}

/// Gives a counter the boxes that the shaft keeps.
template <class AnyCounter>
[[nodiscard]] AnyCounter plain_counted(const CompiledShaft& shaft, const BoxView& boxes, const Kernels& kernels,
                                       AnyCounter counter) {
  for_each_plain_chunk(shaft, boxes, kernels, first_chunk_for(counter), [&](const ScannedChunk& chunk) {
    counter.words({nullptr, chunk.kept, nullptr, chunk.words});
    return !is_done(counter);
  });
  return counter;
}

}  // namespace shaftcull::kernel
