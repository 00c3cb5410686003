#include "box_text.hpp"

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

[[noreturn]] void refuse(std::string_view what, const std::string& why) {
  throw InvalidArgument(fmt::format("{}: {}; a box takes six numbers: lo x,lo y,lo z,hi x,hi y,hi z", what, why));
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
  const std::vector<std::string_view> fields = fields_of(text);
  std::array<float, 6> numbers{};
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto [value, error] = parse_number<float>(fields[i]);
    if (error == std::errc::result_out_of_range)
      refuse(what, fmt::format("'{}' is beyond what a float holds", fields[i]));
    if (error != std::errc()) refuse(what, fmt::format("'{}' is not a number", fields[i]));
    if (i < numbers.size()) numbers[i] = value;
  }
  if (fields.size() != numbers.size()) {
    refuse(what, fmt::format("{} number{}", fields.size(), fields.size() == 1 ? "" : "s"));
  }
  const Box box{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
  require_box(box, what);
  return box;
}

std::string to_text(const Box& box) {
  return fmt::format("{},{},{},{},{},{}", box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2]);
}

}  // namespace shaftcull::cli
