// SPDX-License-Identifier: MIT
// What the library needs of the module: errors are told to JavaScript, and memory grows in large steps.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "shaftcull.h"

extern "C" {

// The module has no exceptions of its own; JavaScript throws one through it.
[[clang::import_module("shaftcull"), clang::import_name("fail")]] void fail(shaftcull_status status,
                                                                            const char* message,
                                                                            std::uint64_t position);

// malloc asks for a little more memory each time that it has none left. Memory grows by a quarter then, since browsers
// look for garbage each time that it does.
void* sbrk(std::intptr_t increment) {
  constexpr std::size_t page = 65536;
  static std::size_t end = __builtin_wasm_memory_size(0) * page;  // of what malloc has
  const std::size_t size = __builtin_wasm_memory_size(0) * page;
  const std::size_t wanted = end + static_cast<std::size_t>(increment);
  if (increment < 0 || wanted < end) return reinterpret_cast<void*>(-1);
  if (wanted > size) {
    const std::size_t pages = (wanted - size + page - 1) / page;
    const std::size_t more = std::max(pages, size / page / 4);
    if (__builtin_wasm_memory_grow(0, more) == SIZE_MAX && __builtin_wasm_memory_grow(0, pages) == SIZE_MAX) {
      return reinterpret_cast<void*>(-1);
    }
  }
  void* const begin = reinterpret_cast<void*>(end);
  end = wanted;
  return begin;
}

}  // extern "C"

namespace {

[[maybe_unused]] const shaftcull_error_handler before = shaftcull_set_error_handler(fail);

}  // namespace
