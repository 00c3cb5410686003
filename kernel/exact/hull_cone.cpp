// SPDX-License-Identifier: MIT
#include "exact/hull_cone.hpp"

#include <algorithm>

#include "exact/orientation.hpp"

namespace shaftcull::kernel {

void HullCone::begin(const HullMesh& hull, std::span<const Vec3> end, EndPoints counting, float tolerance) {
  hull_ = &hull;
  end_ = end;
  counting_ = counting;
  tolerance_ = tolerance;
  planes_.clear();
  sides_.resize(hull.faces().size() * end.size());
  is_behind_.resize(hull.faces().size());
  for (std::size_t face = 0; face != hull.faces().size(); ++face) add_face(face);
}

/// The plane of a face, unless the end is behind it.
void HullCone::add_face(std::size_t face) {
  const NearPlane& plane = hull_->faces()[face];
  const bool all_count = counting_ == EndPoints::all;
  std::int8_t* const sides = &sides_[face * end_.size()];
  bool any_behind = false;
  bool any_on = false;
  bool any_in_front = false;
  for (std::size_t i = 0; i != end_.size(); ++i) {
    const int side = plane.side(end_[i]);
    sides[i] = static_cast<std::int8_t>(side);
    any_behind |= side < 0;
    any_on |= side == 0;
    any_in_front |= side > 0;
  }
  const bool is_behind = any_behind && !any_in_front && !(any_on && all_count);
  is_behind_[face] = is_behind ? 1 : 0;
  bool is_off = is_behind;
  if (is_behind && tolerance_ > 0) {
    const auto stays_behind = [&](const Vec3& x) { return plane.is_behind(x, tolerance_); };
    is_off = all_count ? std::all_of(end_.begin(), end_.end(), stays_behind)
                       : std::any_of(end_.begin(), end_.end(), stays_behind);
  }
  if (!is_off) planes_.push_back({plane.points()[0], plane.points()[1], plane.points()[2], &plane, true});
}

void HullCone::add_edges() {
  for (const HullMesh::Edge& edge : hull_->edges()) {
    if (is_behind_[edge.left] == is_behind_[edge.right]) continue;
    if (is_behind_[edge.right] != 0) {
      add_edge(edge.from, edge.to, edge.left, edge.right);
    } else {
      add_edge(edge.to, edge.from, edge.right, edge.left);
    }
  }
}

/// The plane through an edge and the corner of the end that is farthest around it. The edge runs counterclockwise
/// around face `front`, which the end is not behind, and clockwise around face `back`, which it is behind. If no corner
/// is in front of the former, its own plane is that plane.
void HullCone::add_edge(const Vec3& from, const Vec3& to, std::uint32_t front, std::uint32_t back) {
  const std::int8_t* const of_front = &sides_[front * end_.size()];
  const std::int8_t* const of_back = &sides_[back * end_.size()];
  const Vec3* farthest = nullptr;
  bool takes_in_end = true;
  for (std::size_t i = 0; i != end_.size(); ++i) {
    if (of_front[i] <= 0) {
      const bool is_in_line_with_edge = of_front[i] == 0 && of_back[i] == 0;
      takes_in_end = takes_in_end && is_in_line_with_edge;
      continue;
    }
    if (farthest == nullptr) {
      farthest = &end_[i];
      continue;
    }
    const int side = side_of(plane_of(from, to, *farthest), end_[i]);
    takes_in_end = takes_in_end && side == 0;
    if (side > 0) farthest = &end_[i];
  }
  if (farthest != nullptr) planes_.push_back({from, to, *farthest, nullptr, takes_in_end});
}

bool HullCone::hides(std::span<const Vec3> other) const noexcept {
  return std::all_of(planes_.begin(), planes_.end(), [&](const Plane& plane) { return is_behind(plane, other); });
}

bool HullCone::is_behind(const Plane& plane, std::span<const Vec3> other) const noexcept {
  const bool all_count = counting_ == EndPoints::all;
  const SpannedPlane through = plane_of(plane.p, plane.q, plane.r);
  const auto is_off = [&](const Vec3& x) { return plane.face->is_behind(x, tolerance_); };
  // Whether an end lies in a face is seldom a close decision, but which side of it such an end is on is.
  if (plane.face != nullptr && tolerance_ > 0 && std::none_of(other.begin(), other.end(), is_off)) return false;
  bool any_off = !plane.takes_in_end;
  for (const Vec3& x : other) {
    const int side = plane.face != nullptr ? plane.face->side(x) : side_of(through, x);
    if (side > 0) return false;
    if (any_off && !all_count) continue;
    const bool is_behind = side < 0 && (plane.face == nullptr || is_off(x));
    if (all_count && !is_behind) return false;
    any_off = any_off || is_behind;
  }
  return any_off;
}

bool are_in_front_of_a_face(const HullMesh& hull, std::span<const Vec3> points) noexcept {
  return std::any_of(hull.faces().begin(), hull.faces().end(), [&](const NearPlane& face) {
    return std::all_of(points.begin(), points.end(), [&](const Vec3& x) { return face.side(x) >= 0; });
  });
}

}  // namespace shaftcull::kernel
