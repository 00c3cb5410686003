// SPDX-License-Identifier: MIT
#include "npz.hpp"

#include <array>
#include <bit>
#include <type_traits>

#include <fmt/format.h>

namespace shaftcull::cli {
namespace {

static_assert(std::endian::native == std::endian::little, "bytes are written as they are in memory");

/// The check sum of zip archives, by a table of what each byte adds.
class Crc32 {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) sum_ = table()[(sum_ ^ static_cast<unsigned char>(c)) & 0xff] ^ (sum_ >> 8);
  }
  [[nodiscard]] std::uint32_t value() const noexcept { return ~sum_; }

 private:
  static const std::array<std::uint32_t, 256>& table() {
    static const std::array<std::uint32_t, 256> sums = [] {
      std::array<std::uint32_t, 256> all{};
      for (std::uint32_t i = 0; i < all.size(); ++i) {
        std::uint32_t sum = i;
        for (int bit = 0; bit < 8; ++bit) sum = (sum & 1) != 0 ? 0xedb88320 ^ (sum >> 1) : sum >> 1;
        all[i] = sum;
      }
      return all;
    }();
    return sums;
  }

  std::uint32_t sum_ = 0xffffffff;
};

template <class T>
void put_number(std::string& bytes, std::type_identity_t<T> value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
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
constexpr Four first_of_1980 = 0x00210000;  ///< the earliest date; files of the same run are the same

/// A file of the archive.
struct ZipEntry {
  std::string name;
  std::uint32_t crc;
  std::uint64_t size;
  std::uint64_t offset;  ///< of its header
};

/// What headers of both kinds have in common, from the version needed to the length of the name.
void put_common(std::string& bytes, const ZipEntry& entry) {
  put_number<Two>(bytes, version_with_64_bits);
  put_number<Two>(bytes, 0);  // no flags
  put_number<Two>(bytes, 0);  // stored
  put_number<Four>(bytes, first_of_1980);
  put_number<Four>(bytes, entry.crc);
  put_number<Four>(bytes, in_extra);
  put_number<Four>(bytes, in_extra);
  put_number<Two>(bytes, static_cast<Two>(entry.name.size()));
}

std::string local_header_of(const ZipEntry& entry) {
  std::string bytes;
  put_number<Four>(bytes, local_header);
  put_common(bytes, entry);
  put_number<Two>(bytes, 20);  // bytes of what is behind the name
  bytes += entry.name;
  put_number<Two>(bytes, extra_64_bits);
  put_number<Two>(bytes, 16);
  put_number<Eight>(bytes, entry.size);
  put_number<Eight>(bytes, entry.size);
  return bytes;
}

std::string directory_of(const std::vector<ZipEntry>& entries, std::uint64_t begin) {
  std::string bytes;
  for (const ZipEntry& entry : entries) {
    put_number<Four>(bytes, central_header);
    put_number<Two>(bytes, version_with_64_bits);
    put_common(bytes, entry);
    put_number<Two>(bytes, 28);  // bytes of what is behind the name
    put_number<Two>(bytes, 0);   // no comment
    put_number<Two>(bytes, 0);   // on the first disk
    put_number<Two>(bytes, 0);   // no attributes
    put_number<Four>(bytes, 0);  // none here either
    put_number<Four>(bytes, in_extra);
    bytes += entry.name;
    put_number<Two>(bytes, extra_64_bits);
    put_number<Two>(bytes, 24);
    put_number<Eight>(bytes, entry.size);
    put_number<Eight>(bytes, entry.size);
    put_number<Eight>(bytes, entry.offset);
  }
  const std::uint64_t size = bytes.size();
  put_number<Four>(bytes, end_of_directory_64);
  put_number<Eight>(bytes, 44);  // bytes that follow in this record
  put_number<Two>(bytes, version_with_64_bits);
  put_number<Two>(bytes, version_with_64_bits);
  put_number<Four>(bytes, 0);
  put_number<Four>(bytes, 0);
  put_number<Eight>(bytes, entries.size());
  put_number<Eight>(bytes, entries.size());
  put_number<Eight>(bytes, size);
  put_number<Eight>(bytes, begin);
  put_number<Four>(bytes, locator_of_end_64);
  put_number<Four>(bytes, 0);
  put_number<Eight>(bytes, begin + size);
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

}  // namespace

NpyArray::NpyArray(const OutputFile& file, std::string name, std::string type, std::vector<std::size_t> columns)
    : name_(std::move(name)), type_(std::move(type)), columns_(std::move(columns)), spool_(file) {}

std::string NpyArray::header() const {
  std::uint64_t row = static_cast<std::uint64_t>(type_.back() - '0');
  std::string shape;
  for (const std::size_t n : columns_) {
    row *= n;
    shape += fmt::format(" {},", n);
  }
  if (!shape.empty()) shape.pop_back();
  std::string text =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({},{}), }}", type_, spool_.size() / row, shape);
  // Numbers begin at a multiple of 64 bytes.
  constexpr std::size_t before_text = 10;
  text.append(63 - (before_text + text.size()) % 64, ' ');
  text += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  put_number<Two>(bytes, static_cast<Two>(text.size()));
  return bytes + text;
}

NpzFile::NpzFile(const std::string& path) : file_(path) {}

NpyArray& NpzFile::add(std::string name, std::string type, std::vector<std::size_t> columns) {
  arrays_.push_back(std::make_unique<NpyArray>(file_, std::move(name), std::move(type), std::move(columns)));
  return *arrays_.back();
}

void NpzFile::finish() {
  std::vector<ZipEntry> entries;
  std::uint64_t offset = 0;
  for (const std::unique_ptr<NpyArray>& array : arrays_) {
    const std::string begin = array->header();
    Crc32 crc;
    crc.add(begin);
    array->spool().read_all([&](std::string_view bytes) { crc.add(bytes); });
    entries.push_back({array->name() + ".npy", crc.value(), begin.size() + array->spool().size(), offset});
    const std::string header = local_header_of(entries.back());
    file_.write(header);
    file_.write(begin);
    array->spool().read_all([&](std::string_view bytes) { file_.write(bytes); });
    offset += header.size() + entries.back().size;
  }
  file_.write(directory_of(entries, offset));
  file_.finish();
}

}  // namespace shaftcull::cli
