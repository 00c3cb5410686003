// SPDX-License-Identifier: MIT
/// The known names that come closest to a mistyped one.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace shaftcull::cli {

/// "'a', 'b', 'c'": all `names` if there are few, else those at the smallest edit distance from `wanted` and how
/// many more there are.
[[nodiscard]] std::string closest_names(std::string_view wanted, std::span<const std::string> names);

}  // namespace shaftcull::cli
