// SPDX-License-Identifier: MIT
#include "mesh_origin.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "mesh_format.hpp"
#include "number.hpp"
#include "printable.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

using Words = std::vector<std::string_view>;

/// The line at the beginning, which is taken away with its end.
std::string_view take_line(std::string_view& bytes) {
  const std::string_view line = bytes.substr(0, bytes.find('\n'));
  bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
  return line;
}

void split(std::string_view line, Words& words) {
  constexpr std::string_view blanks = " \t\r";
  words.clear();
  for (std::size_t begin = 0; (begin = line.find_first_not_of(blanks, begin)) != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = end;
  }
}

/// Bytes of a scalar of a PLY file; 0 for an unknown type.
std::size_t size_of(std::string_view type) {
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
  if (type == "int" || type == "uint" || type == "int32" || type == "uint32") return 4;
  if (type == "float" || type == "float32") return 4;
  return type == "double" || type == "float64" ? 8 : 0;
}

bool is_real(std::string_view type) {
  return type == "float" || type == "float32" || type == "double" || type == "float64";
}

/// Where vertices are, if they come first in the file and have no lists.
std::optional<VertexPlaces> places_in_ply(std::string_view bytes) {
  const std::string_view whole = bytes;
  VertexPlaces places;
  std::size_t elements = 0;
  std::size_t columns = 0;
  unsigned found = 0;  // bit k: coordinate k
  bool are_doubles = true;
  bool has_ended = false;
  Words words;
  while (!bytes.empty() && !has_ended) {
    split(take_line(bytes), words);
    ++places.first;
    if (words.empty()) continue;
    has_ended = words[0] == "end_header";
    if (words[0] == "format" && words.size() > 1) {
      if (elements != 0) return {};
      places.is_text = words[1] == "ascii";
      places.is_big_endian = words[1] == "binary_big_endian";
      if (!places.is_text && !places.is_big_endian && words[1] != "binary_little_endian") return {};
    } else if (words[0] == "element" && words.size() == 3) {
      if (++elements > 1) continue;
      const auto [count, error] = parse_number<std::size_t>(words[2]);
      if (words[1] != "vertex" || error != std::errc()) return {};
      places.count = count;
    } else if (words[0] == "property" && elements == 1) {
      const std::size_t size = words.size() == 3 ? size_of(words[1]) : 0;
      if (size == 0) return {};
      const std::size_t axis = words[2].size() == 1 ? std::size_t(words[2][0]) - 'x' : 3;
      if (axis < 3) {
        if ((found >> axis & 1U) != 0 || !is_real(words[1])) return {};
        places.place[axis] = places.is_text ? columns : places.stride;
        are_doubles = are_doubles && size == 8;
        found |= 1U << axis;
      }
      ++columns;
      places.stride += size;
    }
  }
  if (!has_ended || found != 7 || places.count == 0) return {};
  if (places.is_text) return places;
  places.first = whole.size() - bytes.size();
  if (!are_doubles || bytes.size() / places.stride < places.count) return {};
  return places;
}

/// Whether a vertex of an OBJ file has three numbers and no more, or three of a colour, or a weight of 1. Coordinates
/// are divided by another weight.
bool has_no_weight(const Words& words) {
  std::size_t numbers = 0;
  while (numbers + 1 < words.size() && parse_number<double>(words[numbers + 1]).error == std::errc()) ++numbers;
  return numbers == 3 || numbers == 6 || (numbers == 4 && parse_number<double>(words[4]).value == 1);
}

/// Nothing for a line that is not three finite numbers, or goes on in the next one, or has a weight.
std::optional<WorldPoint> vertex_in(const Words& words, const VertexPlaces& places) {
  WorldPoint vertex{};
  for (std::size_t k = 0; k != 3; ++k) {
    if (words.size() <= places.place[k]) return {};
    const auto [number, error] = parse_number<double>(words[places.place[k]]);
    if (error != std::errc() || !std::isfinite(number)) return {};
    vertex[k] = number;
  }
  if (places.keyword == "v" && (!has_no_weight(words) || words.back().ends_with('\\'))) return {};
  return vertex;
}

/// Calls `is_vertex(words, line, number)` for each line of a vertex and `is_other(line)` for each other one, until one
/// of the former returns false. Returns whether none did.
template <class IsVertex, class IsOther>
bool each_line(std::string_view bytes, const VertexPlaces& places, const IsVertex& is_vertex, const IsOther& is_other) {
  Words words;
  for (std::size_t number = 0; !bytes.empty(); ++number) {
    const std::string_view line = take_line(bytes);
    split(line, words);
    // To assimp, a keyword behind a blank is none in OBJ files.
    const bool has_keyword = !words.empty() && words[0] == places.keyword && (words[0] != "v" || line[0] == 'v');
    const bool is_one = places.keyword.empty() ? number - places.first < places.count : has_keyword;
    if (!is_one) {
      is_other(line);
    } else if (!is_vertex(words, line, number)) {
      return false;
    }
  }
  return true;
}

/// A coordinate of a binary file.
double number_at(const char* from, bool is_big_endian) {
  std::array<unsigned char, 8> bytes{};
  std::memcpy(bytes.data(), from, bytes.size());
  if (is_big_endian != (std::endian::native == std::endian::big)) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<double>(bytes);
}
void put_number(char* to, bool is_big_endian, double number) {
  auto bytes = std::bit_cast<std::array<unsigned char, 8>>(number);
  if (is_big_endian != (std::endian::native == std::endian::big)) std::reverse(bytes.begin(), bytes.end());
  std::memcpy(to, bytes.data(), bytes.size());
}

void add(VertexExtent& extent, std::size_t k, double x) {
  extent.lo[k] = std::min(extent.lo[k], x);
  extent.hi[k] = std::max(extent.hi[k], x);
}

/// Whether lines end as those of Unix or Windows, and nothing else in the text ends a line for assimp.
bool has_usual_lines(std::string_view text) {
  constexpr std::string_view odd("\0\f\v", 3);
  if (text.find_first_of(odd) != std::string_view::npos) return false;
  for (std::size_t at = 0; (at = text.find('\r', at)) != std::string_view::npos; ++at) {
    if (at + 1 == text.size() || text[at + 1] != '\n') return false;
  }
  return true;
}

/// Whether each vertex of an STL file of text is a line of its own. To assimp all blanks are alike.
bool has_vertices_in_lines(std::string_view text) {
  Words words;
  while (!text.empty()) {
    split(take_line(text), words);
    if (words.empty() || words[0] == "solid" || words[0] == "endsolid") continue;
    const auto found = std::find(words.begin(), words.end(), "vertex");
    if (found != words.end() && (found != words.begin() || words.size() != 4)) return false;
  }
  return true;
}

}  // namespace

std::optional<VertexPlaces> vertex_places(std::string_view bytes, std::string_view ending) {
  std::optional<VertexPlaces> places;
  if (ending == "obj") places = VertexPlaces{.keyword = "v", .place = {1, 2, 3}};
  if (ending == "stl" && !is_binary_stl(bytes) && has_vertices_in_lines(bytes)) {
    places = VertexPlaces{.keyword = "vertex", .place = {1, 2, 3}};
  }
  if (ending == "ply") places = places_in_ply(bytes);
  if (places && places->is_text && !has_usual_lines(bytes)) return {};
  return places;
}

std::optional<VertexExtent> extent_of(std::string_view bytes, const VertexPlaces& places) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  VertexExtent extent{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  if (places.is_text) {
    const auto take = [&](const Words& words, std::string_view /*line*/, std::size_t /*number*/) {
      const std::optional<WorldPoint> vertex = vertex_in(words, places);
      for (std::size_t k = 0; vertex && k != 3; ++k) add(extent, k, (*vertex)[k]);
      return vertex.has_value();
    };
    if (!each_line(bytes, places, take, [](std::string_view) {})) return {};
    return extent;
  }
  for (std::size_t i = 0; i != places.count; ++i) {
    const char* const vertex = bytes.data() + places.first + i * places.stride;
    for (std::size_t k = 0; k != 3; ++k) {
      const double x = number_at(vertex + places.place[k], places.is_big_endian);
      if (!std::isfinite(x)) return {};
      add(extent, k, x);
    }
  }
  return extent;
}

std::optional<WorldPoint> origin_of(const VertexExtent& extent) {
  double largest = 0;
  double longest = 0;
  for (std::size_t k = 0; k != 3; ++k) {
    largest = std::max({largest, std::abs(extent.lo[k]), std::abs(extent.hi[k])});
    longest = std::max(longest, extent.hi[k] - extent.lo[k]);
  }
  constexpr double gain = 8;  // in steps of floats, at half the length
  if (!(longest > 0) || !std::isfinite(largest) || largest < gain * longest / 2) return {};
  WorldPoint origin{};
  for (std::size_t k = 0; k != 3; ++k) origin[k] = std::round(0.5 * extent.lo[k] + 0.5 * extent.hi[k]);
  return origin;
}

std::string relative_to(const WorldPoint& origin, std::string_view bytes, const VertexPlaces& places,
                        const std::string& name) {
  if (!places.is_text) {
    // assimp takes a first byte of 10 for a part of the header, unless that ends as lines of Windows do.
    std::string relative(bytes.substr(0, places.first));
    while (relative.ends_with('\n') || relative.ends_with('\r')) relative.pop_back();
    relative += "\r\n";
    const std::size_t first = relative.size();
    relative.append(bytes.substr(places.first));
    for (std::size_t i = 0; i != places.count; ++i) {
      char* const vertex = relative.data() + first + i * places.stride;
      for (std::size_t k = 0; k != 3; ++k) {
        char* const at = vertex + places.place[k];
        put_number(at, places.is_big_endian, number_at(at, places.is_big_endian) - origin[k]);
      }
    }
    return relative;
  }
  std::string relative;
  relative.reserve(bytes.size());
  const auto move = [&](const Words& words, std::string_view line, std::size_t number) {
    const std::optional<WorldPoint> vertex = vertex_in(words, places);
    if (!vertex) {
      throw InvalidArgument(
          fmt::format("{}:{}: \"{}\" is not a vertex of three numbers, so no origin can be subtracted; --origin 0,0,0 "
                      "subtracts none",
                      name, number + 1,
                      printable(std::string(line.substr(std::min(line.find_first_not_of(" \t"), line.size()), 40)))));
    }
    for (std::size_t i = 0; i != words.size(); ++i) {
      const auto k =
          static_cast<std::size_t>(std::find(places.place.begin(), places.place.end(), i) - places.place.begin());
      if (i != 0) relative += ' ';
      if (k < 3) {
        fmt::format_to(std::back_inserter(relative), "{}", (*vertex)[k] - origin[k]);
      } else {
        relative.append(words[i]);
      }
    }
    relative += '\n';
    return true;
  };
  each_line(bytes, places, move, [&](std::string_view line) { relative.append(line).push_back('\n'); });
  return relative;
}

}  // namespace shaftcull::cli
