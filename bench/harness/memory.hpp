// SPDX-License-Identifier: MIT
/// How much memory benchmarks may take, and where they get it from.
#pragma once

#include <cstdint>
#include <fstream>
#include <limits>
#include <string>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

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

/// While this lives, memory that is freed stays with the process, large memory too, where the C library is glibc. So
/// work that is done again finds its memory at hand, and does not wait for the system.
class FreedMemoryKept {
 public:
  FreedMemoryKept() { set(0, std::numeric_limits<int>::max()); }
  FreedMemoryKept(const FreedMemoryKept&) = delete;
  FreedMemoryKept& operator=(const FreedMemoryKept&) = delete;
  ~FreedMemoryKept() {
    set(65'536, 128 * 1024);  // what they are at first
#if defined(__GLIBC__)
    malloc_trim(0);
#endif
  }

 private:
  static void set([[maybe_unused]] int most_mapped, [[maybe_unused]] int most_kept) {
#if defined(__GLIBC__)
    mallopt(M_MMAP_MAX, most_mapped);
    mallopt(M_TRIM_THRESHOLD, most_kept);
#endif
  }
};

}  // namespace shaftcull::bench
