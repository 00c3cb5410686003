// SPDX-License-Identifier: MIT
// A program without exceptions: its handler is told of an error and ends it; without a handler the library does.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include <shaftcull/shaftcull.hpp>

int main(int arguments, char** /*argument*/) {
  if (arguments > 1) {
    shaftcull::set_error_handler([](const std::exception& error) {
      std::printf("told: %s\n", error.what());
      std::fflush(stdout);
      std::_Exit(7);
    });
  }
  const shaftcull::Box wrong{{1, 0, 0}, {0, 1, 1}};
  static_cast<void>(shaftcull::compile(wrong, wrong));
  return 0;
}
