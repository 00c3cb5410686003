// SPDX-License-Identifier: MIT
#include "shaftcull/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "exact/expansion.hpp"
#include "shafts/view.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/padding.hpp"
#include "support/text.hpp"

namespace shaftcull {
namespace {

using kernel::sum_rounded_down;
using kernel::sum_rounded_up;

[[noreturn]] void refuse_infinite(const std::string& what, float value) {
  kernel::fail(InvalidArgument(what + " = " + kernel::text(value) + " is not finite"));
}

/// One of the six inequalities of clip space: w_share · w + sign · (row of the matrix) is 0 or more.
struct ClipRule {
  const char* name;
  float w_share;
  std::size_t row;
  float sign;
};

Plane plane_of(std::span<const float, 16> matrix, const ClipRule& rule) noexcept {
  const auto coefficient = [&](std::size_t column) {
    const double w = matrix[12 + column];
    const double row = matrix[4 * rule.row + column];
    return static_cast<float>(rule.w_share * w + rule.sign * row);
  };
  return {{-coefficient(0), -coefficient(1), -coefficient(2)}, coefficient(3)};
}

[[noreturn]] void refuse_plane(const char* call, const ClipRule& rule, const char* why) {
  kernel::fail(InvalidArgument(std::string(call) + ": the " + rule.name + " plane " + why));
}

bool is_finite(const Plane& plane) noexcept {
  return std::isfinite(plane.normal[0]) && std::isfinite(plane.normal[1]) && std::isfinite(plane.normal[2]) &&
         std::isfinite(plane.offset);
}

/// Refuses a matrix that is stored column by column. The last row of a perspective measures distance along the
/// direction of view, so it has a unit normal; that of a parallel projection has none. Transposed, the last column has
/// it.
void require_stored_by_rows(const char* call, std::span<const float, 16> matrix) {
  const auto length = [&](std::size_t x, std::size_t y, std::size_t z) {
    return std::hypot(double{matrix[x]}, double{matrix[y]}, double{matrix[z]});
  };
  const auto is_unit = [](double of) { return std::fabs(of - 1) < 1e-5; };
  const double row = length(12, 13, 14);
  const double column = length(3, 7, 11);
  if (row == 0 || is_unit(row) || !(column == 0 || is_unit(column))) return;
  kernel::fail(InvalidArgument(
      std::string(call) + ": the matrix seems to be stored column by column: its last row has length " +
      kernel::text(static_cast<float>(row)) + ", its last column " + kernel::text(static_cast<float>(column)) +
      "; pass it row after row (if it is, divide it by the length of its last row)"));
}

}  // namespace

Box box_around(std::span<const Vec3> points) {
  kernel::require_memory("points", points, "points");
  return kernel::in_float_environment([&] {
    Box box = kernel::empty_box;
    for (std::size_t i = 0; i != points.size(); ++i) {
      for (std::size_t k = 0; k != 3; ++k) {
        const float x = points[i][k];
        if (std::isnan(x)) {
          kernel::fail(BadBound(i, "box_around: point " + std::to_string(i) + ": " + "xyz"[k] + " is not a number"));
        }
        box.lo[k] = std::min(box.lo[k], x);
        box.hi[k] = std::max(box.hi[k], x);
      }
    }
    return box;
  });
}

Box joined(const Box& a, const Box& b) noexcept {
  return kernel::in_float_environment([&] {
    Box box;
    for (std::size_t k = 0; k != 3; ++k) {
      box.lo[k] = std::min(a.lo[k], b.lo[k]);
      box.hi[k] = std::max(a.hi[k], b.hi[k]);
    }
    return box;
  });
}

Box translated(const Box& box, const Vec3& by) {
  return kernel::in_float_environment([&] {
    Box moved;
    for (std::size_t k = 0; k != 3; ++k) {
      if (!std::isfinite(by[k])) refuse_infinite(std::string("translated: by.") + "xyz"[k], by[k]);
      moved.lo[k] = sum_rounded_down(box.lo[k], by[k]);
      moved.hi[k] = sum_rounded_up(box.hi[k], by[k]);
    }
    return moved;
  });
}

Box inflated(const Box& box, float by) {
  return kernel::in_float_environment([&] {
    if (!std::isfinite(by)) refuse_infinite("inflated: by", by);
    if (by < 0)
      kernel::fail(InvalidArgument("inflated: by = " + kernel::text(by) + " is negative; it must be 0 or more"));
    Box larger;
    for (std::size_t k = 0; k != 3; ++k) {
      larger.lo[k] = sum_rounded_down(box.lo[k], -by);
      larger.hi[k] = sum_rounded_up(box.hi[k], by);
    }
    return larger;
  });
}

ViewPlanes kernel::planes_of_view(const char* call, std::span<const float, 16> matrix, ClipDepth depth) {
  if (depth > ClipDepth::minus_one_to_one) {
    kernel::fail(InvalidArgument(std::string(call) + ": depth = " + std::to_string(static_cast<unsigned>(depth)) +
                                 " is neither ClipDepth::zero_to_one nor ClipDepth::minus_one_to_one"));
  }
  const float near_share = depth == ClipDepth::zero_to_one ? 0.0F : 1.0F;
  const ClipRule rules[6] = {{"left", 1, 0, 1}, {"right", 1, 0, -1},        {"bottom", 1, 1, 1},
                             {"top", 1, 1, -1}, {"near", near_share, 2, 1}, {"far", 1, 2, -1}};
  return kernel::in_float_environment([&] {
    for (std::size_t i = 0; i != matrix.size(); ++i) {
      if (!std::isfinite(matrix[i]))
        refuse_infinite(std::string(call) + ": matrix[" + std::to_string(i) + "]", matrix[i]);
    }
    require_stored_by_rows(call, matrix);
    ViewPlanes planes{};
    for (const ClipRule& rule : rules) {
      const Plane plane = plane_of(matrix, rule);
      if (!is_finite(plane)) refuse_plane(call, rule, "is beyond the largest float; scale the matrix down");
      if (plane.normal != Vec3{0, 0, 0}) {
        planes.plane[planes.count++] = plane;
      } else if (plane.offset < 0) {
        refuse_plane(call, rule, "leaves nothing in view; is this a view-projection matrix, row after row?");
      }
    }
    return planes;
  });
}

ViewPlanes view_planes(std::span<const float, 16> matrix, ClipDepth depth) {
  return kernel::planes_of_view("view_planes", matrix, depth);
}

}  // namespace shaftcull
