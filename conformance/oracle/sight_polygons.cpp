// SPDX-License-Identifier: MIT
/// Scenes whose patches are polygons.
#include <algorithm>
#include <cmath>

#include "oracle/sight_scene.hpp"

namespace shaftcull {
namespace {

/// Draws polygons in place of boxes.
class PolygonPainter {
 public:
  PolygonPainter(const std::vector<Box>& boxes, Random& random) : boxes_(boxes), random_(random) {}

  std::vector<Vec3> polygon() {
    const unsigned kind = random_.below(8);
    std::vector<Vec3> corners;
    if (kind == 0) {  // points of one box: often a triangle in its face, or a line
      const Box& box = one();
      for (unsigned left = 3 + random_.below(3); left != 0; --left) {
        Vec3 corner = box.lo;
        for (std::size_t k = 0; k != 3; ++k) corner[k] = random_.one_in(2) ? box.hi[k] : corner[k];
        corners.push_back(corner);
      }
    } else if (kind == 1) {
      corners = side_of(one());
    } else {
      if (side_[0] == Vec3{} || random_.one_in(3)) {
        from_ = one().lo;
        for (Vec3& side : side_) side = extent();
      } else if (random_.one_in(2)) {  // in one plane with the one before, up to rounding
        from_ = at(random_.integer(-3, 3), random_.integer(-3, 3));
      }
      corners = in_plane(kind);
    }
    if (random_.one_in(10)) {
      Vec3& corner = corners[random_.below(static_cast<unsigned>(corners.size()))];
      for (float& x : corner) x = random_.one_in(2) ? random_.nudge(x) : x;
    }
    if (random_.one_in(3)) std::reverse(corners.begin(), corners.end());
    for (Vec3& corner : corners) {
      for (float& x : corner) x = std::clamp(x, -largest_float, largest_float);
    }
    return corners;
  }

  std::vector<Vec3> side_of(const Box& box) {
    const std::size_t axis = random_.below(3);
    const std::size_t i = (axis + 1) % 3;
    const std::size_t j = (axis + 2) % 3;
    std::vector<Vec3> corners(4, random_.one_in(2) ? box.lo : box.hi);
    for (const std::size_t c : {1U, 2U}) corners[c][i] = box.lo[i] == corners[c][i] ? box.hi[i] : box.lo[i];
    for (const std::size_t c : {2U, 3U}) corners[c][j] = box.lo[j] == corners[c][j] ? box.hi[j] : box.lo[j];
    for (Vec3& corner : corners) {
      for (float& x : corner) x = std::clamp(x, -largest_float, largest_float);
    }
    return corners;
  }

 private:
  const Box& one() { return boxes_[random_.below(static_cast<unsigned>(boxes_.size()))]; }
  /// The extent of one of the boxes, some of it the other way or 0.
  Vec3 extent() {
    const Box& box = one();
    Vec3 extent{};
    for (std::size_t k = 0; k != 3; ++k) {
      const float length = std::min(box.hi[k] - box.lo[k], largest_float);
      extent[k] = random_.one_in(4) ? 0 : random_.one_in(2) ? length : -length;
    }
    return extent;
  }
  Vec3 at(float s, float t) {
    Vec3 point{};
    for (std::size_t k = 0; k != 3; ++k) {
      const double x = double{from_[k]} + double{s} * double{side_[0][k]} + double{t} * double{side_[1][k]};
      point[k] = static_cast<float>(std::clamp(x, -double{largest_float}, double{largest_float}));
    }
    return point;
  }
  std::vector<Vec3> in_plane(unsigned kind) {
    if (kind < 4) return {at(0, 0), at(1, 0), at(0, 1)};
    if (kind < 6) return {at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
    if (kind == 6) return {at(0, 0), at(1, 0), at(2, 1), at(2, 2), at(1, 2), at(0, 1)};
    return {at(1, 0), at(2, 0), at(3, 1), at(3, 2), at(2, 3), at(1, 3), at(0, 2), at(0, 1)};
  }

  const std::vector<Box>& boxes_;
  Random& random_;
  Vec3 from_{};
  Vec3 side_[2]{};
};

}  // namespace

SightScene with_corners(SightScene scene, std::uint64_t seed, PolygonMix mix) {
  Random random(seed);
  const auto replace = [&](std::vector<Box>& boxes, std::vector<Plane>& planes,
                           std::vector<std::vector<Vec3>>& polygons) {
    if (boxes.empty()) return;
    PolygonPainter painter(boxes, random);
    std::vector<Box> around;
    const bool has_sides = mix == PolygonMix::sides_beside;
    const float plane = has_sides ? boxes[random.below(static_cast<unsigned>(boxes.size()))].lo[0] : 0;
    for (const Box& patch : boxes) {
      const bool is_side = has_sides && (patch.lo[0] > plane || random.one_in(2));
      polygons.push_back(is_side ? painter.side_of(patch) : painter.polygon());
      Box box{polygons.back().front(), polygons.back().front()};
      for (const Vec3& corner : polygons.back()) {
        for (std::size_t k = 0; k != 3; ++k) {
          box.lo[k] = std::min(box.lo[k], corner[k]);
          box.hi[k] = std::max(box.hi[k], corner[k]);
        }
      }
      around.push_back(box);
    }
    boxes = around;
    planes.clear();
  };
  const unsigned which = scene.is_of_one_set ? 0 : random.below(3);  // the first set, the second, or both
  if (which != 1) replace(scene.a, scene.a_planes, scene.a_corners);
  if (which != 0) replace(scene.b, scene.b_planes, scene.b_corners);
  if (random.one_in(3)) {
    const Box& box = scene.a[random.below(static_cast<unsigned>(scene.a.size()))];
    scene.tolerance = std::fabs(box.hi[random.below(3)]) * (random.one_in(2) ? 0x1p-22F : 0.25F);
  }
  return scene;
}

}  // namespace shaftcull
