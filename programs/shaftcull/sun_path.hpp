// SPDX-License-Identifier: MIT
/// Where the sun stands in the sky.
#pragma once

#include <string>
#include <vector>

#include "shaftcull/bounds.hpp"

namespace shaftcull::cli {

struct SunPosition {
  Vec3 towards;  ///< the way to it, of length 1
  double hours;  ///< how long it stands there
};

/// A day of the year, from 1 to 365, of its month and day: "06-21". Throws InvalidArgument for any other text.
[[nodiscard]] int day_of_year(const std::string& text);

/// The step of sun_path(), in minutes: near what was asked for, and a part of 24 hours.
[[nodiscard]] double sun_step(double minutes);

/// Where the sun stands on a day, by solar time. The day from sunrise to sunset is cut into steps of about so many
/// minutes, so many that they divide 24 hours; the first and the last one begin and end at the horizon. A position is
/// in the middle of each. `latitude` is in degrees, north of the equator positive. `up` is the axis that points up:
/// with z, x is east and y north; with y, x is east and -z north; with x, y is east and z north.
///
/// The declination is J. Spencer's series, "Fourier Series Representation of the Position of the Sun", Search 2 (1971),
/// which is right to 0.04 degrees.
[[nodiscard]] std::vector<SunPosition> sun_path(double latitude, int day, double minutes, char up);

/// Positions that a file lists, a line each: x,y,z or x,y,z,hours; 1 hour where none is given. Lines that are empty or
/// begin with # are left out, and so is a first one with names, x,y,z. Throws InvalidArgument, with the line, for any
/// other; and if there is none.
[[nodiscard]] std::vector<SunPosition> read_sun_positions(const std::string& path);

}  // namespace shaftcull::cli
