#include "box_text.hpp"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

std::optional<float> number_from_text(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  float value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::optional<Box> box_from_text(std::string_view text) {
  std::array<float, 6> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == numbers.size())) return std::nullopt;
    const auto number = number_from_text(text.substr(0, comma));
    if (!number) return std::nullopt;
    numbers[i] = *number;
    if (comma != std::string_view::npos) text.remove_prefix(comma + 1);
  }
  return Box{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
}

void require_finite(const Box& box, std::string_view what) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(box.lo[axis]) || !std::isfinite(box.hi[axis])) {
      throw InvalidArgument(fmt::format("{}: {} {} to {} is not finite; a shaft needs finite boxes", what, "xyz"[axis],
                                        box.lo[axis], box.hi[axis]));
    }
    if (box.lo[axis] > box.hi[axis]) {
      throw InvalidArgument(fmt::format("{}: lo {} = {} is greater than hi {} = {}; give lo x,y,z, then hi x,y,z", what,
                                        "xyz"[axis], box.lo[axis], "xyz"[axis], box.hi[axis]));
    }
  }
}

Box box_option(std::string_view option, std::string_view text) {
  const auto box = box_from_text(text);
  if (!box) {
    throw InvalidArgument(
        fmt::format("{} {}: not a box; give six comma-separated numbers lo x,lo y,lo z,hi x,hi y,hi z", option, text));
  }
  require_finite(*box, fmt::format("{} {}", option, text));
  return *box;
}

std::string to_text(const Box& box) {
  return fmt::format("{},{},{},{},{},{}", box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2]);
}

}  // namespace shaftcull::cli
