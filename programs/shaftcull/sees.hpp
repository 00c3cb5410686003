// SPDX-License-Identifier: MIT
/// The runs of `shaftcull sees`, for others that show one.
#pragma once

#include "interrupt.hpp"
#include "progress.hpp"
#include "sees_report.hpp"

namespace shaftcull::cli {

/// How far a run is, in a line: pairs answered, pairs left, and how long these may take.
[[nodiscard]] std::string progress_text(const VisibilityProgress& progress, double seconds);

/// Asks about a scene with the caller's threads and reports; `work` has no progress callback yet, and `out` is the file
/// that a sink writes, if one does. Throws Interrupted if a signal ends it.
[[nodiscard]] SeesReport run_sees(const SeesScene& scene, const PatchSet& patches, SeesWork work,
                                  const std::string& source, const std::string& out, std::span<SightSink* const> sinks,
                                  Progress& progress, const InterruptWatch& interrupt);

}  // namespace shaftcull::cli
