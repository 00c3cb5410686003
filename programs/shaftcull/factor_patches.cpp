// SPDX-License-Identifier: MIT
#include "factor_patches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "patches.hpp"
#include "region.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

using Quadrilateral = std::array<Point3, 4>;

Point3 way(const Point3& from, const Point3& to) { return {to[0] - from[0], to[1] - from[1], to[2] - from[2]}; }
double inner(const Point3& p, const Point3& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }
Point3 outer(const Point3& p, const Point3& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}
double length(const Point3& p) { return std::sqrt(inner(p, p)); }

/// Whether corners turn one way at each of them, in one plane as far as floats can say.
bool is_flat_and_convex(const Quadrilateral& corner) {
  const Point3 normal = outer(way(corner[0], corner[2]), way(corner[1], corner[3]));
  const double area = length(normal);
  if (!(area > 0)) return false;
  double largest = 0;
  for (const Point3& of : corner) largest = std::max({largest, std::fabs(of[0]), std::fabs(of[1]), std::fabs(of[2])});
  for (std::size_t c = 0; c != 4; ++c) {
    const Point3 before = way(corner[(c + 3) % 4], corner[c]);
    const Point3 behind = way(corner[c], corner[(c + 1) % 4]);
    constexpr double straight = 1e-4;
    if (inner(outer(before, behind), normal) <= straight * area * length(before) * length(behind)) return false;
    constexpr double two_steps = 0x1p-22;
    if (std::fabs(inner(normal, behind)) > two_steps * area * largest) return false;
  }
  return true;
}

/// The quadrilateral that two triangles with a common edge form.
std::optional<Quadrilateral> joined(const MeshTriangle& one, const MeshTriangle& other) {
  if (one.object != other.object) return std::nullopt;
  for (std::size_t i = 0; i != 3; ++i) {
    const Vec3& from = one.vertex[i];
    const Vec3& to = one.vertex[(i + 1) % 3];
    for (std::size_t j = 0; j != 3; ++j) {
      if (other.vertex[j] != to || other.vertex[(j + 1) % 3] != from) continue;
      const Quadrilateral corners{in_doubles(to), in_doubles(one.vertex[(i + 2) % 3]), in_doubles(from),
                                  in_doubles(other.vertex[(j + 2) % 3])};
      if (is_flat_and_convex(corners)) return corners;
    }
  }
  return std::nullopt;
}

class PatchMaker {
 public:
  explicit PatchMaker(double size) : size_(size) {}

  void add(const Quadrilateral& corner, std::uint32_t triangle) {
    const auto pieces = [&](double longest) {
      const double count = size_ == 0 ? 1 : std::ceil(longest / size_ * (1 - 1e-6));
      return static_cast<std::size_t>(std::clamp(count, 1.0, static_cast<double>(most_patches)));
    };
    const auto side = [&](std::size_t i, std::size_t j) { return length(way(corner[i], corner[j])); };
    const std::size_t columns = pieces(std::max(side(0, 1), side(3, 2)));
    const std::size_t rows = pieces(std::max(side(0, 3), side(1, 2)));
    require(columns * rows);
    const auto at = [&](std::size_t column, std::size_t row) {
      const double u = static_cast<double>(column) / static_cast<double>(columns);
      const double v = static_cast<double>(row) / static_cast<double>(rows);
      Point3 point{};
      for (std::size_t k = 0; k != 3; ++k) {
        point[k] =
            (corner[0][k] * (1 - u) + corner[1][k] * u) * (1 - v) + (corner[3][k] * (1 - u) + corner[2][k] * u) * v;
      }
      return point;
    };
    for (std::size_t row = 0; row != rows; ++row) {
      for (std::size_t column = 0; column != columns; ++column) {
        add_patch(Quadrilateral{at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1)},
                  triangle);
      }
    }
  }

  void add(const MeshTriangle& triangle, std::uint32_t number) {
    const double size = size_ == 0 ? 1e30 : size_;
    require(count_patches({&triangle, 1}, size, most_patches + 1));
    for (const MeshPatch& patch : split_into_patches({&triangle, 1}, size)) add_patch(patch.corner, number);
  }

  [[nodiscard]] FactorPatches take() { return std::move(patches_); }

 private:
  void require(std::size_t more) const {
    if (patches_.size() + more <= most_patches) return;
    throw InvalidArgument(
        fmt::format("--patches {}: there would be more than {} patches; choose a larger size", size_, most_patches));
  }

  template <std::size_t count>
  void add_patch(const std::array<Point3, count>& corners, std::uint32_t triangle) {
    for (const Point3& corner : corners) {
      patches_.corners.push_back(
          {static_cast<float>(corner[0]), static_cast<float>(corner[1]), static_cast<float>(corner[2])});
    }
    patches_.first.push_back(patches_.corners.size());
    patches_.triangle.push_back(triangle);
  }

  double size_;
  FactorPatches patches_;
};

}  // namespace

FactorPatches factor_patches(std::span<const MeshTriangle> triangles, double size) {
  PatchMaker maker(size);
  for (std::size_t i = 0; i != triangles.size(); ++i) {
    const auto number = static_cast<std::uint32_t>(i);
    if (i + 1 != triangles.size()) {
      if (const std::optional<Quadrilateral> both = joined(triangles[i], triangles[i + 1])) {
        maker.add(*both, number);
        ++i;
        continue;
      }
    }
    maker.add(triangles[i], number);
  }
  return maker.take();
}

}  // namespace shaftcull::cli
