// SPDX-License-Identifier: MIT
#include "crc32.hpp"

#include <array>
#include <bit>
#include <cstring>

namespace shaftcull::cli {
namespace {

static_assert(std::endian::native == std::endian::little, "words are read as their bytes stand in memory");

constexpr std::uint32_t crc32_polynomial = 0xedb88320;  ///< bit 31 is 1, bit 30 is x, …; x³² is left out

constexpr std::uint32_t times_x(std::uint32_t a) { return (a & 1) != 0 ? crc32_polynomial ^ (a >> 1) : a >> 1; }

/// Of bytes that are taken eight at once: what a byte adds with so many behind it. M. E. Kounavis and F. L. Berry,
/// "Systematic Approaches to Building High Performance Software-Based CRC Generators" (2005), "slicing by 8".
constexpr std::size_t bytes_at_a_time = 8;
using Crc32Tables = std::array<std::array<std::uint32_t, 256>, bytes_at_a_time>;

constexpr Crc32Tables make_tables() {
  Crc32Tables tables{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t sum = i;
    for (int bit = 0; bit < 8; ++bit) sum = times_x(sum);
    tables[0][i] = sum;
  }
  for (std::size_t behind = 1; behind < tables.size(); ++behind) {
    for (std::size_t i = 0; i < 256; ++i) {
      const std::uint32_t sum = tables[behind - 1][i];
      tables[behind][i] = tables[0][sum & 0xff] ^ (sum >> 8);
    }
  }
  return tables;
}

constexpr Crc32Tables crc32_tables = make_tables();

/// The product of two polynomials, modulo that of the sum.
std::uint32_t times(std::uint32_t a, std::uint32_t b) noexcept {
  std::uint32_t product = 0;
  for (std::uint32_t bit = std::uint32_t{1} << 31; bit != 0; bit >>= 1) {
    if ((a & bit) != 0) product ^= b;
    b = times_x(b);
  }
  return product;
}

}  // namespace

void Crc32::add(std::span<const std::byte> bytes) noexcept {
  std::uint32_t sum = sum_;
  const std::byte* at = bytes.data();
  std::size_t left = bytes.size();
  for (; left >= bytes_at_a_time; left -= bytes_at_a_time, at += bytes_at_a_time) {
    std::uint64_t word = 0;
    std::memcpy(&word, at, sizeof(word));
    word ^= sum;
    sum = 0;
    for (std::size_t i = 0; i < bytes_at_a_time; ++i) {
      sum ^= crc32_tables[bytes_at_a_time - 1 - i][(word >> (8 * i)) & 0xff];
    }
  }
  for (; left != 0; --left, ++at) {
    sum = crc32_tables[0][(sum ^ std::to_integer<std::uint32_t>(*at)) & 0xff] ^ (sum >> 8);
  }
  sum_ = sum;
}

std::uint32_t joined_crc32(std::uint32_t first, std::uint32_t second, std::uint64_t second_bytes) noexcept {
  // A byte behind others multiplies what they add by x⁸. By squaring that, x to the power of 8 times the length.
  std::uint32_t power = std::uint32_t{1} << (31 - 8);
  for (std::uint64_t left = second_bytes; left != 0; left >>= 1) {
    if ((left & 1) != 0) first = times(power, first);
    power = times(power, power);
  }
  return first ^ second;
}

}  // namespace shaftcull::cli
