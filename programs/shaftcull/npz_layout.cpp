// SPDX-License-Identifier: MIT
#include "npz_layout.hpp"

#include <bit>
#include <type_traits>

#include <fmt/format.h>

#include "crc32.hpp"

namespace shaftcull::cli {
namespace {

/// Little-endian, as all numbers of headers are.
template <class T>
void put_number(std::string& bytes, std::type_identity_t<T> value) {
  for (std::size_t byte = 0; byte != sizeof(T); ++byte) {
    bytes += static_cast<char>(static_cast<unsigned char>(std::uint64_t{value} >> (8 * byte)));
  }
}

using Two = std::uint16_t;
using Four = std::uint32_t;
using Eight = std::uint64_t;

// PKWARE's APPNOTE.TXT 6.3 says what these are.
constexpr Four local_header = 0x04034b50;
constexpr Four central_header = 0x02014b50;
constexpr Four end_of_directory = 0x06054b50;
constexpr Four end_of_directory_64 = 0x06064b50;
constexpr Four locator_of_end_64 = 0x07064b50;
constexpr Two version_with_64_bits = 45;
constexpr Two extra_64_bits = 1;
constexpr Two in_extra_16 = 0xffff;
constexpr Four in_extra = 0xffffffff;
constexpr Four first_of_1980 = 0x00210000;        ///< the earliest date; files of the same run are the same
constexpr std::uint64_t local_header_bytes = 50;  ///< without the name

/// What headers of both kinds have in common, from the version needed to the length of the name.
void put_common(std::string& bytes, const std::string& name, std::uint32_t crc) {
  put_number<Two>(bytes, version_with_64_bits);
  put_number<Two>(bytes, 0);  // no flags
  put_number<Two>(bytes, 0);  // stored
  put_number<Four>(bytes, first_of_1980);
  put_number<Four>(bytes, crc);
  put_number<Four>(bytes, in_extra);
  put_number<Four>(bytes, in_extra);
  put_number<Two>(bytes, static_cast<Two>(name.size()));
}

/// What an .npy file begins with.
std::string npy_header_of(const NpyFormat& format, std::uint64_t rows) {
  std::string shape;
  for (const std::size_t n : format.columns) shape += fmt::format(" {},", n);
  if (!shape.empty()) shape.pop_back();
  std::string type = format.type;
  if (std::endian::native == std::endian::big && type.front() == '<') type.front() = '>';
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({},{}), }}", type, rows, shape);
  // Numbers begin at a multiple of 64 bytes.
  constexpr std::size_t before_text = 10;
  text.append(63 - (before_text + text.size()) % 64, ' ');
  text += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  put_number<Two>(bytes, static_cast<Two>(text.size()));
  return bytes + text;
}

}  // namespace

std::uint64_t NpyFormat::row_bytes() const {
  std::uint64_t bytes = static_cast<std::uint64_t>(type.back() - '0');
  for (const std::size_t n : columns) bytes *= n;
  return bytes;
}

void NpzLayout::add(const NpyFormat& format, std::uint64_t rows) {
  const Entry& entry =
      entries_.emplace_back(Entry{format.name + ".npy", npy_header_of(format, rows), rows * format.row_bytes(), end_});
  end_ = place_of_numbers(entries_.size() - 1) + entry.numbers;
}

std::uint64_t NpzLayout::place_of_numbers(std::size_t array) const {
  const Entry& entry = entries_[array];
  return entry.place + local_header_bytes + entry.name.size() + entry.npy_header.size();
}

std::uint32_t NpzLayout::crc_of(const Entry& entry, std::uint32_t numbers_crc) {
  return joined_crc32(crc32_of(std::as_bytes(std::span(entry.npy_header))), numbers_crc, entry.numbers);
}

std::string NpzLayout::head(std::size_t array, std::uint32_t numbers_crc) const {
  const Entry& entry = entries_[array];
  const std::uint64_t size = entry.npy_header.size() + entry.numbers;
  std::string bytes;
  put_number<Four>(bytes, local_header);
  put_common(bytes, entry.name, crc_of(entry, numbers_crc));
  put_number<Two>(bytes, 20);  // bytes of what is behind the name
  bytes += entry.name;
  put_number<Two>(bytes, extra_64_bits);
  put_number<Two>(bytes, 16);
  put_number<Eight>(bytes, size);
  put_number<Eight>(bytes, size);
  return bytes + entry.npy_header;
}

std::string NpzLayout::directory(std::span<const std::uint32_t> numbers_crcs) const {
  std::string bytes;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Entry& entry = entries_[i];
    const std::uint64_t size = entry.npy_header.size() + entry.numbers;
    put_number<Four>(bytes, central_header);
    put_number<Two>(bytes, version_with_64_bits);
    put_common(bytes, entry.name, crc_of(entry, numbers_crcs[i]));
    put_number<Two>(bytes, 28);  // bytes of what is behind the name
    put_number<Two>(bytes, 0);   // no comment
    put_number<Two>(bytes, 0);   // on the first disk
    put_number<Two>(bytes, 0);   // no attributes
    put_number<Four>(bytes, 0);  // none here either
    put_number<Four>(bytes, in_extra);
    bytes += entry.name;
    put_number<Two>(bytes, extra_64_bits);
    put_number<Two>(bytes, 24);
    put_number<Eight>(bytes, size);
    put_number<Eight>(bytes, size);
    put_number<Eight>(bytes, entry.place);
  }
  const std::uint64_t size = bytes.size();
  put_number<Four>(bytes, end_of_directory_64);
  put_number<Eight>(bytes, 44);  // bytes that follow in this record
  put_number<Two>(bytes, version_with_64_bits);
  put_number<Two>(bytes, version_with_64_bits);
  put_number<Four>(bytes, 0);
  put_number<Four>(bytes, 0);
  put_number<Eight>(bytes, entries_.size());
  put_number<Eight>(bytes, entries_.size());
  put_number<Eight>(bytes, size);
  put_number<Eight>(bytes, end_);
  put_number<Four>(bytes, locator_of_end_64);
  put_number<Four>(bytes, 0);
  put_number<Eight>(bytes, end_ + size);
  put_number<Four>(bytes, 1);
  put_number<Four>(bytes, end_of_directory);
  put_number<Two>(bytes, 0);
  put_number<Two>(bytes, 0);
  put_number<Two>(bytes, in_extra_16);
  put_number<Two>(bytes, in_extra_16);
  put_number<Four>(bytes, in_extra);
  put_number<Four>(bytes, in_extra);
  put_number<Two>(bytes, 0);
  return bytes;
}

}  // namespace shaftcull::cli
