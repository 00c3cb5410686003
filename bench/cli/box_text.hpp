/// A box as text: "lo x,lo y,lo z,hi x,hi y,hi z".
#pragma once

#include <string>
#include <string_view>

#include "shaftcull/bounds.hpp"

namespace shaftcull::cli {

/// Whether `text` is meant for a box rather than a name: it has a comma, and a number before the first.
[[nodiscard]] bool looks_like_box(std::string_view text);

/// The box that `text` spells. Throws InvalidArgument, naming the option and what is wrong, unless it is six finite
/// numbers with lo ≤ hi.
[[nodiscard]] Box box_option(std::string_view option, std::string_view text);

[[nodiscard]] std::string to_text(const Box& box);

}  // namespace shaftcull::cli
