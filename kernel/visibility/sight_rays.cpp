// SPDX-License-Identifier: MIT
#include "visibility/sight_rays.hpp"

#include <algorithm>
#include <array>
#include <bit>
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

}  // namespace

SeenShare::SeenShare(const RayTally& tally, double mean_weight) noexcept : part(0), error(0) {
  if (tally.facing == 0) {  // nothing is known
    part = error = 1;
    return;
  }
  const double rays = tally.rays;
  const double mean = tally.weight / rays;
  const double mean_of_seen = tally.weight_of_seen / rays;
  const double variance = tally.square / rays - mean * mean;
  // One ray more may be the first that arrives, or does not.
  error = 1.0 / tally.facing;
  if (tally.seen == 0) return;
  part = static_cast<double>(tally.seen) / tally.facing;
  if (tally.seen == tally.facing || !(variance > 0) || !(mean_weight > 0) || !std::isfinite(variance)) return;
  const double covariance = tally.square_of_seen / rays - mean_of_seen * mean;
  const double slope = covariance / variance;
  part = std::clamp((mean_of_seen - slope * (mean - mean_weight)) / mean_weight, 0.0, 1.0);
  const double variance_of_seen = tally.square_of_seen / rays - mean_of_seen * mean_of_seen;
  const double left = std::max(0.0, variance_of_seen - slope * covariance);
  error = std::max(error / 4, std::sqrt(left / rays) / mean_weight);
}

RayPoints::RayPoints(std::uint32_t rays) {
  const std::uint32_t count = (rays + most_packet_rays - 1) / most_packet_rays * most_packet_rays;
  for (std::size_t s = 0; s != steps.size(); ++s) {
    points_[s].reserve(count);
    for (std::uint32_t i = 0; i != count; ++i) points_[s].push_back(fraction(i * steps[s]));
  }
}

SightRays::SightRays(const PatchTree& a, const PatchTree& b, const OccluderData& occluders, float tolerance,
                     std::uint32_t most_rays, std::uint64_t seed)
    : a_(a.ray_patches()),
      b_(b.ray_patches()),
      occluders_(occluders),
      shapes_(occluders.ray_shapes.of([&] { return RayShapes(occluders); })),
      kernels_(active_kernels().rays),
      margin_(std::max(tolerance, rounding_of(joined(joined(a_->around, b_->around), shapes_->around),
                                              std::max({a.largest_coordinate(), b.largest_coordinate(),
                                                        occluders.largest_coordinate})))),
      most_rays_((most_rays + 15) / 16 * 16),
      seed_(seed),
      points_(most_rays_) {}

SightRays::Shift SightRays::shift_of(PatchPair pair) const noexcept {
  Shift shift{};
  std::uint64_t state = mixed(seed_ ^ mixed(std::uint64_t{pair.a} << 32 | pair.b));
  for (float& s : shift.of) {
    state = mixed(state);
    s = static_cast<float>(state >> 40) * 0x1p-24F;
  }
  return shift;
}

void SightRays::cast_packet(PatchPair pair, const Shift& shift, std::span<const std::uint32_t> candidates,
                            std::uint32_t count, RayTally& tally) const {
  const float* points[4];
  for (std::size_t s = 0; s != 4; ++s) points[s] = points_.stream(s) + tally.rays;
  RayPacket packet;
  const std::uint64_t facing = kernels_.form(a_->patches[pair.a], b_->patches[pair.b], points, shift.of, count, packet);
  std::uint64_t left = facing;
  for (const std::uint32_t occluder : candidates) {
    if (left == 0) break;
    left &= ~meet(packet, occluder, left);
  }
  tally.rays += count;
  tally.facing += static_cast<std::uint32_t>(std::popcount(facing));
  tally.seen += static_cast<std::uint32_t>(std::popcount(left));
  for (std::uint64_t rays = facing; rays != 0; rays &= rays - 1) {
    const auto ray = static_cast<unsigned>(std::countr_zero(rays));
    const double weight = packet.weight[ray];
    tally.weight += weight;
    tally.square += weight * weight;
    if ((left >> ray & 1U) == 0) continue;
    tally.weight_of_seen += weight;
    tally.square_of_seen += weight * weight;
  }
}

std::uint64_t SightRays::meet(const RayPacket& packet, std::uint32_t occluder, std::uint64_t asked) const {
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

std::uint64_t SightRays::meet_tree(const RayPacket& packet, std::uint32_t root, std::uint64_t asked) const {
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
