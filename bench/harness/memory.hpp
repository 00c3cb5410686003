// SPDX-License-Identifier: MIT
/// How much memory benchmarks may take.
#pragma once

#include <cstdint>
#include <fstream>
#include <limits>
#include <string>

namespace shaftcull::bench {

/// Bytes that programs can still get without others being moved out, as Linux says; elsewhere 0.
inline std::uint64_t available_memory() {
  std::ifstream file("/proc/meminfo");
  for (std::string name; file >> name;) {
    std::uint64_t kibibytes = 0;
    if (name == "MemAvailable:" && file >> kibibytes) return kibibytes * 1024;
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return 0;
}

}  // namespace shaftcull::bench
