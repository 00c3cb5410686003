// SPDX-License-Identifier: MIT
#include "radiation/flat_polygon.hpp"

#include <algorithm>

#include "support/exact_floats.hpp"

namespace shaftcull::kernel {

Polygon::Polygon(std::span<const Vec3> corners, const Double3& origin, double scale) noexcept : count_(corners.size()) {
  for (std::size_t i = 0; i != count_; ++i) {
    for (std::size_t k = 0; k != 3; ++k) corner_[i][k] = (double{corners[i][k]} - origin[k]) * scale;
  }
}

Polygon Polygon::moved(const Double3& origin, double scale) const noexcept {
  Polygon result = *this;
  for (std::size_t i = 0; i != count_; ++i) {
    for (std::size_t k = 0; k != 3; ++k) result.corner_[i][k] = (corner_[i][k] - origin[k]) * scale;
  }
  return result;
}

Double3 Polygon::normal() const noexcept {
  Double3 sum{};
  for (std::size_t i = 2; i < count_; ++i) {
    const Double3 of_triangle = cross(corner_[i - 1] - corner_[0], corner_[i] - corner_[0]);
    for (std::size_t k = 0; k != 3; ++k) sum[k] += of_triangle[k];
  }
  return sum;
}

Polygon Polygon::in_front_of(const Polygon& other) const noexcept {
  const Double3 normal = other.normal();
  std::array<double, most_given + 1> height{};
  for (std::size_t i = 0; i != count_; ++i) height[i] = dot(normal, corner_[i] - other.corner_[0]);
  Polygon cut;
  if (std::none_of(height.begin(), height.begin() + static_cast<std::ptrdiff_t>(count_),
                   [](double h) { return h > 0; })) {
    return cut;
  }
  for (std::size_t i = 0; i != count_; ++i) {
    const std::size_t next = i + 1 == count_ ? 0 : i + 1;
    const auto add = [&](const Double3& corner) {
      if (cut.count_ != cut.corner_.size()) cut.corner_[cut.count_++] = corner;
    };
    if (height[i] >= 0) add(corner_[i]);
    if ((height[i] > 0 && height[next] < 0) || (height[i] < 0 && height[next] > 0)) {
      const double part = height[i] / (height[i] - height[next]);
      Double3 crossing{};
      for (std::size_t k = 0; k != 3; ++k) crossing[k] = corner_[i][k] + part * (corner_[next][k] - corner_[i][k]);
      add(crossing);
    }
  }
  if (cut.count_ < 3) cut.count_ = 0;
  return cut;
}

}  // namespace shaftcull::kernel
