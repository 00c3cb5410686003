// SPDX-License-Identifier: MIT
/// Planes of a convex hull as kernels read them, with the margins of floats.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <utility>

#include "compiled/hull_data.hpp"
#include "exact/hull_planes.hpp"
#include "support/exact_floats.hpp"

namespace shaftcull::kernel {

/// Writes planes behind those that a hull has. Faces come first.
class HullPlaneWriter {
 public:
  /// A writer for a hull that has its box.
  explicit HullPlaneWriter(HullData& hull) noexcept : hull_(hull) {
    for (unsigned k = 0; k < 3; ++k) {
      const double lo = hull.box[k];
      const double hi = hull.box[k + 3];
      largest_[k] = std::max(std::fabs(lo), std::fabs(hi));
      width_[k] = hi - lo;
    }
  }

  /// Writes the plane of a face through three vertices. Its outward normal is theirs for sign 1, and the opposite for
  /// −1. No component is 0.
  void add_face(const std::uint8_t (&vertices)[3], const double (&normal)[3], int sign) noexcept {
    HullData::Plane& plane = hull_.plane[hull_.faces++];
    for (unsigned i = 0; i < 3; ++i) plane.vertices[i] = vertices[i];  // of three bytes g++ makes no call
    plane.axis = 3;
    write<3>(plane, {0, 1, 2}, normal, sign);
  }

  /// Writes the plane of an oblique edge along an axis, through two vertices. Edges that are faces, too, come first.
  void add_edge(const ProjectedLine& line, unsigned axis, unsigned from, unsigned to, int sign, bool is_face) noexcept {
    const unsigned number = hull_.faces + hull_.edges++;
    HullData::Plane& plane = hull_.plane[number];
    plane.vertices[0] = static_cast<std::uint8_t>(from);
    plane.vertices[1] = static_cast<std::uint8_t>(to);
    plane.vertices[2] = 0;
    plane.axis = static_cast<std::uint8_t>(axis);
    plane.inward[2] = 0;
    plane.near[2] = 0;
    write<2>(plane, {line.i, line.j}, {line.along[1].rounded(), -line.along[0].rounded()}, sign);
    if (is_face) std::swap(plane, hull_.plane[hull_.faces + hull_.face_edges++]);
  }

  /// Writes what all planes have in common, when the last one is written.
  void finish() noexcept {
    hull_.suits_floats = suits_floats_;
    // No term overflows for a coordinate of this size.
    const double farthest = largest_term / largest_component_;
    constexpr float largest = std::numeric_limits<float>::max();
    hull_.farthest = farthest < double{largest} ? static_cast<float>(farthest) : largest;
  }

 private:
  /// Writes a plane that has its vertices, by n components of its normal.
  template <unsigned n>
  void write(HullData::Plane& plane, const unsigned (&axis)[n], const double (&normal)[n], int sign) noexcept {
    plane.sign = static_cast<std::int8_t>(sign);
    double largest = 0;
    for (unsigned i = 0; i < n; ++i) largest = std::max(largest, std::fabs(normal[i]));
    // A normal with components between 1 and 2, or below, and what its terms may amount to.
    const double scale = -sign * power_of_2(-exponent_of(largest));
    double inward[n];
    double offset = 0;
    double square = 0;
    double terms = 0;  // of the vertex
    double most = 0;   // terms of any corner of the box
    double widths = 0;
    double least = 2;
    for (unsigned i = 0; i < n; ++i) {
      const unsigned k = axis[i];
      inward[i] = static_cast<float>(normal[i] * scale);
      // By the sign of the component itself: as a float it may be 0.
      const bool is_inward = std::signbit(normal[i]) == (sign > 0);
      plane.near[i] = static_cast<std::uint8_t>(k + 3 * static_cast<unsigned>(is_inward));
      const double magnitude = std::fabs(inward[i]);
      least = std::min(least, magnitude);
      const double term = inward[i] * hull_.vertex[plane.vertices[0]][k];
      offset -= term;
      terms += std::fabs(term);
      square += magnitude * magnitude;
      most += magnitude * largest_[k];
      widths += magnitude * width_[k];
    }
    int exponent = 0;
    double margin = 0;
    if (hull_.is_bounded) {
      margin = 1;
      const double error = unit * (17 * widths + 8 * std::fabs(offset) + 5 * most) * 1.02;
      exponent = error == 0 ? 0 : exponent_of(error) + 1;  // of a number below 1, times the error's power of 2
    }
    suits_floats_ &= least >= smallest_component && std::abs(exponent) < most_exponent && terms < largest_terms;
    const double back = power_of_2(-exponent);
    for (unsigned i = 0; i < n; ++i) {
      plane.inward[i] = static_cast<float>(inward[i] * back);
      largest_component_ = std::max(largest_component_, std::fabs(static_cast<double>(plane.inward[i])));
    }
    plane.offset = static_cast<float>(offset * back + margin);
    plane.length = static_cast<float>(std::sqrt(square) * back);
    plane.magnitude = static_cast<float>((terms + std::fabs(offset)) * back * (1 + 0x1p-20) + least_magnitude);
  }

  /// Of doubles that are neither 0 nor denormal: normals and margins of floats keep to 2^±400.
  static int exponent_of(double x) noexcept {
    return static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52 & 0x7ffU) - 1023;
  }
  static double power_of_2(int exponent) noexcept {
    return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
  }

  static constexpr double unit = 0x1p-24;  // of a float
  static constexpr double smallest_component = 0x1p-60;
  static constexpr double largest_terms = 0x1p60;
  static constexpr int most_exponent = 60;
  static constexpr double largest_term = 0x1p125;
  /// So that a margin relative to it is more than what products that are denormal are off by.
  static constexpr double least_magnitude = 0x1p-120;

  HullData& hull_;
  double largest_[3];  ///< coordinate of the box
  double width_[3];    ///< of the box
  bool suits_floats_ = true;
  double largest_component_ = 0;
};

}  // namespace shaftcull::kernel
