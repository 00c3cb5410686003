// SPDX-License-Identifier: MIT
#include "printable.hpp"

#include <cstddef>

#include <fmt/format.h>

namespace shaftcull::cli {
namespace {

constexpr bool continues(char c) noexcept { return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U; }

/// Bytes of the UTF-8 sequence that `text` begins with; 1 if it begins with none.
std::size_t sequence_length(std::string_view text) noexcept {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t length = lead >= 0xf0 && lead < 0xf8   ? 4
                             : lead >= 0xe0 && lead < 0xf0 ? 3
                             : lead >= 0xc2 && lead < 0xe0 ? 2
                                                           : 1;
  if (length > text.size()) return 1;
  for (std::size_t i = 1; i < length; ++i) {
    if (!continues(text[i])) return 1;
  }
  return length;
}

std::string spelled(char control) {
  switch (control) {
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    default:
      return fmt::format("\\x{:02x}", static_cast<unsigned char>(control));
  }
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = sequence_length(text);
    const auto last = static_cast<unsigned char>(text[length - 1]);
    const bool is_control = length == 1   ? last < 0x20 || last == 0x7f || (last >= 0x80 && last < 0xa0)
                            : length == 2 ? text.front() == '\xc2' && last < 0xa0
                                          : false;
    if (is_control) {
      result += spelled(text[length - 1]);
    } else {
      result += text.substr(0, length);
    }
    text.remove_prefix(length);
  }
  return result;
}

}  // namespace shaftcull::cli
