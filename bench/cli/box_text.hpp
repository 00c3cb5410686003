/// A box as text: "lo x,lo y,lo z,hi x,hi y,hi z".
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "shaftcull/bounds.hpp"

namespace shaftcull::cli {

/// The box that `text` spells, or nothing if it is not six comma-separated numbers. Nothing else is checked.
[[nodiscard]] std::optional<Box> box_from_text(std::string_view text);

/// Likewise, for an option that takes nothing but a box. Throws InvalidArgument, naming the option, unless it
/// is six finite numbers with lo ≤ hi.
[[nodiscard]] Box box_option(std::string_view option, std::string_view text);

/// Throws InvalidArgument unless `box` is finite with lo ≤ hi; `what` tells whose box it is.
void require_finite(const Box& box, std::string_view what);

[[nodiscard]] std::string to_text(const Box& box);

}  // namespace shaftcull::cli
