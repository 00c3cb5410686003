// SPDX-License-Identifier: MIT
/// The run as a JSON file, for those who compare runs.
#pragma once

#include <filesystem>

#include "harness/results.hpp"
#include "harness/run_size.hpp"
#include "harness/suite.hpp"

namespace shaftcull::bench {

/// Writes an object of
///
///     machine: {cpu, cores, isa, compiler, caches, date}
///     run: {quick, bounds, shafts, repetitions}
///     results: {NAME: {per_s, vs_paper}}
///     reach: [{row, against, value, target, unit, bound, met}]: unit "x" is the speed of row over that of against,
///     "ns" the time of
///            one item; bound is "least" or "most"
///     limits: [{row, per_s, fraction, ceilings: [{by, units, what, per_s}]}]: ceilings ascending, and fraction is of
///     the first
///
/// Benchmarks that did not run are left out of the results, and paths without any measured limit out of the limits;
/// vs_paper is null if what it compares with did not run, and a target's value likewise (it then counts as not met).
/// Throws std::runtime_error if the file cannot be written.
void write_summary(const std::filesystem::path& file, const Suite& suite, const RunSize& size, const Results& results);

}  // namespace shaftcull::bench
