// SPDX-License-Identifier: MIT
/// Bounds in plain vectors, one for each coordinate: a view of the user's own memory that nothing has checked.
/// Each is allocated to its exact size, so that AddressSanitizer sees what is read beyond the last bound.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <vector>

#include "shaftcull/streams.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull {

template <class Bound, class View>
class BoundColumns {
 public:
  explicit BoundColumns(const std::vector<Bound>& bounds) : count_(bounds.size()) {
    for (std::vector<float>& column : column_) column.reserve(count_);
    for (const Bound& bound : bounds) {
      const auto coordinates = std::bit_cast<std::array<float, column_count>>(bound);
      for (std::size_t s = 0; s != column_count; ++s) column_[s].push_back(coordinates[s]);
    }
  }
  [[nodiscard]] View view() const {
    View view;
    for (std::size_t s = 0; s != column_count; ++s) view.stream[s] = column_[s].data();
    view.count = count_;
    return view;
  }

 private:
  static constexpr std::size_t column_count = sizeof(Bound) / sizeof(float);

  std::array<std::vector<float>, column_count> column_;
  std::size_t count_;
};

using BoxColumns = BoundColumns<Box, BoxView>;
using SphereColumns = BoundColumns<Sphere, SphereView>;
using TriangleColumns = BoundColumns<Triangle, TriangleView>;

inline BoxColumns columns(const std::vector<Box>& boxes) { return BoxColumns(boxes); }
inline SphereColumns columns(const std::vector<Sphere>& spheres) { return SphereColumns(spheres); }

}  // namespace shaftcull
