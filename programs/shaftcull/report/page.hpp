// SPDX-License-Identifier: MIT
/// The report as a page of HTML.
#pragma once

#include <string>

#include "report/summary_file.hpp"

namespace shaftcull::cli {

/// One page that needs nothing else: styles and pictures (SVG, drawn by gnuplot) are in it. Throws as run_gnuplot().
[[nodiscard]] std::string report_page(const BenchSummary& summary);

}  // namespace shaftcull::cli
