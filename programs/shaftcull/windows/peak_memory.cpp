// SPDX-License-Identifier: MIT
#include "peak_memory.hpp"

#include <windows.h>

#include <psapi.h>

namespace shaftcull::cli {

std::uint64_t peak_memory() {
  PROCESS_MEMORY_COUNTERS counters{};
  GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof(counters));
  return counters.PeakWorkingSetSize;
}

}  // namespace shaftcull::cli
