/// From the user's records to streams: everything is checked, then written, so that an error leaves a stream unchanged.
#pragma once

#include <cstddef>

#include "shaftcull/streams.hpp"
#include "support/exact_floats.hpp"

namespace shaftcull::kernel {

/// Replaces the bounds [first, first + records.count) of a stream of `size` bounds in `memory`.
/// Throws InvalidArgument if the range does not fit or memory is null, BadBound for the first illegal record.
void pack(const BoxView& boxes, std::size_t first, std::size_t size, const StreamMemory& memory);
void pack(const SphereView& spheres, std::size_t first, std::size_t size, const StreamMemory& memory);
void pack(const MinMaxRecords& records, std::size_t first, std::size_t size, const StreamMemory& memory);
void pack(const CentreExtentRecords& records, std::size_t first, std::size_t size, const StreamMemory& memory);
void pack(const SphereRecords& records, std::size_t first, std::size_t size, const StreamMemory& memory);

}  // namespace shaftcull::kernel
