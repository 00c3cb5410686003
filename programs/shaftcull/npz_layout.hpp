// SPDX-License-Identifier: MIT
/// Where what stands in a file that NumPy reads, as numpy.load("sights.npz") does: arrays one behind the other in a zip
/// archive, stored, not deflated, and with 64-bit sizes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace shaftcull::cli {

/// What an array is. `type` is as NumPy spells it: "<u4". Numbers are written as they are in memory, so a big-endian
/// machine writes ">u4", which NumPy reads as well. A row has `columns` numbers; an array of one axis has none
/// said.
struct NpyFormat {
  std::string name;
  std::string type;
  std::vector<std::size_t> columns = {};

  /// How many bytes a row has.
  [[nodiscard]] std::uint64_t row_bytes() const;
};

/// Places of arrays whose lengths are known. A head, of which nothing but the check sum depends on numbers, stands
/// before the numbers of each, and a directory behind all. All places are in bytes from the begin of the file.
class NpzLayout {
 public:
  /// Puts an array of so many rows behind those that are there.
  void add(const NpyFormat& format, std::uint64_t rows);

  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }
  /// Where the head of an array stands.
  [[nodiscard]] std::uint64_t place_of_head(std::size_t array) const { return entries_[array].place; }
  /// Where its numbers begin.
  [[nodiscard]] std::uint64_t place_of_numbers(std::size_t array) const;
  /// Where the directory stands.
  [[nodiscard]] std::uint64_t place_of_directory() const noexcept { return end_; }

  /// The head of an array, of whose numbers the CRC-32 is given.
  [[nodiscard]] std::string head(std::size_t array, std::uint32_t numbers_crc) const;
  /// What the file ends with, given that of the numbers of each array.
  [[nodiscard]] std::string directory(std::span<const std::uint32_t> numbers_crcs) const;

 private:
  /// A file of the archive.
  struct Entry {
    std::string name;
    std::string npy_header;
    std::uint64_t numbers;  ///< bytes of them
    std::uint64_t place;
  };
  [[nodiscard]] static std::uint32_t crc_of(const Entry& entry, std::uint32_t numbers_crc);

  std::vector<Entry> entries_;
  std::uint64_t end_ = 0;
};

}  // namespace shaftcull::cli
