// SPDX-License-Identifier: MIT
#include "complaint.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "printable.hpp"

namespace shaftcull::cli {

int complain(std::string what, int code) {
  for (char& c : what) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  while (!what.empty() && what.back() == ' ') what.pop_back();
  // Where standard error cannot be written, the exit code has to do.
  static_cast<void>(std::fputs(fmt::format("shaftcull: {}\n", printable(what)).c_str(), stderr));
  return code;
}

}  // namespace shaftcull::cli
