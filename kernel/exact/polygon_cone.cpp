// SPDX-License-Identifier: MIT
#include "exact/polygon_cone.hpp"

#include <algorithm>
#include <cstddef>

#include "exact/orientation.hpp"

namespace shaftcull::kernel {
namespace {

bool has_area(const NearPlane& plane) noexcept {
  return plane.normal(0) != 0 || plane.normal(1) != 0 || plane.normal(2) != 0;
}

/// The number of the corner with which the first corner and the one before form a triangle with an area; their number
/// if there is none.
std::size_t first_triangle(std::span<const Vec3> points) noexcept {
  std::size_t i = 2;
  while (i < points.size() && !has_area(NearPlane(points[0], points[i - 1], points[i]))) ++i;
  return i;
}

}  // namespace

bool is_flat(std::span<const Vec3> points) noexcept {
  const std::size_t i = first_triangle(points);
  if (i >= points.size()) return true;
  const NearPlane plane(points[0], points[i - 1], points[i]);
  return std::all_of(points.begin(), points.end(), [&](const Vec3& x) { return plane.side(x) == 0; });
}

bool PolygonCone::begin(std::span<const Vec3> polygon, std::span<const Vec3> back, bool is_flat,
                        std::span<const Vec3> end, EndPoints counting) {
  planes_.clear();
  face_.clear();
  if (!is_flat) {
    is_sufficient_ = true;
    face_.reserve(polygon.size() + back.size());
    if (add_bent(polygon, end) && (back.empty() || add_bent(back, end))) return true;
    planes_.clear();
    face_.clear();
  }
  return begin_flat(polygon, is_flat, end, counting);
}

/// Adds the planes of a bent polygon, of which each triangle has the end strictly on the same side. Otherwise returns
/// false.
bool PolygonCone::add_bent(std::span<const Vec3> polygon, std::span<const Vec3> end) {
  int side = 0;
  for (std::size_t i = 2; i != polygon.size(); ++i) {
    NearPlane face(polygon[0], polygon[i - 1], polygon[i]);
    if (!has_area(face)) return false;
    for (const Vec3& x : end) {
      const int of_x = face.side(x);
      if (of_x == 0 || of_x == -side) return false;
      side = of_x;
    }
    if (side < 0) face = NearPlane(polygon[0], polygon[i], polygon[i - 1]);
    face_.push_back(face);
    const auto& at = face_.back().points();
    planes_.push_back({at[0], at[1], at[2], &face_.back(), true});
  }
  for (std::size_t p = 0; p != polygon.size(); ++p) {
    const Vec3& from = polygon[p];
    const Vec3& to = polygon[p + 1 == polygon.size() ? 0 : p + 1];
    side > 0 ? add_edge(from, to, end) : add_edge(to, from, end);
  }
  return true;
}

bool PolygonCone::begin_flat(std::span<const Vec3> polygon, bool is_flat, std::span<const Vec3> end,
                             EndPoints counting) {
  const std::size_t i = first_triangle(polygon);
  if (i >= polygon.size()) return false;
  face_.emplace_back(polygon[0], polygon[i - 1], polygon[i]);
  bool any_in_front = false;
  bool any_behind = false;
  bool any_on = false;
  for (const Vec3& x : end) {
    const int side = face_[0].side(x);
    any_in_front |= side > 0;
    any_behind |= side < 0;
    any_on |= side == 0;
  }
  if (any_in_front == any_behind || (any_on && counting == EndPoints::all)) return false;
  if (any_behind) face_[0] = NearPlane(polygon[0], polygon[i], polygon[i - 1]);
  is_sufficient_ = is_flat && !any_on;
  const auto& at = face_[0].points();
  planes_.push_back({at[0], at[1], at[2], &face_[0], true});
  for (std::size_t p = 0; p != polygon.size(); ++p) {
    const Vec3& from = polygon[p];
    const Vec3& to = polygon[p + 1 == polygon.size() ? 0 : p + 1];
    if (from == to) continue;
    any_in_front ? add_edge(from, to, end) : add_edge(to, from, end);
  }
  return true;
}

/// Every corner's plane is needed; that of the farthest one implies the others, if all corners are in front.
void PolygonCone::add_edge(const Vec3& from, const Vec3& to, std::span<const Vec3> end) {
  const Vec3* farthest = nullptr;
  bool takes_in_end = is_sufficient_;
  for (const Vec3& x : end) {
    if (!is_sufficient_ && face_[0].side(x) <= 0) continue;
    if (farthest == nullptr) {
      farthest = &x;
      continue;
    }
    const int side = side_of(plane_of(from, to, *farthest), x);
    takes_in_end = takes_in_end && side == 0;
    if (side > 0) farthest = &x;
  }
  if (farthest != nullptr) planes_.push_back({from, to, *farthest, nullptr, takes_in_end});
}

}  // namespace shaftcull::kernel
