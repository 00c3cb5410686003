// SPDX-License-Identifier: MIT
/// Rows of floats of a file: its own, or those of float64, rounded relative to an origin.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "batch/array_file.hpp"
#include "shaftcull/origin.hpp"

namespace shaftcull::batch {

/// What rows of float64 become.
enum class RowRounding : std::uint8_t {
  boxes_around,    ///< boxes of 6 numbers, one or two a row, that contain the given ones
  boxes_within,    ///< boxes of 6 numbers that the given ones contain
  spheres_around,  ///< spheres of 4 numbers that contain the given ones
  nearest,         ///< points of 3 numbers, three a row
};

/// Whether an array holds floats of 32 or 64 bits.
[[nodiscard]] inline bool is_of_floats(const ArrayFile& file) noexcept {
  return file.number() == Number::float32 || file.number() == Number::float64;
}

/// The floats of rows of a file whose numbers are float32 or float64. Rows of float32 are never changed.
class FloatRows {
 public:
  FloatRows() = default;
  FloatRows(const ArrayFile& file, const Origin& origin, RowRounding rounding) noexcept
      : file_(&file), origin_(origin), rounding_(rounding) {}

  /// The floats of rows [first, first + count): where they are, or in `scratch`, and valid until that is used again.
  /// For any thread. Throws as ArrayFile::read() does.
  [[nodiscard]] std::span<const float> read(std::uint64_t first, std::uint64_t count,
                                            std::vector<std::byte>& scratch) const;

 private:
  const ArrayFile* file_ = nullptr;
  Origin origin_;
  RowRounding rounding_ = RowRounding::boxes_around;
};

}  // namespace shaftcull::batch
