// SPDX-License-Identifier: MIT
#include "batch/npy_header.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "shaftcull/error.hpp"

namespace shaftcull::batch {
namespace {

constexpr std::string_view npy_magic = "\x93NUMPY";

/// What stands behind 'key': in the dictionary, without the spaces before it. Empty if there is none.
std::string_view value_of(std::string_view dictionary, std::string_view key) {
  const std::size_t at = dictionary.find(fmt::format("'{}'", key));
  if (at == std::string_view::npos) return {};
  const std::size_t colon = dictionary.find(':', at);
  if (colon == std::string_view::npos) return {};
  const std::size_t value = dictionary.find_first_not_of(' ', colon + 1);
  return value == std::string_view::npos ? std::string_view() : dictionary.substr(value);
}

}  // namespace

bool begins_as_npy(std::span<const std::byte> file) noexcept {
  return file.size() >= npy_magic.size() && std::memcmp(file.data(), npy_magic.data(), npy_magic.size()) == 0;
}

NpyHeader read_npy_header(std::span<const std::byte> file, const std::string& name) {
  const auto refuse = [&](std::string_view why) {
    throw InvalidArgument(fmt::format("{}: is not a valid .npy file of NumPy: {}", name, why));
  };
  if (!begins_as_npy(file)) refuse("its first bytes are not \\x93NUMPY");
  if (file.size() < 12) refuse("it ends within its header");
  const auto byte = [&](std::size_t i) { return std::to_integer<std::uint64_t>(file[i]); };
  const std::uint64_t version = byte(6);
  if (version < 1 || version > 3) refuse(fmt::format("its version is {}", version));
  const std::uint64_t begin = version == 1 ? 10 : 12;
  const std::uint64_t size =
      version == 1 ? byte(8) | byte(9) << 8 : byte(8) | byte(9) << 8 | byte(10) << 16 | byte(11) << 24;
  if (size > file.size() - begin) refuse("it ends within its header");
  const std::string_view dictionary(reinterpret_cast<const char*>(file.data()) + begin, size);

  NpyHeader header;
  header.data_at = begin + size;
  const std::string_view type = value_of(dictionary, "descr");
  const std::size_t type_end = type.empty() || type.front() != '\'' ? std::string_view::npos : type.find('\'', 1);
  // Records of several fields have a list there.
  header.type = type_end == std::string_view::npos ? "a record" : std::string(type.substr(1, type_end - 1));
  const std::string_view order = value_of(dictionary, "fortran_order");
  if (!order.starts_with("True") && !order.starts_with("False")) refuse("its header has no fortran_order");
  header.fortran_order = order.starts_with("True");
  std::string_view shape = value_of(dictionary, "shape");
  if (shape.empty() || shape.front() != '(' || shape.find(')') == std::string_view::npos)
    refuse("its header has no shape");
  shape = shape.substr(1, shape.find(')') - 1);
  while (true) {
    shape.remove_prefix(std::min(shape.find_first_not_of(", "), shape.size()));
    if (shape.empty()) break;
    std::uint64_t extent = 0;
    const auto [end, error] = std::from_chars(shape.data(), shape.data() + shape.size(), extent);
    if (error != std::errc()) refuse("its shape is not made of numbers");
    header.shape.push_back(extent);
    shape.remove_prefix(static_cast<std::size_t>(end - shape.data()));
  }
  return header;
}

}  // namespace shaftcull::batch
