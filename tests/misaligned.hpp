// SPDX-License-Identifier: MIT
/// A copy of a view whose streams begin a known number of floats after a cache line.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace shaftcull {

template <class View>
class Misaligned {
 public:
  /// The first stream is `offset` floats off, and each further one `apart` more than the one before.
  Misaligned(const View& view, std::size_t offset, std::size_t apart) : view_(view) {
    for (std::size_t k = 0; k != memory_.size(); ++k) {
      memory_[k].resize(view.count + 32);
      const std::size_t into_line = reinterpret_cast<std::uintptr_t>(memory_[k].data()) % 64 / sizeof(float);
      float* const start = memory_[k].data() + (16 - into_line) % 16 + (offset + k * apart) % 16;
      std::copy_n(view.stream[k], view.count, start);
      view_.stream[k] = start;
    }
  }
  Misaligned(const Misaligned&) = delete;
  Misaligned& operator=(const Misaligned&) = delete;

  [[nodiscard]] const View& view() const noexcept { return view_; }

 private:
  std::array<std::vector<float>, std::tuple_size_v<decltype(View::stream)>> memory_;
  View view_;
};

}  // namespace shaftcull
