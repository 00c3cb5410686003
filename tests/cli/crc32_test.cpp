// SPDX-License-Identifier: MIT
/// Check sums of zip archives: pieces give that of the whole, empty ones too.
#include "crc32.hpp"

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <string_view>

namespace shaftcull::test {
namespace {

using cli::crc32_of;
using cli::joined_crc32;

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

TEST(CliCrc32, PiecesGiveThatOfTheWhole) {
  const std::string_view text = "123456789";
  constexpr std::uint32_t known = 0xcbf43926;
  for (std::size_t size = 0; size <= text.size(); ++size) {
    const std::span<const std::byte> first = bytes_of(text.substr(0, size));
    const std::span<const std::byte> second = bytes_of(text.substr(size));
    EXPECT_EQ(crc32_of(second, crc32_of(first)), known) << size;
    EXPECT_EQ(joined_crc32(crc32_of(first), crc32_of(second), second.size()), known) << size;
  }
}

TEST(CliCrc32, NothingAddsNothing) {
  const std::uint32_t sum = crc32_of(bytes_of("some"));
  EXPECT_EQ(crc32_of({}, sum), sum);
  EXPECT_EQ(crc32_of({}), 0U);
  EXPECT_EQ(joined_crc32(sum, 0, 0), sum);
}

}  // namespace
}  // namespace shaftcull::test
