// SPDX-License-Identifier: MIT
#include "visibility/ray_casting.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "dispatch/active_kernels.hpp"
#include "shaftcull/geometry.hpp"

namespace shaftcull::kernel {
namespace {

/// Fractions of powers of the root of x⁵ = x + 1: their multiples fill four dimensions evenly. M. Roberts, "The
/// Unreasonable Effectiveness of Quasirandom Sequences", 2018.
constexpr std::array<double, 4> steps{0.8566748838545029, 0.733891856627126, 0.6287067210378087, 0.5385972572236101};

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

RayPoints::RayPoints(std::uint32_t rays) {
  const std::uint32_t count = (rays + most_packet_rays - 1) / most_packet_rays * most_packet_rays;
  for (std::size_t s = 0; s != steps.size(); ++s) {
    points_[s].reserve(count);
    for (std::uint32_t i = 0; i != count; ++i) points_[s].push_back(fraction(i * steps[s]));
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
    case RayShapes::Kind::box: {
      // What touches an end of a ray is left out of the box, but of no side more than a quarter.
      const float(&face)[8] = occluders_.boxes[occluder].face;
      float within[6];
      for (std::size_t k = 0; k != 3; ++k) {
        const float margin = std::min(margin_, (face[k + 3] - face[k]) / 4);
        within[k] = face[k] + margin;
        within[k + 3] = face[k + 3] - margin;
      }
      return kernels_.meet_box(packet, within, asked);
    }
    case RayShapes::Kind::body:
      asked &= kernels_.meet_box(packet, occluders_.boxes[occluder].face, asked);
      return asked == 0 ? 0 : kernels_.meet_body(packet, &shapes_->planes[shape.first], shape.count, margin_, asked);
    case RayShapes::Kind::tree:
      return meet_tree(packet, shape.first, asked);
  }
  return 0;
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
