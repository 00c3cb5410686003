// SPDX-License-Identifier: MIT
#include "interrupts.hpp"

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>

#include "shaftcull/error.hpp"

namespace shaftcull::python {

namespace py = pybind11;

namespace {

/// One shaft may list millions of bounds, so the first chunk is small; smaller where it is asked twice.
[[nodiscard]] constexpr std::size_t first_chunk(Chunks chunks) { return chunks == Chunks::joined ? 16 : 64; }
/// Shafts differ, so a chunk is not much larger than the one before.
constexpr std::size_t growth = 64;
constexpr double seconds_a_chunk = 0.5;

void hear_signals() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace

void begin_parallel() {
  static std::atomic<pid_t> process{0};
  pid_t none = 0;
  const pid_t self = getpid();
  if (!process.compare_exchange_strong(none, self) && none != self) {
    throw std::runtime_error(
        "this process was forked from one that has used shaftcull in parallel, and has none of its threads. Pass one "
        "shaft at a time, or start processes by multiprocessing.get_context(\"spawn\") or \"forkserver\"");
  }
}

void in_chunks(std::size_t shafts, Chunks chunks, FunctionRef<void(std::size_t first, std::size_t count)> run) {
  begin_parallel();
  const auto unlocked = [&run, shafts](std::size_t first, std::size_t count) {
    const py::gil_scoped_release release;
    try {
      run(first, count);
    } catch (const InvalidArgument&) {
      // Its message counts from the first shaft of the chunk. Arguments are checked before all else, so this throws at
      // once, and says where in all of them.
      if (count == shafts) throw;
      run(0, shafts);
    }
  };
  if (shafts <= first_chunk(chunks)) {
    unlocked(0, shafts);
    return;
  }
  std::size_t first = 0;
  std::size_t count = first_chunk(chunks);
  while (true) {
    const auto start = std::chrono::steady_clock::now();
    unlocked(first, count);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    hear_signals();
    const auto fitting =
        static_cast<std::size_t>(seconds_a_chunk * static_cast<double>(count) / std::max(seconds, 1e-9));
    if (first == 0 && chunks == Chunks::joined && shafts <= std::min(fitting, growth * count)) {
      unlocked(0, shafts);
      return;
    }
    first += count;
    if (first == shafts) return;
    count = std::min({std::max<std::size_t>(fitting, 1), growth * count, shafts - first});
  }
}

}  // namespace shaftcull::python
