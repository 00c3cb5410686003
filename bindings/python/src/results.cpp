// SPDX-License-Identifier: MIT
#include "results.hpp"

#include <array>
#include <bit>
#include <cstring>

namespace shaftcull::python {

namespace {

using EightBytes = std::array<bool, 8>;

constexpr std::array<EightBytes, 256> table() {
  std::array<EightBytes, 256> rows{};
  for (std::size_t byte = 0; byte != rows.size(); ++byte) {
    for (std::size_t bit = 0; bit != 8; ++bit) rows[byte][bit] = (byte >> bit & 1) != 0;
  }
  return rows;
}

}  // namespace

void unpack(const std::uint64_t* words, std::size_t count, bool* to) noexcept {
  static constexpr std::array<EightBytes, 256> rows = table();
  static_assert(sizeof(bool) == 1);
  std::size_t i = 0;
  for (; i + 64 <= count; i += 64) {
    const std::uint64_t word = words[i / 64];
    for (unsigned byte = 0; byte != 8; ++byte) {
      std::memcpy(to + i + std::size_t{8} * byte, rows[word >> (8 * byte) & 0xFF].data(), 8);
    }
  }
  for (; i != count; ++i) to[i] = (words[i / 64] >> (i % 64) & 1) != 0;
}

}  // namespace shaftcull::python
