// SPDX-License-Identifier: MIT
/// What calls about visibility share: counts of pairs, and callbacks that may end a call.
#pragma once

#include <cstdint>
#include <functional>

#include "shaftcull.h"
#include "shaftcull/visibility.hpp"
#include "status.hpp"

namespace shaftcull::binding {

[[nodiscard]] inline shaftcull_sight_counts from_sights(const SightCounts& counts) noexcept {
  return {counts.undecided, counts.clear, counts.occluded, counts.facing_away};
}

/// Ends the call if a callback has not returned 0.
inline void go_on_if(std::int32_t returned) {
  if (returned != 0) fail(Stopped(returned));
}

/// A callback as that of the C++ interface.
[[nodiscard]] inline std::function<bool(const VisibilityProgress&)> as_progress(shaftcull_progress_callback progress,
                                                                                void* user) {
  return [progress, user](const VisibilityProgress& come) {
    go_on_if(progress(come.done, come.total, user));
    return true;
  };
}

}  // namespace shaftcull::binding
