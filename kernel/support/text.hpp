// SPDX-License-Identifier: MIT
/// Numbers in messages.
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>

namespace shaftcull::kernel {

/// The shortest decimal that reads back to the same float: "3", "0.1", "1e+30", "inf", "nan".
inline std::string text(float number) {
  if (std::isnan(number)) return "nan";  // without a sign that means nothing
  char digits[32];
  const std::to_chars_result written = std::to_chars(digits, digits + sizeof digits, number);
  return {digits, written.ptr};
}

/// "1 word", "2 words".
inline std::string counted(std::size_t count, const char* noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// "1 index", "2 indices".
inline std::string counted_indices(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " index" : " indices");
}

}  // namespace shaftcull::kernel
