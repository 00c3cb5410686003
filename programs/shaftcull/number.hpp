// SPDX-License-Identifier: MIT
/// Numbers on the command line.
#pragma once

#include <charconv>
#include <concepts>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

#include <CLI/CLI.hpp>

namespace shaftcull::cli {

/// A number that was read from text. Its value means nothing if there is an error.
template <class T>
struct ParsedNumber {
  T value;
  std::errc error;  ///< invalid_argument: no number; result_out_of_range: T does not hold it
};

/// Reads a number that all of `text` spells; spaces around it and a plus sign are allowed.
template <class T>
[[nodiscard]] ParsedNumber<T> parse_number(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  ParsedNumber<T> number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number.value);
  number.error = end == text.data() + text.size() ? error : std::errc::invalid_argument;
  return number;
}

/// The number in `text`, from `least` to `most`. Throws InvalidArgument, which names the option, the text and the
/// range, if it is no number, NaN, not whole, or outside the range.
[[nodiscard]] std::uint64_t whole_number(std::string_view option, std::string_view text, std::uint64_t least,
                                         std::uint64_t most);
[[nodiscard]] double real_number(std::string_view option, std::string_view text, double least, double most);

inline constexpr std::uint64_t largest_seed = std::numeric_limits<std::uint64_t>::max();

/// Adds an option that takes a number from `least` to `most`; any other ends the run as whole_number() and
/// real_number() say. `value` must live until the command line has been parsed.
template <class T>
CLI::Option* add_number(CLI::App& subcommand, const std::string& option, T& value, std::type_identity_t<T> least,
                        std::type_identity_t<T> most, const std::string& description) {
  const auto store = [=, &value](const std::string& text) {
    if constexpr (std::floating_point<T>) {
      value = real_number(option, text, least, most);
    } else {
      value = static_cast<T>(
          whole_number(option, text, static_cast<std::uint64_t>(least), static_cast<std::uint64_t>(most)));
    }
  };
  return subcommand.add_option_function<std::string>(option, store, description);
}

}  // namespace shaftcull::cli
