// SPDX-License-Identifier: MIT
#include "patch_outlines.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

namespace shaftcull::cli {
namespace {

/// A flat box, in the plane across an axis.
struct FlatBox {
  Box box;
  std::size_t axis;

  [[nodiscard]] std::size_t u() const noexcept { return (axis + 1) % 3; }
  [[nodiscard]] std::size_t v() const noexcept { return (axis + 2) % 3; }
  /// Its corners, counter-clockwise as seen from where the axis points to.
  [[nodiscard]] std::array<Vec3, 4> corners() const noexcept {
    std::array<Vec3, 4> corners{box.lo, box.lo, box.hi, box.hi};
    corners[1][u()] = box.hi[u()];
    corners[3][u()] = box.lo[u()];
    return corners;
  }
};

std::optional<FlatBox> flat_box(const Box& box) noexcept {
  std::optional<FlatBox> flat;
  for (std::size_t k = 0; k != 3; ++k) {
    if (box.lo[k] != box.hi[k]) continue;
    if (flat) return std::nullopt;
    flat = FlatBox{box, k};
  }
  return flat;
}

/// Half of a flat box, which has three of its corners.
struct HalfOfBox {
  FlatBox of;
  std::size_t missing;  ///< which of the corners the half has not
  bool faces_up;        ///< where the axis points to
};

std::optional<HalfOfBox> half_of_box(const MeshTriangle& triangle) noexcept {
  const std::optional<FlatBox> flat = flat_box(triangle.box);
  if (!flat) return std::nullopt;
  const std::array<Vec3, 4> corners = flat->corners();
  std::array<std::size_t, 3> which{};
  for (std::size_t i = 0; i != 3; ++i) {
    const auto corner = std::find(corners.begin(), corners.end(), triangle.vertex[i]);
    if (corner == corners.end()) return std::nullopt;
    which[i] = static_cast<std::size_t>(corner - corners.begin());
  }
  if (which[0] == which[1] || which[1] == which[2] || which[2] == which[0]) return std::nullopt;
  const std::size_t missing = 6 - which[0] - which[1] - which[2];
  // The steps from each to the next are one turn if they are counter-clockwise, two if they are clockwise.
  std::size_t steps = 0;
  for (std::size_t i = 0; i != 3; ++i) steps += (which[(i + 1) % 3] + 4 - which[i]) % 4;
  return HalfOfBox{*flat, missing, steps == 4};
}

/// Which triangles are halves of rectangles across an axis whose other halves are there.
std::vector<bool> are_of_rectangles(std::span<const MeshTriangle> triangles) {
  using Key = std::array<float, 7>;
  const auto key_of = [](const HalfOfBox& half) {
    const Box& box = half.of.box;
    return Key{box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2], half.faces_up ? 1.0F : -1.0F};
  };
  std::map<Key, std::array<bool, 4>> missing;
  for (const MeshTriangle& triangle : triangles) {
    if (const auto half = half_of_box(triangle)) missing[key_of(*half)][half->missing] = true;
  }
  std::vector<bool> are(triangles.size(), false);
  for (std::size_t i = 0; i != triangles.size(); ++i) {
    if (const auto half = half_of_box(triangles[i])) are[i] = missing[key_of(*half)][(half->missing + 2) % 4];
  }
  return are;
}

}  // namespace

PatchSet PatchOutlines::set_of(std::span<const std::uint32_t> some, PatchSides sides) const {
  std::vector<Vec3> some_corners;
  std::vector<std::size_t> some_first{0};
  for (const std::uint32_t patch : some) {
    some_corners.insert(some_corners.end(), corners.begin() + static_cast<std::ptrdiff_t>(first[patch]),
                        corners.begin() + static_cast<std::ptrdiff_t>(first[patch + 1]));
    some_first.push_back(some_corners.size());
  }
  return PatchSet(some_corners, some_first, sides);
}

PatchOutlines outlines_of(std::span<const MeshTriangle> triangles, std::span<const MeshPatch> patches,
                          std::span<const Box> boxes) {
  const std::vector<bool> is_of_rectangle = are_of_rectangles(triangles);
  const auto box_of = [&](std::size_t i) -> std::optional<FlatBox> {
    return is_of_rectangle[patches[i].triangle] ? flat_box(boxes[i]) : std::nullopt;
  };
  PatchOutlines outlines;
  for (std::size_t i = 0; i != patches.size(); ++i) {
    outlines.first.push_back(outlines.corners.size());
    if (const std::optional<FlatBox> flat = box_of(i)) {
      std::array<Vec3, 4> corners = flat->corners();
      if (!half_of_box(triangles[patches[i].triangle])->faces_up) std::swap(corners[1], corners[3]);
      outlines.corners.insert(outlines.corners.end(), corners.begin(), corners.end());
      continue;
    }
    outlines.are_boxes = false;
    for (const Point3& corner : patches[i].corner) {
      outlines.corners.push_back(
          {static_cast<float>(corner[0]), static_cast<float>(corner[1]), static_cast<float>(corner[2])});
    }
  }
  outlines.first.push_back(outlines.corners.size());
  return outlines;
}

}  // namespace shaftcull::cli
