// SPDX-License-Identifier: MIT
/// Arrays that a job reads: an .npy file of NumPy, or a dataset of an HDF5 file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace shaftcull::batch {

/// What an array is made of.
enum class Number : std::uint8_t { float32, float64, int32, uint32, int64, uint64 };

[[nodiscard]] std::size_t bytes_of(Number number) noexcept;
[[nodiscard]] const char* name_of(Number number) noexcept;

/// Rows of numbers, one behind the other, little-endian. An .npy file, and a dataset that is stored in one piece, are
/// mapped into memory; of others, in chunks or compressed, rows are read when they are asked for.
class ArrayFile {
 public:
  /// `name` is "FILE.npy" or "FILE.h5:/dataset". Throws InvalidArgument, which names it and what is wrong, if it cannot
  /// be read, has not two axes, or holds other numbers than those of Number.
  explicit ArrayFile(std::string name);
  ArrayFile(const ArrayFile&) = delete;
  ArrayFile& operator=(const ArrayFile&) = delete;
  ~ArrayFile();

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] std::uint64_t rows() const noexcept { return rows_; }
  [[nodiscard]] std::size_t columns() const noexcept { return columns_; }
  [[nodiscard]] Number number() const noexcept { return number_; }
  [[nodiscard]] std::size_t row_bytes() const noexcept { return columns_ * bytes_of(number_); }

  /// "(1000, 12) of float32", for messages.
  [[nodiscard]] std::string shape() const;

  /// All rows in memory, or null if they are read from a file piece by piece.
  [[nodiscard]] const std::byte* mapped() const noexcept { return mapped_; }

  /// The bytes of rows [first, first + count), which lie within rows(): where they are, or read into `scratch`, and
  /// valid until that is used again. For any thread; rows that are not mapped are read by one at a time. Throws
  /// std::runtime_error if they cannot be read.
  [[nodiscard]] std::span<const std::byte> read(std::uint64_t first, std::uint64_t count,
                                                std::vector<std::byte>& scratch) const;

  /// Has the system read the bytes of these rows while this thread goes on. Nothing where the file is not mapped.
  void read_ahead(std::uint64_t first, std::uint64_t count) const noexcept;

 private:
  struct Source;
  std::string name_;
  std::uint64_t rows_ = 0;
  std::size_t columns_ = 0;
  Number number_ = Number::float32;
  const std::byte* mapped_ = nullptr;
  std::unique_ptr<Source> source_;
};

}  // namespace shaftcull::batch
