// SPDX-License-Identifier: MIT
#include "plane_count.hpp"

namespace shaftcull::cli {
namespace {

bool apart(const Box& p, const Box& q) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (p.lo[axis] > q.hi[axis] || p.hi[axis] < q.lo[axis]) return true;
  }
  return false;
}

bool contains(const Box& outer, const Box& inner) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (inner.lo[axis] < outer.lo[axis] || inner.hi[axis] > outer.hi[axis]) return false;
  }
  return true;
}

/// The planes with a box's corner beyond them, one bit a plane, for the near corner and for the far corner.
struct BeyondMasks {
  unsigned near = 0;
  unsigned far = 0;
};

BeyondMasks beyond(std::span<const JoiningPlane> planes, const Box& box) {
  BeyondMasks masks;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const Plane& plane = planes[i].plane;
    float near = -plane.offset;
    float far = -plane.offset;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float n = plane.normal[axis];
      near += n * (n >= 0 ? box.lo[axis] : box.hi[axis]);
      far += n * (n >= 0 ? box.hi[axis] : box.lo[axis]);
    }
    masks.near |= static_cast<unsigned>(near > 0) << i;
    masks.far |= static_cast<unsigned>(far > 0) << i;
  }
  return masks;
}

/// For every set of planes: how many a test in this order looks at until it comes upon one of the set.
using TestsUntil = std::array<std::uint8_t, 1U << max_joining_planes>;

/// `planes` are in the order of the tests; the bit of a plane is its position in `numbering`.
TestsUntil tests_until(std::span<const JoiningPlane> planes, std::span<const JoiningPlane> numbering) {
  std::array<unsigned, max_joining_planes> bit{};
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (std::size_t j = 0; j < numbering.size(); ++j) {
      if (planes[i].red == numbering[j].red && planes[i].blue == numbering[j].blue) bit[i] = 1U << j;
    }
  }
  TestsUntil tests{};
  for (unsigned set = 0; set < (1U << planes.size()); ++set) {
    std::size_t looked_at = 0;
    while (looked_at < planes.size() && (set & bit[looked_at]) == 0) ++looked_at;
    tests[set] = static_cast<std::uint8_t>(looked_at < planes.size() ? looked_at + 1 : looked_at);
  }
  return tests;
}

}  // namespace

std::size_t PlaneCount::add(const Box& a, const Box& b, std::span<const Box> boxes) {
  // All orders hold the same planes, so a bound is tested once against each. What an order costs is then how many
  // planes it looks at until the first that decides.
  const Shaft unsorted(a, b, {.order = PlaneOrder::unsorted});
  std::array<TestsUntil, plane_orders.size()> tests;
  for (std::size_t order = 0; order < plane_orders.size(); ++order) {
    tests[order] = tests_until(Shaft(a, b, {.order = plane_orders[order]}).joining_planes(), unsorted.joining_planes());
  }
  bounds += boxes.size();
  for (const Box& box : boxes) {
    if (apart(box, unsorted.box())) continue;
    const BeyondMasks masks = beyond(unsorted.joining_planes(), box);
    ++outside_tests;
    for (std::size_t order = 0; order < plane_orders.size(); ++order)
      outside_plane_tests[order] += tests[order][masks.near];
    if (masks.near != 0) {
      ++culled_by_planes;
    } else if (contains(unsorted.box(), box)) {
      ++inside_tests;
      for (std::size_t order = 0; order < plane_orders.size(); ++order)
        inside_plane_tests[order] += tests[order][masks.far];
      inside += masks.far == 0 ? 1 : 0;
    }
  }
  return unsorted.joining_planes().size();
}

}  // namespace shaftcull::cli
