// SPDX-License-Identifier: MIT
#include "mesh_origin.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "printable.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

constexpr std::string_view blanks = " \t\r";

/// The line at the beginning, which is taken away with its end.
std::string_view take_line(std::string_view& bytes) {
  const std::string_view line = bytes.substr(0, bytes.find('\n'));
  bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
  return line;
}

std::string_view without_blanks(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text;
}

/// A vertex, and what follows its coordinates: weights or colours.
struct Vertex {
  WorldPoint at;
  std::string_view rest;
};

/// The number at the beginning, which is taken away.
std::optional<double> take_number(std::string_view& text) {
  text = without_blanks(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || !std::isfinite(number)) return {};
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

/// A single number behind the coordinates is a weight, which they are divided by.
bool has_weight(std::string_view rest) {
  const std::optional<double> weight = take_number(rest);
  return weight && *weight != 1 && without_blanks(rest).empty();
}

bool is_vertex(std::string_view line) {
  line = without_blanks(line);
  return line.size() >= 2 && line[0] == 'v' && blanks.find(line[1]) != std::string_view::npos;
}

/// Nothing for a vertex that is not three numbers, or goes on in the next line, or has a weight.
std::optional<Vertex> vertex_in(std::string_view line) {
  line = without_blanks(line).substr(1);
  Vertex vertex{};
  for (double& coordinate : vertex.at) {
    const std::optional<double> number = take_number(line);
    if (!number) return {};
    coordinate = *number;
  }
  vertex.rest = line;
  if (has_weight(line) || line.find('\\') != std::string_view::npos) return {};
  return vertex;
}

}  // namespace

std::optional<WorldPoint> origin_of_obj(std::string_view bytes) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  WorldPoint lo{infinity, infinity, infinity};
  WorldPoint hi{-infinity, -infinity, -infinity};
  while (!bytes.empty()) {
    const std::string_view line = take_line(bytes);
    if (!is_vertex(line)) continue;
    const std::optional<Vertex> vertex = vertex_in(line);
    if (!vertex) return {};
    for (std::size_t k = 0; k != 3; ++k) {
      lo[k] = std::min(lo[k], vertex->at[k]);
      hi[k] = std::max(hi[k], vertex->at[k]);
    }
  }
  double largest = 0;
  double longest = 0;
  for (std::size_t k = 0; k != 3; ++k) {
    largest = std::max({largest, std::abs(lo[k]), std::abs(hi[k])});
    longest = std::max(longest, hi[k] - lo[k]);
  }
  constexpr double gain = 8;  // in steps of floats, at half the length
  if (!(longest > 0) || !std::isfinite(largest) || largest < gain * longest / 2) return {};
  WorldPoint origin{};
  for (std::size_t k = 0; k != 3; ++k) origin[k] = std::round(0.5 * lo[k] + 0.5 * hi[k]);
  return origin;
}

std::string obj_relative_to(std::string_view bytes, const WorldPoint& origin, const std::string& name) {
  std::string relative;
  relative.reserve(bytes.size());
  for (std::size_t number = 1; !bytes.empty(); ++number) {
    const std::string_view line = take_line(bytes);
    if (!is_vertex(line)) {
      relative.append(line).push_back('\n');
      continue;
    }
    const std::optional<Vertex> vertex = vertex_in(line);
    if (!vertex) {
      throw InvalidArgument(fmt::format(
          "{}:{}: \"{}\" is no vertex of three numbers, so no origin can be subtracted; --origin 0,0,0 subtracts none",
          name, number, printable(std::string(without_blanks(line).substr(0, 40)))));
    }
    fmt::format_to(std::back_inserter(relative), "v {} {} {}{}\n", vertex->at[0] - origin[0], vertex->at[1] - origin[1],
                   vertex->at[2] - origin[2], vertex->rest);
  }
  return relative;
}

}  // namespace shaftcull::cli
