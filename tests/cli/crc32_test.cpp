// SPDX-License-Identifier: MIT
/// Check sums of zip archives, and of two parts those of both.
#include "crc32.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace shaftcull::test {
namespace {

using cli::Crc32;
using cli::joined_crc32;

std::uint32_t crc_of(std::string_view bytes) {
  Crc32 crc;
  crc.add(std::as_bytes(std::span(bytes)));
  return crc.value();
}

/// As the definition says: the remainder of a polynomial, bit by bit.
std::uint32_t crc_by_bits(std::string_view bytes) {
  std::uint32_t sum = 0xffffffff;
  for (const char c : bytes) {
    sum ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) sum = (sum & 1) != 0 ? 0xedb88320 ^ (sum >> 1) : sum >> 1;
  }
  return ~sum;
}

/// Bytes that are all different from their neighbours.
std::string some_bytes(std::size_t count) {
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i) bytes += static_cast<char>(i * 37 + i / 7);
  return bytes;
}

TEST(CliCrc32, ItIsTheOneThatIsKnown) {
  EXPECT_EQ(crc_of("123456789"), 0xcbf43926);
  EXPECT_EQ(crc_of(""), 0U);
}

TEST(CliCrc32, ItIsThatOfTheDefinitionForEachLengthAndBegin) {
  const std::string bytes = some_bytes(60);
  for (std::size_t begin = 0; begin < 9; ++begin) {
    for (std::size_t count = 0; begin + count <= bytes.size(); ++count) {
      const std::string_view part = std::string_view(bytes).substr(begin, count);
      EXPECT_EQ(crc_of(part), crc_by_bits(part)) << begin << ' ' << count;
    }
  }
}

TEST(CliCrc32, PiecesAddUp) {
  const std::string bytes = some_bytes(100);
  for (std::size_t step = 1; step < 30; ++step) {
    Crc32 crc;
    for (std::size_t at = 0; at < bytes.size(); at += step) {
      crc.add(std::as_bytes(std::span(bytes)).subspan(at, std::min(step, bytes.size() - at)));
    }
    EXPECT_EQ(crc.value(), crc_of(bytes)) << step;
  }
}

TEST(CliCrc32, ThoseOfTwoPartsGiveThatOfBoth) {
  const std::string bytes = some_bytes(300);
  for (std::size_t first = 0; first <= bytes.size(); ++first) {
    const std::string_view one = std::string_view(bytes).substr(0, first);
    const std::string_view other = std::string_view(bytes).substr(first);
    EXPECT_EQ(joined_crc32(crc_of(one), crc_of(other), other.size()), crc_of(bytes)) << first;
  }
}

TEST(CliCrc32, PartsMayBeLongerThanThirtyTwoBitsCount) {
  // 2⁴⁰ + 5 bytes, all 0, by doubling.
  std::uint32_t zeros = crc_of(std::string(1, '\0'));
  for (std::uint64_t count = 1; count != std::uint64_t{1} << 40; count *= 2) zeros = joined_crc32(zeros, zeros, count);
  const std::uint32_t five = crc_of(std::string(5, '\0'));
  const std::uint64_t many = std::uint64_t{1} << 40;
  EXPECT_EQ(joined_crc32(zeros, five, 5), joined_crc32(five, zeros, many));
  EXPECT_EQ(joined_crc32(crc_of("a"), joined_crc32(zeros, five, 5), many + 5),
            joined_crc32(joined_crc32(crc_of("a"), zeros, many), five, 5));
}

}  // namespace
}  // namespace shaftcull::test
