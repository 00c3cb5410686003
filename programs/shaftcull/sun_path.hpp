// SPDX-License-Identifier: MIT
/// Where the sun stands in the sky.
#pragma once

#include <string>
#include <vector>

#include "shaftcull/bounds.hpp"

namespace shaftcull::cli {

struct SunPosition {
  Vec3 towards;  ///< the way to it, of any length
  double hours;  ///< how long it stands there
};

/// A day of the year, from 1 to 365, of its month and day: "06-21". Throws InvalidArgument for any other text.
[[nodiscard]] int day_of_year(const std::string& text);

/// Where the sun stands on a day, by solar time: in the middle of each of equal steps of about so many minutes, where
/// that is above the horizon. `latitude` is in degrees, north of the equator positive. `up` is the axis that points up,
/// x, y or z; then east and north are z, the axes behind it (x, y), −z and x for y, y and z for x.
///
/// The declination is J. Spencer's series, "Fourier Series Representation of the Position of the Sun", Search 2 (1971),
/// which is right to 0.04 degrees.
[[nodiscard]] std::vector<SunPosition> sun_path(double latitude, int day, double minutes, char up);

/// Positions that a file lists, a line each: x,y,z or x,y,z,hours; 1 hour where none is given. Lines that are empty or
/// begin with # are left out. Throws InvalidArgument, with the line, for any other; and if there is none.
[[nodiscard]] std::vector<SunPosition> read_sun_positions(const std::string& path);

}  // namespace shaftcull::cli
