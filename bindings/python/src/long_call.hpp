// SPDX-License-Identifier: MIT
/// Calls about all pairs of patches, which may take long.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <future>

#include "interrupts.hpp"
#include "module.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull::python {

inline constexpr Sight all_sights[] = {Sight::undecided, Sight::clear, Sight::occluded, Sight::facing_away};

/// Runs a long call on a thread of its own, while this one hears signals and reports progress. An exception of either
/// ends the call.
template <class Options, class Call>
auto while_hearing(Options options, const py::object& progress, Call&& call) {
  begin_parallel();
  std::atomic<std::uint64_t> done{0};
  std::atomic<std::uint64_t> total{0};
  std::atomic<bool> stop{false};
  options.progress = [&](const VisibilityProgress& come) {
    total = come.total;
    done = come.done;
    return !stop;
  };
  const auto report = [&] {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress.is_none() && total != 0) progress(done.load(), total.load());
  };
  std::future<decltype(call(options))> answer;
  {
    const py::gil_scoped_release release;
    answer = std::async(std::launch::async, [&] { return call(options); });
  }
  const auto has_ended = [&] {
    const py::gil_scoped_release release;
    return answer.wait_for(std::chrono::milliseconds(100)) == std::future_status::ready;
  };
  try {
    while (!has_ended()) report();
  } catch (...) {
    stop = true;
    const py::gil_scoped_release release;
    answer.wait();
    throw;
  }
  auto result = answer.get();
  report();
  return result;
}

/// Numbers of pairs by the names of their kinds.
[[nodiscard]] inline py::dict counts_of(const SightCounts& counts) {
  py::dict dict;
  for (const Sight sight : all_sights) dict[py::str(name(sight))] = counts.of(sight);
  return dict;
}

}  // namespace shaftcull::python
