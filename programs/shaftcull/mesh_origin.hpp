// SPDX-License-Identifier: MIT
/// OBJ files in map coordinates: their vertices in doubles, relative to an origin near them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "mesh.hpp"

namespace shaftcull::cli {

/// A whole number on each axis near the middle of the vertices of an OBJ file, if they are so far from 0 that floats
/// near the middle are eight times as fine. Otherwise nothing, and nothing if a vertex cannot be read here.
[[nodiscard]] std::optional<WorldPoint> origin_of_obj(std::string_view bytes);

/// The same OBJ file with its vertices relative to an origin: coordinates are read and subtracted in doubles, and
/// written with all digits. Throws InvalidArgument, naming the line of the file that is called `name`, for a vertex
/// that is not three numbers, or that has a weight.
[[nodiscard]] std::string obj_relative_to(std::string_view bytes, const WorldPoint& origin, const std::string& name);

}  // namespace shaftcull::cli
