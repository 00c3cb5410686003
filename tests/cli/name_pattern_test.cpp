// SPDX-License-Identifier: MIT
/// Patterns of names.
#include "name_pattern.hpp"

#include <gtest/gtest.h>

#include <string>

namespace shaftcull::cli {
namespace {

TEST(NamePattern, MatchesTheNameItself) {
  EXPECT_TRUE(matches("wall", "wall"));
  EXPECT_TRUE(matches("", ""));
  for (const char* name : {"wal", "walls", "Wall", ""}) EXPECT_FALSE(matches("wall", name)) << name;
}

TEST(NamePattern, HasStarsForAnyCharacters) {
  for (const char* name : {"wall", "wall 1", "wall/*"}) EXPECT_TRUE(matches("wall*", name)) << name;
  EXPECT_TRUE(matches("*", ""));
  EXPECT_TRUE(matches("*a*b*", "xxaxxabb"));
  EXPECT_TRUE(matches("*ab", "aab"));
  EXPECT_FALSE(matches("*ab", "aba"));
  EXPECT_FALSE(matches("w*l*x", "wall"));
  EXPECT_FALSE(matches(std::string(40, '*') + 'b', std::string(5000, 'a')));  // and soon
}

TEST(NamePattern, HasSymbolsForOneCharacter) {
  EXPECT_TRUE(matches("w?ll", "well"));
  EXPECT_FALSE(matches("wall?", "wall"));
  EXPECT_TRUE(matches("w[ae]ll", "well"));
  EXPECT_TRUE(matches("wall[0-9]", "wall7"));
  EXPECT_FALSE(matches("wall[!0-9]", "wall7"));
  EXPECT_TRUE(matches("wall[^0-9]", "wallx"));
  EXPECT_TRUE(matches("[]-]", "]"));
  EXPECT_TRUE(matches("[]-]", "-"));
  EXPECT_TRUE(matches("[a-]", "-"));
}

TEST(NamePattern, MayHaveAnyOfThemAsItself) {
  EXPECT_TRUE(matches("\\*\\?\\[", "*?["));
  EXPECT_FALSE(matches("\\*", "wall"));
  EXPECT_TRUE(matches("[\\]]", "]"));
  EXPECT_TRUE(matches("[wall", "[wall"));  // a set that has no end
  EXPECT_TRUE(matches("wall\\", "wall\\"));
}

}  // namespace
}  // namespace shaftcull::cli
