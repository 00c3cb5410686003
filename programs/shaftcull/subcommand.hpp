// SPDX-License-Identifier: MIT
/// The program's subcommands: each adds itself to the command line, and runs when it is named there.
#pragma once

#include <stdexcept>

#include <CLI/CLI.hpp>

namespace shaftcull::cli {

void add_demo(CLI::App& program);
void add_cull(CLI::App& program);
void add_sees(CLI::App& program);
void add_factors(CLI::App& program);
void add_sun(CLI::App& program);
void add_batch(CLI::App& program);
void add_stats(CLI::App& program);
void add_draw(CLI::App& program);
void add_hash(CLI::App& program);
void add_verify(CLI::App& program);  ///< in builds that found GMP

/// Exit codes of the program.
enum ExitCode : int {
  exit_ok = 0,
  exit_failure = 1,    ///< the machine let us down: memory, output; verify found a wrong answer
  exit_bad_input = 2,  ///< an option, the environment or a file cannot be used
};

/// Ends the program with an exit code, and without a word: this process, or another one of the same run, has said why.
class EarlyExit : public std::runtime_error {
 public:
  explicit EarlyExit(int code) : std::runtime_error("said before"), code_(code) {}
  [[nodiscard]] int code() const noexcept { return code_; }

 private:
  int code_;
};

}  // namespace shaftcull::cli
