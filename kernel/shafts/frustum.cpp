// SPDX-License-Identifier: MIT
/// Hulls of views, and of what casts shadows into them.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "shaftcull/error.hpp"
#include "shaftcull/hull.hpp"
#include "shafts/view.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"

namespace shaftcull {
namespace {

using Matrix = std::array<std::array<double, 4>, 4>;

/// Solves matrix · result = columns, by elimination with the largest pivots. Returns false for a matrix that is not
/// invertible.
bool invert(Matrix matrix, Matrix& inverse) noexcept {
  inverse = {};
  for (std::size_t i = 0; i != 4; ++i) inverse[i][i] = 1;
  for (std::size_t c = 0; c != 4; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r != 4; ++r) {
      if (std::fabs(matrix[r][c]) > std::fabs(matrix[pivot][c])) pivot = r;
    }
    if (matrix[pivot][c] == 0) return false;
    std::swap(matrix[c], matrix[pivot]);
    std::swap(inverse[c], inverse[pivot]);
    const double scale = 1 / matrix[c][c];
    for (std::size_t k = 0; k != 4; ++k) {
      matrix[c][k] *= scale;
      inverse[c][k] *= scale;
    }
    for (std::size_t r = 0; r != 4; ++r) {
      if (r == c) continue;
      const double factor = matrix[r][c];
      for (std::size_t k = 0; k != 4; ++k) {
        matrix[r][k] -= factor * matrix[c][k];
        inverse[r][k] -= factor * inverse[c][k];
      }
    }
  }
  return true;
}

/// The coefficients of x, y, z and 1 in `z_share` · z + w_share · w of clip space.
std::array<double, 4> combined(const Matrix& matrix, double z_share, double w_share) noexcept {
  std::array<double, 4> sum{};
  for (std::size_t c = 0; c != 4; ++c) sum[c] = z_share * matrix[2][c] + w_share * matrix[3][c];
  return sum;
}

/// The four corners of a view at one depth of clip space: directions if it has no end there, else points.
std::array<Vec3, 4> corners_at(const Matrix& inverse, double depth, bool are_directions) {
  std::array<Vec3, 4> corners{};
  for (std::size_t i = 0; i != 4; ++i) {
    const std::array<double, 4> clip = {i % 2 == 0 ? -1.0 : 1.0, i / 2 == 0 ? -1.0 : 1.0, depth, 1};
    std::array<double, 4> world{};
    for (std::size_t r = 0; r != 4; ++r) {
      for (std::size_t c = 0; c != 4; ++c) world[r] += inverse[r][c] * clip[c];
    }
    if (!are_directions && !(world[3] > 0))
      kernel::fail(InvalidArgument("frustum: a corner is not in front of the eye"));
    const double length = std::max({std::fabs(world[0]), std::fabs(world[1]), std::fabs(world[2])});
    const double scale = are_directions ? length : world[3];
    for (std::size_t k = 0; k != 3; ++k) {
      corners[i][k] = static_cast<float>(world[k] / scale);
      if (!std::isfinite(corners[i][k])) kernel::fail(InvalidArgument("frustum: a corner is beyond all floats"));
    }
  }
  return corners;
}

ConvexHull frustum_of(std::span<const float, 16> floats, ClipDepth depth, HullTest test) {
  Matrix matrix{};
  for (std::size_t i = 0; i != 16; ++i) matrix[i / 4][i % 4] = floats[i];
  Matrix inverse{};
  if (!invert(matrix, inverse)) kernel::fail(InvalidArgument("frustum: the matrix is not invertible"));
  struct End {
    double depth;
    std::array<double, 4> plane;  // that cuts the view off there
  };
  const double least = depth == ClipDepth::zero_to_one ? 0 : -1;
  const End ends[2] = {{least, combined(matrix, 1, -least)}, {1, combined(matrix, -1, 1)}};
  std::array<Vec3, 8> vertex{};
  std::size_t points = 0;
  for (const bool are_directions : {false, true}) {  // points first
    for (const End& end : ends) {
      const bool is_open = end.plane[0] == 0 && end.plane[1] == 0 && end.plane[2] == 0;
      if (is_open != are_directions) continue;
      const std::array<Vec3, 4> corners = corners_at(inverse, end.depth, are_directions);
      std::copy(corners.begin(), corners.end(), vertex.data() + (are_directions ? 4 : points));
      if (!are_directions) points += 4;
    }
  }
  if (points == 0) kernel::fail(InvalidArgument("frustum: the view has no end, neither near nor far"));
  return ConvexHull(std::span(vertex).first(points), std::span(vertex).subspan(points), test);
}

/// Throws unless a call can add a vertex, the light or the direction called `what`, to a view.
void require_extensible(const char* call, const ConvexHull& view, const char* what, const Vec3& added) {
  const auto refuse = [&](const std::string& why) { kernel::fail(InvalidArgument(std::string(call) + ": " + why)); };
  if (view.points().empty()) refuse("the view was never formed, or was moved from");
  for (std::size_t k = 0; k != 3; ++k) {
    if (!std::isfinite(added[k]))
      refuse(std::string(what) + "." + "xyz"[k] + " = " + kernel::text(added[k]) + " is not finite");
  }
  const std::size_t vertices = view.points().size() + view.directions().size();
  if (vertices == ConvexHull::max_vertices) {
    refuse("the view has " + std::to_string(vertices) + " points and directions, and with " + what +
           " one more than a hull can have");
  }
}

}  // namespace

ConvexHull frustum(std::span<const float, 16> matrix, ClipDepth depth, HullTest test) {
  static_cast<void>(kernel::planes_of_view("frustum", matrix, depth));  // throws unless the matrix shows anything
  return kernel::in_float_environment([&] { return frustum_of(matrix, depth, test); });
}

ConvexHull casters(const ConvexHull& view, const Vec3& light) {
  kernel::in_float_environment([&] { require_extensible("casters", view, "light", light); });
  return {view, light, false};
}

ConvexHull casters_towards(const ConvexHull& view, const Vec3& towards_sun) {
  kernel::in_float_environment([&] {  // where denormals are not 0
    require_extensible("casters_towards", view, "towards_sun", towards_sun);
    if (towards_sun == Vec3{0, 0, 0}) {
      kernel::fail(InvalidArgument("casters_towards: towards_sun is zero; it must be a direction"));
    }
  });
  return {view, towards_sun, true};
}

}  // namespace shaftcull
