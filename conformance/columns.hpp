// SPDX-License-Identifier: MIT
/// Bounds in plain vectors, one for each coordinate: a view of the user's own memory that nothing has checked.
/// Each is allocated to its exact size, so that AddressSanitizer sees what is read beyond the last bound.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "shaftcull/streams.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull {

class BoxColumns {
 public:
  explicit BoxColumns(const std::vector<Box>& boxes) : count_(boxes.size()) {
    for (std::vector<float>& column : column_) column.reserve(count_);
    for (const Box& box : boxes) {
      for (std::size_t k = 0; k != 3; ++k) {
        column_[k].push_back(box.lo[k]);
        column_[k + 3].push_back(box.hi[k]);
      }
    }
  }
  [[nodiscard]] BoxView view() const {
    BoxView view;
    for (std::size_t k = 0; k != 6; ++k) view.stream[k] = column_[k].data();
    view.count = count_;
    return view;
  }

 private:
  std::array<std::vector<float>, 6> column_;
  std::size_t count_;
};

class SphereColumns {
 public:
  explicit SphereColumns(const std::vector<Sphere>& spheres) : count_(spheres.size()) {
    for (std::vector<float>& column : column_) column.reserve(count_);
    for (const Sphere& sphere : spheres) {
      for (std::size_t k = 0; k != 3; ++k) column_[k].push_back(sphere.centre[k]);
      column_[3].push_back(sphere.radius);
    }
  }
  [[nodiscard]] SphereView view() const {
    SphereView view;
    for (std::size_t k = 0; k != 4; ++k) view.stream[k] = column_[k].data();
    view.count = count_;
    return view;
  }

 private:
  std::array<std::vector<float>, 4> column_;
  std::size_t count_;
};

class TriangleColumns {
 public:
  explicit TriangleColumns(const std::vector<Triangle>& triangles) : count_(triangles.size()) {
    for (std::vector<float>& column : column_) column.reserve(count_);
    for (const Triangle& triangle : triangles) {
      for (std::size_t s = 0; s != column_.size(); ++s) column_[s].push_back(triangle.vertex[s / 3][s % 3]);
    }
  }
  [[nodiscard]] TriangleView view() const {
    TriangleView view;
    for (std::size_t s = 0; s != column_.size(); ++s) view.stream[s] = column_[s].data();
    view.count = count_;
    return view;
  }

 private:
  std::array<std::vector<float>, 9> column_;
  std::size_t count_;
};

inline BoxColumns columns(const std::vector<Box>& boxes) { return BoxColumns(boxes); }
inline SphereColumns columns(const std::vector<Sphere>& spheres) { return SphereColumns(spheres); }

}  // namespace shaftcull
