// SPDX-License-Identifier: MIT
/// What calls of visibility.hpp refuse.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "shaftcull/visibility.hpp"

namespace shaftcull::kernel {

/// Refuses a value that is no Sight. `what` says where it is, and `whose` of what pair.
[[noreturn]] void refuse_sight(const std::string& what, Sight sight, const std::string& whose = "");

void require_options(const VisibilityOptions& options);

/// Throws InvalidArgument unless `part` is below `parts`.
void require_part(std::uint32_t part, std::uint32_t parts);

/// Of calls that cast rays: at most `rays` of each pair, until an error is reached.
void require_rays(std::uint32_t rays, double error, float tolerance);

/// `bits` has one row for each of `a` patches, of a bit for each of `b`.
void require_rows(std::span<const std::uint64_t> bits, std::size_t a, std::size_t b);

void require_callback(const FunctionRef<void(const SightBatch&)>& deliver);

}  // namespace shaftcull::kernel
