// SPDX-License-Identifier: MIT
/// The check sum of zip archives: CRC-32, of the polynomial 0x04c11db7, its bits reversed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace shaftcull::cli {

/// The sum of bytes that come in pieces: that of all of them one behind the other.
class Crc32 {
 public:
  void add(std::span<const std::byte> bytes) noexcept;
  [[nodiscard]] std::uint32_t value() const noexcept { return ~sum_; }

 private:
  std::uint32_t sum_ = 0xffffffff;
};

/// The sum of some bytes and `second_bytes` more behind them, of which the sums are known. Takes a step for each bit of
/// the length.
[[nodiscard]] std::uint32_t joined_crc32(std::uint32_t first, std::uint32_t second,
                                         std::uint64_t second_bytes) noexcept;

}  // namespace shaftcull::cli
