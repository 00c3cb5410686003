// SPDX-License-Identifier: MIT
#include "number.hpp"

#include <cmath>

#include <fmt/format.h>

#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

/// Why `text` is not a number from `least` to `most`; empty if it is one.
std::string_view fault_of(std::string_view text, double least, double most) {
  const auto [value, error] = parse_number<double>(text);
  if (error == std::errc::result_out_of_range) return "out of range";
  if (error != std::errc() || std::isnan(value)) return "not a number";
  if (value < least) return "too small";
  if (value > most) return "too large";
  return {};
}

}  // namespace

std::uint64_t whole_number(std::string_view option, std::string_view text, std::uint64_t least, std::uint64_t most) {
  const auto [value, error] = parse_number<std::uint64_t>(text);
  if (error == std::errc() && value >= least && value <= most) return value;
  std::string_view fault = fault_of(text, static_cast<double>(least), static_cast<double>(most));
  if (fault.empty()) {
    const double real = parse_number<double>(text).value;
    fault = error == std::errc::result_out_of_range ? "too large"
            : real == std::trunc(real)              ? "not written in digits only"
                                                    : "not a whole number";
  }
  throw InvalidArgument(fmt::format("{} {}: {}; give a whole number from {} to {}", option, text, fault, least, most));
}

double real_number(std::string_view option, std::string_view text, double least, double most) {
  const std::string_view fault = fault_of(text, least, most);
  if (fault.empty()) return parse_number<double>(text).value;
  throw InvalidArgument(fmt::format("{} {}: {}; give a number from {} to {}", option, text, fault, least, most));
}

}  // namespace shaftcull::cli
