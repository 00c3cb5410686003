// SPDX-License-Identifier: MIT
/// What calls answer, and the rule for results that do not fit.
///
/// A call that lists into a span of the caller's returns how many results there are, whether they fit or not. The first
/// of them are written, as many as the span has room for; the others are counted only. So call again with as much room
/// as the number returned, if that was more than there was. An empty span is legal: then the call counts. Room past the
/// last result may be overwritten with anything.
///
/// A call that lists into IndexLists or LeafRangeLists makes the room itself. A call that writes bits or a
/// number for each shaft wants a span of exactly the right size, and throws InvalidArgument for any other.
#pragma once

#include <cstddef>

#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// How many of each answer there are. Kept are overlap + inside.
struct KeptCounts {
  std::size_t overlap;  ///< not outside, and not inside either
  std::size_t inside;   ///< inside the shaft entirely
  friend bool operator==(const KeptCounts&, const KeptCounts&) = default;
};

}  // namespace shaftcull
