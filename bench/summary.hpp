/// The run as a JSON file, for those who compare runs.
#pragma once

#include <filesystem>

#include "results.hpp"
#include "suite.hpp"

namespace shaftcull::bench {

/// Writes {"machine": {…}, "results": {name: {"per_s", "vs_paper"}}, "reach": [{"row", "value", "target", "met"}]}.
///
/// Benchmarks that did not run are left out of the results; vs_paper is null if what it compares with did not run, and
/// a target's value likewise (it then counts as not met). Throws std::runtime_error if the file cannot be written.
void write_summary(const std::filesystem::path& file, const Suite& suite, const Results& results);

}  // namespace shaftcull::bench
