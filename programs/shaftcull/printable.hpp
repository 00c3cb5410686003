// SPDX-License-Identifier: MIT
/// Text from files, for the eyes of a reader.
#pragma once

#include <string>
#include <string_view>

namespace shaftcull::cli {

/// `text` with its control characters spelled out, "\n" or "\x1b", so that no terminal obeys them: those of ASCII, and
/// U+0080 to U+009F in UTF-8 or as single bytes. Everything else, other bytes that are not UTF-8 too, stays.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace shaftcull::cli
