// SPDX-License-Identifier: MIT
#include "sun_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

#include "file_path.hpp"
#include "number.hpp"
#include "printable.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

constexpr double degree = std::numbers::pi / 180;

double declination(int day) {
  const double angle = 2 * std::numbers::pi * (day - 1) / 365;
  return 0.006918 - 0.399912 * std::cos(angle) + 0.070257 * std::sin(angle) - 0.006758 * std::cos(2 * angle) +
         0.000907 * std::sin(2 * angle) - 0.002697 * std::cos(3 * angle) + 0.00148 * std::sin(3 * angle);
}

Vec3 in_scene(double east, double north, double above, char up) {
  const auto vector = [](double x, double y, double z) {
    return Vec3{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
  };
  if (up == 'x') return vector(above, east, north);
  if (up == 'y') return vector(east, above, -north);
  return vector(east, north, above);
}

/// The numbers between commas, if all are; at most four.
std::vector<double> numbers_of(std::string_view line) {
  std::vector<double> numbers;
  while (numbers.size() != 4) {
    const std::size_t end = std::min(line.find(','), line.size());
    const ParsedNumber<double> number = parse_number<double>(line.substr(0, end));
    if (number.error != std::errc()) return {};
    numbers.push_back(number.value);
    if (end == line.size()) return numbers;
    line.remove_prefix(end + 1);
  }
  return {};
}

}  // namespace

int day_of_year(const std::string& text) {
  constexpr std::array<int, 12> days{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const std::size_t dash = std::min(text.find('-'), text.size());
  const ParsedNumber<unsigned> month = parse_number<unsigned>(std::string_view(text).substr(0, dash));
  const ParsedNumber<int> day = parse_number<int>(std::string_view(text).substr(std::min(dash + 1, text.size())));
  const bool are_numbers = month.error == std::errc() && day.error == std::errc();
  if (!are_numbers || month.value < 1 || month.value > 12 || day.value < 1 || day.value > days[month.value - 1]) {
    throw InvalidArgument(
        fmt::format("--day {}: give a month and a day of a year of 365 days, for example 06-21", printable(text)));
  }
  int number = day.value;
  for (std::size_t m = 0; m + 1 < month.value; ++m) number += days[m];
  return number;
}

double sun_step(double minutes) {
  constexpr double day = 24 * 60;
  return day / static_cast<double>(std::max<long>(1, std::lround(day / minutes)));
}

std::vector<SunPosition> sun_path(double latitude, int day, double minutes, char up) {
  const double phi = latitude * degree;
  const double delta = declination(day);
  const double day_begins = std::acos(std::clamp(-std::tan(phi) * std::tan(delta), -1.0, 1.0));  // before noon
  const long steps = std::lround(24 * 60 / sun_step(minutes));
  const auto begin_of = [&](long step) {
    return 2 * std::numbers::pi * (static_cast<double>(step) / static_cast<double>(steps) - 0.5);
  };
  std::vector<SunPosition> path;
  for (long step = 0; step != steps; ++step) {
    const double begin = std::max(begin_of(step), -day_begins);
    const double end = std::min(begin_of(step + 1), day_begins);
    if (begin >= end) continue;
    const double angle = (begin + end) / 2;
    const double above = std::sin(phi) * std::sin(delta) + std::cos(phi) * std::cos(delta) * std::cos(angle);
    const double east = -std::cos(delta) * std::sin(angle);
    const double north = std::cos(phi) * std::sin(delta) - std::sin(phi) * std::cos(delta) * std::cos(angle);
    path.push_back({in_scene(east, north, above, up), (end - begin) * 12 / std::numbers::pi});
  }
  return path;
}

std::vector<SunPosition> read_sun_positions(const std::string& path) {
  std::ifstream file(file_path(path));
  if (!file) throw InvalidArgument(fmt::format("--directions {}: the file cannot be read", printable(path)));
  std::vector<SunPosition> positions;
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // UTF-8, says the file
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.empty() || line.front() == '#' || (positions.empty() && line.starts_with("x,"))) continue;
    const std::vector<double> numbers = numbers_of(line);
    const auto is_useful = [](double x) { return std::fabs(x) <= 1e30; };
    const bool is_direction =
        numbers.size() >= 3 && std::all_of(numbers.begin(), numbers.end(), is_useful) &&
        (std::fabs(numbers[0]) >= 1e-30 || std::fabs(numbers[1]) >= 1e-30 || std::fabs(numbers[2]) >= 1e-30);
    if (!is_direction || (numbers.size() == 4 && numbers[3] < 0)) {
      throw InvalidArgument(
          fmt::format("--directions {}: line {} is \"{}\"; give a direction to the sun, as x,y,z or x,y,z,hours",
                      printable(path), number, printable(line.substr(0, 80))));
    }
    const double length = std::hypot(numbers[0], numbers[1], numbers[2]);
    Vec3 towards{};
    for (std::size_t k = 0; k != 3; ++k) towards[k] = static_cast<float>(numbers[k] / length);
    positions.push_back({towards, numbers.size() == 4 ? numbers[3] : 1});
  }
  if (file.bad()) throw InvalidArgument(fmt::format("--directions {}: the file cannot be read", printable(path)));
  if (positions.empty())
    throw InvalidArgument(fmt::format("--directions {}: the file has no line x,y,z", printable(path)));
  return positions;
}

}  // namespace shaftcull::cli
