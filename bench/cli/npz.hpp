// SPDX-License-Identifier: MIT
/// Arrays in a file that NumPy reads: numpy.load("sights.npz").
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "output_file.hpp"

namespace shaftcull::cli {

/// An array that grows row by row. Its bytes are on disk, not in memory.
class NpyArray {
 public:
  /// `type` is as NumPy spells it: "<u4". A row has `columns` numbers; an array of one axis has none said.
  NpyArray(const OutputFile& file, std::string name, std::string type, std::vector<std::size_t> columns);

  template <class T>
  void append(std::span<const T> values) {
    spool_.write({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] Spool& spool() noexcept { return spool_; }
  /// What an .npy file begins with.
  [[nodiscard]] std::string header() const;

 private:
  std::string name_;
  std::string type_;
  std::vector<std::size_t> columns_;
  Spool spool_;
};

/// Writes arrays one behind the other as a zip archive: stored, not deflated, and with 64-bit sizes.
class NpzFile {
 public:
  /// Throws InvalidArgument if it cannot be made.
  explicit NpzFile(const std::string& path);

  NpyArray& add(std::string name, std::string type, std::vector<std::size_t> columns = {});
  /// Puts the file together. Throws std::runtime_error if it cannot be written.
  void finish();

 private:
  OutputFile file_;
  std::vector<std::unique_ptr<NpyArray>> arrays_;
};

}  // namespace shaftcull::cli
