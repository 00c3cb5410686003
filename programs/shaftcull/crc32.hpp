// SPDX-License-Identifier: MIT
/// The check sum of zip archives, by zlib.
#pragma once

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace shaftcull::cli {

/// The CRC-32 of bytes behind others, whose sum is `before`; that of none is 0.
[[nodiscard]] inline std::uint32_t crc32_of(std::span<const std::byte> bytes, std::uint32_t before = 0) noexcept {
  if (bytes.empty()) return before;  // zlib takes null for a question about the sum of nothing
  return static_cast<std::uint32_t>(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// That of some bytes and `second_bytes` more behind them, of which the sums are known.
[[nodiscard]] inline std::uint32_t joined_crc32(std::uint32_t first, std::uint32_t second,
                                                std::uint64_t second_bytes) noexcept {
  return static_cast<std::uint32_t>(crc32_combine(first, second, static_cast<z_off_t>(second_bytes)));
}

}  // namespace shaftcull::cli
