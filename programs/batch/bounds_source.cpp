// SPDX-License-Identifier: MIT
#include "batch/bounds_source.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "shaftcull/error.hpp"

namespace shaftcull::batch {

BoundsSource::BoundsSource(const std::string& bounds, const Origin& origin, bool are_solids) : array_(bounds) {
  const std::size_t columns = array_.columns();
  if (!is_of_floats(array_) || (columns != 4 && columns != 6 && columns != 9)) {
    throw InvalidArgument(fmt::format("{}: is {}; bounds are rows of floats: boxes of 6, spheres of 4, triangles of 9",
                                      bounds, array_.shape()));
  }
  kind_ = columns == 6 ? BoundKind::box : columns == 4 ? BoundKind::sphere : BoundKind::triangle;
  const RowRounding rounding = kind_ == BoundKind::triangle ? RowRounding::nearest
                               : kind_ == BoundKind::sphere ? RowRounding::spheres_around
                               : are_solids                 ? RowRounding::boxes_within
                                                            : RowRounding::boxes_around;
  rows_ = FloatRows(array_, origin, rounding);
}

std::span<const float> BoundsSource::read(std::uint64_t first, std::uint64_t count,
                                          std::vector<std::byte>& scratch) const {
  return rows_.read(first, count, scratch);
}

Box BoundsSource::box_around(const float* floats) const noexcept {
  Box box{};
  for (std::size_t axis = 0; axis != 3; ++axis) {
    switch (kind_) {
      case BoundKind::box:
        box.lo[axis] = floats[axis];
        box.hi[axis] = floats[axis + 3];
        break;
      case BoundKind::sphere: {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        box.lo[axis] = std::nextafter(floats[axis] - floats[3], -infinity);
        box.hi[axis] = std::nextafter(floats[axis] + floats[3], infinity);
        break;
      }
      case BoundKind::triangle:
        box.lo[axis] = std::min({floats[axis], floats[axis + 3], floats[axis + 6]});
        box.hi[axis] = std::max({floats[axis], floats[axis + 3], floats[axis + 6]});
        break;
    }
  }
  return box;
}

}  // namespace shaftcull::batch
