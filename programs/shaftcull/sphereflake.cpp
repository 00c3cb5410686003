// SPDX-License-Identifier: MIT
#include "sphereflake.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "workers.hpp"

namespace shaftcull::cli {
namespace {

constexpr std::size_t children = 9;
constexpr std::size_t spheres_per_chunk = 2048;

Vec3 sum(const Vec3& p, const Vec3& q) { return {p[0] + q[0], p[1] + q[1], p[2] + q[2]}; }
Vec3 scaled(const Vec3& p, float s) { return {p[0] * s, p[1] * s, p[2] * s}; }
Vec3 cross(const Vec3& p, const Vec3& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

/// How a sphere stands: its pole and a direction of its equator, both of unit length.
struct Stance {
  Vec3 pole;
  Vec3 equator;
};

/// A direction in a stance: cos(elevation) (cos(azimuth) e + sin(azimuth) (pole × e)) + sin(elevation) pole.
struct Direction {
  float along_equator;
  float across;
  float along_pole;
};

std::array<Direction, children> child_directions() {
  using std::numbers::pi;
  std::array<Direction, children> directions{};
  // Elevation of the upper three in the closest packing of spheres: sin² = 2/3.
  const double up = std::sqrt(2.0 / 3.0);
  const double out = std::sqrt(1.0 / 3.0);
  for (std::size_t i = 0; i < children; ++i) {
    const bool upper = i >= 6;
    const double azimuth = upper ? pi / 6 + static_cast<double>(i - 6) * 2 * pi / 3 : static_cast<double>(i) * pi / 3;
    const double level = upper ? out : 1.0;
    directions[i] = {static_cast<float>(level * std::cos(azimuth)), static_cast<float>(level * std::sin(azimuth)),
                     static_cast<float>(upper ? up : 0.0)};
  }
  return directions;
}

Vec3 resolve(const Stance& stance, const Direction& d) {
  return sum(sum(scaled(stance.equator, d.along_equator), scaled(cross(stance.pole, stance.equator), d.across)),
             scaled(stance.pole, d.along_pole));
}

/// The stance of a child that sits at `outwards`: its equator starts in the plane of its parent's pole.
Stance child_stance(const Vec3& outwards, const Vec3& parent_pole) {
  const Vec3 side = cross(parent_pole, outwards);
  const float length = std::sqrt(side[0] * side[0] + side[1] * side[1] + side[2] * side[2]);
  return {outwards, scaled(side, 1 / length)};
}

}  // namespace

Sphereflake::Sphereflake(std::size_t count) {
  const auto directions = child_directions();
  // The children of sphere i are spheres 9 i + 1 … 9 i + 9: no tree needs to be kept, only stances of those with
  // children.
  at_rest_.resize(count);
  std::vector<Stance> stances(count / children + 1);
  at_rest_[0] = {{0, 0, 0}, 1};
  stances[0] = {{0, 0, 1}, {1, 0, 0}};
  for (std::size_t i = 1; i < count; ++i) {
    const std::size_t parent = (i - 1) / children;
    const Stance& stance = stances[parent];
    const Vec3 outwards = resolve(stance, directions[(i - 1) % children]);
    const float radius = at_rest_[parent].radius / 3;
    at_rest_[i] = {sum(at_rest_[parent].centre, scaled(outwards, at_rest_[parent].radius + radius)), radius};
    if (i < stances.size()) stances[i] = child_stance(outwards, stance.pole);
  }
  stream_ = SphereStream(at_rest_);
}

void Sphereflake::use_tree() {
  SphereTree tree{std::span<const Sphere>(at_rest_)};
  stream_ = SphereStream();
  // Everything moves, so the spheres are kept as the tree keeps them.
  moved_.swap(at_rest_);
  at_rest_.clear();
  for (const std::uint32_t i : tree.order()) at_rest_.push_back(moved_[i]);
  tree.reorder();
  trees_.use(std::move(tree));
}

void Sphereflake::move_to(double time) {
  constexpr double turn_per_second = 0.3;
  const double angle = turn_per_second * time;
  const auto size = static_cast<float>(1.0 + 0.05 * std::sin(2.0 * time));
  const auto c = static_cast<float>(std::cos(angle)) * size;
  const auto s = static_cast<float>(std::sin(angle)) * size;
  const auto moved = [&](const Sphere& sphere) {
    const auto& [p, radius] = sphere;
    return Sphere{{c * p[0] - s * p[1], s * p[0] + c * p[1], size * p[2]}, size * radius};
  };
  if (trees_.in_use()) {
    Workers::for_chunks(at_rest_.size(), spheres_per_chunk, [&](std::size_t first, std::size_t count) {
      for (std::size_t i = first; i < first + count; ++i) moved_[i] = moved(at_rest_[i]);
    });
    trees_.updated().update(std::span<const Sphere>(moved_));
    return;
  }
  Workers::for_chunks(at_rest_.size(), spheres_per_chunk, [&](std::size_t first, std::size_t count) {
    std::array<Sphere, spheres_per_chunk> some;
    for (std::size_t i = 0; i < count; ++i) some[i] = moved(at_rest_[first + i]);
    stream_.update(first, std::span<const Sphere>(some.data(), count));
  });
}

void Sphereflake::place_shafts(double time, std::span<Box> a, std::span<Box> b) const {
  using std::numbers::pi;
  constexpr std::size_t lights = 8;
  const std::size_t tiles = (a.size() + lights - 1) / lights;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double light = 2 * pi * static_cast<double>(i % lights) / lights - 0.2 * time;
    a[i] = box_around({static_cast<float>(2.5 * std::cos(light)), static_cast<float>(2.5 * std::sin(light)), 3.0F},
                      {0.2F, 0.2F, 0.0F});
    const std::size_t place = i / lights;
    const double tile = 2 * pi * static_cast<double>(place) / static_cast<double>(tiles) + 0.1 * time;
    b[i] = box_around({static_cast<float>(1.2 * std::cos(tile)), static_cast<float>(1.2 * std::sin(tile)), -2.2F},
                      {0.15F, 0.15F, 0.0F});
  }
}

}  // namespace shaftcull::cli
