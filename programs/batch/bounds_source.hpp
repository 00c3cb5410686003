// SPDX-License-Identifier: MIT
/// The bounds of a job, as they are in their file, or rounded to floats.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "batch/array_file.hpp"
#include "batch/float_rows.hpp"
#include "batch/question.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::batch {

/// Rows of floats: boxes in 6 (lo x, lo y, lo z, hi x, hi y, hi z), spheres in 4 (centre, radius), triangles in 9. Of a
/// file of doubles, boxes and spheres that contain the given ones, solid boxes within them, and triangles whose
/// vertices are rounded to nearest, all relative to an origin.
class BoundsSource {
 public:
  /// Throws InvalidArgument, which names the file, if it holds something else.
  explicit BoundsSource(const std::string& bounds, const Origin& origin = {}, bool are_solids = false);
  BoundsSource(const BoundsSource&) = delete;
  BoundsSource& operator=(const BoundsSource&) = delete;

  [[nodiscard]] BoundKind kind() const noexcept { return kind_; }
  [[nodiscard]] std::uint64_t size() const noexcept { return array_.rows(); }
  [[nodiscard]] const ArrayFile& array() const noexcept { return array_; }

  /// Floats of bounds [first, first + count): where they are, or read into `scratch`.
  [[nodiscard]] std::span<const float> read(std::uint64_t first, std::uint64_t count,
                                            std::vector<std::byte>& scratch) const;

  /// Calls take(first, floats, count) for bounds [first, first + count), many at a time, one piece behind the other.
  template <class Take>
  void for_pieces(std::uint64_t first, std::uint64_t count, const Take& take) const {
    constexpr std::uint64_t at_once = std::uint64_t{1} << 20;
    std::vector<std::byte> scratch;
    for (std::uint64_t done = 0; done < count; done += at_once) {
      const std::uint64_t size = std::min(at_once, count - done);
      take(first + done, read(first + done, size, scratch).data(), static_cast<std::size_t>(size));
    }
  }

  /// The box around a bound that `floats` describe; around a sphere rounded outwards.
  [[nodiscard]] Box box_around(const float* floats) const noexcept;

 private:
  ArrayFile array_;
  BoundKind kind_ = BoundKind::box;
  FloatRows rows_;  ///< of array_
};

}  // namespace shaftcull::batch
