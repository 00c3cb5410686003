// SPDX-License-Identifier: MIT
#include "shaftcull/solids.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "shaftcull/cull.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/hull.hpp"
#include "support/arguments.hpp"
#include "support/double3.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"
#include "visibility/corner_lists.hpp"

namespace shaftcull {
namespace {

using kernel::between;
using kernel::cross;
using kernel::dot;
using kernel::Double3;
using kernel::in_doubles;
using kernel::length;

bool contains(const Box& outer, const Box& inner) noexcept {
  for (std::size_t k = 0; k != 3; ++k) {
    if (inner.lo[k] < outer.lo[k] || inner.hi[k] > outer.hi[k]) return false;
  }
  return true;
}

/// Joins boxes that are alike on the two other axes and touch or overlap on this one. The result is sorted.
std::vector<Box> joined_along(std::vector<Box> boxes, std::size_t axis) {
  const std::size_t i = (axis + 1) % 3;
  const std::size_t j = (axis + 2) % 3;
  const auto section = [&](const Box& box) { return std::tie(box.lo[i], box.hi[i], box.lo[j], box.hi[j]); };
  std::sort(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    return std::tuple_cat(section(a), std::tie(a.lo[axis], a.hi[axis])) <
           std::tuple_cat(section(b), std::tie(b.lo[axis], b.hi[axis]));
  });
  std::vector<Box> joined;
  for (const Box& box : boxes) {
    if (!joined.empty() && section(joined.back()) == section(box) && box.lo[axis] <= joined.back().hi[axis]) {
      joined.back().hi[axis] = std::max(joined.back().hi[axis], box.hi[axis]);
    } else {
      joined.push_back(box);
    }
  }
  return joined;
}

/// Leaves out boxes that lie in another one. Sorted by lo x, a box can only lie in one that begins before it.
void drop_contained(std::vector<Box>& boxes) {
  const auto key = [](const Box& box) { return std::tie(box.lo, box.hi); };
  std::sort(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) { return key(a) < key(b); });
  boxes.erase(std::unique(boxes.begin(), boxes.end()), boxes.end());
  std::vector<Box> kept;
  std::vector<const Box*> open;  // those that reach as far as the box at hand
  for (const Box& box : boxes) {
    std::erase_if(open, [&](const Box* other) { return other->hi[0] < box.lo[0]; });
    const bool is_contained =
        std::any_of(open.begin(), open.end(), [&](const Box* other) { return contains(*other, box); });
    open.push_back(&box);
    if (!is_contained) kept.push_back(box);
  }
  // One that begins at the same x may come later.
  std::vector<Box> result;
  for (std::size_t b = 0; b != kept.size(); ++b) {
    bool is_contained = false;
    for (std::size_t c = b + 1; c != kept.size() && kept[c].lo[0] == kept[b].lo[0]; ++c) {
      is_contained |= contains(kept[c], kept[b]);
    }
    if (!is_contained) result.push_back(kept[b]);
  }
  boxes = std::move(result);
}

/// normal·p ≤ offset for all corners of a hull.
struct HullPlane {
  Double3 normal;
  double offset;
};

/// Planes through three of the corners that have all others on one side, within rounding.
std::vector<HullPlane> planes_of(std::span<const Vec3> corners, double size) {
  std::vector<HullPlane> planes;
  for (std::size_t a = 0; a != corners.size(); ++a) {
    for (std::size_t b = a + 1; b != corners.size(); ++b) {
      for (std::size_t c = b + 1; c != corners.size(); ++c) {
        Double3 n = cross(between(corners[a], corners[b]), between(corners[a], corners[c]));
        const double area = length(n);
        if (!(area > 1e-9 * size * size)) continue;
        for (double& x : n) x /= area;
        const auto at = [&](const Vec3& p) { return dot(n, in_doubles(p)); };
        const double offset = at(corners[a]);
        double least = 0;
        double largest = 0;
        for (const Vec3& p : corners) {
          least = std::min(least, at(p) - offset);
          largest = std::max(largest, at(p) - offset);
        }
        const double rounding = 1e-6 * size;
        if (largest <= rounding) planes.push_back({n, offset});
        if (least >= -rounding) planes.push_back({{-n[0], -n[1], -n[2]}, -offset});
      }
    }
  }
  return planes;
}

/// Half the box around `middle` of largest volume that lies within all planes, nearly: coordinate after coordinate is
/// made as large as the volume gains by it.
Double3 largest_half_extent(std::span<const HullPlane> planes, const Double3& middle) {
  std::vector<double> room(planes.size());
  for (std::size_t p = 0; p != planes.size(); ++p) {
    const HullPlane& plane = planes[p];
    room[p] = plane.offset - (plane.normal[0] * middle[0] + plane.normal[1] * middle[1] + plane.normal[2] * middle[2]);
  }
  // How far a box of these proportions can grow.
  const auto growth = [&](const Double3& half) {
    double least = 1e300;
    for (std::size_t p = 0; p != planes.size(); ++p) {
      double reach = 0;
      for (std::size_t k = 0; k != 3; ++k) reach += std::fabs(planes[p].normal[k]) * half[k];
      if (reach > 0) least = std::min(least, room[p] / reach);
    }
    return least;
  };
  const auto volume = [&](const Double3& half) {
    const double by = growth(half);
    return by * by * by * half[0] * half[1] * half[2];
  };
  Double3 best{1, 1, 1};
  double most = volume(best);
  constexpr std::size_t steps = 9;
  double step = 4;  // then its square root, and so on: the last one is 1.005
  for (std::size_t i = 0; i != steps; ++i, step = std::sqrt(step)) {
    for (bool has_gained = true; has_gained;) {
      has_gained = false;
      for (std::size_t k = 0; k != 3; ++k) {
        for (const double factor : {step, 1 / step}) {
          Double3 other = best;
          other[k] *= factor;
          if (const double gained = volume(other); gained > most * (1 + 1e-9)) {
            most = gained;
            best = other;
            has_gained = true;
          }
        }
      }
    }
  }
  const double by = growth(best);
  for (double& x : best) x *= by;
  return best;
}

Box box_inside(std::span<const Vec3> corners) {
  const Box around = kernel::box_around_corners(corners);
  // The hull may be a box as it is.
  const ConvexHull hull(corners);
  if (classify(hull, around) == Answer::inside) return around;
  const Box point{corners[0], corners[0]};
  Double3 middle{};
  double size = 0;
  for (std::size_t k = 0; k != 3; ++k) {
    for (const Vec3& corner : corners) middle[k] += corner[k] / static_cast<double>(corners.size());
    size = std::max(size, double{around.hi[k]} - around.lo[k]);
  }
  const std::vector<HullPlane> planes = planes_of(corners, size);
  if (planes.empty()) return point;
  const Double3 half = largest_half_extent(planes, middle);
  // In doubles it fits but for rounding: so make it smaller until the exact predicate says so.
  constexpr std::size_t tries = 10;
  double less = 0x1p-20;
  for (std::size_t i = 0; i != tries; ++i, less *= 4) {
    const double by = 1 - less;
    Box box{};
    bool is_box = true;
    for (std::size_t k = 0; k != 3; ++k) {
      box.lo[k] = static_cast<float>(middle[k] - by * half[k]);
      box.hi[k] = static_cast<float>(middle[k] + by * half[k]);
      is_box = is_box && half[k] > 0 && box.lo[k] <= box.hi[k];
    }
    if (!is_box) return point;
    if (classify(hull, box) == Answer::inside) return box;
  }
  return point;
}

std::vector<Box> merge(std::span<const Box> boxes) {
  kernel::require_memory("boxes", boxes, "boxes");
  for (std::size_t i = 0; i != boxes.size(); ++i) kernel::require_usable_box(boxes[i], "box", i);
  std::vector<Box> merged(boxes.begin(), boxes.end());
  for (Box& box : merged) {
    for (std::size_t k = 0; k != 3; ++k) {
      box.lo[k] += 0.0F;  // -0 and 0 are one coordinate
      box.hi[k] += 0.0F;
    }
  }
  drop_contained(merged);
  while (true) {
    // Along each axis apart, so that a wall that crosses another one does not keep it from being whole.
    std::vector<Box> larger = merged;
    for (std::size_t axis = 0; axis != 3; ++axis) {
      const std::vector<Box> joined = joined_along(merged, axis);
      larger.insert(larger.end(), joined.begin(), joined.end());
    }
    drop_contained(larger);
    if (larger == merged) return merged;
    merged = std::move(larger);
  }
}

}  // namespace

std::vector<Box> merged_boxes(std::span<const Box> boxes) {
  return kernel::in_float_environment([&] { return merge(boxes); });
}

Box inscribed_box(std::span<const Vec3> corners) {
  kernel::require_memory("corners", corners, "corners");
  if (corners.size() < 4 || corners.size() > ConvexHull::max_vertices) {
    kernel::fail(InvalidArgument("a solid hull has " + kernel::counted(corners.size(), "corner") + "; it takes 4 to " +
                                 std::to_string(ConvexHull::max_vertices)));
  }
  return kernel::in_float_environment([&] {
    for (std::size_t i = 0; i != corners.size(); ++i) {
      for (const float x : corners[i]) {
        if (!std::isfinite(x))
          kernel::fail(InvalidArgument("corner " + std::to_string(i) + " of a solid hull is not finite"));
      }
    }
    return box_inside(corners);
  });
}

}  // namespace shaftcull
