// SPDX-License-Identifier: MIT
/// Memory of whole pages, which can be made such that whoever touches it ends the program. WebAssembly lets everybody
/// read and write everything, so there it stays as it was.
#pragma once

#include <cstddef>
#include <span>

namespace shaftcull {

class Pages {
 public:
  /// Zeros, at least so many bytes. Throws std::bad_alloc where the system has no memory for them.
  explicit Pages(std::size_t bytes);
  Pages(const Pages&) = delete;
  Pages& operator=(const Pages&) = delete;
  ~Pages();

  [[nodiscard]] static std::size_t page_bytes();

  /// As many as asked for.
  [[nodiscard]] std::span<std::byte> bytes() const { return {memory_, bytes_}; }

  /// From now on these bytes can only be read. Both return whether the system allows it.
  [[nodiscard]] bool forbid_writing() const;
  /// From now on bytes from `first` on, which begins a page, can be neither read nor written.
  [[nodiscard]] bool forbid_from(std::size_t first) const;

 private:
  std::size_t bytes_;
  std::byte* memory_;
};

}  // namespace shaftcull
