// SPDX-License-Identifier: MIT
/// Names of files and objects, as text shows them.
#include "printable.hpp"

#include <gtest/gtest.h>

namespace shaftcull::cli {
namespace {

TEST(CliPrintable, ControlCharactersAreSpelledOut) {
  EXPECT_EQ(printable("red\x1b[31m"), "red\\x1b[31m");
  EXPECT_EQ(printable("a\nb\rc\td"), "a\\nb\\rc\\td");
  EXPECT_EQ(printable(std::string_view("\0\x7f", 2)), "\\x00\\x7f");
}

TEST(CliPrintable, ControlCharactersAbove127AreSpelledOut) {
  EXPECT_EQ(printable("a\xc2\x9b"
                      "b"),
            "a\\x9bb");
  EXPECT_EQ(printable("a\x9b"
                      "b"),
            "a\\x9bb");
}

TEST(CliPrintable, EverythingElseStays) {
  for (const char* text :
       {"", "room", "C:\\rooms\\1", "Bücherregal", "部屋", "🚪 door", "\xc3", "\xe9t\xe9", "\xc2\xa0"})
    EXPECT_EQ(printable(text), text);
}

}  // namespace
}  // namespace shaftcull::cli
