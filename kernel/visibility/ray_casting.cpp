// SPDX-License-Identifier: MIT
#include "visibility/ray_casting.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "dispatch/active_kernels.hpp"
#include "shaftcull/geometry.hpp"

namespace shaftcull::kernel {
namespace {

/// Powers of 1 by the root of x³ = x + 1, and of x⁵ = x + 1: multiples of them fill two and four dimensions evenly.
/// M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018.
constexpr std::array<double, 2> steps_of_two{0.7548776662466927, 0.5698402909980532};
constexpr std::array<double, 4> steps_of_four{0.8566748838545029, 0.733891856627126, 0.6287067210378087,
                                              0.5385972572236101};

/// S. Vigna's splitmix64.
std::uint64_t mixed(std::uint64_t x) noexcept {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

/// A float from 0 to below 1.
float fraction(double x) noexcept { return static_cast<float>(std::floor((x - std::floor(x)) * 0x1p24) * 0x1p-24); }

/// What rounding may do to a ray. Its ends, which are as precise as distances are, lie in a plane within so much; and
/// corners that are given are rounded by half of the step of coordinates.
float rounding_of(const Box& around, float largest_coordinate) noexcept {
  float extent = 0;
  for (std::size_t k = 0; k != 3; ++k) extent = std::max(extent, around.hi[k] - around.lo[k]);
  return std::max(extent * 0x1p-19F, largest_coordinate * 0x1p-22F);
}

/// Of these rays, those neither of whose ends is_near(point), which is relative to the packet's origin.
template <class IsNear>
std::uint64_t away_from_ends(const RayPacket& packet, std::uint64_t rays, const IsNear& is_near) noexcept {
  std::uint64_t away = 0;
  for (; rays != 0; rays &= rays - 1) {
    const auto ray = static_cast<unsigned>(std::countr_zero(rays));
    Vec3 from{};
    Vec3 to{};
    for (std::size_t k = 0; k != 3; ++k) {
      from[k] = packet.from[k][ray];
      to[k] = from[k] + packet.way[k][ray];
    }
    if (!is_near(from) && !is_near(to)) away |= rays & (~rays + 1);
  }
  return away;
}

/// More than the diagonal of a box.
float beyond(const Box& around) noexcept {
  double square = 0;
  for (std::size_t k = 0; k != 3; ++k) {
    const double extent = double{around.hi[k]} - around.lo[k];
    square += extent * extent;
  }
  return square > 0 ? static_cast<float>(std::min(1.25 * std::sqrt(square), 0x1p126)) : 1;
}

}  // namespace

RayPoints::RayPoints(std::uint32_t rays, std::size_t dimensions) {
  const std::span<const double> steps =
      dimensions == 2 ? std::span<const double>(steps_of_two) : std::span<const double>(steps_of_four);
  for (std::size_t s = 0; s != steps.size(); ++s) {
    points_[s].reserve(rays);
    for (std::uint32_t i = 0; i != rays; ++i) points_[s].push_back(fraction(i * steps[s]));
  }
}

RayShift::RayShift(std::uint64_t seed, PatchPair pair) noexcept : of{} {
  std::uint64_t state = mixed(seed ^ mixed(std::uint64_t{pair.a} << 32 | pair.b));
  for (float& s : of) {
    state = mixed(state);
    s = static_cast<float>(state >> 40) * 0x1p-24F;
  }
}

RayTargets::RayTargets(const OccluderData& occluders, const Box& ends, float largest_end, float tolerance)
    : occluders_(occluders),
      shapes_(occluders.ray_shapes.of([&] { return RayShapes(occluders); })),
      kernels_(active_kernels().rays),
      margin_(std::max(
          tolerance, rounding_of(joined(ends, shapes_->around), std::max(largest_end, occluders.largest_coordinate)))),
      reach_(beyond(joined(ends, shapes_->around))) {}

std::uint64_t RayTargets::unmet(const RayPacket& packet, std::span<const std::uint32_t> occluders,
                                std::uint64_t asked) const {
  for (const std::uint32_t occluder : occluders) {
    if (asked == 0) break;
    asked &= ~meet(packet, occluder, asked);
  }
  return asked;
}

std::uint64_t RayTargets::meet(const RayPacket& packet, std::uint32_t occluder, std::uint64_t asked) const {
  const RayShapes::Shape& shape = shapes_->shapes[occluder];
  switch (shape.kind) {
    case RayShapes::Kind::nothing:
      return 0;
    case RayShapes::Kind::box:
      return meet_box(packet, occluders_.boxes[occluder].face, asked);
    case RayShapes::Kind::body:
      asked &= kernels_.meet_box(packet, occluders_.boxes[occluder].face, asked);
      return meet_body(packet, std::span(shapes_->planes).subspan(shape.first, shape.count), asked);
    case RayShapes::Kind::tree:
      return meet_tree(packet, shape.first, asked);
    case RayShapes::Kind::large_group:
      return shapes_->large_groups.meet(kernels_, packet, shape.first, margin_, asked);
  }
  return 0;
}

// A ray that has an end on a solid meets it if it comes further inside than the margin. Others meet all of it: so there
// are no gaps between solids that touch.
std::uint64_t RayTargets::meet_box(const RayPacket& packet, const float (&face)[8], std::uint64_t asked) const {
  asked &= kernels_.meet_box(packet, face, asked);
  if (asked == 0) return 0;
  float within[6];
  for (std::size_t k = 0; k != 3; ++k) {
    const float margin = std::min(margin_, (face[k + 3] - face[k]) / 4);
    within[k] = face[k] + margin;
    within[k + 3] = face[k + 3] - margin;
  }
  const std::uint64_t deep = asked & kernels_.meet_box(packet, within, asked);
  return deep | away_from_ends(packet, asked & ~deep, [&](const Vec3& point) {
           bool is_near = true;
           for (std::size_t k = 0; k != 3; ++k) {
             is_near = is_near && point[k] >= face[k] - packet.origin[k] - margin_ &&
                       point[k] <= face[k + 3] - packet.origin[k] + margin_;
           }
           return is_near;
         });
}

std::uint64_t RayTargets::meet_body(const RayPacket& packet, std::span<const RayPlane> planes,
                                    std::uint64_t asked) const {
  if (asked != 0) asked &= kernels_.meet_body(packet, planes.data(), planes.size(), 0, asked);
  if (asked == 0) return 0;
  const std::uint64_t deep = asked & kernels_.meet_body(packet, planes.data(), planes.size(), margin_, asked);
  return deep | away_from_ends(packet, asked & ~deep, [&](const Vec3& point) {
           return std::all_of(planes.begin(), planes.end(), [&](const RayPlane& plane) {
             float height = 0;
             for (std::size_t k = 0; k != 3; ++k) {
               height += plane.normal[k] * (point[k] - (plane.point[k] - packet.origin[k]));
             }
             return height <= margin_;
           });
         });
}

std::uint64_t RayTargets::meet_tree(const RayPacket& packet, std::uint32_t root, std::uint64_t asked) const {
  std::uint32_t waiting[64];  // a node a level, and there are at most 32 levels
  unsigned count = 0;
  waiting[count++] = root;
  std::uint64_t left = asked;
  while (count != 0 && left != 0) {
    const RayShapes::Node& node = shapes_->nodes[waiting[--count]];
    float around[6];
    for (std::size_t k = 0; k != 3; ++k) {
      around[k] = node.box.face[k] - margin_;
      around[k + 3] = node.box.face[k + 3] + margin_;
    }
    const std::uint64_t reaching = left & kernels_.meet_box(packet, around, left);
    if (reaching == 0) continue;
    if (node.count != 0) {
      left &= ~kernels_.meet_triangles(packet, &shapes_->triangles[node.first], node.count, margin_, reaching);
      continue;
    }
    waiting[count++] = node.first + 1;
    waiting[count++] = node.first;
  }
  return asked & ~left;
}

}  // namespace shaftcull::kernel
