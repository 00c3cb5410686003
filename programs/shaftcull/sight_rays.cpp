// SPDX-License-Identifier: MIT
#include "sight_rays.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace shaftcull::cli {
namespace {

/// What is nearer to an end of a ray than this share of it is what the end lies on.
constexpr double end_of_ray = 1e-9;

/// Fractions of powers of the root of x⁵ = x + 1: their multiples fill four dimensions evenly. M. Roberts, "The
/// Unreasonable Effectiveness of Quasirandom Sequences", 2018.
constexpr std::array<double, 4> steps{0.8566748838545029, 0.733891856627126, 0.6287067210378087, 0.5385972572236101};

/// S. Vigna's splitmix64.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

double inner(const Point3& p, const Point3& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

Point3 outer(const Point3& p, const Point3& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

Point3 way_between(const Point3& from, const Point3& to) { return {to[0] - from[0], to[1] - from[1], to[2] - from[2]}; }

/// A point of a triangle; equally likely everywhere if u and v are in [0, 1). The square is folded along its diagonal,
/// which keeps neighbours together.
Point3 point_of(const MeshPatch& patch, double u, double v) {
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  Point3 point{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double start = patch.corner[0][axis];
    point[axis] = start + u * (patch.corner[1][axis] - start) + v * (patch.corner[2][axis] - start);
  }
  return point;
}

Point3 facing_of(const MeshPatch& patch) {
  return outer(way_between(patch.corner[0], patch.corner[1]), way_between(patch.corner[0], patch.corner[2]));
}

bool passes_box(const Point3& lo, const Point3& hi, const Point3& from, const Point3& way) {
  double enter = 0;
  double leave = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0) {
      if (from[axis] < lo[axis] || from[axis] > hi[axis]) return false;
      continue;
    }
    const double to_lo = (lo[axis] - from[axis]) / way[axis];
    const double to_hi = (hi[axis] - from[axis]) / way[axis];
    enter = std::max(enter, std::min(to_lo, to_hi));
    leave = std::min(leave, std::max(to_lo, to_hi));
  }
  // Rounding may part what meets in a point: a flat box has both at the same place.
  return enter <= leave + end_of_ray;
}

}  // namespace

void SightRays::add_occluder(std::span<const MeshTriangle> mesh, std::span<const std::uint32_t> triangles) {
  RayOccluder occluder{in_doubles(mesh[triangles.front()].box.lo), in_doubles(mesh[triangles.front()].box.hi), 0};
  for (const std::uint32_t i : triangles) {
    const MeshTriangle& triangle = mesh[i];
    const Point3 start = in_doubles(triangle.vertex[0]);
    triangles_.push_back(
        {start,
         {way_between(start, in_doubles(triangle.vertex[1])), way_between(start, in_doubles(triangle.vertex[2]))},
         i});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      occluder.lo[axis] = std::min(occluder.lo[axis], double{triangle.box.lo[axis]});
      occluder.hi[axis] = std::max(occluder.hi[axis], double{triangle.box.hi[axis]});
    }
  }
  occluder.end = triangles_.size();
  occluders_.push_back(occluder);
}

bool SightRays::is_hit(const RayOccluder& occluder, std::size_t first, const Point3& from, const Point3& way,
                       const MeshPatch& a, const MeshPatch& b) const {
  if (!passes_box(occluder.lo, occluder.hi, from, way)) return false;
  for (std::size_t i = first; i < occluder.end; ++i) {
    // T. Möller and B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.
    const RayTriangle& triangle = triangles_[i];
    if (triangle.number == a.triangle || triangle.number == b.triangle) continue;
    const Point3 across = outer(way, triangle.edge[1]);
    const double volume = inner(triangle.edge[0], across);
    if (volume == 0) continue;
    const Point3 to_start = way_between(triangle.vertex, from);
    const double u = inner(to_start, across) / volume;
    if (!(u >= 0 && u <= 1)) continue;
    const Point3 along = outer(to_start, triangle.edge[0]);
    const double v = inner(way, along) / volume;
    if (!(v >= 0 && u + v <= 1)) continue;
    const double t = inner(triangle.edge[1], along) / volume;
    if (t > end_of_ray && t < 1 - end_of_ray) return true;
  }
  return false;
}

std::uint32_t SightRays::seen(std::span<const MeshPatch> patches, std::uint32_t a, std::uint32_t b,
                              std::span<const std::uint32_t> occluders) const {
  const MeshPatch& from = patches[a];
  const MeshPatch& to = patches[b];
  const Point3 from_front = facing_of(from);
  const Point3 to_front = facing_of(to);
  std::array<double, 4> shift{};
  std::uint64_t state = mixed(seed_ ^ mixed(std::uint64_t{a} << 32 | b));
  for (double& s : shift) {
    state = mixed(state);
    s = static_cast<double>(state >> 11) * 0x1p-53;
  }
  std::uint32_t count = 0;
  std::size_t last_hit = 0;  // most rays of a pair meet the same occluder
  for (std::uint32_t ray = 0; ray < rays_; ++ray) {
    std::array<double, 4> at{};
    for (std::size_t k = 0; k < at.size(); ++k) {
      const double x = shift[k] + ray * steps[k];
      at[k] = x - std::floor(x);
    }
    const Point3 start = point_of(from, at[0], at[1]);
    const Point3 way = way_between(start, point_of(to, at[2], at[3]));
    if (!sides_ && !(inner(from_front, way) > 0 && inner(to_front, way) < 0)) continue;
    bool hit = false;
    for (std::size_t i = 0; i < occluders.size() && !hit; ++i) {
      const std::size_t candidate = (last_hit + i) % occluders.size();
      const std::uint32_t number = occluders[candidate];
      hit = is_hit(occluders_[number], number == 0 ? 0 : occluders_[number - 1].end, start, way, from, to);
      if (hit) last_hit = candidate;
    }
    if (!hit) ++count;
  }
  return count;
}

}  // namespace shaftcull::cli
