// SPDX-License-Identifier: MIT
/// Arrays in a file that NumPy reads, written while they grow.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "crc32.hpp"
#include "npz_layout.hpp"
#include "output_file.hpp"

namespace shaftcull::cli {

/// An array that grows row by row. Its bytes are on disk, not in memory.
class NpyArray {
 public:
  NpyArray(const OutputFile& file, NpyFormat format) : format_(std::move(format)), spool_(file) {}

  template <class T>
  void append(std::span<const T> values) {
    crc_ = crc32_of(std::as_bytes(values), crc_);
    spool_.write({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }

  [[nodiscard]] const NpyFormat& format() const noexcept { return format_; }
  [[nodiscard]] std::uint32_t crc() const noexcept { return crc_; }
  [[nodiscard]] Spool& spool() noexcept { return spool_; }

 private:
  NpyFormat format_;
  std::uint32_t crc_ = 0;
  Spool spool_;
};

/// Writes arrays one behind the other, as NpzLayout says.
class NpzFile {
 public:
  /// Throws InvalidArgument if it cannot be made.
  explicit NpzFile(const std::string& path) : file_(path) {}

  NpyArray& add(NpyFormat format);
  /// Puts the file together. Throws std::runtime_error if it cannot be written.
  void finish();

 private:
  OutputFile file_;
  std::vector<std::unique_ptr<NpyArray>> arrays_;
};

}  // namespace shaftcull::cli
