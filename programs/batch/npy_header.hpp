// SPDX-License-Identifier: MIT
/// What an .npy file of NumPy begins with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace shaftcull::batch {

struct NpyHeader {
  std::string type;                  ///< as NumPy spells it: "<f4"
  bool fortran_order = false;        ///< columns one behind the other
  std::vector<std::uint64_t> shape;  ///< rows, columns, …
  std::uint64_t data_at = 0;         ///< where numbers begin, in bytes
};

/// Whether a file begins as those of NumPy do.
[[nodiscard]] bool begins_as_npy(std::span<const std::byte> file) noexcept;

/// Reads the header of versions 1 to 3. Throws InvalidArgument, which begins with `name`, if it is damaged.
[[nodiscard]] NpyHeader read_npy_header(std::span<const std::byte> file, const std::string& name);

}  // namespace shaftcull::batch
