// SPDX-License-Identifier: MIT
#include "name_pattern.hpp"

#include <cstddef>

namespace shaftcull::cli {
namespace {

/// The first character of a pattern, or the set of characters that it begins with.
struct Symbol {
  std::size_t size;  ///< of its text in the pattern
  bool matches;      ///< a character
};

Symbol symbol_of(std::string_view pattern, char c) {
  if (pattern[0] == '\\' && pattern.size() > 1) return {2, pattern[1] == c};
  if (pattern[0] == '?') return {1, true};
  if (pattern[0] != '[') return {1, pattern[0] == c};
  const auto code = [](char x) { return static_cast<unsigned char>(x); };
  const bool is_negative = pattern.size() > 1 && (pattern[1] == '!' || pattern[1] == '^');
  const std::size_t begin = is_negative ? 2 : 1;
  bool is_in_set = false;
  // A ] that comes first is one of the set.
  for (std::size_t i = begin; i < pattern.size(); ++i) {
    if (pattern[i] == ']' && i != begin) return {i + 1, is_in_set != is_negative};
    if (pattern[i] == '\\' && i + 1 < pattern.size()) ++i;
    const char first = pattern[i];
    char last = first;
    if (i + 2 < pattern.size() && pattern[i + 1] == '-' && pattern[i + 2] != ']') {
      last = pattern[i + 2];
      i += 2;
    }
    is_in_set = is_in_set || (code(first) <= code(c) && code(c) <= code(last));
  }
  return {1, pattern[0] == c};  // the set has no end, so [ is itself
}

}  // namespace

bool matches(std::string_view pattern, std::string_view name) {
  // Only the last * need be tried again: what one before it took more would leave less for this one.
  constexpr std::size_t none = std::string_view::npos;
  std::size_t p = 0;
  std::size_t n = 0;
  std::size_t behind_star = none;
  std::size_t taken_to = 0;  // where what that * takes ends
  while (n != name.size() || p != pattern.size()) {
    if (p != pattern.size() && pattern[p] == '*') {
      behind_star = ++p;
      taken_to = n;
      continue;
    }
    if (p != pattern.size() && n != name.size()) {
      if (const Symbol symbol = symbol_of(pattern.substr(p), name[n]); symbol.matches) {
        p += symbol.size;
        ++n;
        continue;
      }
    }
    if (behind_star == none || taken_to == name.size()) return false;
    p = behind_star;
    n = ++taken_to;
  }
  return true;
}

}  // namespace shaftcull::cli
