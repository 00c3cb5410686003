// SPDX-License-Identifier: MIT
/// Long runs that end early, with what they have so far, when the user asks for it.
#pragma once

#include <stdexcept>
#include <string>

namespace shaftcull::cli {

/// While one exists, the first SIGINT or SIGTERM is only noted, for the run to look at; a second one ends the program
/// at once. A signal that the program was started to ignore stays ignored. There may be one at a time.
class InterruptWatch {
 public:
  InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;
  ~InterruptWatch();

  /// The signal that came, or 0. For any thread.
  [[nodiscard]] int signal() const noexcept;
};

/// A run ended early, after it had shown what it had. The program's exit code is 128 + signal, as a shell has it.
class Interrupted : public std::runtime_error {
 public:
  Interrupted(int signal, const std::string& what) : std::runtime_error(what), signal_(signal) {}
  [[nodiscard]] int signal() const noexcept { return signal_; }

 private:
  int signal_;
};

}  // namespace shaftcull::cli
