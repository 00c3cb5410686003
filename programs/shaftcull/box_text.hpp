// SPDX-License-Identifier: MIT
/// Boxes and vectors as text: "lo x,lo y,lo z,hi x,hi y,hi z" and "x,y,z".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "shaftcull/origin.hpp"

namespace shaftcull::cli {

/// Whether `text` is meant for a box rather than a name: it has a comma, and a number before the first.
[[nodiscard]] bool looks_like_box(std::string_view text);

/// The box that `text` spells. Throws InvalidArgument, naming the option and what is wrong, unless it is six finite
/// numbers with lo ≤ hi.
[[nodiscard]] Box box_option(std::string_view option, std::string_view text);
/// The same relative to an origin: corners are read in doubles, and rounded to the nearest floats, as vertices are.
[[nodiscard]] Box box_option(std::string_view option, std::string_view text, const Origin& origin);

/// The vector that `text` spells. Throws InvalidArgument, naming the option, what the vector is ("a displacement") and
/// what is wrong, unless it is three finite numbers.
[[nodiscard]] Vec3 vector_option(std::string_view option, std::string_view text, std::string_view noun);

/// The same with all digits.
[[nodiscard]] WorldVec3 world_point_option(std::string_view option, std::string_view text, std::string_view noun);

/// The point that `text` spells in three numbers, or the eight corners of the box that it spells in six.
[[nodiscard]] std::vector<Vec3> corners_option(std::string_view option, std::string_view text);
/// The same relative to an origin, in the same way.
[[nodiscard]] std::vector<Vec3> corners_option(std::string_view option, std::string_view text, const Origin& origin);

[[nodiscard]] std::string to_text(const Box& box);
[[nodiscard]] std::string to_text(const Vec3& vector);

/// The number with the fewest digits that is `value` as a float: 0.1, not 0.10000000149.
[[nodiscard]] double shortest(float value);
/// The number with the fewest digits that is `value` as a float relative to the origin.
[[nodiscard]] double shortest(float value, double origin);
/// The box where it is in the world, as text.
[[nodiscard]] std::string to_text(const Box& box, const WorldVec3& origin);

}  // namespace shaftcull::cli
