// SPDX-License-Identifier: MIT
#include "box_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "number.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

std::vector<std::string_view> fields_of(std::string_view text) {
  std::vector<std::string_view> fields;
  for (std::size_t comma = 0; (comma = text.find(',')) != std::string_view::npos; text.remove_prefix(comma + 1)) {
    fields.push_back(text.substr(0, comma));
  }
  fields.push_back(text);
  return fields;
}

constexpr std::string_view of_a_box = "a box takes six numbers: lo x,lo y,lo z,hi x,hi y,hi z";

/// The finite or infinite numbers that `text` spells. Throws InvalidArgument with `rule` for a field that is none.
template <class Number>
std::vector<Number> numbers_of(std::string_view what, std::string_view text, std::string_view rule) {
  std::vector<Number> numbers;
  for (const std::string_view field : fields_of(text)) {
    const auto [value, error] = parse_number<Number>(field);
    if (error == std::errc::result_out_of_range) {
      throw InvalidArgument(fmt::format("{}: '{}' is out of range for a {}; {}", what, field,
                                        sizeof(Number) == sizeof(float) ? "float" : "double", rule));
    }
    if (error != std::errc()) throw InvalidArgument(fmt::format("{}: '{}' is not a number; {}", what, field, rule));
    numbers.push_back(value);
  }
  return numbers;
}

[[noreturn]] void refuse_count(std::string_view what, std::size_t count, std::string_view rule) {
  throw InvalidArgument(fmt::format("{}: {} number{}; {}", what, count, count == 1 ? "" : "s", rule));
}

template <class Number>
void require_finite(const std::array<Number, 3>& vector, std::string_view what) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::isfinite(vector[axis])) continue;
    throw InvalidArgument(fmt::format("{}: {} is {}; give finite numbers", what, "xyz"[axis], vector[axis]));
  }
}

template <class AnyBox>
void require_box(const AnyBox& box, std::string_view what) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const auto& [side, corner] : {std::pair("lo", &box.lo), std::pair("hi", &box.hi)}) {
      const auto x = (*corner)[axis];
      if (!std::isfinite(x)) {
        throw InvalidArgument(fmt::format("{}: {} {} is {}; a shaft needs finite boxes", what, side, "xyz"[axis], x));
      }
    }
    if (box.lo[axis] > box.hi[axis]) {
      throw InvalidArgument(fmt::format("{}: lo {} = {} is greater than hi {} = {}; give lo x,y,z, then hi x,y,z", what,
                                        "xyz"[axis], box.lo[axis], "xyz"[axis], box.hi[axis]));
    }
  }
}

/// Of floats or doubles: a Box or a WorldBox.
template <class AnyBox, class Number>
AnyBox any_box(std::string_view option, std::string_view text) {
  const std::string what = fmt::format("{} {}", option, text);
  const std::vector<Number> numbers = numbers_of<Number>(what, text, of_a_box);
  if (numbers.size() != 6) refuse_count(what, numbers.size(), of_a_box);
  const AnyBox box{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
  require_box(box, what);
  return box;
}

template <class Number>
std::array<Number, 3> any_vector(std::string_view option, std::string_view text, std::string_view noun) {
  const std::string what = fmt::format("{} {}", option, text);
  const std::string rule = fmt::format("{} takes three numbers: x,y,z", noun);
  const std::vector<Number> numbers = numbers_of<Number>(what, text, rule);
  if (numbers.size() != 3) refuse_count(what, numbers.size(), rule);
  const std::array<Number, 3> vector{numbers[0], numbers[1], numbers[2]};
  require_finite(vector, what);
  return vector;
}

template <class AnyBox, class Number>
std::vector<std::array<Number, 3>> any_corners(std::string_view option, std::string_view text) {
  const auto commas = std::count(text.begin(), text.end(), ',');
  if (commas != 2 && commas != 5) {
    throw InvalidArgument(
        fmt::format("{} {}: neither a point, x,y,z, nor a box, lo x,lo y,lo z,hi x,hi y,hi z", option, text));
  }
  if (commas == 2) return {any_vector<Number>(option, text, "a point")};
  const AnyBox box = any_box<AnyBox, Number>(option, text);
  std::vector<std::array<Number, 3>> corners;
  for (unsigned corner = 0; corner < 8; ++corner) {
    std::array<Number, 3> point{};
    for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = ((corner >> axis & 1) != 0 ? box.hi : box.lo)[axis];
    corners.push_back(point);
  }
  return corners;
}

}  // namespace

bool looks_like_box(std::string_view text) {
  const std::vector<std::string_view> fields = fields_of(text);
  return fields.size() > 1 && parse_number<float>(fields.front()).error != std::errc::invalid_argument;
}

Box box_option(std::string_view option, std::string_view text) { return any_box<Box, float>(option, text); }

Box box_option(std::string_view option, std::string_view text, const Origin& origin) {
  if (origin == Origin()) return box_option(option, text);
  const WorldBox world = any_box<WorldBox, double>(option, text);
  const Box box{origin.nearest(world.lo), origin.nearest(world.hi)};
  require_box(box, fmt::format("{} {}, relative to {}", option, text, fmt::join(origin.at(), ",")));
  return box;
}

Vec3 vector_option(std::string_view option, std::string_view text, std::string_view noun) {
  return any_vector<float>(option, text, noun);
}

WorldVec3 world_point_option(std::string_view option, std::string_view text, std::string_view noun) {
  return any_vector<double>(option, text, noun);
}

std::vector<Vec3> corners_option(std::string_view option, std::string_view text) {
  return any_corners<Box, float>(option, text);
}

std::vector<Vec3> corners_option(std::string_view option, std::string_view text, const Origin& origin) {
  if (origin == Origin()) return corners_option(option, text);
  std::vector<Vec3> corners;
  for (const WorldVec3& corner : any_corners<WorldBox, double>(option, text)) {
    corners.push_back(origin.nearest(corner));
    require_finite(corners.back(), fmt::format("{} {}, relative to {}", option, text, fmt::join(origin.at(), ",")));
  }
  return corners;
}

std::string to_text(const Box& box) {
  return fmt::format("{},{},{},{},{},{}", box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2]);
}

std::string to_text(const Vec3& vector) { return fmt::format("{},{},{}", vector[0], vector[1], vector[2]); }

double shortest(float value) { return parse_number<double>(fmt::format("{}", value)).value; }

double shortest(float value, double origin) {
  if (origin == 0) return shortest(value);
  const double exact = double{value} + origin;
  constexpr int most_digits = 17;
  for (int digits = 1; digits < most_digits; ++digits) {
    const double rounded = parse_number<double>(fmt::format("{:.{}g}", exact, digits)).value;
    if (static_cast<float>(rounded - origin) == value) return rounded;
  }
  return exact;
}

std::string to_text(const Box& box, const WorldVec3& origin) {
  const auto in_world = [&](const Vec3& corner, std::size_t axis) { return shortest(corner[axis], origin[axis]); };
  return fmt::format("{},{},{},{},{},{}", in_world(box.lo, 0), in_world(box.lo, 1), in_world(box.lo, 2),
                     in_world(box.hi, 0), in_world(box.hi, 1), in_world(box.hi, 2));
}

}  // namespace shaftcull::cli
