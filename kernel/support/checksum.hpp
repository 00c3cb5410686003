// SPDX-License-Identifier: MIT
/// A checksum of memory: XXH64 by Yann Collet (https://github.com/Cyan4973/xxHash), of what is a multiple of 32 bytes
/// long.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace shaftcull::kernel {

/// XXH64 with seed 0. bytes.size() is a multiple of 32, and not 0. Machines that order bytes otherwise get another
/// number.
[[nodiscard]] inline std::uint64_t checksum(std::span<const std::byte> bytes) noexcept {
  constexpr std::uint64_t prime1 = 0x9E3779B185EBCA87;
  constexpr std::uint64_t prime2 = 0xC2B2AE3D27D4EB4F;
  constexpr std::uint64_t prime3 = 0x165667B19E3779F9;
  constexpr std::uint64_t prime4 = 0x85EBCA77C2B2AE63;
  constexpr auto round = [](std::uint64_t sum, std::uint64_t word) {
    return std::rotl(sum + word * prime2, 31) * prime1;
  };
  std::uint64_t sum[4] = {prime1 + prime2, prime2, 0, 0 - prime1};
  for (std::size_t at = 0; at != bytes.size(); at += sizeof sum) {
    std::uint64_t word[4];
    std::memcpy(word, bytes.data() + at, sizeof word);
    for (std::size_t lane = 0; lane != 4; ++lane) sum[lane] = round(sum[lane], word[lane]);
  }
  std::uint64_t all = std::rotl(sum[0], 1) + std::rotl(sum[1], 7) + std::rotl(sum[2], 12) + std::rotl(sum[3], 18);
  for (const std::uint64_t lane : sum) all = (all ^ round(0, lane)) * prime1 + prime4;
  all += bytes.size();
  all = (all ^ all >> 33) * prime2;
  all = (all ^ all >> 29) * prime3;
  return all ^ all >> 32;
}

}  // namespace shaftcull::kernel
