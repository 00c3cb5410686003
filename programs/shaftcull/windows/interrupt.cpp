// SPDX-License-Identifier: MIT
#include "interrupt.hpp"

#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>
#include <cstdlib>

namespace shaftcull::cli {
namespace {

// Ctrl+C is SIGINT. SIGTERM comes from this process alone.
constexpr std::array watched{SIGINT, SIGTERM};
constexpr int exit_of_signal = 128;

std::atomic<int> caught = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler writes it");

using Handler = void (*)(int);
std::array<Handler, watched.size()> previous{};

extern "C" void note_signal(int number) {
  if (caught.exchange(number, std::memory_order_relaxed) != 0) std::_Exit(exit_of_signal + number);
  // A handler is called once and forgotten; the next signal may be the other one.
  for (const int signal : watched) {
    if (std::signal(signal, note_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

}  // namespace

InterruptWatch::InterruptWatch() {
  caught = 0;
  for (std::size_t i = 0; i < watched.size(); ++i) {
    previous[i] = std::signal(watched[i], note_signal);
    if (previous[i] == SIG_IGN) std::signal(watched[i], SIG_IGN);
  }
}

InterruptWatch::~InterruptWatch() {
  for (std::size_t i = 0; i < watched.size(); ++i) std::signal(watched[i], previous[i]);
}

int InterruptWatch::signal() const noexcept { return caught.load(std::memory_order_relaxed); }

}  // namespace shaftcull::cli
