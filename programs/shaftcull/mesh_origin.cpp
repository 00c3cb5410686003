// SPDX-License-Identifier: MIT
#include "mesh_origin.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include <fmt/format.h>

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

/// What a line has if it is one of a vertex.
std::optional<Vertex> vertex_in(std::string_view line) {
  line = without_blanks(line);
  if (line.size() < 2 || line[0] != 'v' || blanks.find(line[1]) == std::string_view::npos) return {};
  line.remove_prefix(1);
  Vertex vertex{};
  for (double& coordinate : vertex.at) {
    line = without_blanks(line);
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), coordinate);
    if (error != std::errc() || !std::isfinite(coordinate)) return {};
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  }
  vertex.rest = line;
  return vertex;
}

}  // namespace

std::optional<WorldPoint> origin_of_obj(std::string_view bytes) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  WorldPoint lo{infinity, infinity, infinity};
  WorldPoint hi{-infinity, -infinity, -infinity};
  while (!bytes.empty()) {
    const std::optional<Vertex> vertex = vertex_in(take_line(bytes));
    if (!vertex) continue;
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

std::string obj_relative_to(std::string_view bytes, const WorldPoint& origin) {
  std::string relative;
  relative.reserve(bytes.size());
  while (!bytes.empty()) {
    const std::string_view line = take_line(bytes);
    if (const std::optional<Vertex> vertex = vertex_in(line)) {
      fmt::format_to(std::back_inserter(relative), "v {} {} {}{}\n", vertex->at[0] - origin[0],
                     vertex->at[1] - origin[1], vertex->at[2] - origin[2], vertex->rest);
    } else {
      relative.append(line).push_back('\n');
    }
  }
  return relative;
}

}  // namespace shaftcull::cli
