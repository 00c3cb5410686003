// SPDX-License-Identifier: MIT
#include "box_text.hpp"

#include <algorithm>
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
std::vector<float> numbers_of(std::string_view what, std::string_view text, std::string_view rule) {
  std::vector<float> numbers;
  for (const std::string_view field : fields_of(text)) {
    const auto [value, error] = parse_number<float>(field);
    if (error == std::errc::result_out_of_range) {
      throw InvalidArgument(fmt::format("{}: '{}' is beyond what a float holds; {}", what, field, rule));
    }
    if (error != std::errc()) throw InvalidArgument(fmt::format("{}: '{}' is not a number; {}", what, field, rule));
    numbers.push_back(value);
  }
  return numbers;
}

[[noreturn]] void refuse_count(std::string_view what, std::size_t count, std::string_view rule) {
  throw InvalidArgument(fmt::format("{}: {} number{}; {}", what, count, count == 1 ? "" : "s", rule));
}

void require_finite(const Vec3& vector, std::string_view what) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::isfinite(vector[axis])) continue;
    throw InvalidArgument(fmt::format("{}: {} is {}; give finite numbers", what, "xyz"[axis], vector[axis]));
  }
}

void require_box(const Box& box, std::string_view what) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const auto& [side, corner] : {std::pair("lo", &box.lo), std::pair("hi", &box.hi)}) {
      const float x = (*corner)[axis];
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

}  // namespace

bool looks_like_box(std::string_view text) {
  const std::vector<std::string_view> fields = fields_of(text);
  return fields.size() > 1 && parse_number<float>(fields.front()).error != std::errc::invalid_argument;
}

Box box_option(std::string_view option, std::string_view text) {
  const std::string what = fmt::format("{} {}", option, text);
  const std::vector<float> numbers = numbers_of(what, text, of_a_box);
  if (numbers.size() != 6) refuse_count(what, numbers.size(), of_a_box);
  const Box box{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
  require_box(box, what);
  return box;
}

Vec3 vector_option(std::string_view option, std::string_view text, std::string_view noun) {
  const std::string what = fmt::format("{} {}", option, text);
  const std::string rule = fmt::format("{} takes three numbers: x,y,z", noun);
  const std::vector<float> numbers = numbers_of(what, text, rule);
  if (numbers.size() != 3) refuse_count(what, numbers.size(), rule);
  const Vec3 vector{numbers[0], numbers[1], numbers[2]};
  require_finite(vector, what);
  return vector;
}

std::vector<Vec3> corners_option(std::string_view option, std::string_view text) {
  const auto commas = std::count(text.begin(), text.end(), ',');
  if (commas != 2 && commas != 5) {
    throw InvalidArgument(
        fmt::format("{} {}: neither a point, x,y,z, nor a box, lo x,lo y,lo z,hi x,hi y,hi z", option, text));
  }
  if (commas == 2) return {vector_option(option, text, "a point")};
  const Box box = box_option(option, text);
  std::vector<Vec3> corners;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vec3 point{};
    for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = ((corner >> axis & 1) != 0 ? box.hi : box.lo)[axis];
    corners.push_back(point);
  }
  return corners;
}

std::string to_text(const Box& box) {
  return fmt::format("{},{},{},{},{},{}", box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2]);
}

std::string to_text(const Vec3& vector) { return fmt::format("{},{},{}", vector[0], vector[1], vector[2]); }

}  // namespace shaftcull::cli
