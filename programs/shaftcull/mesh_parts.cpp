// SPDX-License-Identifier: MIT
#include "mesh_parts.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "shaftcull/geometry.hpp"

namespace shaftcull::cli {
namespace {

/// Twice the centre, in doubles, where the sum of any two floats is finite.
double centre(const Box& box, std::size_t axis) {
  return static_cast<double>(box.lo[axis]) + static_cast<double>(box.hi[axis]);
}

/// Divides the triangles of one object.
class Divider {
 public:
  Divider(std::span<MeshTriangle> triangles, std::size_t most, std::vector<MeshPart>& parts)
      : triangles_(triangles), most_(most), parts_(parts), first_part_(parts.size()) {}

  /// `chosen` are positions among the object's triangles, in any order.
  void divide(std::span<std::uint32_t> chosen) {
    if (chosen.size() <= most_) {
      add_part(chosen);
      return;
    }
    const std::size_t axis = widest_axis(chosen);
    const auto middle = static_cast<std::ptrdiff_t>(chosen.size() / 2);
    // Equal centres go by position, so that every standard library finds the same halves.
    std::nth_element(chosen.begin(), chosen.begin() + middle, chosen.end(), [&](std::uint32_t p, std::uint32_t q) {
      return std::tuple(centre(triangles_[p].box, axis), p) < std::tuple(centre(triangles_[q].box, axis), q);
    });
    divide(chosen.first(static_cast<std::size_t>(middle)));
    divide(chosen.subspan(static_cast<std::size_t>(middle)));
  }

 private:
  void add_part(std::span<const std::uint32_t> chosen) {
    const auto part = static_cast<std::uint32_t>(parts_.size());
    Box box = triangles_[chosen.front()].box;
    for (const std::uint32_t i : chosen) {
      box = joined(box, triangles_[i].box);
      triangles_[i].part = part;
    }
    parts_.push_back({box, triangles_.front().object, static_cast<std::uint32_t>(part - first_part_ + 1)});
  }

  std::size_t widest_axis(std::span<const std::uint32_t> chosen) const {
    std::size_t widest = 0;
    double width = -1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [least, most] =
          std::minmax_element(chosen.begin(), chosen.end(), [&](std::uint32_t p, std::uint32_t q) {
            return centre(triangles_[p].box, axis) < centre(triangles_[q].box, axis);
          });
      const double spread = centre(triangles_[*most].box, axis) - centre(triangles_[*least].box, axis);
      if (spread > width) {
        widest = axis;
        width = spread;
      }
    }
    return widest;
  }

  std::span<MeshTriangle> triangles_;
  std::size_t most_;
  std::vector<MeshPart>& parts_;
  std::size_t first_part_;
};

}  // namespace

std::vector<MeshPart> divide_into_parts(std::span<MeshTriangle> triangles, std::size_t most) {
  std::vector<MeshPart> parts;
  std::vector<std::uint32_t> chosen;
  while (!triangles.empty()) {
    const std::uint32_t object = triangles.front().object;
    const auto end = std::find_if(triangles.begin(), triangles.end(),
                                  [&](const MeshTriangle& triangle) { return triangle.object != object; });
    const auto count = static_cast<std::size_t>(end - triangles.begin());
    chosen.resize(count);
    std::iota(chosen.begin(), chosen.end(), std::uint32_t{0});
    Divider(triangles.first(count), most, parts).divide(chosen);
    triangles = triangles.subspan(count);
  }
  return parts;
}

}  // namespace shaftcull::cli
