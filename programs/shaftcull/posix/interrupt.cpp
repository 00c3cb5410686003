// SPDX-License-Identifier: MIT
#include "interrupt.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>

namespace shaftcull::cli {
namespace {

constexpr std::array watched{SIGINT, SIGTERM};
constexpr int exit_of_signal = 128;

std::atomic<int> caught = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler writes it");

std::array<struct sigaction, watched.size()> previous{};

extern "C" void note_signal(int number) {
  if (caught.exchange(number, std::memory_order_relaxed) != 0) _exit(exit_of_signal + number);
}

}  // namespace

InterruptWatch::InterruptWatch() {
  caught = 0;
  struct sigaction action {};
  action.sa_handler = note_signal;
  action.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < watched.size(); ++i) {
    sigaction(watched[i], nullptr, &previous[i]);
    if (previous[i].sa_handler != SIG_IGN) sigaction(watched[i], &action, nullptr);
  }
}

InterruptWatch::~InterruptWatch() {
  for (std::size_t i = 0; i < watched.size(); ++i) sigaction(watched[i], &previous[i], nullptr);
}

int InterruptWatch::signal() const noexcept { return caught.load(std::memory_order_relaxed); }

}  // namespace shaftcull::cli
